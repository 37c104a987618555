/* The project's claim: predicted cost equals the measured mean within sampling error, for every scene and every variant. */
#include "tests/structure.h"

#include "accel/octree.h"

enum { RAYS = 200000 };

static void compare_variants(const struct primitives *p, const char *scene, enum workload w, uint64_t rays)
{
	for (int v = 0; v < 12; v++) {
		struct err e = { 0 };
		struct accel a;
		const struct octree_options o = { .balanced = v & 1, .max_objects = (const int[]){ 2, 5, 10 }[v / 4], .max_depth = 8,
			                          .root = v & 2 ? ROOT_BOX : ROOT_CUBE };
		char what[120];
		snprintf(what, sizeof what, "%s balanced=%d max_objects=%d root=%s", scene, o.balanced, (int)o.max_objects,
		         o.root == ROOT_BOX ? "box" : "cube");
		if (accel_build(&a, accel_find("octree"), &o, p, &e) != 0)
			fail_msg("%s", e.text);
		compare_all(&a, w, rays, what);
		accel_free(&a);
	}
}

struct family {
	const char *name;
	bool tessellate;
};

static void rays_in_spd_scenes(void **state)
{
	const struct family *f = *state;
	for (int size = 1; size <= 2; size++) {
		char scene[64];
		snprintf(scene, sizeof scene, "%s-%d", f->name, size);
		struct primitives p = make_spd(f->name, size, f->tessellate);
		compare_variants(&p, scene, WORKLOAD_INVARIANT, RAYS);
		primitives_free(&p);
	}
}

static void lines_in_gears(void **state)
{
	(void)state;
	struct primitives p = make_spd("gears", 1, false);
	compare_variants(&p, "lines in gears-1", WORKLOAD_LINES, RAYS / 2);
	primitives_free(&p);
}

static void faces_in_cell_planes(void **state)
{
	(void)state;
	struct primitives p = make_flush_boxes();
	compare_variants(&p, "boxes", WORKLOAD_INVARIANT, RAYS);
	primitives_free(&p);
}

/* Rays that start outside of closed solids only. */
static void one_sided_rays_outside_of_solids(void **state)
{
	(void)state;
	static const struct { const char *family; int least, most; } scenes[] = { { "sphere", 1, 3 }, { "tetra", 2, 4 } };
	for (int i = 0; i < 2; i++)
		for (int size = scenes[i].least; size <= scenes[i].most; size++) {
			char scene[64];
			snprintf(scene, sizeof scene, "outside of %s-%d", scenes[i].family, size);
			struct primitives p = make_spd(scenes[i].family, size, false);
			compare_variants(&p, scene, WORKLOAD_ONE_SIDED, RAYS);
			primitives_free(&p);
		}
}

/* Solids flush with the root and with cell planes. */
static void solids_in_cell_planes(void **state)
{
	(void)state;
	struct scene s = { 0 };
	add_box(&s, vec(0, 0, 0), vec(0.25, 0.25, 0.5));
	add_box(&s, vec(0.375, 0, 0), vec(0.5, 0.125, 0.3));
	add_box(&s, vec(0.25, 0.5, 0.25), vec(0.75, 0.75, 0.5));
	add_box(&s, vec(0.5, 0.5, 0.625), vec(0.6, 0.6, 1));
	add_box(&s, vec(0.9, 0.875, 0.875), vec(1, 1, 1));
	struct primitives p = make_primitives(&s);
	compare_variants(&p, "solid boxes", WORKLOAD_ONE_SIDED, RAYS);
	primitives_free(&p);
}

static void open_surfaces_are_no_solids(void **state)
{
	(void)state;
	static const char *const families[] = { "teapot", "balls" };
	for (int i = 0; i < 2; i++) {
		struct err e = { 0 };
		struct primitives p = make_spd(families[i], 1, false);
		struct prediction q;
		struct accel a;
		int root = ROOT_BOX;
		assert_int_equal(accel_build(&a, accel_find("list"), &root, &p, &e), 0);
		assert_int_equal(cost_predict(&q, &a, LAW_EXT, 1, 1, &e), -1);
		assert_int_equal(e.code, STATUS_INPUT);
		accel_free(&a);
		primitives_free(&p);
	}
}

/* Other criteria make other trees; the prediction does not care. */
static void features_and_chance_are_exact_too(void **state)
{
	(void)state;
	struct primitives p = make_spd("gears", 1, false);
	for (int v = 0; v < 4; v++) {
		struct err e = { 0 };
		struct accel a;
		struct octree_options o = { .balanced = v & 1, .max_depth = 7, .criterion = v & 2 ? CRITERION_FEATURES : CRITERION_RANDOM,
			                    .run = v + 1, .cutoff = 0.02 };
		assert_int_equal(accel_build(&a, accel_find("octree"), &o, &p, &e), 0);
		compare_all(&a, WORKLOAD_INVARIANT, RAYS / 2, v & 2 ? "features" : "random");
		accel_free(&a);
	}
	primitives_free(&p);
}

static void the_list_is_exact_too(void **state)
{
	(void)state;
	static const char *const families[] = { "tetra", "gears", "balls" };
	for (int i = 0; i < 3; i++) {
		struct err e = { 0 };
		struct primitives p = make_spd(families[i], 1, false);
		struct accel a;
		int root = ROOT_BOX;
		assert_int_equal(accel_build(&a, accel_find("list"), &root, &p, &e), 0);
		compare_all(&a, WORKLOAD_INVARIANT, 20000, families[i]);
		accel_free(&a);
		primitives_free(&p);
	}
}

