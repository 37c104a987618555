/* Running a job: every combination, predicted and measured, into its output folder. */
#ifndef BATCH_RUN_H
#define BATCH_RUN_H

#include "batch/job.h"
#include "io/text.h"

#include <stdatomic.h>
#include <stdint.h>

struct run_options {
	const char *folder;       /* output; NULL: out/NAME. A shard's is shards/K-of-N in it */
	const char *version;      /* of the program, for the manifest */
	int threads;
	bool fresh;               /* do everything anew */
	uint32_t shard, shards;   /* only shard 'shard' of so many; 0 of 0: all rows */
	const atomic_int *stop; /* becomes the number of a signal that wants the run to end; may be NULL */
};

/* What came of it. */
struct run_result {
	size_t kept, added, failed;
	char folder[3000];
};

/* Run a job, or go on with it. *table receives the summary for people (text_free it). 0 when all rows are there, though some may have
 * failed; or -1 and *e: STATUS_BUSY, STATUS_ENVIRONMENT, or 128 + n when stopped by signal n. */
int run_job(const struct job *job, const struct run_options *o, struct run_result *result, struct text *table, struct err *e);

#endif
