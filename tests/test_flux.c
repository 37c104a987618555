/* Costs from flux: what areas say where the flux is even, what a replay counts where cells are made of voxels, near it elsewhere. */
#include "tests/check.h"

#include "accel/octree.h"
#include "cost/cost.h"
#include "cost/image.h"
#include "trace/flux_count.h"
#include "trace/rays.h"
#include "trace/replay.h"

enum { RAYS = 20000 };

#define ALPHA 0.5
#define BETA 2.0

static struct accel build(const struct primitives *p, const char *name, const void *options)
{
	struct err e = { 0 };
	struct accel a;
	if (accel_build(&a, accel_find(name), options, p, &e) != 0)
		fail_msg("%s", e.text);
	return a;
}

static struct octree_options variant(int v, int max_depth)
{
	struct octree_options o;
	key_defaults(accel_find("octree")->keys, &o);
	o.balanced = v & 1;
	o.root = v & 2 ? ROOT_BOX : ROOT_CUBE;
	o.max_objects = v & 4 ? 2 : 10;
	o.max_depth = max_depth;
	o.criterion = v < 8 ? CRITERION_OBJECTS : CRITERION_RANDOM;
	return o;
}

static struct flux count_flux(const struct accel *a, const struct segment *segments, size_t count)
{
	struct err e = { 0 };
	struct flux f;
	if (flux_open(&f, &a->root, &e) != 0)
		fail_msg("%s", e.text);
	flux_count(&f, segments, count, a->slack);
	return f;
}

static struct estimate predict(const struct flux *f, const struct accel *a)
{
	struct err e = { 0 };
	struct estimate cost;
	if (cost_predict_image(&cost, f, a, ALPHA, BETA, &e) != 0)
		fail_msg("%s", e.text);
	return cost;
}

/* Random rays of a workload, each a sample of its own; from malloc. */
static struct segment *make_segments(const struct accel *a, enum workload w)
{
	struct err e = { 0 };
	struct ray_source source;
	struct segment *s = calloc(RAYS, sizeof *s);
	assert_non_null(s);
	if (ray_source_open(&source, a, w, 7, &e) != 0)
		fail_msg("%s", e.text);
	for (size_t i = 0; i < RAYS; i++) {
		struct hit h;
		s[i].ray = ray_source_draw(&source, i);
		s[i].sample = (uint32_t)i;
		s[i].hit = !s[i].ray.through && a->ops->shoot(a, &s[i].ray, &h);
		if (s[i].hit)
			s[i].ray.t_max = h.t;
	}
	ray_source_close(&source);
	return s;
}

static double sum(const double by_group[FLUX_GROUPS])
{
	double all = 0;
	for (int g = 0; g < FLUX_GROUPS; g++)
		all += by_group[g];
	return all;
}

static double visits_of(const struct flux *f, const struct box *b)
{
	double crossings[FLUX_GROUPS], inside[FLUX_GROUPS], on_surface[FLUX_GROUPS];
	flux_crossings(f, b, crossings);
	flux_ends(f, FLUX_FREE, b, inside);
	flux_ends(f, FLUX_ON_SURFACE, b, on_surface);
	return (sum(crossings) + sum(inside) + sum(on_surface)) / 2;
}

static uint64_t segments_of(const struct flux *f)
{
	uint64_t all = 0;
	for (int g = 0; g < FLUX_GROUPS; g++)
		all += f->segments[g];
	return all;
}

/* Every segment has two ends; what comes in goes out or ends. */
static void every_segment_visits_the_root_once(void **state)
{
	(void)state;
	const enum workload workloads[] = { WORKLOAD_LINES, WORKLOAD_INVARIANT };
	const struct box whole = { { { { 0, 0, 0 } } }, { { { FLUX_SIDE, FLUX_SIDE, FLUX_SIDE } } } };
	struct primitives p = make_spd("gears", 1, true);
	for (int v = 0; v < 4; v++) {
		struct octree_options o = variant(v, 8);
		struct accel a = build(&p, "octree", &o);
		struct segment *s = make_segments(&a, workloads[v % 2]);
		struct flux f = count_flux(&a, s, RAYS);
		assert_true(segments_of(&f) > RAYS / 2);
		assert_near(visits_of(&f, &whole), (double)segments_of(&f), 0);
		flux_close(&f);
		free(s);
		accel_free(&a);
	}
	primitives_free(&p);
}

