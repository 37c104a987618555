/* Planar polygons, convex or concave, into triangles. */
#ifndef SCENE_TRIANGULATE_H
#define SCENE_TRIANGULATE_H

#include "base/arena.h"
#include "geom/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Cut a simple polygon of n >= 3 corners into n - 2 triangles by clipping ears (Meisters 1975), in O(n^2). triples[3 (n - 2)]
 * receives corner numbers; every triangle has the polygon's orientation. Repeated and collinear corners give triangles of
 * zero area; a polygon that crosses itself is cut into n - 2 triangles all the same. scratch: for working space.
 * 0, or -1 when memory is out. */
int triangulate_polygon(const struct vec *corners, size_t n, uint32_t *triples, struct arena *scratch);

#endif
