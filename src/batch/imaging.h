/* What the rows of one scene and one image share: the pilot, and its flux over the roots of their structures. */
#ifndef BATCH_IMAGING_H
#define BATCH_IMAGING_H

#include "accel/flux.h"
#include "batch/job.h"
#include "trace/replay.h"

/* Roots whose fluxes are kept: a scene's structures share a cube or a box. */
enum { IMAGING_ROOTS = 2 };

/* Zero-initialise to open; imaging_free closes. */
struct imaging {
	bool known, saved;    /* the pilot is there; the image is kept already */
	struct pilot pilot;
	struct flux fluxes[IMAGING_ROOTS];
};

struct imaging_run {
	const struct measure_spec *measure;
	const struct scene *setting;
	int threads;
	const atomic_int *stop;
};

/* Predict the image's cost a ray in structure a: *replay and *counts by the pilot's rays, *calibrated by their flux. What is missing is
 * made first. 0, or -1 and *e: memory, stopped. */
int imaging_predict(struct imaging *m, const struct imaging_run *run, const struct accel *a, struct estimate *replay,
                    struct replay_counts *counts, struct estimate *calibrated, struct err *e);

void imaging_free(struct imaging *m);

#endif
