/* A ray and the hit it ends in. */
#ifndef GEOM_RAY_H
#define GEOM_RAY_H

#include "geom/vec.h"

#include <stdbool.h>
#include <stdint.h>

#define NO_PRIMITIVE UINT32_MAX

/* o + t d, |d| = 1, t in [0, t_max]. from: id of the primitive it starts on, or NO_PRIMITIVE.
 * slack: 1e-9 of the root's diagonal; what lies nearer than that to the start lies at the start.
 * through: a line rather than a ray; primitives are listed and counted, none stops it.
 * any: whatever is hit may end it, the nearest or not; structures that gain nothing by that find the nearest;
 *   its t is then no more than an upper bound.
 * clear: nothing within slack of the start stops it: a ray of an image leaves all surfaces that coincide where it starts. */
struct ray {
	struct vec o, d;
	double t_max, slack;
	uint32_t from;
	bool through, clear, any;
};

/* t at the hit and the id of what was hit; t = t_max, NO_PRIMITIVE before any. */
struct hit {
	double t;
	uint32_t id;
};

/* No hit yet. */
static inline struct hit hit_none(const struct ray *r)
{
	return (struct hit){ r->t_max, NO_PRIMITIVE };
}

/* Whether a root t of primitive 'id' may end the ray, by where the ray starts (design rule 4): behind the start it may not; at
 * the start only a primitive of higher id than the start's may, so that a zero-length ray between coincident surfaces exists
 * once. The start primitive itself is the caller's business. */
static inline bool ray_accepts(const struct ray *r, double t, uint32_t id)
{
	return t > r->slack || (!r->clear && t >= -r->slack && (r->from == NO_PRIMITIVE || id > r->from));
}

/* The one order of hits: nearer first, then the lower id. */
static inline bool hit_better(double t, uint32_t id, const struct hit *h)
{
	return t < h->t || (t == h->t && id < h->id);
}

#endif
