/* Bounding volume hierarchies: every builder and every traversal finds what the list finds, visits what the theory says, and is the
 * same for any number of threads. */
#include "tests/oracle.h"

#include "accel/bvh.h"

static const char *const builders[] = { "binned", "sah", "median", "insertion", "spatial" };
enum { BUILDERS = 5, TRAVERSALS = 8 };

static struct bvh_options options(void)
{
	struct bvh_options o;
	key_defaults(accel_find("bvh")->keys, &o);
	return o;
}

static void hits_are_those_of_the_list(void **state)
{
	(void)state;
	for (int s = 0; s < SCENES; s++) {
		struct primitives p = make_spd(scenes[s].family, scenes[s].size, scenes[s].tessellate);
		struct oracle oracle = oracle_make(&p, 10000);
		for (int v = 0; v < BUILDERS + TRAVERSALS + 1; v++) {
			char what[120];
			struct bvh_options o = options();
			o.builder = v < BUILDERS ? v : v % 2 ? BVH_BINNED : BVH_MEDIAN;
			o.traversal = v < BUILDERS || v == BUILDERS + TRAVERSALS ? BVH_ORDERED : v - BUILDERS;
			o.max_objects = v % 3 + 1;
			o.optimise = v == BUILDERS + TRAVERSALS ? 2 : 0;
			struct accel a = build("bvh", &o, &p);
			snprintf(what, sizeof what, "%s %d: %s, traversal %d", scenes[s].family, scenes[s].size, builders[o.builder], o.traversal);
			if (o.traversal != BVH_CACHE)
				compare_hits(&a, &oracle, 0, what);
			accel_free(&a);
		}
		oracle_free(&oracle);
		primitives_free(&p);
	}
}

/* Rays cut off where they end, so that no traversal can do less or more: the counts of the theory exactly. */
static void nodes_up_to_the_hit_are_predicted_exactly(void **state)
{
	(void)state;
	for (int s = 0; s < SCENES; s++) {
		struct primitives p = make_spd(scenes[s].family, scenes[s].size, scenes[s].tessellate);
		struct oracle oracle = oracle_make(&p, 40000);
		for (int v = 0; v < BUILDERS; v++) {
			struct err e = { 0 };
			struct bvh_options o = options();
			struct prediction predicted;
			double sum = 0, square = 0;
			o.builder = v;
			struct accel a = build("bvh", &o, &p);
			assert_int_equal(cost_predict(&predicted, &a, LAW_RAYS, 1.2, 1, &e), 0);
			assert_near(predicted.volumes, (1 - predicted.surface_share) * predicted.sah +
			            predicted.surface_share * (predicted.epo + predicted.dq), 1e-9 * predicted.volumes);
			for (size_t i = 0; i < oracle.count; i++) {
				struct ray r = oracle.rays[i];
				struct hit h;
				struct tally n = { 0 };
				r.through = true;
				r.t_max = oracle.hits[i].t;
				a.ops->shoot_counted(&a, &r, &h, &n);
				double cost = 1.2 * (double)n.inner_step + (double)n.tests;
				sum += cost;
				square += cost * cost;
			}
			double count = (double)oracle.count, mean = sum / count, se = sqrt((square / count - mean * mean) / count);
			if (fabs(mean - predicted.volumes) > 4 * se)
				fail_msg("%s %d, %s: %.5f, predicted %.5f, z %.2f", scenes[s].family, scenes[s].size, builders[v], mean,
				         predicted.volumes, (mean - predicted.volumes) / se);
			accel_free(&a);
		}
		oracle_free(&oracle);
		primitives_free(&p);
	}
}

