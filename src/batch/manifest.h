/* manifest.json: what was run, by what, on what, when, and how it ended. */
#ifndef BATCH_MANIFEST_H
#define BATCH_MANIFEST_H

#include "batch/run.h"

struct manifest {
	const struct job *job;
	const struct run_options *options;
	char start[32]; /* UTC */
};

void manifest_start(struct manifest *m, const struct job *job, const struct run_options *o);

/* Write it into the output folder. status: of the run, or -1 while it lasts: "end" and "status" are null in the manifest of a run that is
 * at work, or was killed. 0, or -1 and *e, if *e holds no earlier error. */
int manifest_write(const struct manifest *m, const struct run_result *result, int status, struct err *e);

#endif
