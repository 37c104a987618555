/* Axis-aligned boxes. */
#ifndef GEOM_BOX_H
#define GEOM_BOX_H

#include "geom/vec.h"

struct box {
	struct vec lo, hi;
};

/* The box that contains nothing and grows by box_extend. */
static inline struct box box_empty(void)
{
	return (struct box){ vec(INFINITY, INFINITY, INFINITY), vec(-INFINITY, -INFINITY, -INFINITY) };
}

static inline void box_extend(struct box *b, struct vec p)
{
	for (int i = 0; i < 3; i++) {
		b->lo.a[i] = p.a[i] < b->lo.a[i] ? p.a[i] : b->lo.a[i];
		b->hi.a[i] = p.a[i] > b->hi.a[i] ? p.a[i] : b->hi.a[i];
	}
}

static inline void box_join(struct box *b, const struct box *c)
{
	box_extend(b, c->lo);
	box_extend(b, c->hi);
}

/* Surface area of the box. */
static inline double box_area(const struct box *b)
{
	struct vec e = vec_sub(b->hi, b->lo);
	return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

static inline double box_volume(const struct box *b)
{
	struct vec e = vec_sub(b->hi, b->lo);
	return e.x * e.y * e.z;
}

static inline double box_diagonal(const struct box *b)
{
	return vec_length(vec_sub(b->hi, b->lo));
}

#endif
