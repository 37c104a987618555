#include "report/claims.h"

#include "report/rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct range {
	double low, high, sum;
	size_t count, inside; /* inside: of the paper's band */
};

static struct range range_none(void)
{
	return (struct range){ .low = INFINITY, .high = -INFINITY };
}

static void range_add(struct range *r, double x, double low, double high)
{
	if (!isfinite(x))
		return;
	r->low = fmin(r->low, x);
	r->high = fmax(r->high, x);
	r->sum += x;
	r->count++;
	r->inside += x >= low && x <= high;
}

static void range_print(struct text *out, const char *what, const struct range *r)
{
	if (r->count > 0)
		text_print(out, "%s%s%.3g .. %.3g in %zu rows, %.0f %% of them in the paper's band", out->size ? "; " : "", what, r->low, r->high,
		           r->count, 100 * (double)r->inside / (double)r->count);
}

/* The range of a column over the rows that 'shows' picks. */
static struct range range_of(const struct table *t, bool (*shows)(const struct table *, size_t), const char *column, double low,
                             double high)
{
	struct range r = range_none();
	for (size_t i = 0; i < t->rows; i++)
		if (shows(t, i))
			range_add(&r, table_number(t, i, column), low, high);
	return r;
}

/* The row that differs from 'row' in balance only, or none (t->rows). */
static size_t find_balanced_twin(const struct table *t, size_t row)
{
	static const char *const same[] = { "scene", "max_objects", "root", "max_depth", "overlap", "workload", "rays", "criterion", "width" };
	for (size_t i = 0; i < t->rows; i++) {
		size_t c = 0;
		if (!table_is(t, i, "balanced", "true") || !table_is(t, i, "scene", table_text(t, row, "scene")))
			continue;
		while (c < sizeof same / sizeof *same &&
		       (strcmp(same[c], "rays") == 0 && table_is(t, row, "workload", "render") ? true
		        : table_is(t, i, same[c], table_text(t, row, same[c]))))
			c++;
		if (c == sizeof same / sizeof *same)
			return i;
	}
	return t->rows;
}

static void measure_growth(struct text *out, const struct table *t)
{
	struct range r = range_none();
	for (size_t i = 0; i < t->rows; i++) {
		if (!rows_is_random_rays(t, i) || !table_is(t, i, "balanced", "false"))
			continue;
		size_t twin = find_balanced_twin(t, i);
		if (twin < t->rows)
			range_add(&r, table_number(t, twin, "leaves") / table_number(t, i, "leaves"), 2, 5);
	}
	range_print(out, "leaves grow by ", &r);
	if (r.count)
		text_print(out, "; %.2f on average", r.sum / (double)r.count);
}

static void measure_random_rays(struct text *out, const struct table *t)
{
	struct range small = range_none(), large = range_none();
	for (size_t i = 0; i < t->rows; i++)
		if (rows_is_random_rays(t, i))
			range_add(table_number(t, i, "triangles") < 100 ? &small : &large, table_number(t, i, "ratio"), 0.8, 1.7);
	range_print(out, "", &large);
	range_print(out, "scenes below 100 triangles ", &small);
}

static void measure_balance(struct text *out, const struct table *t)
{
	size_t pairs = 0, better = 0;
	for (size_t i = 0; i < t->rows; i++) {
		if (!rows_is_random_rays(t, i) || !table_is(t, i, "balanced", "false"))
			continue;
		size_t twin = find_balanced_twin(t, i);
		if (twin == t->rows)
			continue;
		pairs++;
		better += fabs(table_number(t, twin, "ratio") - 1) <= fabs(table_number(t, i, "ratio") - 1);
	}
	if (pairs)
		text_print(out, "the balanced tree has the ratio nearer to 1 in %zu of %zu pairs", better, pairs);
}

static void measure_convergence(struct text *out, const struct table *t)
{
	double least = INFINITY, most = 0, far_least = 0, far_most = 0;
	for (size_t i = 0; i < t->rows; i++) {
		double rays = table_number(t, i, "rays"), far = fabs(table_number(t, i, "ratio_exact") - 1);
		if (!rows_is_convergence(t, i))
			continue;
		if (rays < least || rays > most) {
			far_least = rays < least ? 0 : far_least;
			far_most = rays > most ? 0 : far_most;
			least = fmin(least, rays);
			most = fmax(most, rays);
		}
		far_least = rays == least ? fmax(far_least, far) : far_least;
		far_most = rays == most ? fmax(far_most, far) : far_most;
	}
	if (most > least)
		text_print(out, "off the limit, which is known exactly, by up to %.2g %% at %.0f rays and %.2g %% at %.0f", 100 * far_least, least,
		           100 * far_most, most);
}

static bool is_wall_outside(const struct table *t, size_t row)
{
	return rows_is_image(t, row) && rows_is_wall_outside(t, row);
}

static bool is_not_wall_outside(const struct table *t, size_t row)
{
	return rows_is_image(t, row) && !rows_is_wall_outside(t, row);
}

