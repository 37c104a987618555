/* The three coordinates of a point in one register, with a fourth lane that is to be kept from mattering. */
#ifndef ACCEL_AXES_H
#define ACCEL_AXES_H

#include "geom/vec.h"

#include <stdbool.h>
#include <stdint.h>

typedef double axes __attribute__((vector_size(32)));
typedef int64_t axes_mask __attribute__((vector_size(32)));
typedef int32_t axes_int __attribute__((vector_size(16)));

/* Inlined always: how a function takes vectors would depend on the processor compiled for; hence -Wno-psabi in the Makefile. */
#define INLINED static inline __attribute__((always_inline))

INLINED axes axes_of(struct vec v, double fourth)
{
	return (axes){ v.x, v.y, v.z, fourth };
}

INLINED axes axes_all(double x)
{
	return (axes){ x, x, x, x };
}

/* Whether any lane is set. */
INLINED bool axes_any(axes_mask m)
{
	return (m[0] | m[1] | m[2] | m[3]) != 0;
}

INLINED axes_int axes_narrow(axes_mask m)
{
	return __builtin_convertvector(m, axes_int);
}

/* Lane by lane p where m is set, else q. */
INLINED axes axes_pick(axes_mask m, axes p, axes q)
{
	return (axes)((m & (axes_mask)p) | (~m & (axes_mask)q));
}

INLINED axes_int axes_pick_int(axes_int m, axes_int i, axes_int k)
{
	return (m & i) | (~m & k);
}

INLINED axes_int axes_clamp(axes_int i, axes_int low, axes_int high)
{
	i = axes_pick_int(i < low, low, i);
	return axes_pick_int(i > high, high, i);
}

#endif
