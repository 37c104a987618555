/* Polygons into triangles in SPD's way. */
#ifndef IO_SPD_SPLIT_H
#define IO_SPD_SPLIT_H

#include "base/arena.h"
#include "geom/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Cut a polygon of n >= 3 corners into n - 2 triangles as the SPD programs do: the corner least in a coordinate is cut off, or, where
 * others lie in the bounds of the triangle it makes with its neighbours, joined to the least of them. Right for SPD's own polygons,
 * to the order and the last bit; for others there is triangulate_polygon. triples[3 (n - 2)] receives them in the order in which they
 * are printed. 0, or -1 when memory is out. */
int spd_split(const struct vec *corners, size_t n, uint32_t *triples, struct arena *scratch);

#endif
