/* How trees of planes are built: what their lists hold, what a plane is worth, and that threads do not matter. */
#include "tests/structure.h"

#include "accel/kd_split.h"

#include <string.h>

/* Every level of Tetra fills half the cells of a step with a quarter of its triangles, and none reaches into two. */
static void inner_lists_part_tetra(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("tetra", 5, false);
	for (int step = 2; step <= 4; step++) {
		const struct variant v = { "bsp", { { "max_objects", 1 }, { "max_depth", 3 * step }, { "touching", 1 } } };
		char what[160];
		struct accel a = build_variant(&p, &v, what, sizeof what);
		struct prediction q;
		assert_int_equal(a.references, p.count);
		assert_int_equal(a.ops->check(&a, &e), 0);
		assert_int_equal(cost_predict(&q, &a, LAW_RAYS, 1, 1, &e), 0);
		assert_true(fabs(q.tests - p.count / pow(4, step)) < 1e-9 * q.tests);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* A plane is only taken where it lowers the expected cost, so that every plane more lowers that of the tree: by the law the rule
 * believes in, lines for areas. A step as dear as all primitives is never worth taking. */
static void planes_lower_the_cost(void **state)
{
	(void)state;
	static const int splits[2] = { SPLIT_SAH, SPLIT_EXACT };
	static const enum law laws[2] = { LAW_LINES, LAW_INTERIOR };
	struct err e = { 0 };
	struct primitives p = make_spd("balls", 1, true);
	for (int s = 0; s < 2; s++) {
		double before = 3.0 * p.count;
		for (int depth = 0; depth <= 18; depth++) {
			const struct variant v = { "kd", { { "split", splits[s] }, { "max_depth", depth } } };
			char what[160];
			struct accel a = build_variant(&p, &v, what, sizeof what);
			struct prediction q;
			assert_int_equal(cost_predict(&q, &a, laws[s], 1, 1, &e), 0);
			if (q.inner + 3 * q.tests > before * (1 + 1e-12))
				fail_msg("%s: cost %g, one level less %g", what, q.inner + 3 * q.tests, before);
			before = q.inner + 3 * q.tests;
			accel_free(&a);
		}
		assert_true(before < 0.1 * 3.0 * p.count);
		const struct variant dear = { "kd", { { "split", splits[s] }, { "step", 3.0 * p.count } } };
		char what[160];
		struct accel a = build_variant(&p, &dear, what, sizeof what);
		assert_int_equal(a.nodes, 1);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* Parts of large trees are built side by side: the same tree for every number of threads, and every primitive is in a leaf. */
static void trees_do_not_depend_on_threads(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct primitives p = make_spd("gears", 2, false);
	for (int split = SPLIT_BALANCE; split <= SPLIT_EXACT; split++) {
		struct kd_options o;
		struct accel one, many;
		key_defaults(accel_find("kd")->keys, &o);
		o.split = split;
		o.common.max_depth = 14;
		o.common.boxes = split == SPLIT_BALANCE || split == SPLIT_SAH ? 0.5 : 0;
		assert_int_equal(accel_build_on(&one, accel_find("kd"), &o, &p, 1, &e), 0);
		assert_int_equal(accel_build_on(&many, accel_find("kd"), &o, &p, 3, &e), 0);
		const struct planes *a = one.impl, *b = many.impl;
		assert_true(a->node_count == b->node_count && a->ref_count == b->ref_count && a->box_count == b->box_count);
		assert_true(o.common.boxes == 0 || a->box_count > 0);
		for (uint32_t i = 0; i < a->node_count; i++) {
			const struct plane_node *n = &a->nodes[i], *m = &b->nodes[i];
			assert_true(memcmp(&n->plane, &m->plane, sizeof n->plane) == 0 && n->child == m->child && n->first == m->first);
			assert_true(n->count == m->count && n->kind == m->kind && n->depth == m->depth);
		}
		assert_memory_equal(a->refs, b->refs, a->ref_count * sizeof *a->refs);
		assert_true(a->box_count == 0 || memcmp(a->boxes, b->boxes, a->box_count * sizeof *a->boxes) == 0);
		if (one.ops->check(&many, &e) != 0)
			fail_msg("%s", e.text);
		accel_free(&one);
		accel_free(&many);
	}
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(inner_lists_part_tetra),
		cmocka_unit_test(planes_lower_the_cost),
		cmocka_unit_test(trees_do_not_depend_on_threads),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
