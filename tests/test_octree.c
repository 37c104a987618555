/* The octree's shape: lists, links, balance, the identities every octree obeys, and the list as the oracle of every hit. */
#include "tests/structure.h"

#include "accel/octree.h"
#include "trace/rays.h"
#include "base/rng.h"

#include <string.h>

static struct octree_options options(bool balanced, int max_objects, int max_depth, int root)
{
	return (struct octree_options){ .balanced = balanced, .max_objects = max_objects, .max_depth = max_depth, .root = root };
}

static struct accel build(const struct primitives *p, struct octree_options o)
{
	struct err e = { 0 };
	struct accel a;
	if (accel_build(&a, accel_find("octree"), &o, p, &e) != 0)
		fail_msg("%s", e.text);
	return a;
}

static void must_hold(const struct accel *a)
{
	struct err e = { 0 };
	if (a->ops->check(a, &e) != 0)
		fail_msg("%s", e.text);
}

static void every_variant_is_sound(void **state)
{
	(void)state;
	static const struct { const char *family; int size; bool tessellate; } scenes[] = {
		{ "tetra", 3, false }, { "gears", 1, false }, { "balls", 1, true }, { "balls", 2, false }, { "teapot", 2, false },
	};
	for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
		struct primitives p = make_spd(scenes[s].family, scenes[s].size, scenes[s].tessellate);
		for (int v = 0; v < 8; v++) {
			struct octree_options o = options(v & 1, v & 2 ? 2 : 10, 6, v & 4 ? ROOT_BOX : ROOT_CUBE);
			o.overlap = v == 3 ? OVERLAP_BBOX : OVERLAP_EXACT;
			struct accel a = build(&p, o);
			must_hold(&a);
			assert_int_equal(a.leaves, 7 * (a.nodes - a.leaves) + 1);
			accel_free(&a);
		}
		primitives_free(&p);
	}
}

/* A leaf's corners are corners or inner points of faces and edges of its neighbours: no leaf that shares one is two deeper. */
static void check_corners(const struct octree *o)
{
	for (uint32_t i = 0; i < o->node_count; i++) {
		const struct octree_node *n = &o->nodes[i];
		for (int corner = 0; !n->inner && corner < 8; corner++) {
			int32_t at[3];
			for (int k = 0; k < 3; k++) { /* the grid cell just outside the corner */
				at[k] = n->cell[k] + (corner >> k & 1 ? octree_side(n->depth) : -1);
				at[k] = at[k] < 0 ? 0 : at[k] >= OCTREE_CELLS ? OCTREE_CELLS - 1 : at[k];
			}
			const struct octree_node *m = o->nodes;
			while (m->inner) {
				int shift = OCTREE_LEVELS - 1 - m->depth;
				m = &o->nodes[m->child + (uint32_t)((at[0] >> shift & 1) | (at[1] >> shift & 1) << 1 |
				                                    (at[2] >> shift & 1) << 2)];
			}
			assert_true(m->depth <= n->depth + 1);
		}
	}
}

static void balancing_is_complete_and_idempotent(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("tetra", 4, false);
	struct octree_options o = options(true, 2, 9, ROOT_CUBE);
	struct accel plain = build(&p, options(false, 2, 9, ROOT_CUBE)), balanced = build(&p, o);
	must_hold(&balanced);
	check_corners(balanced.impl);
	assert_true(balanced.leaves > plain.leaves);

	struct octree_builder b;
	assert_int_equal(octree_builder_open(&b, &balanced, &o, &e), 0);
	assert_int_equal(b.tree.node_count, plain.nodes);
	assert_int_equal(octree_balance(&b, &e), 0);
	assert_int_equal(b.tree.node_count, balanced.nodes);
	assert_int_equal(octree_balance(&b, &e), 0);
	assert_int_equal(b.tree.node_count, balanced.nodes);
	octree_builder_close(&b);
	accel_free(&plain);
	accel_free(&balanced);
	primitives_free(&p);
}

/* Every octree: leaves' area = root's + inner nodes'; for lines the inner nodes met from the top are one fewer than the leaves. */
static void identities_of_octrees(void **state)
{
	(void)state;
	static const char *const families[] = { "tetra", "teapot", "gears", "sphere" };
	for (int i = 0; i < 16; i++) {
		struct err e = { 0 };
		struct primitives p = make_spd(families[i / 4], 2, false);
		struct accel a = build(&p, options(i & 1, 5, 7, i & 2 ? ROOT_BOX : ROOT_CUBE));
		struct prediction lines, rays;
		assert_int_equal(cost_predict(&lines, &a, LAW_LINES, 1, 1, &e), 0);
		assert_int_equal(cost_predict(&rays, &a, LAW_RAYS, 1, 1, &e), 0);
		assert_near(lines.inner_top_down / (lines.leaves - 1), 1, 1e-11);
		assert_near(lines.area_leaves / box_area(&a.root), lines.leaves, 1e-11 * lines.leaves);
		assert_near(rays.area_inside / p.area, 1, 1e-9);
		assert_true(lines.inner_step < lines.leaves && rays.inner_step < rays.leaves);
		if (i & 1)
			assert_true(lines.inner_step < 0.5 * lines.leaves && rays.inner_step < 0.5 * rays.leaves);
		accel_free(&a);
		primitives_free(&p);
	}
}

