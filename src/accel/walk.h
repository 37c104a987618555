/* A walk is written once and compiled twice, without and with counting; and what all walks do in a leaf. */
#ifndef ACCEL_WALK_H
#define ACCEL_WALK_H

#include "accel/accel.h"
#include "geom/hit.h"

/* A WALK must be inlined, for then its constant 'count' folds every COUNT away or in. */
#define WALK static inline __attribute__((always_inline)) bool
#define COUNT(field, n) do { if (count) tally->field += (n); } while (0)
#define WALK_TWICE(walk) \
	static bool shoot(const struct accel *a, const struct ray *r, struct hit *h) \
	{ return walk(a, r, h, NULL, false); } \
	static bool shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n) \
	{ return walk(a, r, h, n, true); }

/* A direction's component, never zero, so that it has an inverse. */
static inline double nonzero(double d)
{
	return d == 0 ? 1e-300 : d;
}

/* Test every primitive of a list; *h keeps the best so far. */
static inline void test_all(const struct primitive *all, const uint32_t *ids, uint32_t n, const struct ray *r, struct hit *h)
{
	for (uint32_t i = 0; i < n; i++)
		primitive_hit(&all[ids[i]], ids[i], r, h);
}

/* Test a primitive; *h keeps the best so far. */
static inline __attribute__((always_inline)) void test_one(const struct primitive *all, uint32_t id, const struct ray *r, struct hit *h,
                                                           struct tally *tally, const bool count)
{
	COUNT(barycentric, all[id].kind == PRIMITIVE_TRIANGLE && triangle_plane_met(&all[id].triangle, r, h->t));
	primitive_hit(&all[id], id, r, h);
}

#endif
