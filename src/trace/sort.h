/* Bringing rays together that start near each other: they meet the same cells, which are then still in the cache. */
#ifndef TRACE_SORT_H
#define TRACE_SORT_H

#include "geom/box.h"
#include "geom/ray.h"

#include <stddef.h>

/* Rays sorted and shot together; and the cells a side, as a power of two, of the grid they are sorted by. */
enum { RAYS_BLOCK = 65536, SORT_LEVELS = 5, SORT_CELLS = 1 << 3 * SORT_LEVELS };

/* Room to work in. */
struct sorter {
	uint32_t cell[RAYS_BLOCK], first[SORT_CELLS + 1];
};

/* Copy rays[0 .. n) into sorted[n], ordered by where in the root they start: cell after cell along a Z-order curve (Morton 1966), in a cell as
 * they came. n at most RAYS_BLOCK. */
void rays_sort(struct ray *sorted, struct sorter *s, const struct ray *rays, size_t n, const struct box *root);

#endif