/* The walk to the nearest hit itself: where the hit is not known before, and boxes overlap. */
static void boxes_are_visited_up_to_the_hit_and_no_others(void **state)
{
	(void)state;
	static const struct { const char *family; int size, builder; } trees[] = {
		{ "lab", SPD_DEFAULT_SIZE, BVH_SPATIAL }, { "theater", SPD_DEFAULT_SIZE, BVH_MEDIAN }, { "gears", 1, BVH_INSERTION }, { "teapot", 2, BVH_BINNED },
	};
	for (size_t k = 0; k < sizeof trees / sizeof *trees; k++) {
		struct primitives p = make_spd(trees[k].family, trees[k].size, true);
		struct err e = { 0 };
		struct bvh_options o = options();
		struct prediction predicted;
		struct actual actual;
		o.builder = trees[k].builder;
		struct accel a = build("bvh", &o, &p);
		assert_int_equal(cost_predict(&predicted, &a, LAW_RAYS, 1.2, 1, &e), 0);
		assert_int_equal(shoot_rays(&actual, &a, WORKLOAD_INVARIANT, 100000, 5, 1.2, 1, par_processors(), NULL, &e), 0);
		compare(trees[k].family, actual.cost, predicted.predicted_exact);
		compare(trees[k].family, actual.leaves, predicted.leaves);
		compare(trees[k].family, actual.tests, predicted.tests);
		compare(trees[k].family, actual.inner_step, predicted.inner_step);
		accel_free(&a);
		primitives_free(&p);
	}
}

/* A ray through hundreds of boxes at once leaves more for later than are kept in order. */
static void boxes_beyond_number_are_visited_in_any_order(void **state)
{
	(void)state;
	struct spd_options soup;
	key_defaults(spd_keys, &soup);
	soup.count = 4000;
	soup.cube = 2;
	struct primitives p = make_family("soup", &soup);
	struct oracle oracle = oracle_make(&p, 300);
	struct bvh_options o = options();
	o.max_objects = 1;
	struct accel a = build("bvh", &o, &p);
	compare_hits(&a, &oracle, 0, "a dense soup");
	accel_free(&a);
	oracle_free(&oracle);
	primitives_free(&p);
}

/* Nothing stops lines, so that SAH is their cost exactly. */
static void lines_cost_their_areas(void **state)
{
	(void)state;
	struct primitives p = make_spd("gears", 1, false);
	for (int v = 0; v < BUILDERS; v++) {
		struct err e = { 0 };
		struct bvh_options o = options();
		struct prediction predicted;
		struct actual actual;
		o.builder = v;
		struct accel a = build("bvh", &o, &p);
		assert_int_equal(cost_predict(&predicted, &a, LAW_LINES, 1.2, 1, &e), 0);
		assert_int_equal(shoot_rays(&actual, &a, WORKLOAD_LINES, 100000, 3, 1.2, 1, par_processors(), NULL, &e), 0);
		assert_near(predicted.predicted_exact, predicted.sah, 1e-12 * predicted.sah);
		if (fabs(actual.cost.mean - predicted.sah) > 4 * actual.cost.se)
			fail_msg("%s: %.5f, predicted %.5f, se %.5f", builders[v], actual.cost.mean, predicted.sah, actual.cost.se);
		accel_free(&a);
	}
	primitives_free(&p);
}

struct digest {
	uint64_t cells, sum;
	double areas;
};

static int digest_cell(void *ctx, const struct cell *c)
{
	struct digest *d = ctx;
	d->cells++;
	d->areas += c->area * (double)(1 + d->cells % 7);
	for (uint32_t i = 0; i < c->count; i++)
		d->sum = d->sum * 31 + c->ids[i];
	return 0;
}

/* More primitives than one thread takes on: the work is divided, the tree is the same. */
static void threads_do_not_change_the_tree(void **state)
{
	(void)state;
	static const char *const names[] = { "bvh", "bvh8" };
	struct primitives p = make_spd("teapot", 39, true);
	for (int k = 0; k < 2; k++) {
		struct digest first = { 0 };
		for (int threads = 1; threads <= 7; threads += 3) {
			_Alignas(16) unsigned char o[ACCEL_OPT_MOST];
			struct err e = { 0 };
			struct digest d = { 0 };
			struct accel a;
			key_defaults(accel_find(names[k])->keys, o);
			assert_int_equal(accel_build_on(&a, accel_find(names[k]), o, &p, threads, &e), 0);
			a.ops->cells(&a, digest_cell, &d);
			if (threads == 1)
				first = d;
			assert_memory_equal(&d, &first, sizeof d);
			accel_free(&a);
		}
	}
	primitives_free(&p);
}

