#include "trace/shoot.h"

#include "base/par.h"
#include "trace/rays.h"
#include "trace/sort.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

/* What a block of rays sums up: counts, their squares, and products of two, steps (accel_steps) times tests among them. Integers: the
 * order does not matter. */
struct block {
	struct tally sum, square;
	uint64_t steps_tests, step_start;
	double seconds;
};

/* Of a pass: rays first .. upto - 1. */
struct run {
	struct ray_source source;
	uint64_t first, upto;
	struct block *blocks;
	const atomic_int *stop;
	atomic_bool failed; /* memory ran out */
};

static void add_ray(struct block *b, const struct accel *a, const struct tally *n)
{
	tally_add(&b->sum, n);
#define ADD(field) b->square.field += n->field * n->field;
	TALLY_COUNTS(ADD)
#undef ADD
	b->steps_tests += accel_steps(a, n) * n->tests;
	b->step_start += n->inner_step * n->inner_start;
}

/* What one block needs. */
struct work {
	struct ray drawn[RAYS_BLOCK], sorted[RAYS_BLOCK];
	struct sorter sorter;
	struct hit hit[RAYS_BLOCK];
	struct tally tally[RAYS_BLOCK];
};

static double thread_seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void shoot_block(void *ctx, size_t i)
{
	struct run *run = ctx;
	const struct accel *a = run->source.accel;
	struct block b = { 0 };
	if ((run->stop && *run->stop) || atomic_load(&run->failed))
		return;
	struct work *w = malloc(sizeof *w);
	if (!w) {
		atomic_store(&run->failed, true);
		return;
	}
	uint64_t first = run->first + (uint64_t)i * RAYS_BLOCK;
	size_t n = first + RAYS_BLOCK < run->upto ? RAYS_BLOCK : (size_t)(run->upto - first);
	const struct ray *rays = w->drawn;
	ray_source_draw_many(&run->source, first, n, w->drawn);
	if (!run->source.segments) { /* the counts do not depend on the order */
		rays_sort(w->sorted, &w->sorter, w->drawn, n, &a->root);
		rays = w->sorted;
	}
	double start = thread_seconds();
	a->ops->shoot_many(a, rays, n, w->hit, w->tally);
	b.seconds = thread_seconds() - start;
	for (size_t k = 0; k < n; k++)
		add_ray(&b, a, &w->tally[k]);
	run->blocks[i] = b;
	free(w);
}

static struct mean mean_of(double sum, double square, double n)
{
	double mean = sum / n, variance = fmax(0, square / n - mean * mean);
	return (struct mean){ mean, n > 1 ? sqrt(variance / (n - 1)) : NAN };
}

/* Squares of counts as doubles: only the standard errors need them. */
struct squares {
#define SQUARE(field) double field;
	TALLY_COUNTS(SQUARE)
#undef SQUARE
	double steps_tests, step_start;
};

/* Merge the blocks of a pass in order. */
static void add_blocks(struct actual *out, struct squares *q, const struct run *run, size_t blocks)
{
	for (size_t i = 0; i < blocks; i++) {
		const struct block *b = &run->blocks[i];
		tally_add(&out->sum, &b->sum);
#define ADD(field) q->field += (double)b->square.field;
		TALLY_COUNTS(ADD)
#undef ADD
		q->steps_tests += (double)b->steps_tests;
		q->step_start += (double)b->step_start;
		out->walk_seconds += b->seconds;
	}
}

static void find_means(struct actual *out, const struct squares *q, const struct accel *a, double alpha, double beta)
{
	const struct tally *sum = &out->sum;
	double n = (double)out->rays;
#define MEAN(field) out->field = mean_of((double)sum->field, q->field, n);
	TALLY_COUNTS(MEAN)
#undef MEAN
	double steps = a->volumes ? q->inner_step : q->leaves;
	out->cost = mean_of(alpha * (double)accel_steps(a, sum) + beta * (double)sum->tests,
	                    alpha * alpha * steps + beta * beta * q->tests + 2 * alpha * beta * q->steps_tests, n);
	out->inner = mean_of((double)sum->inner_step + (double)sum->inner_start, q->inner_step + q->inner_start + 2 * q->step_start, n);
}

static int shoot_pass(struct actual *out, struct squares *q, struct run *run, int threads, struct err *e)
{
	size_t blocks = (size_t)((run->upto - run->first + RAYS_BLOCK - 1) / RAYS_BLOCK);
	run->blocks = calloc(blocks, sizeof *run->blocks);
	if (!run->blocks)
		return err_memory(e, "rays");
	par_for(threads, blocks, shoot_block, run);
	int status = atomic_load(&run->failed) ? err_memory(e, "rays") : 0;
	if (status == 0 && run->stop && *run->stop)
		status = err_at(e, STATUS_ENVIRONMENT, NULL, 0, "interrupted");
	if (status == 0)
		add_blocks(out, q, run, blocks);
	free(run->blocks);
	return status;
}

/* How many rays in all would bring the standard error of every count to 'error' of its mean, by what was found so far; a tenth more,
 * since that is an estimate. */
static uint64_t rays_wanted(const struct actual *found, uint64_t count, double error)
{
	const struct mean *const counts[] = { &found->cost, &found->leaves, &found->tests, &found->inner_step, &found->inner_start };
	double most = (double)count * RAYS_GROWTH, worst = 0;
	for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
		if (counts[i]->mean > 0)
			worst = fmax(worst, counts[i]->se / counts[i]->mean / error);
	return worst > 1 ? (uint64_t)fmin(most, 1.1 * worst * worst * (double)found->rays) : found->rays;
}

int shoot_rays_until(struct actual *out, const struct accel *a, enum workload w, uint64_t count, double error, uint64_t seed,
                     double alpha, double beta, int threads, const atomic_int *stop, struct err *e)
{
	struct run run = { .upto = count, .stop = stop };
	struct squares squares = { 0 };
	int status = ray_source_open(&run.source, a, w, seed, e);
	*out = (struct actual){ 0 };
	while (status == 0 && out->rays < run.upto) {
		status = shoot_pass(out, &squares, &run, threads, e);
		out->rays = run.first = run.upto;
		if (status != 0)
			break;
		find_means(out, &squares, a, alpha, beta);
		if (error > 0)
			run.upto = rays_wanted(out, count, error);
	}
	ray_source_close(&run.source);
	return status;
}

int shoot_rays(struct actual *out, const struct accel *a, enum workload w, uint64_t count, uint64_t seed, double alpha,
               double beta, int threads, const atomic_int *stop, struct err *e)
{
	return shoot_rays_until(out, a, w, count, 0, seed, alpha, beta, threads, stop, e);
}