static void bounding_box_lists_are_exact_too(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("gears", 1, false);
	struct accel a;
	const struct octree_options o = { .max_objects = 5, .max_depth = 7, .overlap = OVERLAP_BBOX };
	assert_int_equal(accel_build(&a, accel_find("octree"), &o, &p, &e), 0);
	compare_all(&a, WORKLOAD_INVARIANT, RAYS, "overlap=bbox");
	accel_free(&a);
	primitives_free(&p);
}

/* The same rays, whatever the number of threads: sums are equal, not just near. */
static void threads_do_not_matter(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("teapot", 2, false);
	struct accel a;
	struct octree_options o;
	key_defaults(accel_find("octree")->keys, &o);
	assert_int_equal(accel_build(&a, accel_find("octree"), &o, &p, &e), 0);
	struct actual one, other;
	assert_int_equal(shoot_rays(&one, &a, WORKLOAD_INVARIANT, RAYS + 1, 5, 1, 0.5, 1, NULL, &e), 0);
	for (int threads = 2; threads <= 7; threads += 5) {
		assert_int_equal(shoot_rays(&other, &a, WORKLOAD_INVARIANT, RAYS + 1, 5, 1, 0.5, threads, NULL, &e), 0);
		assert_memory_equal(&one, &other, offsetof(struct actual, walk_seconds));
	}
	assert_int_equal(shoot_rays(&other, &a, WORKLOAD_INVARIANT, RAYS + 1, 6, 1, 0.5, 1, NULL, &e), 0);
	assert_int_not_equal(one.sum.tests, other.sum.tests);
	accel_free(&a);
	primitives_free(&p);
}

/* Rays go on until every count is as sure as asked for; what is found is what as many rays find at once. */
static void more_rays_until_sure(void **state)
{
	(void)state;
	enum { FEW = 3001 };
	const double error = 0.02;
	struct primitives p = make_spd("balls", 1, true);
	struct err e = { 0 };
	struct accel a;
	struct actual few, sure, once;
	const struct octree_options o = { .max_objects = 2, .max_depth = 8, .root = ROOT_BOX };
	assert_int_equal(accel_build(&a, accel_find("octree"), &o, &p, &e), 0);
	assert_int_equal(shoot_rays_until(&sure, &a, WORKLOAD_INVARIANT, FEW, error, 7, 1, 1, 2, NULL, &e), 0);
	assert_int_equal(shoot_rays(&few, &a, WORKLOAD_INVARIANT, FEW, 7, 1, 1, 2, NULL, &e), 0);
	assert_int_equal(shoot_rays(&once, &a, WORKLOAD_INVARIANT, sure.rays, 7, 1, 1, 1, NULL, &e), 0);
	assert_true(few.tests.se > error * few.tests.mean && few.rays == FEW);
	assert_true(sure.rays > FEW && sure.rays < FEW * RAYS_GROWTH);
	assert_memory_equal(&sure.sum, &once.sum, sizeof sure.sum);
	const struct mean counts[][2] = { { sure.cost, once.cost }, { sure.leaves, once.leaves }, { sure.tests, once.tests },
		                          { sure.inner_step, once.inner_step }, { sure.inner_start, once.inner_start } };
	for (int i = 0; i < 5; i++) {
		assert_true(counts[i][0].se <= error * counts[i][0].mean);
		assert_near(counts[i][0].se, counts[i][1].se, 1e-9 * counts[i][1].se);
	}
	assert_int_equal(shoot_rays_until(&sure, &a, WORKLOAD_INVARIANT, 10, 1e-9, 7, 1, 1, 2, NULL, &e), 0);
	assert_int_equal(sure.rays, 10 * RAYS_GROWTH);
	accel_free(&a);
	primitives_free(&p);
}

int main(void)
{
	static struct family tetra = { "tetra", false }, teapot = { "teapot", false }, gears = { "gears", false },
	                     soup = { "balls", true }, balls = { "balls", false }, sphere = { "sphere", false };
	const struct CMUnitTest tests[] = {
		{ "rays in spd scenes: tetra", rays_in_spd_scenes, NULL, NULL, &tetra },
		{ "rays in spd scenes: teapot", rays_in_spd_scenes, NULL, NULL, &teapot },
		{ "rays in spd scenes: gears", rays_in_spd_scenes, NULL, NULL, &gears },
		{ "rays in spd scenes: balls, tessellated", rays_in_spd_scenes, NULL, NULL, &soup },
		{ "rays in spd scenes: balls, spheres", rays_in_spd_scenes, NULL, NULL, &balls },
		{ "rays in spd scenes: sphere", rays_in_spd_scenes, NULL, NULL, &sphere },
		cmocka_unit_test(lines_in_gears),
		cmocka_unit_test(faces_in_cell_planes),
		cmocka_unit_test(one_sided_rays_outside_of_solids),
		cmocka_unit_test(solids_in_cell_planes),
		cmocka_unit_test(open_surfaces_are_no_solids),
		cmocka_unit_test(features_and_chance_are_exact_too),
		cmocka_unit_test(the_list_is_exact_too),
		cmocka_unit_test(bounding_box_lists_are_exact_too),
		cmocka_unit_test(threads_do_not_matter),
		cmocka_unit_test(more_rays_until_sure),
	};
#ifdef __SANITIZE_THREAD__
	cmocka_set_test_filter("threads_do_not_matter"); /* the others have the same threads do the same, and are slow */
#endif
	return cmocka_run_group_tests(tests, NULL, NULL);
}
