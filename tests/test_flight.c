/* What is measured from inside a scene: flights of a camera, lights inside and outside, rays up to their hits, plane tests apart. */
#include "tests/structure.h"

#include "accel/kd_split.h"
#include "geom/hit.h"
#include "trace/flight.h"
#include "trace/render.h"

#include <string.h>

static void flights_are_read(void **state)
{
	(void)state;
	struct flight f;
	struct err e = { 0 };
	assert_int_equal(flight_parse(&f, NULL, &e), 0);
	assert_int_equal(f.count, 0);
	assert_int_equal(flight_parse(&f, "1 2 3 to 4 5 6", &e), 0);
	assert_int_equal(f.count, 1);
	assert_int_equal(flight_parse(&f, " 1 -2e1 3.5 to 4 5 6 ,\n7 8 9 to 0 0 0\n", &e), 0);
	assert_int_equal(f.count, 2);
	assert_near(f.from[0].y, -20, 0);
	assert_near(f.from[1].z, 9, 0);
	assert_near(f.at[0].x, 4, 0);
	static const char *const bad[] = { "1 2 3", "1 2 to 3 4 5", "1 2 3 to 4 5 6,", "1 2 3 to 4 5 6 7", "1 2 3 to 4 5 6; 1 2 3 to 4 5 6", "x",
		                           "1 2 3 to 1 2 3", "1 2 nan to 4 5 6", "1 2 1e999 to 4 5 6" };
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		e = (struct err){ 0 };
		assert_int_equal(flight_parse(&f, bad[i], &e), -1);
		assert_int_equal(e.code, STATUS_INPUT);
		assert_non_null(strstr(e.text, "flight"));
	}
	char many[(FLIGHT_PLACES + 1) * 20] = "";
	for (int i = 0; i <= FLIGHT_PLACES; i++)
		strcat(many, i ? ",0 0 0 to 1 1 1" : "0 0 0 to 1 1 1");
	e = (struct err){ 0 };
	assert_int_equal(flight_parse(&f, many, &e), -1);
	assert_non_null(strstr(e.text, "more than"));
}

/* Every place is passed, at its time; where places lie evenly on a line the camera keeps its speed, and never does it jump. */
static void flights_are_smooth(void **state)
{
	(void)state;
	struct flight f;
	struct err e = { 0 };
	struct view v = { .angle = 50 };
	assert_int_equal(flight_parse(&f, "0 0 1 to 9 9 9, 1 0 3 to 8 0 0, 5 2 2 to 1 1 7, 6 6 1 to 0 0 0", &e), 0);
	for (int i = 0; i < f.count; i++) {
		flight_place(&f, i / 3.0, &v);
		assert_true(v.given && v.angle == 50);
		assert_near(vec_length(vec_sub(v.from, f.from[i])), 0, 1e-12);
		assert_near(vec_length(vec_sub(v.at, f.at[i])), 0, 1e-12);
	}
	struct vec last[3];
	for (int i = 0; i <= 3000; i++) {
		flight_place(&f, i / 3000.0, &v);
		if (i >= 2) /* a second derivative of 60 a stretch, steps of 1/1000 */
			assert_near(vec_length(vec_add(vec_sub(v.from, vec_scale(last[0], 2)), last[1])), 0, 60 * 1e-6);
		last[1] = last[0];
		last[0] = v.from;
	}
	assert_int_equal(flight_parse(&f, "0 0 0 to 0 0 1, 1 2 3 to 1 2 4, 2 4 6 to 2 4 7, 3 6 9 to 3 6 10", &e), 0);
	for (int i = 0; i <= 60; i++) { /* the first and the last stretch begin and end at half the speed */
		double t = 1.0 / 3 + i / 180.0;
		flight_place(&f, t, &v);
		assert_near(vec_length(vec_sub(v.from, vec_scale(vec(3, 6, 9), t))), 0, 1e-12);
	}
}

struct stage {
	struct scene setting;
	struct primitives primitives;
	struct accel accel;
};

