#include "trace/shoot.h"

#include "base/par.h"
#include "trace/rays.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Rays drawn, sorted and shot together; and the cells a side, as a power of two, of the grid they are sorted by. */
enum { BLOCK = 65536, SORT_LEVELS = 5, SORT_CELLS = 1 << 3 * SORT_LEVELS };

/* What a block of rays sums up: counts, their squares, and steps (accel_steps) times tests. Integers: the order does not matter. */
struct block {
	struct tally sum, square;
	uint64_t steps_tests;
	double seconds;
};

struct run {
	struct ray_source source;
	uint64_t count;
	struct block *blocks;
	const atomic_int *stop;
	atomic_bool failed; /* memory ran out */
};

static void add_ray(struct block *b, const struct accel *a, const struct tally *n)
{
#define ADD(field) do { b->sum.field += n->field; b->square.field += n->field * n->field; } while (0)
	ADD(leaves);
	ADD(tests);
	ADD(inner_step);
	ADD(inner_start);
	ADD(hits);
	ADD(boxes);
#undef ADD
	b->steps_tests += accel_steps(a, n) * n->tests;
}

/* Number of the grid cell that holds p, along a Z-order curve (Morton 1966). */
static uint32_t sort_cell(const struct box *root, struct vec p)
{
	uint32_t cell = 0;
	for (int i = 0; i < 3; i++) {
		double x = (p.a[i] - root->lo.a[i]) / (root->hi.a[i] - root->lo.a[i]) * (1 << SORT_LEVELS);
		uint32_t at = x < 0 ? 0 : x >= (1 << SORT_LEVELS) ? (1 << SORT_LEVELS) - 1 : (uint32_t)x;
		for (int bit = 0; bit < SORT_LEVELS; bit++)
			cell |= (at >> bit & 1) << (3 * bit + i);
	}
	return cell;
}

/* What one block needs. */
struct work {
	struct ray drawn[BLOCK], sorted[BLOCK];
	uint32_t cell[BLOCK], first[SORT_CELLS + 1];
	struct hit hit[BLOCK];
	struct tally tally[BLOCK];
};

/* Draw n rays from number 'first' on and bring those that start near each other together: they meet the same cells, which are then
 * still in the cache. The counts do not depend on the order. */
static void draw_sorted(struct work *w, const struct ray_source *s, uint64_t first, size_t n)
{
	if (s->segments) {
		for (size_t i = 0; i < n; i++)
			w->sorted[i] = ray_source_draw(s, first + i);
		return;
	}
	memset(w->first, 0, sizeof w->first);
	for (size_t i = 0; i < n; i++) {
		w->drawn[i] = ray_source_draw(s, first + i);
		w->cell[i] = sort_cell(&s->accel->root, w->drawn[i].o);
		w->first[w->cell[i] + 1]++;
	}
	for (int c = 0; c < SORT_CELLS; c++)
		w->first[c + 1] += w->first[c];
	for (size_t i = 0; i < n; i++)
		w->sorted[w->first[w->cell[i]]++] = w->drawn[i];
}

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
	uint64_t first = (uint64_t)i * BLOCK;
	size_t n = first + BLOCK < run->count ? BLOCK : (size_t)(run->count - first);
	draw_sorted(w, &run->source, first, n);
	double start = thread_seconds();
	a->ops->shoot_many(a, w->sorted, n, w->hit, w->tally);
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

/* Merge the blocks in order. Squares are added as doubles: only the standard errors need them. */
static void sum_up(struct actual *out, const struct run *run, size_t blocks, double alpha, double beta)
{
	double leaves = 0, tests = 0, step = 0, start = 0, hits = 0, boxes = 0, both = 0, n = (double)run->count;
	struct tally *sum = &out->sum;
	for (size_t i = 0; i < blocks; i++) {
		const struct block *b = &run->blocks[i];
		sum->leaves += b->sum.leaves;
		sum->tests += b->sum.tests;
		sum->inner_step += b->sum.inner_step;
		sum->inner_start += b->sum.inner_start;
		sum->hits += b->sum.hits;
		sum->boxes += b->sum.boxes;
		leaves += (double)b->square.leaves;
		tests += (double)b->square.tests;
		step += (double)b->square.inner_step;
		start += (double)b->square.inner_start;
		hits += (double)b->square.hits;
		boxes += (double)b->square.boxes;
		both += (double)b->steps_tests;
		out->walk_seconds += b->seconds;
	}
	out->leaves = mean_of((double)sum->leaves, leaves, n);
	out->tests = mean_of((double)sum->tests, tests, n);
	out->inner_step = mean_of((double)sum->inner_step, step, n);
	out->inner_start = mean_of((double)sum->inner_start, start, n);
	out->hits = mean_of((double)sum->hits, hits, n);
	out->boxes = mean_of((double)sum->boxes, boxes, n);
	double steps = run->source.accel->volumes ? step : leaves;
	out->cost = mean_of(alpha * (double)accel_steps(run->source.accel, sum) + beta * (double)sum->tests,
	                    alpha * alpha * steps + beta * beta * tests + 2 * alpha * beta * both, n);
}

int shoot_rays(struct actual *out, const struct accel *a, enum workload w, uint64_t count, uint64_t seed, double alpha,
               double beta, int threads, const atomic_int *stop, struct err *e)
{
	struct run run = { .count = count, .stop = stop };
	size_t blocks = (size_t)((count + BLOCK - 1) / BLOCK);
	*out = (struct actual){ .rays = count };
	if (ray_source_open(&run.source, a, w, seed, e) != 0)
		return -1;
	run.blocks = NEW(&run.source.mem, struct block, blocks);
	if (!run.blocks) {
		ray_source_close(&run.source);
		return err_memory(e, "rays");
	}
	par_for(threads, blocks, shoot_block, &run);
	int status = atomic_load(&run.failed) ? err_memory(e, "rays") : 0;
	if (status == 0 && stop && *stop)
		status = err_at(e, STATUS_ENVIRONMENT, NULL, 0, "interrupted");
	if (status == 0 && count > 0)
		sum_up(out, &run, blocks, alpha, beta);
	ray_source_close(&run.source);
	return status;
}
