/* bvh8 on any machine: vectors the compiler maps to what there is. */
#include "accel/quad.h"

#include <string.h>

struct wide {
	quad low, high;
};
#define WIDE struct wide

static inline struct wide wide_load(const char *p)
{
	struct wide w;
	memcpy(&w, p, sizeof w);
	return w;
}

static inline struct wide wide_spread(float x)
{
	return (struct wide){ quad_of(x), quad_of(x) };
}

static inline struct wide wide_min(struct wide a, struct wide b)
{
	return (struct wide){ quad_min(a.low, b.low), quad_min(a.high, b.high) };
}

static inline struct wide wide_max(struct wide a, struct wide b)
{
	return (struct wide){ quad_max(a.low, b.low), quad_max(a.high, b.high) };
}

static inline struct wide wide_mul_sub(struct wide a, struct wide b, struct wide c)
{
	return (struct wide){ a.low * b.low - c.low, a.high * b.high - c.high };
}

static inline uint32_t quad_mask(quad_int m)
{
#ifdef __SSE2__
	return (uint32_t)__builtin_ia32_movmskps((quad)m);
#else
	return (m[0] & 1u) | (m[1] & 2u) | (m[2] & 4u) | (m[3] & 8u);
#endif
}

static inline uint32_t wide_mask(struct wide a, struct wide b)
{
	return quad_mask(a.low <= b.low) | quad_mask(a.high <= b.high) << 4;
}

static inline quad quad_mul_add(quad a, quad b, quad c)
{
	return a * b + c;
}

static inline quad quad_mul_sub(quad a, quad b, quad c)
{
	return a * b - c;
}

#define BVH8_KERNEL bvh8_portable
#include "accel/bvh8_walk.inc"