/* A scene in a kd tree. */
static void open_stage(struct stage *s, const char *family, int split)
{
	struct err e = { 0 };
	struct spd_options o;
	struct kd_options kd;
	*s = (struct stage){ 0 };
	key_defaults(spd_keys, &o);
	key_defaults(accel_find("kd")->keys, &kd);
	kd.split = split;
	if (spd_generate(&s->setting, spd_find(family), &o, &e) != 0 ||
	    primitives_make(&s->primitives, &s->setting, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0 ||
	    accel_build(&s->accel, accel_find("kd"), &kd, &s->primitives, &e) != 0)
		fail_msg("%s", e.text);
}

static void close_stage(struct stage *s)
{
	accel_free(&s->accel);
	primitives_free(&s->primitives);
	scene_free(&s->setting);
}

static void render(struct rendering *out, const struct stage *s, const struct render_options *o)
{
	struct err e = { 0 };
	const struct render_run run = { .alpha = 1, .beta = 1, .threads = 2, .segments = true };
	if (render_scene(out, &s->setting, &s->accel, o, &run, &e) != 0)
		fail_msg("%s", e.text);
}

/* A flight costs what its frames cost one by one, and its image is the first. */
static void flights_are_the_sum_of_their_frames(void **state)
{
	(void)state;
	enum { FRAMES = 5 };
	struct stage s;
	struct render_options o;
	struct rendering whole, one;
	struct class_tally sum[RAY_CLASSES] = { 0 };
	struct flight f;
	struct err e = { 0 };
	open_stage(&s, "room", SPLIT_SAH);
	key_defaults(render_keys, &o);
	o.width = 40;
	o.height = 30;
	o.ray_depth = 2;
	o.frames = FRAMES;
	o.flight = "1 1 1.5 to 3 2.2 0.7, 5 1 1.7 to 2 2 1, 4.5 3.8 1.2 to 2 1 1";
	render(&whole, &s, &o);
	assert_int_equal(flight_parse(&f, o.flight, &e), 0);
	o.flight = NULL;
	size_t segments = 0;
	for (int i = 0; i < FRAMES; i++) {
		flight_place(&f, i / (FRAMES - 1.0), &s.setting.view);
		render(&one, &s, &o);
		for (int c = 0; c < RAY_CLASSES; c++) {
			sum[c].rays += one.classes[c].rays;
			sum[c].missed += one.classes[c].missed;
			tally_add(&sum[c].sum, &one.classes[c].sum);
		}
		if (i == 0)
			assert_memory_equal(whole.pixels, one.pixels, 40 * 30 * 3);
		for (size_t k = 0; k < one.segment_count; k++, segments++)
			assert_int_equal(whole.segments[segments].sample, one.segments[k].sample + (uint32_t)i * 40 * 30);
		rendering_free(&one);
	}
	assert_int_equal(segments, whole.segment_count);
	assert_memory_equal(sum, whole.classes, sizeof sum);
	assert_true(sum[RAY_REFLECTED].rays > 0 && sum[RAY_SHADOW].rays > 0);
	rendering_free(&whole);
	close_stage(&s);
}

/* Shadow rays that nothing stops, but for those that start on the room's outer side and visit no cell. */
static uint64_t count_lit(const struct rendering *image)
{
	const struct class_tally *c = &image->classes[RAY_SHADOW];
	return c->rays - c->missed - c->sum.hits;
}

/* No light comes into a closed room; one that is moved inside shines on what one outside cannot reach. */
static void lights_move(void **state)
{
	(void)state;
	struct stage s;
	struct render_options o;
	struct rendering there, outside, back;
	open_stage(&s, "room", SPLIT_SAH);
	key_defaults(render_keys, &o);
	o.width = o.height = 32;
	render(&there, &s, &o);
	o.light = LIGHT_OUTSIDE;
	render(&outside, &s, &o);
	s.setting.lights[0].at = vec(50, 40, 30);
	o.light = LIGHT_INSIDE;
	render(&back, &s, &o);
	assert_true(count_lit(&there) > 0 && count_lit(&back) > 0);
	assert_int_equal(outside.classes[RAY_SHADOW].rays, there.classes[RAY_SHADOW].rays);
	assert_int_equal(count_lit(&outside), 0);
	o.light = LIGHT_SCENE; /* and is as far outside as it was */
	rendering_free(&back);
	render(&back, &s, &o);
	assert_int_equal(count_lit(&back), 0);
	rendering_free(&there);
	rendering_free(&outside);
	rendering_free(&back);
	close_stage(&s);
}

/* The same rays as those that nothing stops, each up to the hit the list finds, so that they visit less. */
static void interior_rays_end_in_hits(void **state)
{
	(void)state;
	struct stage s;
	struct err e = { 0 };
	struct ray_source stopped, through;
	open_stage(&s, "room", SPLIT_EXACT);
	assert_int_equal(ray_source_open(&stopped, &s.accel, WORKLOAD_INTERIOR_HITS, 5, &e), 0);
	assert_int_equal(ray_source_open(&through, &s.accel, WORKLOAD_INTERIOR, 5, &e), 0);
	for (uint64_t i = 0; i < 2000; i++) {
		struct ray r = ray_source_draw(&stopped, i), q = ray_source_draw(&through, i);
		struct tally n = { 0 }, m = { 0 };
		struct hit h, nothing;
		assert_memory_equal(&r.o, &q.o, sizeof r.o);
		assert_memory_equal(&r.d, &q.d, sizeof r.d);
		assert_true(s.accel.ops->shoot_counted(&s.accel, &r, &h, &n)); /* the room is closed */
		assert_false(s.accel.ops->shoot_counted(&s.accel, &q, &nothing, &m));
		assert_true(n.leaves <= m.leaves && n.tests <= m.tests && n.inner_step + n.inner_start <= m.inner_step + m.inner_start);
		assert_int_equal(m.barycentric, 0);
	}
	ray_source_close(&stopped);
	ray_source_close(&through);
	close_stage(&s);
}

/* Plane tests of a tree of one leaf, by division and in the order of the list. */
static uint64_t count_planes(const struct primitives *p, const struct ray *r)
{
	struct hit h = { r->t_max, NO_PRIMITIVE };
	uint64_t met = 0;
	for (uint32_t i = 0; i < p->count; i++) {
		const struct vec *v = p->all[i].triangle.v;
		struct vec n = vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0]));
		double t = vec_dot(n, vec_sub(v[0], r->o)) / vec_dot(n, r->d);
		met += t >= 0 && t <= h.t;
		primitive_hit(&p->all[i], i, r, &h);
	}
	return met;
}

