/* What the rays of an image come to: means a ray, and their errors. The sample is what is drawn at random, not the ray: rays of one pixel
 * depend on each other. */
#ifndef TRACE_RENDER_SUMS_H
#define TRACE_RENDER_SUMS_H

#include "trace/render.h"

/* What a block of samples sums up, in integers. */
struct render_sums {
	struct class_tally classes[RAY_CLASSES];
	struct tally square, cross; /* per sample: counts squared, and times the sample's rays */
	uint64_t rays, rays_square, steps_tests, step_start;
	struct segment *segments;   /* from malloc, or NULL */
	size_t segment_count, segment_room;
};

/* Add squares and products of what the rays of a sample cost together. */
void render_sums_add(struct render_sums *s, const struct accel *a, const struct tally *n, uint64_t rays);

/* From the blocks of all frames, 'samples' in all: classes and actual of *out, which are zero before. */
void render_sum_up(struct rendering *out, const struct accel *accel, const struct render_run *run, size_t samples,
                   const struct render_sums *sums, size_t blocks);

#endif
