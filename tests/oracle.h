/* The list as the oracle of hierarchies: hits of many rays, one by one and many at once, held against its own. */
#ifndef TESTS_ORACLE_H
#define TESTS_ORACLE_H

#include "tests/structure.h"

#include "accel/root.h"

#include <string.h>

static inline struct accel build(const char *name, const void *o, const struct primitives *p)
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

static inline struct oracle oracle_make(const struct primitives *p, size_t count)
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

static inline void oracle_free(struct oracle *o)
{
	accel_free(&o->list);
	free(o->rays);
	free(o->hits);
}

static inline bool same_time(double t, double u, double near, const struct accel *a)
{
	return t == u || fabs(t - u) <= near * box_diagonal(&a->root);
}

/* Counted one by one and many at once: the list's hits, bit for bit. Uncounted: the same primitive, its t as near as 'near' is of the
 * root's diagonal, alone and among many. Any-hit queries hit when the list does. */
static inline void compare_hits(const struct accel *a, const struct oracle *o, double near, const char *what)
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

#endif
