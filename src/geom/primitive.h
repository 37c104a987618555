/* The shapes rays are tested against. Builders ask 'touches', predictors 'area_inside', walks 'hit'. */
#ifndef GEOM_PRIMITIVE_H
#define GEOM_PRIMITIVE_H

#include "geom/box.h"
#include "geom/ray.h"

enum primitive_kind { PRIMITIVE_TRIANGLE, PRIMITIVE_SPHERE };

/* Counter-clockwise seen from the front. */
struct triangle {
	struct vec v[3];
};

struct sphere {
	struct vec center;
	double radius; /* > 0 */
};

struct primitive {
	enum primitive_kind kind;
	uint32_t material; /* index into the scene's, or NO_MATERIAL */
	union {
		struct triangle triangle;
		struct sphere sphere;
	};
};

/* Bounding box; exact (no rounding for triangles). */
struct box primitive_bounds(const struct primitive *p);

/* One-sided surface area. */
double primitive_area(const struct primitive *p);

/* Whether the closed surface meets the closed box. Never a false no; a false yes only within rounding. */
bool primitive_touches(const struct primitive *p, const struct box *b);

/* One-sided area of the part of the surface inside the box: triangles by clipping, spheres by integration to 1e-9 of their
 * area. */
double primitive_area_inside(const struct primitive *p, const struct box *b);

#endif
