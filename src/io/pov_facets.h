/* Lists of triangles while they are made and cut. */
#ifndef IO_POV_FACETS_H
#define IO_POV_FACETS_H

#include "geom/box.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Counter-clockwise seen from outside. */
struct pov_facet {
	struct vec v[3];
	uint32_t material;
};

/* Zero-initialise to open, but for 'most', the budget. lost: memory ran out; full: the budget did; nothing more is added then, so
 * that fillers need no checks of their own. */
struct pov_facets {
	struct pov_facet *all;
	size_t count, room, most;
	bool lost, full;
};

/* Triangles with two corners in one place, or with one that no number tells, are left out; those of no area else stay, for
 * without them their neighbours would not meet. */
void pov_facets_add(struct pov_facets *f, const struct vec *v, uint32_t material);

/* Empty, the memory kept. */
void pov_facets_clear(struct pov_facets *f);
void pov_facets_free(struct pov_facets *f);

struct box pov_facet_box(const struct pov_facet *f);

/* Whether two closed boxes meet. */
static inline bool box_meets(const struct box *a, const struct box *b)
{
	for (int i = 0; i < 3; i++)
		if (a->hi.a[i] < b->lo.a[i] || a->lo.a[i] > b->hi.a[i])
			return false;
	return true;
}

/* What both boxes contain; empty (some lo > hi) where they do not meet. */
static inline struct box box_common(const struct box *a, const struct box *b)
{
	struct box c = *a;
	for (int i = 0; i < 3; i++) {
		c.lo.a[i] = b->lo.a[i] > c.lo.a[i] ? b->lo.a[i] : c.lo.a[i];
		c.hi.a[i] = b->hi.a[i] < c.hi.a[i] ? b->hi.a[i] : c.hi.a[i];
	}
	return c;
}

static inline struct box box_infinite(void)
{
	return (struct box){ vec(-INFINITY, -INFINITY, -INFINITY), vec(INFINITY, INFINITY, INFINITY) };
}

static inline bool box_is_empty(const struct box *b)
{
	return !(b->lo.x <= b->hi.x && b->lo.y <= b->hi.y && b->lo.z <= b->hi.z);
}

static inline bool box_is_finite(const struct box *b)
{
	for (int i = 0; i < 3; i++)
		if (!isfinite(b->lo.a[i]) || !isfinite(b->hi.a[i]))
			return false;
	return true;
}

/* Longest side. */
static inline double box_longest(const struct box *b)
{
	struct vec e = vec_sub(b->hi, b->lo);
	return fmax(e.x, fmax(e.y, e.z));
}

static inline struct box box_enlarge(const struct box *b, double by)
{
	return (struct box){ vec_sub(b->lo, vec(by, by, by)), vec_add(b->hi, vec(by, by, by)) };
}

#endif
