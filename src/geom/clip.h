/* Convex polygons in space: cutting and measuring. */
#ifndef GEOM_CLIP_H
#define GEOM_CLIP_H

#include "geom/box.h"

/* A triangle cut by the six planes of a box has at most 9 corners; by a few more planes some more. */
enum { POLYGON_MOST = 24 };

struct polygon {
	int count; /* < 3: nothing left */
	struct vec corner[POLYGON_MOST];
};

/* Keep the part where sign * p[axis] <= sign * plane; sign is +1 or -1 (Sutherland, Hodgman 1974). */
void polygon_cut_axis(struct polygon *p, int axis, double sign, double plane);

/* Keep the part where dot(normal, p) <= offset. */
void polygon_cut(struct polygon *p, struct vec normal, double offset);

/* Keep the part inside the box; infinite sides cut nothing. */
void polygon_cut_box(struct polygon *p, const struct box *b);

/* Area vector: length is the area, direction the normal by the right-hand rule. */
struct vec polygon_area_vector(const struct polygon *p);

#endif
