/* Counting segments of rays on the sides and in the voxels of a grid (accel/flux.h). */
#ifndef TRACE_FLUX_COUNT_H
#define TRACE_FLUX_COUNT_H

#include "accel/flux.h"
#include "trace/render.h"

/* Add segments [0 .. count) to f, by the rules of accel.h: a structure over f's root, whose slack is given, whose leaves are made
 * of voxels, counts the visits that follow from f. Samples are put in groups by chance; the segments of one stay together. */
void flux_count(struct flux *f, const struct segment *segments, size_t count, double slack);

#endif
