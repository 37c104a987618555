/* Predicting what a rendering will cost from a pilot image: its rays are kept once, where they started and where they ended, and then
 * walked through any structure without testing a primitive. What ends a ray does not depend on the structure, so a replay counts
 * exactly what that structure would have cost these rays; only the choice of pixels makes it a guess about the full image. */
#ifndef TRACE_REPLAY_H
#define TRACE_REPLAY_H

#include "base/estimate.h"
#include "trace/render.h"

/* Counts a ray, over those that visit a cell; tests_made as the structure's mailbox leaves them, all tests where it has none. */
struct replay_counts {
	double leaves, tests_made, inner, boxes;
};

struct pilot {
	struct rendering image; /* owned; with its segments */
	size_t samples;
};

/* Render scene s small, by any structure over its primitives. o is resolved; its size is replaced by width x height, a frame. 0, or -1 and
 * *e: memory, stopped. Free it in any case. */
int pilot_make(struct pilot *p, const struct scene *s, const struct accel *a, const struct render_options *o, int64_t width,
               int64_t height, int threads, const atomic_int *stop, struct err *e);
void pilot_free(struct pilot *p);

/* The cost of the pilot's rays in structure a, over those that visit a cell: alpha a leaf, beta a primitive in its list; and their
 * counts (may be NULL). NAN where none does. The interval is by a bootstrap over the pilot's pixels (Efron 1979). 0, or -1 and *e
 * (memory). */
int replay_cost(struct estimate *out, struct replay_counts *counts, const struct pilot *p, const struct accel *a, double alpha,
                double beta, struct err *e);

#endif
