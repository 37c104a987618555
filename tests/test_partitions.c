/* kd trees, BSP trees and grids: sound lists, exact predictions, the list as the oracle of every hit. */
#include "tests/structure.h"

#include "accel/grid.h"
#include "accel/kd_split.h"

#include <string.h>

enum { RAYS = 40000 };

static const struct variant variants[] = {
	{ "kd", { { "max_objects", 2 } } },
	{ "kd", { { "max_objects", 1 }, { "max_depth", 12 }, { "traversal", 1 }, { "root", ROOT_CUBE }, { "mailbox", MAILBOX_ONE } } },
	{ "kd", { { "max_objects", 4 }, { "boxes", 0.5 } } },
	{ "kd", { { "max_objects", 1 }, { "boxes", 0.9 }, { "root", ROOT_CUBE }, { "max_depth", 10 } } },
	{ "kd", { { "split", SPLIT_SAH }, { "mailbox", MAILBOX_ONE } } },
	{ "kd", { { "split", SPLIT_HQ26 }, { "max_depth", 12 }, { "traversal", 1 }, { "root", ROOT_CUBE } } },
	{ "kd", { { "split", SPLIT_FAST6 }, { "empty_cutoff", 0.1 }, { "traversal", 1 } } },
	{ "kd", { { "split", SPLIT_EXACT }, { "step", 0.5 }, { "test", 1 }, { "mailbox", MAILBOX_FULL }, { "max_depth", 14 } } },
	{ "bsp", { { "max_objects", 2 }, { "max_depth", 16 }, { "mailbox", MAILBOX_ONE } } },
	{ "bsp", { { "max_objects", 5 }, { "max_depth", 18 }, { "traversal", 1 }, { "root", ROOT_CUBE } } },
	{ "bsp", { { "max_objects", 5 }, { "max_depth", 15 }, { "empty_halves", 1 }, { "mailbox", MAILBOX_FULL } } },
	{ "bsp", { { "max_objects", 1 }, { "max_depth", 12 }, { "touching", 1 }, { "root", ROOT_CUBE } } },
	{ "grid", { { "resolution", 16 }, { "mailbox", MAILBOX_ONE } } },
	{ "grid", { { "resolution", 5 }, { "resolution_y", 8 }, { "resolution_z", 13 }, { "root", ROOT_CUBE }, { "mailbox", MAILBOX_FULL } } },
	{ "grid", { { "setting", GRID_WOO }, { "mailbox", MAILBOX_ONE } } },
	{ "grid", { { "setting", GRID_HOMOGENEOUS }, { "density", 3 } } },
	{ "grid", { { "setting", GRID_HETEROGENEOUS }, { "density", 5 } } },
};
enum { VARIANTS = sizeof variants / sizeof *variants };

static void compare_variants(const struct primitives *p, const char *scene, enum workload w)
{
	for (int v = 0; v < VARIANTS; v++) {
		char name[160], what[260];
		struct accel a = build_variant(p, &variants[v], name, sizeof name);
		snprintf(what, sizeof what, "%s: %s", scene, name);
		compare_all(&a, w, RAYS, what);
		accel_free(&a);
	}
}

struct family {
	const char *name;
	int size;
	bool tessellate;
};

static void rays_in_spd_scenes(void **state)
{
	const struct family *f = *state;
	struct primitives p = make_spd(f->name, f->size, f->tessellate);
	compare_variants(&p, f->name, WORKLOAD_INVARIANT);
	primitives_free(&p);
}

static void lines_in_gears(void **state)
{
	(void)state;
	struct primitives p = make_spd("gears", 1, false);
	compare_variants(&p, "lines in gears", WORKLOAD_LINES);
	primitives_free(&p);
}

static void rays_from_inside(void **state)
{
	const struct family *f = *state;
	struct primitives p = make_spd(f->name, f->size, f->tessellate);
	compare_variants(&p, f->name, WORKLOAD_INTERIOR);
	primitives_free(&p);
}

static void faces_in_cell_planes(void **state)
{
	(void)state;
	struct primitives p = make_flush_boxes();
	compare_variants(&p, "boxes", WORKLOAD_INVARIANT);
	primitives_free(&p);
}

static void outside_of_solids(void **state)
{
	(void)state;
	struct primitives p = make_spd("tetra", 2, false);
	compare_variants(&p, "outside of tetra", WORKLOAD_ONE_SIDED);
	primitives_free(&p);
}

