/* What tests of structures share: structures with options, predicted against measured, the list as an oracle, and a scene whose faces
 * lie in cell planes. */
#ifndef TESTS_STRUCTURE_H
#define TESTS_STRUCTURE_H

#include "tests/check.h"

#include "base/par.h"
#include "cost/cost.h"
#include "trace/rays.h"

/* A structure with options as a job would write them. */
struct variant {
	const char *structure;
	struct { const char *key; double value; } set[5];
};

static inline struct accel build_variant(const struct primitives *p, const struct variant *v, char *what, size_t size)
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

/* Nothing measured is ever more than four standard errors away; counts that do not vary must agree to rounding. */
static inline void compare(const char *what, struct mean actual, double predicted)
{
	double far = fabs(actual.mean - predicted);
	if (!(far <= 4 * actual.se) && !(far <= 1e-12 * fabs(predicted)))
		fail_msg("%s: measured %.6f, predicted %.6f, z %.2f", what, actual.mean, predicted,
		         (actual.mean - predicted) / actual.se);
}

static inline void compare_all(const struct accel *a, enum workload w, uint64_t rays, const char *what)
{
	struct err e = { 0 };
	struct prediction p;
	struct actual actual;
	char name[400];
	enum law law = w == WORKLOAD_LINES ? LAW_LINES : w == WORKLOAD_ONE_SIDED ? LAW_EXT : w == WORKLOAD_INTERIOR ? LAW_INTERIOR : LAW_RAYS;
	if (cost_predict(&p, a, law, 1, 1, &e) != 0 ||
	    shoot_rays(&actual, a, w, rays, 2002, 1, 1, par_processors(), NULL, &e) != 0)
		fail_msg("%s", e.text);
#define COMPARE(field, prediction) do { \
		snprintf(name, sizeof name, "%s: " #field, what); \
		compare(name, actual.field, p.prediction); \
	} while (0)
	COMPARE(cost, predicted_exact);
	COMPARE(leaves, leaves);
	COMPARE(tests, tests);
	if (w != WORKLOAD_INTERIOR || a->travel != TRAVEL_LINKS)
		COMPARE(inner, inner);
	COMPARE(boxes, boxes);
	if (a->mailbox == MAILBOX_ONE && !isnan(p.tests_one))
		COMPARE(tests_made, tests_one);
	if (a->mailbox == MAILBOX_FULL && !isnan(p.tests_one) && actual.tests_made.mean > p.tests_one + 4 * actual.tests_made.se)
		fail_msg("%s: a full mailbox spares less than one of one leaf", what);
	if (!isnan(p.inner_start))
		COMPARE(inner_start, inner_start);
	if (!isnan(p.inner_step))
		COMPARE(inner_step, inner_step);
#undef COMPARE
}

enum { SHOTS = 5000 };

/* Same primitive and same t as the list over the same kind of root, bit for bit; fast, counted and many; from every kind of start. */
static inline void assert_agrees_with_list(const struct accel *a, int root)
{
	struct err e = { 0 };
	struct accel list;
	struct ray_source source;
	assert_int_equal(accel_build(&list, accel_find("list"), &root, a->primitives, &e), 0);
	assert_int_equal(ray_source_open(&source, a, WORKLOAD_INVARIANT, 11, &e), 0);
	static struct ray rays[SHOTS];
	static struct hit many[SHOTS];
	static struct tally tallies[SHOTS];
	for (uint64_t i = 0; i < SHOTS; i++) {
		struct ray r = ray_source_draw(&source, i);
		if (i % 4 == 0) /* from outside, as a camera would */
			r = (struct ray){ .o = vec_sub(r.o, vec_scale(r.d, 100)), .d = r.d, .t_max = INFINITY,
				          .slack = r.slack, .from = NO_PRIMITIVE };
		if (i % 4 == 1) /* a segment */
			r.t_max = 0.3;
		rays[i] = r;
	}
	a->ops->shoot_many(a, rays, SHOTS, many, tallies);
	for (uint64_t i = 0; i < SHOTS; i++) {
		struct ray r = rays[i];
		struct hit fast, counted, truth;
		struct tally n = { 0 };
		bool found = a->ops->shoot(a, &r, &fast), again = a->ops->shoot_counted(a, &r, &counted, &n);
		bool c = list.ops->shoot(&list, &r, &truth);
		assert_true(found == c && again == c && n.hits == c);
		assert_int_equal(fast.id, truth.id);
		assert_int_equal(counted.id, truth.id);
		assert_memory_equal(&fast.t, &truth.t, sizeof truth.t);
		assert_memory_equal(&counted.t, &truth.t, sizeof truth.t);
		assert_int_equal(many[i].id, truth.id);
		assert_memory_equal(&many[i].t, &truth.t, sizeof truth.t);
		assert_memory_equal(&tallies[i], &n, sizeof n);
	}
	ray_source_close(&source);
	accel_free(&list);
}

static inline void add_box(struct scene *s, struct vec lo, struct vec hi)
{
	static const int face[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
	for (int f = 0; f < 6; f++) {
		struct vec corner[4];
		for (int i = 0; i < 4; i++) {
			int k = face[f][i];
			corner[i] = vec(k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y, k & 4 ? hi.z : lo.z);
		}
		scene_add_polygon(s, corner, 4);
	}
}

/* Boxes whose faces lie in cell planes, twice over: in-plane and coincident at once. */
static inline struct primitives make_flush_boxes(void)
{
	struct scene s = { 0 };
	add_box(&s, vec(0, 0, 0), vec(1, 1, 1));
	add_box(&s, vec(0.25, 0.25, 0.25), vec(0.5, 0.75, 0.625));
	add_box(&s, vec(0.25, 0.25, 0.25), vec(0.5, 0.75, 0.625));
	add_box(&s, vec(0.3, 0.3, 0.3), vec(0.5, 0.75, 0.625));
	add_box(&s, vec(0.5, 0.5, 0), vec(0.75, 0.75, 0.25));
	return make_primitives(&s);
}

#endif