/* Lines enter a box as often as its area says, wherever it lies in the grid. */
static void lines_visit_boxes_by_area(void **state)
{
	(void)state;
	struct primitives p = make_spd("tetra", 3, true);
	struct octree_options o = variant(0, 8);
	struct accel a = build(&p, "octree", &o);
	struct segment *s = make_segments(&a, WORKLOAD_LINES);
	struct flux f = count_flux(&a, s, RAYS);
	const struct box boxes[] = {
		{ { { { 0, 0, 0 } } }, { { { 32, 32, 32 } } } },            { { { { 8, 16, 40 } } }, { { { 12, 20, 44 } } } },
		{ { { { 3.5, 17.25, 20 } } }, { { { 50, 17.5, 60 } } } },   { { { { 0, 0, 0 } } }, { { { 64, 0.5, 64 } } } },
		{ { { { 31.25, 5.5, 9.75 } } }, { { { 31.5, 60, 10 } } } }, { { { { 20.3, 30.1, 1.9 } } }, { { { 37.8, 44.4, 50.6 } } } },
	};
	for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
		double share = box_area(&boxes[i]) / (6.0 * FLUX_SIDE * FLUX_SIDE);
		double got = visits_of(&f, &boxes[i]) / RAYS;
		assert_near(got, share, 4 * sqrt(share * (1 - share) / RAYS));
	}
	flux_close(&f);
	free(s);
	accel_free(&a);
	primitives_free(&p);
}

/* Rays of the law whose cost is known exactly. Balls end them in the middle of voxels and the trees are finer than the grid, so this
 * is about ends and interpolation too. */
static void invariant_rays_cost_what_areas_say(void **state)
{
	(void)state;
	const double student = 2.364624;
	struct primitives p = make_spd("balls", 2, false);
	for (int root = 0; root < 4; root += 2) {
		struct octree_options o = variant(root, 5);
		struct accel a = build(&p, "octree", &o);
		struct segment *s = make_segments(&a, WORKLOAD_INVARIANT);
		struct flux f = count_flux(&a, s, RAYS);
		/* Rays that lead out of the root cost nothing and are in no mean here, but they are in the exact one. */
		double share = (double)segments_of(&f) / RAYS;
		accel_free(&a);
		for (int v = 4; v < 9; v += 2) {
			struct err e = { 0 };
			struct prediction exact;
			o = variant(v, v < 8 ? 8 : 7);
			o.root = root ? ROOT_BOX : ROOT_CUBE;
			a = build(&p, "octree", &o);
			struct estimate cost = predict(&f, &a);
			if (cost_predict(&exact, &a, LAW_RAYS, ALPHA, BETA, &e) != 0)
				fail_msg("%s", e.text);
			assert_near(cost.mean * share, exact.predicted_exact, 4 * share * (cost.high - cost.mean) / student);
			accel_free(&a);
		}
		flux_close(&f);
		free(s);
	}
	primitives_free(&p);
}

struct stage {
	struct scene setting;
	struct primitives primitives;
	struct pilot pilot;
	struct flux fluxes[2]; /* over the cube, over the box */
};