static void lists_are_sound(void **state)
{
	(void)state;
	static const struct family scenes[] = { { "tetra", 3, false }, { "gears", 1, false }, { "balls", 1, true }, { "balls", 2, false } };
	for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
		struct primitives p = make_spd(scenes[s].name, scenes[s].size, scenes[s].tessellate);
		for (int v = 0; v < VARIANTS; v++) {
			struct err e = { 0 };
			char what[160];
			struct accel a = build_variant(&p, &variants[v], what, sizeof what);
			if (a.ops->check(&a, &e) != 0)
				fail_msg("%s %s: %s", scenes[s].name, what, e.text);
			accel_free(&a);
		}
		primitives_free(&p);
	}
}

static void agrees_with_list(void **state)
{
	const struct family *f = *state;
	struct primitives p = make_spd(f->name, f->size, f->tessellate);
	for (int v = 0; v < VARIANTS; v++) {
		char what[160];
		struct accel a = build_variant(&p, &variants[v], what, sizeof what);
		assert_agrees_with_list(&a, strstr(what, "root=0") ? ROOT_CUBE : ROOT_BOX);
		accel_free(&a);
	}
	primitives_free(&p);
}

enum { SHOT = 2000 };

/* The leaves a ray meets before it ends, found by cutting it with every leaf; and what they list. */
struct meeting {
	const struct ray *ray;
	double end, slack;
	bool *listed; /* [primitives] */
	uint64_t leaves, tests, distinct;
};

static int meet_leaf(void *ctx, const struct cell *c)
{
	struct meeting *m = ctx;
	double low = 0, high = m->end;
	for (int i = 0; c->leaf && i < 3; i++) {
		double t = (c->bounds.lo.a[i] - m->ray->o.a[i]) / m->ray->d.a[i], u = (c->bounds.hi.a[i] - m->ray->o.a[i]) / m->ray->d.a[i];
		low = fmax(low, fmin(t, u));
		high = fmin(high, fmax(t, u));
	}
	if (!c->leaf || high <= low + m->slack)
		return 0;
	m->leaves++;
	m->tests += c->count;
	for (uint32_t i = 0; i < c->count; i++) {
		m->distinct += !m->listed[c->ids[i]];
		m->listed[c->ids[i]] = true;
	}
	return 0;
}

/* Leaves and lists met are those counted, and a full mailbox leaves every primitive in them one test. */
static void full_mailboxes_test_once(void **state)
{
	(void)state;
	static const struct variant full[] = {
		{ "kd", { { "max_objects", 2 }, { "mailbox", MAILBOX_FULL } } },
		{ "bsp", { { "max_depth", 12 }, { "mailbox", MAILBOX_FULL }, { "traversal", 1 } } },
		{ "grid", { { "resolution", 9 }, { "mailbox", MAILBOX_FULL } } },
	};
	struct err e = { 0 };
	struct primitives p = make_spd("balls", 1, true);
	bool *listed = malloc(p.count * sizeof *listed);
	assert_non_null(listed);
	for (int v = 0; v < 3; v++) {
		char what[160];
		struct accel a = build_variant(&p, &full[v], what, sizeof what);
		struct ray_source source;
		assert_int_equal(ray_source_open(&source, &a, WORKLOAD_INVARIANT, 3, &e), 0);
		for (uint64_t i = 0; i < SHOT; i++) {
			struct ray r = ray_source_draw(&source, i);
			struct hit h;
			struct tally n = { 0 };
			a.ops->shoot_counted(&a, &r, &h, &n);
			if (h.t <= a.slack)
				continue; /* no length to cut */
			struct meeting m = { .ray = &r, .end = h.t, .slack = a.slack, .listed = listed };
			memset(listed, 0, p.count * sizeof *listed);
			a.ops->cells(&a, meet_leaf, &m);
			assert_int_equal(n.leaves, m.leaves);
			assert_int_equal(n.tests, m.tests);
			assert_int_equal(n.tests_made, m.distinct);
		}
		ray_source_close(&source);
		accel_free(&a);
	}
	free(listed);
	primitives_free(&p);
}

/* Both ways of travelling visit the same leaves; who restarts visits as many inner nodes for each as it is deep, who recurses every
 * inner node once. */
