/* Four floats at once, on every machine; boxes and their unions. */
#ifndef ACCEL_QUAD_H
#define ACCEL_QUAD_H

#include <math.h>
#include <stdint.h>

typedef float quad __attribute__((vector_size(16)));
typedef int32_t quad_int __attribute__((vector_size(16)));

static inline quad quad_min(quad a, quad b)
{
#ifdef __SSE2__
	return __builtin_ia32_minps(a, b);
#else
	quad_int m = a < b;
	return (quad)(((quad_int)a & m) | ((quad_int)b & ~m));
#endif
}

static inline quad quad_max(quad a, quad b)
{
#ifdef __SSE2__
	return __builtin_ia32_maxps(a, b);
#else
	quad_int m = a > b;
	return (quad)(((quad_int)a & m) | ((quad_int)b & ~m));
#endif
}

static inline quad quad_of(float x)
{
	return (quad){ x, x, x, x };
}

/* A box; lane 3 holds anything. */
struct quad_box {
	quad lo, hi;
};

static inline struct quad_box quad_box_empty(void)
{
	return (struct quad_box){ quad_of(INFINITY), quad_of(-INFINITY) };
}

static inline void quad_box_join(struct quad_box *b, struct quad_box c)
{
	b->lo = quad_min(b->lo, c.lo);
	b->hi = quad_max(b->hi, c.hi);
}

/* Half the surface area: all that ratios need. */
static inline float quad_box_half_area(struct quad_box b)
{
	quad e = b.hi - b.lo;
	return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

#endif
