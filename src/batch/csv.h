/* Lines of comma-separated values as RFC 4180 writes them, ended by a line feed. */
#ifndef BATCH_CSV_H
#define BATCH_CSV_H

#include "io/text.h"

/* Append one field, quoted where it must be; a comma first unless it is the line's first. */
void csv_add(struct text *line, const char *field, bool first);

/* Copy field number 'index' of a line (up to its newline or NUL) into out[size], unquoted. False when there are fewer fields. */
bool csv_field(const char *line, int index, char *out, size_t size);

#endif
