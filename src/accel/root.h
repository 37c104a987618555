/* The region a structure partitions. */
#ifndef ACCEL_ROOT_H
#define ACCEL_ROOT_H

#include "geom/box.h"
#include "geom/ray.h"

enum root_kind { ROOT_CUBE, ROOT_BOX };

/* The tight box of the bounds, or the cube about its centre. A side without length gets a small one (1e-6 of the longest), so
 * that every cell has a volume. lo + (hi - lo) == hi in every coordinate, so that a grid from lo ends exactly at hi. */
struct box root_box(const struct box *bounds, enum root_kind kind);

/* Where the ray starts inside the root: its origin, or the point where it comes in. per_d: 1 / d, finite. False when it visits
 * nothing: it misses the root, ends before it, or leads out of it from within slack of a side. */
bool root_enter(const struct box *root, const struct ray *r, struct vec per_d, double slack, struct vec *start);

#endif
