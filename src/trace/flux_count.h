/* Counting segments of rays on the planes and in the voxels of a grid (accel/flux.h). */
#ifndef TRACE_FLUX_COUNT_H
#define TRACE_FLUX_COUNT_H

#include "accel/flux.h"
#include "trace/render.h"

/* Add segments [0 .. count) to f, which is not sealed yet. slack: of structures over f's root; by the rules of accel.h, what a
 * structure counts in a cell of theirs is what f knows of it. */
void flux_count(struct flux *f, const struct segment *segments, size_t count, double slack);

#endif