/* A scene, its pilot and the pilot's fluxes. */
static struct stage make_stage(const char *family, int size)
{
	struct err e = { 0 };
	struct stage s = { 0 };
	struct spd_options o;
	struct render_options render;
	key_defaults(spd_keys, &o);
	key_defaults(render_keys, &render);
	o.size = size;
	if (spd_generate(&s.setting, spd_find(family), &o, &e) != 0 ||
	    primitives_make(&s.primitives, &s.setting, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0)
		fail_msg("%s", e.text);
	for (int root = 0; root < 2; root++) {
		struct octree_options octree = variant(2 * root, 6);
		struct accel a = build(&s.primitives, "octree", &octree);
		if (root == 0 && pilot_make(&s.pilot, &s.setting, &a, &render, 24, 20, 2, NULL, &e) != 0)
			fail_msg("%s", e.text);
		s.fluxes[root] = count_flux(&a, s.pilot.image.segments, s.pilot.image.segment_count);
		accel_free(&a);
	}
	return s;
}

static void close_stage(struct stage *s)
{
	flux_close(&s->fluxes[0]);
	flux_close(&s->fluxes[1]);
	pilot_free(&s->pilot);
	primitives_free(&s->primitives);
	scene_free(&s->setting);
}

/* Prediction over replay. */
static double ratio_to_replay(const struct stage *s, const char *name, const void *options, int root)
{
	struct err e = { 0 };
	struct estimate replay;
	struct accel a = build(&s->primitives, name, options);
	struct estimate cost = predict(&s->fluxes[root], &a);
	if (replay_cost(&replay, NULL, &s->pilot, &a, ALPHA, BETA, &e) != 0)
		fail_msg("%s", e.text);
	assert_true(cost.low <= cost.mean && cost.mean <= cost.high);
	accel_free(&a);
	return cost.mean / replay.mean;
}

/* Exact where cells are made of voxels; within a tenth where they are finer. Most rays at the wall end where they come into the
 * root, on walls that lie in its sides. */
static void images_cost_what_a_replay_counts(void **state)
{
	(void)state;
	static const struct { const char *family; int size; } stages[] = { { "gears", 1 }, { "balls", 2 }, { "wall", 12 } };
	_Alignas(16) unsigned char list[ACCEL_OPT_MOST];
	key_defaults(accel_find("list")->keys, list);
	for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
		struct stage s = make_stage(stages[i].family, stages[i].size);
		assert_near(ratio_to_replay(&s, "list", list, 1), 1, 1e-9);
		for (int v = 0; v < 10; v++) {
			struct octree_options coarse = variant(v, 6), fine = variant(v, 8);
			assert_near(ratio_to_replay(&s, "octree", &coarse, v >> 1 & 1), 1, 1e-9);
			if (v >= 4 && v < 9)
				assert_near(ratio_to_replay(&s, "octree", &fine, v >> 1 & 1), 1, 0.1);
		}
		close_stage(&s);
	}
}

/* One leaf that is not all of its box. */
static int list_wedge(const struct accel *a, cell_fn *fn, void *ctx)
{
	const struct cell c = { .bounds = a->root, .area = 0.9 * box_area(&a->root), .leaf = true };
	return fn(ctx, &c);
}

/* Rays that all do the same leave no doubt; none at all, no number; nor cells that are no boxes. */
static void intervals_are_as_wide_as_the_groups_differ(void **state)
{
	(void)state;
	struct primitives p = make_spd("tetra", 2, true);
	struct octree_options o = variant(0, 6);
	struct accel a = build(&p, "octree", &o);
	struct segment same[400];
	for (uint32_t i = 0; i < 400; i++) {
		struct ray r = { .o = { { { 9, 0.3, 0.2 } } }, .d = { { { -1, 0, 0 } } }, .t_max = INFINITY, .slack = a.slack,
			         .from = NO_PRIMITIVE };
		same[i] = (struct segment){ .ray = r, .sample = i };
	}
	struct flux f = count_flux(&a, same, 400);
	struct estimate cost = predict(&f, &a);
	for (int g = 0; g < FLUX_GROUPS; g++)
		assert_true(f.segments[g] > 0);
	assert_true(cost.mean >= ALPHA);
	assert_near(cost.low, cost.mean, 1e-9 * cost.mean);
	assert_near(cost.high, cost.mean, 1e-9 * cost.mean);
	struct accel_ops wedges = *a.ops;
	struct accel wedge = a;
	wedges.cells = list_wedge;
	wedge.ops = &wedges;
	assert_true(isnan(predict(&f, &wedge).mean));
	flux_close(&f);
	f = count_flux(&a, same, 0);
	cost = predict(&f, &a);
	assert_true(isnan(cost.mean) && isnan(cost.low) && isnan(cost.high));
	flux_close(&f);
	accel_free(&a);
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_segment_visits_the_root_once),
		cmocka_unit_test(lines_visit_boxes_by_area),
		cmocka_unit_test(invariant_rays_cost_what_areas_say),
		cmocka_unit_test(images_cost_what_a_replay_counts),
		cmocka_unit_test(intervals_are_as_wide_as_the_groups_differ),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