static void restart_and_recursion_visit_the_same_leaves(void **state)
{
	(void)state;
	static const char *const structures[] = { "kd", "bsp" };
	struct err e = { 0 };
	struct primitives p = make_flush_boxes();
	for (int s = 0; s < 2; s++) {
		char what[160];
		struct accel recursive = build_variant(&p, &(struct variant){ structures[s], { { "max_objects", 1 }, { "max_depth", 12 } } }, what,
		                                       sizeof what);
		struct accel restart = build_variant(&p, &(struct variant){ structures[s], { { "max_objects", 1 }, { "max_depth", 12 }, { "traversal", 1 } } },
		                                     what, sizeof what);
		struct ray_source source;
		assert_int_equal(ray_source_open(&source, &recursive, WORKLOAD_INVARIANT, 3, &e), 0);
		for (uint64_t i = 0; i < 20000; i++) {
			struct ray r = ray_source_draw(&source, i);
			struct hit h, k;
			struct tally n = { 0 }, m = { 0 };
			recursive.ops->shoot_counted(&recursive, &r, &h, &n);
			restart.ops->shoot_counted(&restart, &r, &k, &m);
			assert_true(n.leaves == m.leaves && n.tests == m.tests && n.inner_start == m.inner_start && h.id == k.id);
			assert_true(n.inner_step <= m.inner_step);
			assert_true(n.leaves != 1 || (n.inner_step == 0 && m.inner_step == 0));
		}
		ray_source_close(&source);
		accel_free(&recursive);
		accel_free(&restart);
	}
	primitives_free(&p);
}

/* A grid's leaves have the area of its planes, from both sides. */
static void grids_have_the_area_of_their_planes(void **state)
{
	(void)state;
	struct primitives p = make_spd("teapot", 1, false);
	for (int i = 1; i < 4; i++) {
		struct err e = { 0 };
		struct prediction q;
		char what[160];
		const int n[3] = { 7 * i, 3 + i, 2 * i };
		struct accel a = build_variant(&p, &(struct variant){ "grid", { { "resolution", n[0] }, { "resolution_y", n[1] }, { "resolution_z", n[2] } } },
		                               what, sizeof what);
		struct vec l = vec_sub(a.root.hi, a.root.lo);
		double area = 2 * (n[0] * l.y * l.z + n[1] * l.x * l.z + n[2] * l.x * l.y);
		assert_int_equal(cost_predict(&q, &a, LAW_LINES, 1, 1, &e), 0);
		assert_near(q.area_leaves / area, 1, 1e-12);
		assert_near(q.leaves * box_area(&a.root) / area, 1, 1e-12);
		assert_near(q.area_inside / p.area, 1, 1e-9);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* A tree with boxes has them only where they are small, and a ray that travels by restarting cannot have them. */
static void boxes_are_for_the_recursion(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("tetra", 3, false);
	struct kd_options o;
	struct accel a;
	key_defaults(accel_find("kd")->keys, &o);
	o.common.boxes = 0.5;
	assert_int_equal(accel_build(&a, accel_find("kd"), &o, &p, &e), 0);
	const struct planes *tree = a.impl;
	assert_true(tree->box_count > 10);
	accel_free(&a);
	o.common.travel = 1;
	assert_int_equal(accel_build(&a, accel_find("kd"), &o, &p, &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	primitives_free(&p);
}

int main(void)
{
	static struct family scenes[] = {
		{ "tetra", 2, false }, { "teapot", 1, false }, { "gears", 1, false }, { "balls", 1, true }, { "balls", 2, false }, { "sphere", 2, false },
	};
	static struct family shot[] = { { "tetra", 4, false }, { "gears", 2, false }, { "balls", 2, false } };
	const struct CMUnitTest tests[] = {
		{ "exact: tetra", rays_in_spd_scenes, NULL, NULL, &scenes[0] },
		{ "exact: teapot", rays_in_spd_scenes, NULL, NULL, &scenes[1] },
		{ "exact: gears", rays_in_spd_scenes, NULL, NULL, &scenes[2] },
		{ "exact: balls, tessellated", rays_in_spd_scenes, NULL, NULL, &scenes[3] },
		{ "exact: balls, spheres", rays_in_spd_scenes, NULL, NULL, &scenes[4] },
		{ "exact: sphere", rays_in_spd_scenes, NULL, NULL, &scenes[5] },
		cmocka_unit_test(lines_in_gears),
		{ "from inside: gears", rays_from_inside, NULL, NULL, &scenes[2] },
		{ "from inside: balls", rays_from_inside, NULL, NULL, &scenes[3] },
		cmocka_unit_test(faces_in_cell_planes),
		cmocka_unit_test(outside_of_solids),
		cmocka_unit_test(lists_are_sound),
		cmocka_unit_test(full_mailboxes_test_once),
		cmocka_unit_test(restart_and_recursion_visit_the_same_leaves),
		cmocka_unit_test(grids_have_the_area_of_their_planes),
		cmocka_unit_test(boxes_are_for_the_recursion),
		{ "agrees with list: tetra", agrees_with_list, NULL, NULL, &shot[0] },
		{ "agrees with list: gears", agrees_with_list, NULL, NULL, &shot[1] },
		{ "agrees with list: balls", agrees_with_list, NULL, NULL, &shot[2] },
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
