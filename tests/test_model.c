/* The model of Subramanian and Fussell: its formulas, its fits, and subdivision that ends by it. */
#include "tests/structure.h"

#include "accel/grid.h"
#include "cost/fit.h"
#include "cost/model.h"
#include "cost/stop.h"

/* Regions examined of at most k that each stop a ray by the chance p: as printed, the rays that pass all of them forgotten; and with
 * them. */
static void regions_are_the_sums_they_stand_for(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("tetra", 3, false);
	for (int resolution = 1; resolution <= 4; resolution++) {
		const struct grid_options o = { .resolution = resolution, .root = ROOT_BOX };
		struct accel a;
		struct model m;
		assert_int_equal(accel_build(&a, accel_find("grid"), &o, &p, &e), 0);
		assert_int_equal(model_make(&m, &a, &e), 0);
		double sum = 0, passed = 1, mean = 0;
		for (uint64_t i = 1; i <= a.leaves; i++) {
			mean += passed; /* the chance that region i is examined */
			sum += (double)i * m.chance * passed;
			passed *= 1 - m.chance;
		}
		assert_near(m.regions, fmax(1, sum), 1e-9);
		assert_near(m.regions_truncated, mean, 1e-9);
		assert_near(m.per_leaf, (double)a.references / (double)a.leaves, 1e-12);
		assert_true(m.chance > 0 && m.chance <= 1);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* One axis-parallel rectangle in each of the eight cells of a 2 x 2 x 2 grid: p, n_pr and costs by hand. */
static void statistics_by_hand(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct scene s = { 0 };
	struct vec low[3] = { vec(0, 0, 0), vec(0.5, 0, 0), vec(0, 0.5, 0) }, high[3] = { vec(2, 2, 2), vec(2, 1.5, 2), vec(1.5, 2, 2) };
	scene_add_polygon(&s, low, 3);
	scene_add_polygon(&s, high, 3);
	struct primitives p = make_primitives(&s);
	const struct grid_options o = { .resolution = 2, .root = ROOT_BOX };
	struct accel a;
	struct model m;
	assert_int_equal(accel_build(&a, accel_find("grid"), &o, &p, &e), 0);
	assert_int_equal(model_make(&m, &a, &e), 0);
	assert_near(m.per_leaf, 2.0 / 8, 1e-12);
	assert_near(m.chance, 2 * (2 * 0.5 * 0.5) / (8 * 6), 1e-12);
	assert_near(m.flops.scene, 15.5 * m.regions * m.per_leaf, 1e-12);
	assert_near(m.flops.traversal, 6.5 * m.regions, 1e-12);
	accel_free(&a);
	primitives_free(&p);
}

/* Figure 4: A holds four things, among them B of two, C of three and D of two boxes; of theirs E has two, F three, G two. */
static const struct { int depth; bool leaf; double side; } figure4[] = {
	{ 0, false, 8 },                                                      /* A */
	{ 1, false, 4 }, { 2, false, 2 }, { 3, true, 1 }, { 3, true, 1 }, { 2, true, 1 }, /* B: E, a leaf */
	{ 1, false, 5 }, { 2, false, 3 }, { 3, true, 1 }, { 3, true, 1 }, { 3, true, 1 }, { 2, true, 1 }, { 2, true, 1 }, /* C: F, leaves */
	{ 1, false, 3 }, { 2, false, 2 }, { 3, true, 1 }, { 3, true, 1 }, { 2, true, 1 }, /* D: G, a leaf */
	{ 1, true, 1 },
};

static int cells_of_figure4(const struct accel *a, cell_fn *fn, void *ctx)
{
	static const uint32_t id[1] = { 0 };
	for (size_t i = 0; i < sizeof figure4 / sizeof *figure4; i++) {
		double side = figure4[i].side;
		struct cell c = { .bounds = { vec(0, 0, 0), vec(side, side, side) }, .area = 6 * side * side,
			          .depth = (uint16_t)figure4[i].depth, .leaf = figure4[i].leaf };
		c.ids = c.leaf ? id : NULL;
		c.count = c.leaf;
		int status = fn(ctx, &c);
		if (status != 0)
			return status;
	}
	(void)a;
	return 0;
}

static void hierarchy_of_figure_4(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct scene s = { 0 };
	scene_add_polygon(&s, (const struct vec[3]){ vec(0, 0, 0), vec(1, 0, 0), vec(0, 1, 0) }, 3);
	struct primitives p = make_primitives(&s);
	const struct accel_ops ops = { .name = "figure 4", .cells = cells_of_figure4 };
	const struct accel a = { .ops = &ops, .primitives = &p, .root = { vec(0, 0, 0), vec(8, 8, 8) }, .depth = 3,
		                 .nodes = sizeof figure4 / sizeof *figure4, .leaves = 12 };
	struct model m;
	double A = 64;
	assert_int_equal(model_make(&m, &a, &e), 0);
	/* 1 + 4 P(A|A) + 2 P(B|A) + 3 P(C|A) + 2 P(D|A) + 2 P(E|A) + 3 P(F|A) + 2 P(G|A) */
	double regions = 1 + 4 + (2 * 16 + 3 * 25 + 2 * 9 + 2 * 4 + 3 * 9 + 2 * 4) / A;
	assert_near(m.regions, regions, 1e-12);
	assert_near(m.cost, 15.5 * regions, 1e-12);
	assert_near(m.descent, 15.5 * (1 + 7 * 3 + 4 * 2) / 12, 1e-12);
	primitives_free(&p);
}

/* Tables 7 and 8 lead to h = 13.9 and 13.1 for tetra, 24.0 and 25.5 for balls. */
static void fits_find_what_they_were_made_of(void **state)
{
	(void)state;
	double x[12], y[12];
	for (int i = 0; i < 12; i++) {
		x[i] = i + 3;
		y[i] = 9928.28 * exp(-0.30 * x[i]);
	}
	struct exponential f = fit_exponential(x, y, 12);
	assert_near(f.factor, 9928.28, 1e-8);
	assert_near(f.rate, -0.30, 1e-12);
	static const struct { struct exponential scene, traversal; double height; } paper[] = {
		{ { 9928.28, -0.30 }, { 17.34, 0.19 }, 13.9 }, { { 5473.92, -0.35 }, { 27.92, 0.13 }, 13.1 },
		{ { 111311.80, -0.29 }, { 19.98, 0.11 }, 24.0 }, { { 338605.37, -0.34 }, { 70.41, 0.06 }, 25.5 },
	};
	for (size_t i = 0; i < sizeof paper / sizeof *paper; i++)
		assert_near(fit_minimum(paper[i].scene, paper[i].traversal), paper[i].height, 0.05);
	assert_true(isnan(fit_minimum(f, f)));
	assert_true(isnan(fit_exponential(x, y, 1).rate));
}

/* What stops by a prediction is the tree of the sweep that it likes best. */
static void stops_where_the_prediction_is_least(void **state)
{
	(void)state;
	struct primitives p = make_spd("tetra", 4, false);
	const struct accel_ops *ops = accel_find("bsp");
	const struct key *depth = key_find(ops->keys, "max_depth"), *stop = key_find(ops->keys, "stop");
	for (int by = STOP_MODEL; by <= STOP_EXACT; by++) {
		struct err e = { 0 };
		_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
		int64_t best = -1, reached, *max_depth = (int64_t *)(void *)(options + depth->offset);
		double least = INFINITY;
		key_defaults(ops->keys, options);
		for (*max_depth = 0; *max_depth <= 14; ++*max_depth) {
			struct accel a;
			struct model m;
			struct prediction q;
			assert_int_equal(accel_build(&a, ops, options, &p, &e), 0);
			assert_int_equal(model_make(&m, &a, &e), 0);
			assert_int_equal(cost_predict(&q, &a, LAW_RAYS, 1, 1, &e), 0);
			double cost = by == STOP_MODEL ? m.cost : FLOPS_TEST * q.tests + FLOPS_PLANE * q.inner;
			if (cost < least) {
				least = cost;
				best = *max_depth;
			}
			accel_free(&a);
		}
		*max_depth = 14;
		*(int *)(void *)(options + stop->offset) = by;
		struct accel a;
		assert_int_equal(stop_build(&a, ops, options, &p, 1, &reached, &e), 0);
		assert_int_equal(reached, best);
		assert_int_equal(a.depth, best);
		accel_free(&a);
	}
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(regions_are_the_sums_they_stand_for),
		cmocka_unit_test(statistics_by_hand),
		cmocka_unit_test(hierarchy_of_figure_4),
		cmocka_unit_test(fits_find_what_they_were_made_of),
		cmocka_unit_test(stops_where_the_prediction_is_least),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
