#include "trace/render_sums.h"

void render_sums_add(struct render_sums *s, const struct accel *a, const struct tally *n, uint64_t rays)
{
#define ADD(field) s->square.field += n->field * n->field; s->cross.field += n->field * rays;
	TALLY_COUNTS(ADD)
#undef ADD
	s->steps_tests += accel_steps(a, n) * n->tests;
	s->step_start += n->inner_step * n->inner_start;
	s->rays += rays;
	s->rays_square += rays * rays;
}

/* Mean of a ratio estimator and its standard error by the delta method: x summed over samples, x^2, x times rays. */
static struct mean ratio_mean(double x, double square, double cross, const struct render_sums *all, size_t samples)
{
	double rays = (double)all->rays, n = (double)samples;
	if (rays == 0)
		return (struct mean){ NAN, NAN };
	double mean = x / rays, spread = fmax(0, square - 2 * mean * cross + mean * mean * (double)all->rays_square);
	return (struct mean){ mean, n > 1 ? sqrt(spread * n / (n - 1)) / rays : NAN };
}

void render_sum_up(struct rendering *out, const struct accel *accel, const struct render_run *run, size_t samples,
                   const struct render_sums *sums, size_t blocks)
{
	struct render_sums all = { 0 };
	struct actual *a = &out->actual;
	double alpha = run->alpha, beta = run->beta;
	for (size_t i = 0; i < blocks; i++) {
		const struct render_sums *b = &sums[i];
		for (int c = 0; c < RAY_CLASSES; c++) {
			out->classes[c].rays += b->classes[c].rays;
			out->classes[c].missed += b->classes[c].missed;
			tally_add(&out->classes[c].sum, &b->classes[c].sum);
			tally_add(&a->sum, &b->classes[c].sum);
		}
		tally_add(&all.square, &b->square);
		tally_add(&all.cross, &b->cross);
		all.rays += b->rays;
		all.rays_square += b->rays_square;
		all.steps_tests += b->steps_tests;
		all.step_start += b->step_start;
	}
	a->rays = all.rays;
#define MEAN(field) a->field = ratio_mean((double)a->sum.field, (double)all.square.field, (double)all.cross.field, &all, samples);
	TALLY_COUNTS(MEAN)
#undef MEAN
	a->inner = ratio_mean((double)a->sum.inner_step + (double)a->sum.inner_start,
	                      (double)all.square.inner_step + (double)all.square.inner_start + 2 * (double)all.step_start,
	                      (double)all.cross.inner_step + (double)all.cross.inner_start, &all, samples);
	double square = alpha * alpha * (double)accel_steps(accel, &all.square) + beta * beta * (double)all.square.tests +
	                2 * alpha * beta * (double)all.steps_tests;
	a->cost = ratio_mean(alpha * (double)accel_steps(accel, &a->sum) + beta * (double)a->sum.tests, square,
	                     alpha * (double)accel_steps(accel, &all.cross) + beta * (double)all.cross.tests, &all, samples);
}
