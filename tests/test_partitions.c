/* kd trees, BSP trees and grids: sound lists, exact predictions, the list as the oracle of every hit. */
#include "tests/structure.h"

#include "accel/grid.h"
#include "accel/kd_split.h"

#include <string.h>

enum { RAYS = 60000 };

/* A structure with options as a job would write them. */
struct variant {
	const char *structure;
	struct { const char *key; double value; } set[5];
};

static struct accel build_variant(const struct primitives *p, const struct variant *v, char *what, size_t size)
{
	struct err e = { 0 };
	struct accel a;
	const struct accel_ops *ops = accel_find(v->structure);
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	key_defaults(ops->keys, options);
	size_t n = (size_t)snprintf(what, size, "%s", v->structure);
	for (size_t i = 0; i < sizeof v->set / sizeof *v->set && v->set[i].key; i++) {
		struct key k = *key_find(ops->keys, v->set[i].key);
		k.value = v->set[i].value;
		const struct key one[2] = { k, { 0 } };
		key_defaults(one, options);
		n += (size_t)snprintf(what + n, size - n, " %s=%g", k.name, k.value);
	}
	if (accel_build(&a, ops, options, p, &e) != 0)
		fail_msg("%s: %s", what, e.text);
	return a;
}

static const struct variant variants[] = {
	{ "kd", { { "max_objects", 2 } } },
	{ "kd", { { "max_objects", 1 }, { "max_depth", 12 }, { "traversal", 1 }, { "root", ROOT_CUBE }, { "mailbox", MAILBOX_ONE } } },
	{ "kd", { { "max_objects", 4 }, { "boxes", 0.5 } } },
	{ "kd", { { "max_objects", 1 }, { "boxes", 0.9 }, { "root", ROOT_CUBE }, { "max_depth", 10 } } },
	{ "bsp", { { "max_objects", 2 }, { "max_depth", 16 }, { "mailbox", MAILBOX_ONE } } },
	{ "bsp", { { "max_objects", 5 }, { "max_depth", 18 }, { "traversal", 1 }, { "root", ROOT_CUBE } } },
	{ "bsp", { { "max_objects", 5 }, { "max_depth", 15 }, { "empty_halves", 1 }, { "mailbox", MAILBOX_FULL } } },
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
		cmocka_unit_test(faces_in_cell_planes),
		cmocka_unit_test(outside_of_solids),
		cmocka_unit_test(lists_are_sound),
		{ "agrees with list: tetra", agrees_with_list, NULL, NULL, &shot[0] },
		{ "agrees with list: gears", agrees_with_list, NULL, NULL, &shot[1] },
		{ "agrees with list: balls", agrees_with_list, NULL, NULL, &shot[2] },
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