/* The grid's last plane is the root's upper side, to the bit: else outer faces would not be known as such. */
static void roots_end_on_the_grid(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 20000; i++) {
		uint64_t key = rng_key(4, 4, i);
		struct box b, root;
		for (int k = 0; k < 3; k++) {
			double lo = (2 * rng_uniform(key, (uint64_t)k) - 1) * ldexp(1, (int)(40 * rng_uniform(key, 3)) - 20);
			b.lo.a[k] = lo;
			b.hi.a[k] = lo + rng_uniform(key, 4 + (uint64_t)k) * ldexp(1, (int)(20 * rng_uniform(key, 7)) - 10);
		}
		root = root_box(&b, i % 2 ? ROOT_BOX : ROOT_CUBE);
		for (int k = 0; k < 3; k++) {
			double step = (root.hi.a[k] - root.lo.a[k]) / OCTREE_CELLS;
			assert_true(root.lo.a[k] <= b.lo.a[k] && root.hi.a[k] >= b.hi.a[k] && step > 0);
			assert_true(root.lo.a[k] + OCTREE_CELLS * step == root.hi.a[k]);
		}
	}
}

/* Two specks in every cell of depth 'last' all of whose ancestors, itself included, have coordinates of even sum. */
static void add_specks(struct scene *s, int depth, int last, int x, int y, int z)
{
	if ((x + y + z) % 2)
		return;
	if (depth < last) {
		for (int c = 0; c < 8; c++)
			add_specks(s, depth + 1, last, 2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2));
		return;
	}
	double side = ldexp(1, -depth), speck = 0.01 * side;
	for (int i = 0; i < 2; i++) {
		struct vec o = vec((x + 0.1 + 0.2 * i) * side, (y + 0.1) * side, (z + 0.1) * side);
		struct vec corners[3] = { o, vec_add(o, vec(speck, 0, 0)), vec_add(o, vec(0, speck, 0)) };
		scene_add_polygon(s, corners, 3);
	}
}

/* Splitting just the even cells of a checkerboard at every level drives the overhead of links towards its bound 2:
 * 1 + (D - 2 + 2^(1-D)) / (D + 1) for lines. */
static void checkerboard_overhead(void **state)
{
	(void)state;
	for (int depth = 2; depth <= 6; depth++) {
		struct scene s = { 0 };
		struct err e = { 0 };
		struct prediction lines;
		add_specks(&s, 0, depth - 1, 0, 0, 0);
		struct vec low[3] = { vec(0, 0, 0), vec(1e-3, 0, 1e-3), vec(0, 1e-3, 0) };
		struct vec high[3] = { vec(1, 1, 1), vec(0.999, 1, 0.999), vec(1, 0.999, 1) };
		scene_add_polygon(&s, low, 3);
		scene_add_polygon(&s, high, 3);
		struct primitives p = make_primitives(&s);
		struct accel a = build(&p, options(false, 1, depth, ROOT_BOX));
		assert_int_equal(cost_predict(&lines, &a, LAW_LINES, 1, 1, &e), 0);
		assert_near(1 + lines.inner_step / lines.leaves, 1 + (depth - 2 + ldexp(1, 1 - depth)) / (depth + 1), 1e-12);
		accel_free(&a);
		primitives_free(&p);
	}
}

static void agrees_with_list(void **state)
{
	(void)state;
	static const struct { const char *family; int size; bool tessellate; } scenes[] = {
		{ "tetra", 4, false }, { "teapot", 2, false }, { "gears", 2, false }, { "balls", 1, true }, { "balls", 2, false },
		{ "sphere", 3, false },
	};
	for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
		struct primitives p = make_spd(scenes[k].family, scenes[k].size, scenes[k].tessellate);
		for (int v = 0; v < 4; v++) {
			struct accel tree = build(&p, options(v & 1, 2, 8, v & 2 ? ROOT_BOX : ROOT_CUBE));
			assert_agrees_with_list(&tree, v & 2 ? ROOT_BOX : ROOT_CUBE);
			accel_free(&tree);
		}
		primitives_free(&p);
	}
}