static void measure_rendering(struct text *out, const struct table *t)
{
	struct range wall = range_of(t, is_wall_outside, "ratio", 3.8, 6.0), others = range_of(t, is_not_wall_outside, "ratio", 0.8, 2.7);
	range_print(out, "wall from outside ", &wall);
	range_print(out, "others ", &others);
}

static void measure_centers(struct text *out, const struct table *t)
{
	static const char *const families[] = { "gears", "teapot", "city", "town", "sphere", "tetra" };
	for (size_t f = 0; f < sizeof families / sizeof *families; f++) {
		struct range r = range_none();
		for (size_t i = 0; i < t->rows; i++)
			if (rows_is_image(t, i) && table_is(t, i, "family", families[f]))
				range_add(&r, table_number(t, i, "ratio"), 0, 0);
		if (r.count)
			text_print(out, "%s%s %.2f &plusmn; %.2f", out->size ? "; " : "", families[f], (r.low + r.high) / 2, (r.high - r.low) / 2);
	}
}

static void measure_spread(struct text *out, const struct table *t)
{
	double worst = 0;
	const char *scene = "";
	for (size_t i = 0; i < t->rows; i++) {
		struct range r = range_none();
		if (!rows_is_image(t, i) || (i > 0 && table_is(t, i - 1, "scene", table_text(t, i, "scene"))))
			continue;
		for (size_t k = i; k < t->rows && table_is(t, k, "scene", table_text(t, i, "scene")); k++)
			if (rows_is_image(t, k))
				range_add(&r, table_number(t, k, "ratio"), 0, 0);
		if (r.high / r.low > worst) {
			worst = r.high / r.low;
			scene = table_text(t, i, "scene");
		}
	}
	if (worst > 0)
		text_print(out, "highest over lowest ratio of the octrees of one scene: at most %.2f (%s)", worst, scene);
}

static void measure_overhead(struct text *out, const struct table *t)
{
	struct range r = range_of(t, rows_is_image, "overhead_actual", 1, 1.5);
	range_print(out, "", &r);
}

static void measure_cost(struct text *out, const struct table *t)
{
	struct range r = range_of(t, rows_is_image, "actual", 0, 65);
	range_print(out, "", &r);
}

static void measure_chance(struct text *out, const struct table *t)
{
	struct range ratio = range_of(t, rows_is_image_by_chance, "ratio", 0.91, 1.55);
	struct range cost = range_of(t, rows_is_image_by_chance, "actual", 0, 290);
	range_print(out, "ratio ", &ratio);
	range_print(out, "cost ", &cost);
}

static void measure_exact(struct text *out, const struct table *t)
{
	struct range r = range_of(t, rows_is_random_rays, "ratio_exact", 0.993, 1.007), z = range_of(t, rows_is_random_rays, "z_exact", -4, 4);
	if (r.count)
		text_print(out, "exact prediction / actual %.4f .. %.4f in %zu rows; deviations of %.2f .. %.2f standard errors", r.low, r.high,
		           r.count, z.low, z.high);
}

static void measure_replay(struct text *out, const struct table *t)
{
	struct range replay = range_of(t, rows_is_image_of_any_tree, "ratio_replay", 0.97, 1.03);
	struct range calibrated = range_of(t, rows_is_image_of_any_tree, "ratio_calibrated", 0.9, 1.1);
	if (replay.count && calibrated.count)
		text_print(out, "replay / actual %.3f .. %.3f, %zu of %zu within 3 %%; calibrated / actual %.3f .. %.3f, %zu within 10 %%", replay.low,
		           replay.high, replay.inside, replay.count, calibrated.low, calibrated.high, calibrated.inside);
}

const struct claim claims[] = {
	{ "section 4.3.2", "leaves grow by a factor of 2 to 5 when an octree is balanced", measure_growth },
	{ "figure 1(a)", "random rays: predicted / actual is 0.8 .. 1.7 for all but the smallest scenes", measure_random_rays },
	{ "section 4.3.1", "for all scenes the balanced octree has the better ratio", measure_balance },
	{ "figure 1(b)", "slow but steady convergence in the number of rays", measure_convergence },
	{ "figure 3", "rendering: the ratio is 3.8 .. 6.0 for a wall model, 0.8 .. 2.7 for all others", measure_rendering },
	{ "section 4.3.2", "the ratio is about 0.85 for gears, 1.1 for the teapot, 1.2 for a city", measure_centers },
	{ "section 4.3.2", "the ratio hardly depends on the octree, only on the scene", measure_spread },
	{ "figure 4", "nodes visited / leaves visited is 1 .. 1.5, balanced or not", measure_overhead },
	{ "figure 3", "the actual cost stays below 65 in well-built octrees", measure_cost },
	{ "figure 5", "random octrees: 0.91 .. 1.55 but for one point at 0.65; cost up to nearly 290", measure_chance },
	{ "section 3.2", "E* is the expected cost of random rays; too complex to compute", measure_exact },
	{ "conclusion (i)", "open: to capture the rays of a rendering, and predict its cost", measure_replay },
	{ 0 }
};
