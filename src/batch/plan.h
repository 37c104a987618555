/* The rows of a job before any is done: their keys, what each should take, and which shard does it. Every machine that reads the same
 * job and scenes makes the same plan, so that shards need not talk. */
#ifndef BATCH_PLAN_H
#define BATCH_PLAN_H

#include "batch/job.h"
#include "io/text.h"

#include <stdatomic.h>
#include <stdint.h>

/* Zero-initialise; plan_free closes. Rows stand in plan order: experiments, scenes, structures, measures. */
struct plan {
	struct arena mem;
	size_t count;
	uint64_t *keys;
	uint64_t *costs;  /* estimated, nanoseconds of one processor; from counts alone, so that machines agree */
	uint32_t *shards; /* which does the row: 0 .. shards - 1 */
};

enum { SHARDS_MOST = 100000 };

/* Load every scene and fill *plan for so many shards. stop: as in run.h. 0, or -1 and *e: memory, stopped. */
int plan_make(struct plan *plan, const struct job *job, uint32_t shards, const atomic_int *stop, struct err *e);

void plan_free(struct plan *plan);

/* Longest processing time first (Graham 1969): rows by falling cost, ties by key, each to the shard with the least so far, ties to
 * the lowest. costs and keys [count]; fills shards[count]. 0, or -1 and *e (memory). */
int plan_assign(uint32_t *assigned, const uint64_t *costs, const uint64_t *keys, size_t count, uint32_t shards, struct err *e);

/* The keys, a line each under a head: what a shard leaves for the merge. */
void plan_print_keys(const struct plan *plan, struct text *out);

#endif