/* Smits' variants test the same boxes and primitives in the same order, until rays may end at any hit: then fewer; and a ray shot
 * again right after itself costs one test where it hits. */
static void the_ladder_saves_work(void **state)
{
	(void)state;
	enum { SEGMENTS = 4000 };
	struct primitives p = make_spd("lab", SPD_DEFAULT_SIZE, false);
	struct actual actual[BVH_CACHE + 1], twice;
	for (int t = BVH_POINT; t <= BVH_CACHE; t++) {
		struct err e = { 0 };
		struct bvh_options o = options();
		o.builder = BVH_MEDIAN;
		o.max_objects = 1;
		o.traversal = t;
		struct accel a = build("bvh", &o, &p);
		assert_int_equal(shoot_rays(&actual[t], &a, WORKLOAD_SEGMENTS, SEGMENTS, 5, 1, 1, 1, NULL, &e), 0);
		if (t == BVH_CACHE)
			assert_int_equal(shoot_rays(&twice, &a, WORKLOAD_SEGMENTS_TWICE, SEGMENTS, 5, 1, 1, 1, NULL, &e), 0);
		assert_int_equal(actual[t].sum.hits, actual[BVH_POINT].sum.hits);
		accel_free(&a);
	}
	for (int t = BVH_SLABS; t <= BVH_ARRAY; t++)
		assert_memory_equal(&actual[t].sum, &actual[BVH_SLABS].sum, sizeof actual[t].sum);
	assert_near((double)actual[BVH_POINT].sum.boxes, (double)actual[BVH_SLABS].sum.boxes, 1e-3 * (double)actual[BVH_SLABS].sum.boxes);
	assert_true(actual[BVH_ANY].sum.boxes < actual[BVH_ARRAY].sum.boxes);
	assert_true(actual[BVH_ANY].sum.tests < actual[BVH_ARRAY].sum.tests);
	assert_true(twice.sum.boxes < actual[BVH_CACHE].sum.boxes);
	primitives_free(&p);
}

/* Surfaces that overlap in a side of the root: what starts on one and leads out does not find the other. */
static void rays_out_of_the_root_hit_nothing(void **state)
{
	(void)state;
	struct scene s = { 0 };
	_Alignas(16) unsigned char o[ACCEL_OPT_MOST];
	add_box(&s, vec(0, 0, 0), vec(1, 1, 1));
	add_box(&s, vec(0.25, 0.25, 0), vec(0.75, 0.75, 0.5));
	struct primitives p = make_primitives(&s);
	for (const struct accel_ops *const *ops = accel_all; *ops; ops++) {
		key_defaults((*ops)->keys, o);
		struct accel a = build((*ops)->name, o, &p);
		for (int out = 0; out < 2; out++)
			for (uint32_t from = 0; from < p.count; from++) {
				struct ray r = { .o = vec(0.4, 0.45, 0), .d = vec(0, 0, out ? -1 : 1), .t_max = INFINITY, .slack = a.slack, .from = from };
				struct hit h[3];
				struct tally n[2] = { { 0 } };
				uint64_t found = a.ops->shoot(&a, &r, &h[0]);
				assert_int_equal(a.ops->shoot_counted(&a, &r, &h[1], &n[0]), found);
				a.ops->shoot_many(&a, &r, 1, &h[2], &n[1]);
				assert_true(n[0].hits == found && n[1].hits == found && found == !out);
			}
		accel_free(&a);
	}
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(hits_are_those_of_the_list),
		cmocka_unit_test(rays_out_of_the_root_hit_nothing),
		cmocka_unit_test(boxes_are_visited_up_to_the_hit_and_no_others),
		cmocka_unit_test(boxes_beyond_number_are_visited_in_any_order),
		cmocka_unit_test(lines_cost_their_areas),
		cmocka_unit_test(threads_do_not_change_the_tree),
		cmocka_unit_test(the_ladder_saves_work),
		cmocka_unit_test(nodes_up_to_the_hit_are_predicted_exactly),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