static void plane_tests_are_counted_apart(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct stage s = { 0 };
	struct spd_options soup; /* of no two triangles in a plane */
	struct ray_source source;
	struct accel leaf, tree;
	struct kd_options o;
	key_defaults(spd_keys, &soup);
	soup.count = 200;
	soup.cube = 4;
	assert_int_equal(spd_generate(&s.setting, spd_find("soup"), &soup, &e), 0);
	assert_int_equal(primitives_make(&s.primitives, &s.setting, CURVES_KEEP, 3, "soup", &e), 0);
	key_defaults(accel_find("kd")->keys, &o);
	o.common.max_depth = 0;
	assert_int_equal(accel_build(&leaf, accel_find("kd"), &o, &s.primitives, &e), 0);
	o.common.max_depth = 12;
	o.split = SPLIT_FAST6;
	assert_int_equal(accel_build(&tree, accel_find("kd"), &o, &s.primitives, &e), 0);
	assert_int_equal(ray_source_open(&source, &leaf, WORKLOAD_INTERIOR_HITS, 3, &e), 0);
	uint64_t fewer = 0;
	for (uint64_t i = 0; i < 5000; i++) {
		struct ray r = ray_source_draw(&source, i);
		struct tally n = { 0 }, m = { 0 };
		struct hit h;
		leaf.ops->shoot_counted(&leaf, &r, &h, &n);
		assert_int_equal(n.tests, s.primitives.count);
		assert_int_equal(n.barycentric, count_planes(&s.primitives, &r));
		tree.ops->shoot_counted(&tree, &r, &h, &m);
		assert_true(m.barycentric <= m.tests);
		fewer += m.barycentric < m.tests;
	}
	assert_true(fewer > 0);
	ray_source_close(&source);
	accel_free(&leaf);
	accel_free(&tree);
	primitives_free(&s.primitives);
	scene_free(&s.setting);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(flights_are_read),
		cmocka_unit_test(flights_are_smooth),
		cmocka_unit_test(flights_are_the_sum_of_their_frames),
		cmocka_unit_test(lights_move),
		cmocka_unit_test(interior_rays_end_in_hits),
		cmocka_unit_test(plane_tests_are_counted_apart),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
