/* Shooting many random rays and summing up what they cost. */
#ifndef TRACE_SHOOT_H
#define TRACE_SHOOT_H

#include "accel/accel.h"

#include <stdatomic.h>

/* INVARIANT: the law of cost/cost.h, both sides of every primitive. ONE_SIDED: the front sides only. LINES: from the root only,
 * nothing stops them. SEGMENTS: between two points, uniform in the box of the primitives made 20 % longer on every axis; any hit will
 * do (Smits 1999); they are shot in the order drawn, not sorted. SEGMENTS_TWICE: each of them twice, one after the other. INTERIOR: from points uniform in
 * the volume of the root, in uniform directions; nothing stops them (Fabianowski, Fowler, Dingliana 2009).
 * INTERIOR_HITS: the same rays, each up to its hit. */
enum workload { WORKLOAD_INVARIANT, WORKLOAD_ONE_SIDED, WORKLOAD_LINES, WORKLOAD_SEGMENTS, WORKLOAD_SEGMENTS_TWICE, WORKLOAD_INTERIOR,
                WORKLOAD_INTERIOR_HITS };

/* A mean over rays and its standard error. */
struct mean {
	double mean, se;
};

struct actual {
	uint64_t rays;
	struct tally sum; /* exact */
	/* Per ray; cost = alpha leaves + beta tests, for volumes alpha inner_step + beta tests; inner = inner_step + inner_start. */
	struct mean cost, leaves, tests, tests_made, barycentric, inner_step, inner_start, inner, boxes, hits;
	double walk_seconds; /* of all threads, without drawing the rays; the one thing here that is not the same every time */
};

/* Shoot rays 0 .. count-1 of the workload; every number follows from (seed, ray number), whatever the threads.
 * stop (may be NULL): when it becomes nonzero the run ends early with -1. 0, or -1 and *e: memory, stopped (code
 * STATUS_ENVIRONMENT, "interrupted"). */
int shoot_rays(struct actual *out, const struct accel *a, enum workload w, uint64_t count, uint64_t seed, double alpha,
               double beta, int threads, const atomic_int *stop, struct err *e);

/* As shoot_rays, and then on until the standard error of cost, leaves, tests, inner_step and inner_start each is at most 'error'
 * (more than 0; 0: never) of its mean, or RAYS_GROWTH times 'count' rays are shot. out->rays: how many it came to, which follows from the
 * counts alone. */
enum { RAYS_GROWTH = 100 };
int shoot_rays_until(struct actual *out, const struct accel *a, enum workload w, uint64_t count, double error, uint64_t seed,
                     double alpha, double beta, int threads, const atomic_int *stop, struct err *e);

#endif
