/* Ending subdivision where a predictor says that it pays no more. */
#ifndef COST_STOP_H
#define COST_STOP_H

#include "accel/accel.h"

/* Build as accel_build_on does, but heed the option 'stop': of the trees of max_depth 0, 1, 2, ... up to the one asked for, or the grids
 * of 1, 2, 4, ... cells a side, the one of least cost in flops by cost/model.h (MODEL) or by the exact expectation (EXACT). The
 * search ends when nine trees, or two grids, in a row were no better than the best. *reached (may be NULL): the depth or resolution
 * that was built, -1 where nothing was searched. 0, or -1 and *e; then nothing is held. */
int stop_build(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, int threads,
               int64_t *reached, struct err *e);

#endif
