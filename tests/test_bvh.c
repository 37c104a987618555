/* Bounding volume hierarchies: every builder and every traversal finds what the list finds, visits what the theory says, and is the
 * same for any number of threads. */
#include "tests/structure.h"

#include "accel/bvh.h"
#include "accel/bvh8.h"
#include "accel/root.h"
#include "base/rng.h"
#include "trace/replay.h"

#include <string.h>

static const char *const builders[] = { "binned", "sah", "median", "insertion", "spatial" };
enum { BUILDERS = 5, TRAVERSALS = 8 };

static struct bvh_options options(void)
{
	struct bvh_options o;
	key_defaults(accel_find("bvh")->keys, &o);
	return o;
}

static struct accel build(const char *name, const void *o, const struct primitives *p)
{
	struct err e = { 0 };
	struct accel a;
	if (accel_build_on(&a, accel_find(name), o, p, par_processors(), &e) != 0 || a.ops->check(&a, &e) != 0)
		fail_msg("%s", e.text);
	return a;
}

/* The list's answer to 'count' invariant rays. */
struct oracle {
	struct accel list;
	struct ray *rays;
	struct hit *hits;
	size_t count;
};

static struct oracle oracle_make(const struct primitives *p, size_t count)
{
	struct err e = { 0 };
	struct ray_source source;
	int root = ROOT_BOX;
	struct oracle o = { .count = count, .rays = malloc(count * sizeof *o.rays), .hits = malloc(count * sizeof *o.hits) };
	o.list = build("list", &root, p);
	assert_int_equal(ray_source_open(&source, &o.list, WORKLOAD_INVARIANT, 7, &e), 0);
	for (size_t i = 0; i < count; i++) {
		o.rays[i] = ray_source_draw(&source, i);
		o.list.ops->shoot(&o.list, &o.rays[i], &o.hits[i]);
	}
	ray_source_close(&source);
	return o;
}

static void oracle_free(struct oracle *o)
{
	accel_free(&o->list);
	free(o->rays);
	free(o->hits);
}

static bool same_time(double t, double u, double near, const struct accel *a)
{
	return t == u || fabs(t - u) <= near * box_diagonal(&a->root);
}

/* Counted one by one and many at once: the list's hits, bit for bit. Uncounted: the same primitive, its t as near as 'near' is of the
 * root's diagonal, alone and among many. Any-hit queries hit when the list does. */
static void compare_hits(const struct accel *a, const struct oracle *o, double near, const char *what)
{
	struct hit *many = malloc(o->count * sizeof *many), *uncounted = malloc(o->count * sizeof *uncounted);
	struct tally *tallies = malloc(o->count * sizeof *tallies);
	a->ops->shoot_many(a, o->rays, o->count, many, tallies);
	accel_hit_many(a, o->rays, o->count, uncounted);
	for (size_t i = 0; i < o->count; i++) {
		struct hit h, counted;
		struct tally n = { 0 };
		struct ray any = o->rays[i];
		any.any = true;
		bool hit = a->ops->shoot(a, &o->rays[i], &h);
		a->ops->shoot_counted(a, &o->rays[i], &counted, &n);
		const struct hit *want = &o->hits[i];
		if (h.id != want->id || !same_time(h.t, want->t, near, a) ||
		    hit != (h.id != NO_PRIMITIVE) || counted.id != h.id || counted.t != want->t || many[i].id != h.id || many[i].t != want->t)
			fail_msg("%s: ray %zu hits %u at %.17g, %u counted, %u among many; the list %u at %.17g", what, i, h.id, h.t, counted.id,
			         many[i].id, o->hits[i].id, o->hits[i].t);
		if (uncounted[i].id != h.id || !same_time(uncounted[i].t, want->t, near, a))
			fail_msg("%s: ray %zu hits %u at %.17g among many, uncounted", what, i, uncounted[i].id, uncounted[i].t);
		if (memcmp(&n, &tallies[i], sizeof n) != 0)
			fail_msg("%s: ray %zu is counted otherwise among many", what, i);
		if (a->ops->shoot(a, &any, &h) != hit)
			fail_msg("%s: ray %zu: any hit and nearest hit disagree", what, i);
	}
	free(many);
	free(uncounted);
	free(tallies);
}

struct scene_at {
	const char *family;
	int size;
	bool tessellate;
};
static const struct scene_at scenes[] = { { "tetra", 3, false }, { "gears", 1, false }, { "balls", 1, false }, { "balls", 1, true },
	{ "teapot", 2, false }, { "wall", 4, false } };
enum { SCENES = sizeof scenes / sizeof *scenes };

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

