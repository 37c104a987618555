/* What the rows of one scene and one image share: the pilot, and the reference trees that calibrate. */
#ifndef BATCH_IMAGING_H
#define BATCH_IMAGING_H

#include "accel/root.h"
#include "batch/job.h"
#include "trace/replay.h"

/* The tree whose pilot cost calibrates: an octree of the usual options over the same kind of root. */
struct reference {
	bool known;
	double exact;         /* its expected cost under invariant rays */
	struct estimate cost; /* of the pilot's rays in it */
};

/* Zero-initialise to open; imaging_free closes. */
struct imaging {
	bool known, saved;    /* the pilot is there; the image is kept already */
	struct pilot pilot;
	struct reference references[ROOT_BOX + 1];
};

struct imaging_run {
	const struct measure_spec *measure;
	const struct scene *setting;
	int threads;
	const atomic_int *stop;
};

/* Predict the image's cost a ray in structure a, built to 'spec': *replay and *counts by the pilot's rays, *calibrated from 'exact', the expected
 * cost under invariant rays in a. What is missing is made first. 0, or -1 and *e: memory, stopped. */
int imaging_predict(struct imaging *m, const struct imaging_run *run, const struct accel *a, const struct structure_spec *spec,
                    double exact, struct estimate *replay, struct replay_counts *counts, struct estimate *calibrated, struct err *e);

void imaging_free(struct imaging *m);

#endif
