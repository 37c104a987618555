/* Numbers as text. */
#ifndef IO_NUMBER_H
#define IO_NUMBER_H

#include "io/text.h"

/* Append x with this many significant digits as %g does; from 15 digits on the fewest of 15 to 17 that read back as the same double. */
void number_write(struct text *out, double x, int digits);

/* n numbers, 'before' in front of the first and 'between' between them. */
void number_write_row(struct text *out, const char *before, const double *x, int n, const char *between, int digits);

#endif