static void any_instructions_find_what_the_list_finds(void **state)
{
	(void)state;
	for (int s = 0; s < SCENES; s++) {
		struct primitives p = make_spd(scenes[s].family, scenes[s].size, scenes[s].tessellate);
		struct oracle oracle = oracle_make(&p, 20000);
		for (int kernel = BVH8_BEST; kernel <= BVH8_PORTABLE; kernel++) {
			char what[120];
			struct bvh8_options o = { .kernel = kernel };
			struct accel a = build("bvh8", &o, &p);
			snprintf(what, sizeof what, "%s %d: bvh8, kernel %d", scenes[s].family, scenes[s].size, kernel);
			compare_hits(&a, &oracle, 5e-4, what);
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

/* Enough rays for bvh8 to sort them and to have several in flight; some of them for any hit, some through everything. */
static void order_does_not_matter(void **state)
{
	(void)state;
	enum { COUNT = 20000 };
	struct primitives p = make_spd("teapot", 70, true);
	struct bvh8_options o = { 0 };
	struct accel a = build("bvh8", &o, &p);
	struct err e = { 0 };
	struct ray_source source;
	struct ray *rays = malloc(COUNT * sizeof *rays);
	struct hit *hits = malloc(COUNT * sizeof *hits);
	struct hit *uncounted = malloc(COUNT * sizeof *uncounted);
	struct tally *tallies = malloc(COUNT * sizeof *tallies);
	assert_int_equal(ray_source_open(&source, &a, WORKLOAD_INVARIANT, 11, &e), 0);
	for (size_t i = 0; i < COUNT; i++) {
		rays[i] = ray_source_draw(&source, i);
		rays[i].any = i % 3 == 1;
		rays[i].through = i % 5 == 2;
	}
	uint32_t *order = bvh8_order(&a, rays, COUNT);
	assert_non_null(order);
	free(order);
	a.ops->shoot_many(&a, rays, COUNT, hits, tallies);
	accel_hit_many(&a, rays, COUNT, uncounted);
	for (size_t i = 0; i < COUNT; i++) {
		struct hit h;
		struct tally n = { 0 };
		a.ops->shoot_counted(&a, &rays[i], &h, &n);
		if (h.id != hits[i].id || h.t != hits[i].t || memcmp(&n, &tallies[i], sizeof n) != 0)
			fail_msg("ray %zu: %u at %.17g alone, %u at %.17g among many", i, h.id, h.t, hits[i].id, hits[i].t);
		a.ops->shoot(&a, &rays[i], &h);
		if (h.id != uncounted[i].id || !same_time(h.t, uncounted[i].t, 5e-4, &a))
			fail_msg("ray %zu, uncounted: %u at %.17g alone, %u at %.17g among many", i, h.id, h.t, uncounted[i].id, uncounted[i].t);
	}
	ray_source_close(&source);
	free(rays);
	free(hits);
	free(uncounted);
	free(tallies);
	accel_free(&a);
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

/* A solid box among specks that fill far larger boxes: rays towards it that any hit ends go straight there. */
static void any_hit_is_sought_where_it_is_likely(void **state)
{
	(void)state;
	enum { SPECKS = 10, RAYS = 2000 };
	struct scene s = { 0 };
	for (int i = 0; i < SPECKS * SPECKS * SPECKS; i++) {
		struct vec at = vec(i % SPECKS, i / SPECKS % SPECKS, i / SPECKS / SPECKS);
		add_box(&s, at, vec_add(at, vec(0.05, 0.05, 0.05)));
	}
	add_box(&s, vec(4.2, 4.2, 4.2), vec(4.9, 4.9, 4.9));
	struct primitives p = make_primitives(&s);
	_Alignas(16) unsigned char o[ACCEL_OPT_MOST];
	key_defaults(accel_find("bvh8")->keys, o);
	struct accel a = build("bvh8", o, &p);
	struct tally n = { 0 };
	for (uint64_t i = 0; i < RAYS; i++) {
		uint64_t key = rng_key(8, 1, i);
		struct vec from = vec(9 * rng_uniform(key, 0), 9 * rng_uniform(key, 1), -1);
		struct vec to = vec(4.2 + 0.7 * rng_uniform(key, 2), 4.2 + 0.7 * rng_uniform(key, 3), 4.5);
		struct ray r = { .o = from, .d = vec_unit(vec_sub(to, from)), .t_max = INFINITY, .slack = a.slack, .from = NO_PRIMITIVE, .any = true };
		struct hit h;
		assert_true(a.ops->shoot_counted(&a, &r, &h, &n));
	}
	assert_int_equal(n.leaves, RAYS);
	assert_true(n.inner_step <= RAYS * (uint64_t)a.depth);
	accel_free(&a);
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(hits_are_those_of_the_list),
		cmocka_unit_test(any_instructions_find_what_the_list_finds),
		cmocka_unit_test(rays_out_of_the_root_hit_nothing),
		cmocka_unit_test(boxes_are_visited_up_to_the_hit_and_no_others),
		cmocka_unit_test(boxes_beyond_number_are_visited_in_any_order),
		cmocka_unit_test(lines_cost_their_areas),
		cmocka_unit_test(threads_do_not_change_the_tree),
		cmocka_unit_test(order_does_not_matter),
		cmocka_unit_test(the_ladder_saves_work),
		cmocka_unit_test(any_hit_is_sought_where_it_is_likely),
		cmocka_unit_test(nodes_up_to_the_hit_are_predicted_exactly),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