/* Nodes of random octrees: the next level has 8 P(l) times as many, P = min(1, 2 / l), up to level 8. */
static void random_octrees_are_as_large_as_expected(void **state)
{
	(void)state;
	struct primitives p = make_spd("tetra", 1, false);
	for (int root_level = 0; root_level <= 1; root_level++) {
		int runs = root_level ? 50 : 12;
		double expected = 1, level_nodes = 1, sum = 0, square = 0;
		for (int level = root_level; level < 8; level++)
			expected += level_nodes *= 8 * (level < 2 ? 1 : 2.0 / level);
		assert_near(expected, root_level ? 44430 : 355442, 1);
		for (int run = 1; run <= runs; run++) {
			struct octree_options o = { .max_depth = 10, .criterion = CRITERION_RANDOM, .root_level = root_level, .run = run };
			struct accel a = build(&p, o);
			assert_true(a.depth == 8 - root_level);
			sum += (double)a.nodes;
			square += (double)a.nodes * (double)a.nodes;
			accel_free(&a);
		}
		double mean = sum / runs, deviation = sqrt((square / runs - mean * mean) / (runs - 1));
		assert_near(mean, expected, 3 * deviation);
	}
	primitives_free(&p);
}

/* A tree split for features: no leaf above the cut-off meets an edge, and faces alone split nothing. */
static void features_are_isolated(void **state)
{
	(void)state;
	struct scene s = { 0 };
	scene_add_polygon(&s, (const struct vec[3]){ vec(0, 0, 0), vec(1, 0, 0.3), vec(0, 1, 0.6) }, 3);
	struct primitives p = make_primitives(&s);
	struct octree_options o = { .max_depth = 9, .criterion = CRITERION_FEATURES, .cutoff = 1.0 / 32 };
	struct accel a = build(&p, o);
	must_hold(&a);
	assert_int_equal(a.depth, 5);
	struct octree_options everywhere = { .max_objects = 0, .max_depth = 5 };
	struct accel b = build(&p, everywhere);
	assert_true(a.leaves < b.leaves); /* the inside of the triangle is not refined */
	accel_free(&a);
	accel_free(&b);
	primitives_free(&p);
}

static void memory_is_bounded(void **state)
{
	(void)state;
	struct primitives p = make_spd("teapot", 12, false);
	for (int max_objects = 2; max_objects <= 10; max_objects += 8) {
		struct accel a = build(&p, options(false, max_objects, 8, ROOT_BOX));
		assert_true((double)a.mem.held / (double)a.leaves < 400);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* Whatever the processor, and however many rays are on their way: what one ray at a time finds and costs. */
static void crowds_count_what_single_rays_count(void **state)
{
	(void)state;
	enum { RAYS = 3000 };
	static struct ray rays[RAYS];
	static struct hit hits[RAYS];
	static struct tally tallies[RAYS];
	static void (*const crowds[])(const struct accel *, const struct ray *, size_t, struct hit *, struct tally *) = {
		octree_crowd,
#ifdef __x86_64__
		octree_crowd_avx2,
		octree_crowd_avx512,
#endif
	};
	for (size_t c = 0; c < sizeof crowds / sizeof *crowds; c++) {
#ifdef __x86_64__
		if ((crowds[c] == octree_crowd_avx2 && !__builtin_cpu_supports("avx2")) ||
		    (crowds[c] == octree_crowd_avx512 && !(__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))))
			continue;
#endif
		for (int v = 0; v < 4; v++) {
			struct primitives p = make_spd(v & 1 ? "balls" : "gears", v & 1 ? 2 : 1, v & 2);
			struct accel a = build(&p, options(false, v & 1 ? 2 : 12, 6, ROOT_BOX));
			struct ray_source source;
			struct err e = { 0 };
			assert_int_equal(ray_source_open(&source, &a, WORKLOAD_INVARIANT, 7, &e), 0);
			ray_source_draw_many(&source, 0, RAYS, rays);
			crowds[c](&a, rays, RAYS, hits, tallies);
			for (int i = 0; i < RAYS; i++) {
				struct hit h;
				struct tally n = { 0 };
				accel_find("octree")->shoot_counted(&a, &rays[i], &h, &n);
				assert_memory_equal(&tallies[i], &n, sizeof n);
				assert_int_equal(hits[i].id, h.id);
				assert_true(hits[i].t == h.t);
			}
			ray_source_close(&source);
			accel_free(&a);
			primitives_free(&p);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_variant_is_sound),
		cmocka_unit_test(balancing_is_complete_and_idempotent),
		cmocka_unit_test(identities_of_octrees),
		cmocka_unit_test(roots_end_on_the_grid),
		cmocka_unit_test(checkerboard_overhead),
		cmocka_unit_test(agrees_with_list),
		cmocka_unit_test(random_octrees_are_as_large_as_expected),
		cmocka_unit_test(features_are_isolated),
		cmocka_unit_test(memory_is_bounded),
		cmocka_unit_test(crowds_count_what_single_rays_count),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
