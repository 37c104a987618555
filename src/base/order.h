/* Putting numbers in order. */
#ifndef BASE_ORDER_H
#define BASE_ORDER_H

#include <stddef.h>

/* Sort v[n] ascending, -0 before +0; no NaN. spare[n]: room to work in. Time grows with n alone (radix sort by bytes). */
void reals_sort(double *v, double *spare, size_t n);

#endif
