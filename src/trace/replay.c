#include "trace/replay.h"

#include "base/rng.h"

#include <stdlib.h>

/* Rays walked together; resamples of the bootstrap, of which the 10 lowest and the 10 highest lie outside the interval. */
enum { BLOCK = 4096, RESAMPLES = 400, OUTSIDE = 10 };

/* What a pixel's rays cost, and how many they are. */
struct pixel {
	double cost, rays;
};

int pilot_make(struct pilot *p, const struct scene *s, const struct accel *a, const struct render_options *o, int64_t width,
               int64_t height, int threads, const atomic_int *stop, struct err *e)
{
	struct render_options small = *o;
	const struct render_run run = { .alpha = 1, .beta = 1, .threads = threads, .segments = true, .stop = stop };
	small.width = width;
	small.height = height;
	small.sampling = SAMPLE_LATTICE;
	p->samples = (size_t)(width * height) * render_frames(o);
	return render_scene(&p->image, s, a, &small, &run, e);
}

void pilot_free(struct pilot *p)
{
	rendering_free(&p->image);
}

/* Rays, hits and tallies of one block. */
struct work {
	struct ray rays[BLOCK];
	struct hit hits[BLOCK];
	struct tally tallies[BLOCK];
};

static void add_counts(struct replay_counts *c, const struct tally *n, bool mailbox)
{
	c->leaves += (double)n->leaves;
	c->tests_made += (double)(mailbox ? n->tests_made : n->tests);
	c->inner += (double)(n->inner_step + n->inner_start);
	c->boxes += (double)n->boxes;
}

static void replay_block(struct pixel *pixels, struct replay_counts *counts, struct work *w, const struct segment *segments, size_t count, const struct accel *a,
                         double alpha, double beta)
{
	for (size_t i = 0; i < count; i++) {
		w->rays[i] = segments[i].ray;
		w->rays[i].slack = a->slack;
		w->rays[i].through = true;
	}
	a->ops->shoot_many(a, w->rays, count, w->hits, w->tallies);
	for (size_t i = 0; i < count; i++) {
		struct pixel *p = &pixels[segments[i].sample];
		p->cost += alpha * (double)accel_steps(a, &w->tallies[i]) + beta * (double)w->tallies[i].tests;
		add_counts(counts, &w->tallies[i], a->mailbox != MAILBOX_NONE);
		p->rays += w->tallies[i].leaves + w->tallies[i].inner_start + w->tallies[i].inner_step > 0;
	}
}

static int compare_reals(const void *p, const void *q)
{
	double a = *(const double *)p, b = *(const double *)q;
	return (a > b) - (a < b);
}

static double mean_of(const struct pixel *pixels, size_t count)
{
	double cost = 0, rays = 0;
	for (size_t i = 0; i < count; i++) {
		cost += pixels[i].cost;
		rays += pixels[i].rays;
	}
	return rays > 0 ? cost / rays : NAN;
}

static double resample(const struct pixel *pixels, size_t count, uint64_t number)
{
	double cost = 0, rays = 0;
	uint64_t key = rng_key(count, 0, number);
	for (size_t i = 0; i < count; i++) {
		const struct pixel *p = &pixels[(size_t)(rng_uniform(key, i) * (double)count)];
		cost += p->cost;
		rays += p->rays;
	}
	return rays > 0 ? cost / rays : NAN;
}

static void find_interval(struct estimate *out, const struct pixel *pixels, size_t count)
{
	double means[RESAMPLES];
	for (size_t i = 0; i < RESAMPLES; i++)
		means[i] = resample(pixels, count, i);
	qsort(means, RESAMPLES, sizeof *means, compare_reals);
	out->low = means[OUTSIDE];
	out->high = means[RESAMPLES - 1 - OUTSIDE];
}

/* Sums over all rays as means over those that visit a cell. */
static void find_means(struct replay_counts *c, const struct pixel *pixels, size_t count)
{
	double rays = 0;
	for (size_t i = 0; i < count; i++)
		rays += pixels[i].rays;
	c->leaves /= rays;
	c->tests_made /= rays;
	c->inner /= rays;
	c->boxes /= rays;
}

int replay_cost(struct estimate *out, struct replay_counts *counts, const struct pilot *p, const struct accel *a,
                double alpha, double beta, struct err *e)
{
	struct pixel *pixels = calloc(p->samples, sizeof *pixels);
	struct work *w = malloc(sizeof *w);
	struct replay_counts sum = { 0 };
	int status = pixels && w ? 0 : err_memory(e, "replay");
	for (size_t i = 0; status == 0 && i < p->image.segment_count; i += BLOCK) {
		size_t left = p->image.segment_count - i;
		replay_block(pixels, &sum, w, &p->image.segments[i], left < BLOCK ? left : BLOCK, a, alpha, beta);
	}
	if (status == 0) {
		out->mean = mean_of(pixels, p->samples);
		find_interval(out, pixels, p->samples);
		find_means(&sum, pixels, p->samples);
		if (counts)
			*counts = sum;
	}
	free(pixels);
	free(w);
	return status;
}
