/* What is measured: rays of a law, or the rays of an image. */
#ifndef BATCH_MEASURE_H
#define BATCH_MEASURE_H

#include "base/key.h"
#include "trace/render.h"

enum { RAYS_INVARIANT, RAYS_LINES, RAYS_SEGMENTS, RAYS_SEGMENTS_TWICE, RAYS_INTERIOR, RAYS_INTERIOR_HITS };
enum { SIDES_TWO, SIDES_ONE, SIDES_EXT };

struct measure_spec {
	bool render;
	double alpha, beta;
	int rays, sides;             /* if not render */
	int64_t count;
	double error;
	struct render_options image; /* if render */
	int64_t pilot_width, pilot_height;
};

/* The options of either kind, in a struct measure_spec. */
extern const struct key measure_rays_keys[], measure_image_keys[];

static inline const struct key *measure_keys(const struct measure_spec *m)
{
	return m->render ? measure_image_keys : measure_rays_keys;
}

/* Where rays start and what stops them, in one word: invariant, invariant-one-sided, invariant-ext, lines, segments,
 * segments-twice, interior, interior-hits, render. */
const char *measure_workload(const struct measure_spec *m);

/* Whether the option called 'key' means anything beside the others. */
bool measure_applies(const struct measure_spec *m, const char *key);

/* "rays=invariant count=..." or "render width=...", into out[size]. */
void measure_print(const struct measure_spec *m, char *out, size_t size);

#endif
