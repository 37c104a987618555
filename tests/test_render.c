/* The ray tracer: the same rays and the same image whatever the structure and the threads, the statistics published for the SPD scenes,
 * and a pilot that replays exactly. */
#include "tests/check.h"

#include "accel/kd_split.h"
#include "accel/octree.h"
#include "trace/camera.h"
#include "trace/replay.h"
#include "trace/shade.h"

#include <string.h>

/* A scene ready to be rendered. */
struct stage {
	struct scene setting;
	struct primitives primitives;
};

static struct stage make_stage(const char *family, int size)
{
	struct err e = { 0 };
	struct stage s = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	if (spd_generate(&s.setting, spd_find(family), &o, &e) != 0 ||
	    primitives_make(&s.primitives, &s.setting, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

static void close_stage(struct stage *s)
{
	scene_free(&s->setting);
	primitives_free(&s->primitives);
}

static struct render_options small(int64_t width, int64_t height)
{
	struct render_options o;
	key_defaults(render_keys, &o);
	o.width = width;
	o.height = height;
	return o;
}

static void render(struct rendering *out, const struct stage *s, const struct accel *a, const struct render_options *o, int threads)
{
	struct err e = { 0 };
	const struct render_run run = { .alpha = 1, .beta = 1, .threads = threads };
	if (render_scene(out, &s->setting, a, o, &run, &e) != 0)
		fail_msg("%s", e.text);
}

static struct accel build(const struct stage *s, const char *name, const void *options)
{
	struct err e = { 0 };
	struct accel a;
	if (accel_build(&a, accel_find(name), options, &s->primitives, &e) != 0)
		fail_msg("%s", e.text);
	return a;
}

static struct accel build_default(const struct stage *s, const char *name)
{
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	key_defaults(accel_find(name)->keys, options);
	return build(s, name, options);
}

static struct octree_options variant(int v)
{
	struct octree_options o;
	key_defaults(accel_find("octree")->keys, &o);
	o.balanced = v & 1;
	o.root = v & 2 ? ROOT_BOX : ROOT_CUBE;
	o.max_objects = v & 4 ? 2 : 10;
	o.max_depth = 6;
	o.criterion = v < 8 ? CRITERION_OBJECTS : v & 1 ? CRITERION_RANDOM : CRITERION_FEATURES;
	return o;
}

static const struct { const char *family; int size; } scenes[] = {
	{ "tetra", 3 }, { "teapot", 2 }, { "gears", 1 }, { "balls", 2 }, { "mount", 2 },
};

static void rays_do_not_depend_on_the_structure(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
		struct stage s = make_stage(scenes[i].family, scenes[i].size);
		struct render_options o = small(40, 30);
		struct accel list = build_default(&s, "list");
		struct rendering want, got;
		render(&want, &s, &list, &o, 2);
		assert_int_equal(want.classes[RAY_PRIMARY].rays, 40 * 30);
		for (int v = 0; v < 15; v++) {
			static const char *const others[] = { "kd", "bsp", "grid", "bvh", "bvh8" };
			struct octree_options octree = variant(v);
			struct accel a = v < 10 ? build(&s, "octree", &octree) : build_default(&s, others[v - 10]);
			render(&got, &s, &a, &o, 2);
			for (int c = 0; c < RAY_CLASSES; c++) {
				assert_int_equal(got.classes[c].rays, want.classes[c].rays);
				assert_int_equal(got.classes[c].sum.hits, want.classes[c].sum.hits);
			}
			assert_memory_equal(got.pixels, want.pixels, 40 * 30 * 3);
			rendering_free(&got);
			accel_free(&a);
		}
		rendering_free(&want);
		accel_free(&list);
		close_stage(&s);
	}
}

static void images_do_not_depend_on_threads(void **state)
{
	(void)state;
	struct stage s = make_stage("gears", 1);
	struct accel a = build_default(&s, "octree");
	struct render_options o = small(70, 50);
	struct rendering want, got;
	o.sampling = SAMPLE_CORNERS;
	render(&want, &s, &a, &o, 1);
	assert_int_equal(want.classes[RAY_PRIMARY].rays, 71 * 51);
	for (int threads = 2; threads <= 7; threads += 5) {
		render(&got, &s, &a, &o, threads);
		assert_memory_equal(got.pixels, want.pixels, 70 * 50 * 3);
		assert_memory_equal(&got.actual, &want.actual, sizeof got.actual);
		assert_memory_equal(got.classes, want.classes, sizeof got.classes);
		rendering_free(&got);
	}
	rendering_free(&want);
	accel_free(&a);
	close_stage(&s);
}

static void assert_close(const char *what, uint64_t got, double published)
{
	if (fabs((double)got / published - 1) > 0.005)
		fail_msg("%s: %llu, published %.0f", what, (unsigned long long)got, published);
}

/* Numbers of rays as Haines' tables have them, of the scenes at their default sizes; his programs sent no shadow rays from the side of
 * a surface that looks away from the light. */
static void rays_of_the_spd_scenes_as_published(void **state)
{
	(void)state;
	static const struct { const char *family; double shadow, reflected; } published[] = {
		{ "tetra", 46150, 0 }, { "teapot", 407656, 225720 }, { "balls", 954368, 175095 }, { "mount", 0, 355008 },
	};
	for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
		struct stage s = make_stage(published[i].family, SPD_DEFAULT_SIZE);
		struct accel a = build_default(&s, "octree");
		struct render_options o = small(512, 512);
		struct rendering image;
		o.preset = PRESET_SPD;
		o.shadows = SHADOWS_FACING;
		render_resolve(&o);
		render(&image, &s, &a, &o, 2);
		assert_int_equal(image.classes[RAY_PRIMARY].rays, 513 * 513);
		if (published[i].shadow > 0)
			assert_close(published[i].family, image.classes[RAY_SHADOW].rays, published[i].shadow);
		if (published[i].reflected > 0)
			assert_close(published[i].family, image.classes[RAY_REFLECTED].rays, published[i].reflected);
		rendering_free(&image);
		accel_free(&a);
		close_stage(&s);
	}
}

static void limits_end_the_tree_of_rays(void **state)
{
	(void)state;
	struct stage s = make_stage("balls", 1);
	struct accel a = build_default(&s, "octree");
	uint64_t last = 0;
	for (int64_t depth = 1; depth <= 4; depth++) {
		struct render_options o = small(60, 60);
		struct rendering image;
		o.ray_depth = depth;
		render(&image, &s, &a, &o, 2);
		uint64_t hits = image.classes[RAY_PRIMARY].sum.hits + image.classes[RAY_REFLECTED].sum.hits;
		assert_int_equal(image.classes[RAY_SHADOW].rays, 3 * hits);
		assert_true(depth == 1 ? image.classes[RAY_REFLECTED].rays == 0 : image.classes[RAY_REFLECTED].rays > last);
		last = image.classes[RAY_REFLECTED].rays;
		rendering_free(&image);
		o.ray_depth = 5;
		o.weight = pow(0.5, (double)depth - 1) * 0.99; /* the balls mirror half of the light */
		render(&image, &s, &a, &o, 2);
		assert_int_equal(image.classes[RAY_REFLECTED].rays, last);
		rendering_free(&image);
	}
	accel_free(&a);
	close_stage(&s);
}

/* The pilot's rays cost in any structure what they would have cost traced in it, to the last count. */
static void replay_counts_what_tracing_counts(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
		struct err e = { 0 };
		struct stage s = make_stage(scenes[i].family, scenes[i].size);
		struct render_options o = small(24, 20);
		struct accel list = build_default(&s, "list");
		struct pilot pilot;
		assert_int_equal(pilot_make(&pilot, &s.setting, &list, &o, 24, 20, 2, NULL, &e), 0);
		o.sampling = SAMPLE_LATTICE;
		const struct kd_options kd = { .common = { .max_objects = 2, .max_depth = 14, .root = ROOT_BOX, .mailbox = MAILBOX_FULL, .boxes = 0.5 } };
		for (int v = 0; v < 11; v++) {
			struct octree_options octree = variant(v);
			struct accel a = v < 10 ? build(&s, "octree", &octree) : build(&s, "kd", &kd);
			struct rendering traced;
			struct estimate cost;
			struct replay_counts counts;
			render(&traced, &s, &a, &o, 2);
			assert_int_equal(replay_cost(&cost, &counts, &pilot, &a, 1, 1, &e), 0);
			assert_near(cost.mean / traced.actual.cost.mean, 1, 1e-12);
			assert_true(cost.low < cost.mean && cost.mean < cost.high);
			assert_near(counts.leaves / traced.actual.leaves.mean, 1, 1e-12);
			assert_near(counts.inner / traced.actual.inner.mean, 1, 1e-12);
			assert_near(counts.boxes, traced.actual.boxes.mean, 1e-12);
			assert_near(counts.tests_made, v < 10 ? traced.actual.tests.mean : traced.actual.tests_made.mean, 1e-9);
			rendering_free(&traced);
			accel_free(&a);
		}
		pilot_free(&pilot);
		accel_free(&list);
		close_stage(&s);
	}
}

static void cameras_look_where_they_should(void **state)
{
	(void)state;
	const struct view v = { .given = true, .from = vec(0, 0, 5), .up = vec(0, 1, 0), .angle = 90, .hither = 1, .width = 10, .height = 10 };
	const struct box b = { { { { -1, -1, -1 } } }, { { { 1, 1, 1 } } } };
	struct camera c = camera_make(&v, &b, 200, 100);
	struct vec middle = camera_direction(&c, 0.5, 0.5), corner = camera_direction(&c, 0, 0);
	assert_near(middle.z, -1, 1e-15);
	assert_near(corner.x / corner.z, 2, 1e-12); /* 90 degrees high, twice as wide */
	assert_near(corner.y / -corner.z, 1, 1e-12);
	/* Without a view, and looking along 'up': still a picture of the box. */
	const struct view none = { 0 }, along = { .given = true, .from = vec(0, 0, 5), .up = vec(0, 0, 1), .angle = 45, .hither = 1, .width = 10, .height = 10 };
	c = camera_make(&none, &b, 1, 1);
	assert_true(vec_dot(camera_direction(&c, 0.5, 0.5), c.from) < -0.99 * vec_length(c.from));
	c = camera_make(&along, &b, 1, 1);
	assert_near(vec_length(camera_direction(&c, 0.3, 0.7)), 1, 1e-12);
	/* A window of any shape, whatever the picture's; parallel rays start in it. */
	struct view window = { .given = true, .from = vec(1, 2, 3), .window = true, .direction = vec(0, 0, 2), .right = vec(4, 0, 0),
		               .window_up = vec(0, 8, 0) };
	c = camera_make(&window, &b, 100, 7);
	corner = camera_direction(&c, 1, 0);
	assert_near(corner.x / corner.z, 1, 1e-12);
	assert_near(corner.y / corner.z, 2, 1e-12);
	window.parallel = true;
	c = camera_make(&window, &b, 100, 7);
	assert_near(vec_length(vec_sub(camera_origin(&c, 1, 0), vec(3, 6, 3))), 0, 1e-12);
	assert_near(vec_length(vec_sub(camera_direction(&c, 1, 0), vec(0, 0, 1))), 0, 1e-12);
}

static void light_bends_as_snell_says(void **state)
{
	(void)state;
	const struct material glass = { .ior = 1.5, .transmit = 1 };
	struct surface_point p = { .normal = vec(0, 0, 1), .shading = vec(0, 0, 1), .material = &glass };
	struct vec in = vec_unit(vec(3, 0, -4)), out;
	assert_true(refract(&p, in, &out));
	assert_near(out.x, in.x / 1.5, 1e-12);
	assert_near(reflect(&p, in).z, -in.z, 1e-12);
	p.inside = true;
	assert_true(refract(&p, vec_unit(vec(1, 0, -4)), &out));
	assert_near(out.x, 1.5 / sqrt(17), 1e-12);
	assert_true(refract(&p, in, &out)); /* 1.5 x 0.6 is below 1 */
	assert_false(refract(&p, vec_unit(vec(3.6, 0, -4)), &out));
}

/* Of 262,144 primary rays 61,000, 60,000 and 152,000 hit in Subramanian and Fussell's Table 1 (for DNA and Arches half the shadow rays
 * of two lights, for Geo58 a third of those of three). */
static void stand_ins_are_as_large_and_as_near_as_what_they_stand_for(void **state)
{
	(void)state;
	static const struct { const char *family; size_t objects, lights; double share; } wanted[] = {
		{ "dna", 410, 2, 61.0 / 262.144 }, { "arches", 4818, 2, 60.0 / 262.144 }, { "geo58", 306, 3, 152.0 / 262.144 },
	};
	for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
		struct stage s = make_stage(wanted[i].family, SPD_DEFAULT_SIZE);
		struct render_options o = small(128, 128);
		struct accel a = build_default(&s, "kd");
		struct rendering image;
		o.ray_depth = 1;
		render(&image, &s, &a, &o, 2);
		assert_int_equal(s.setting.object_count, wanted[i].objects);
		assert_int_equal(s.setting.light_count, wanted[i].lights);
		assert_near((double)image.classes[RAY_PRIMARY].sum.hits / (128 * 128), wanted[i].share, 0.05 * wanted[i].share);
		rendering_free(&image);
		accel_free(&a);
		close_stage(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(rays_do_not_depend_on_the_structure),
		cmocka_unit_test(images_do_not_depend_on_threads),
		cmocka_unit_test(rays_of_the_spd_scenes_as_published),
		cmocka_unit_test(limits_end_the_tree_of_rays),
		cmocka_unit_test(replay_counts_what_tracing_counts),
		cmocka_unit_test(cameras_look_where_they_should),
		cmocka_unit_test(light_bends_as_snell_says),
		cmocka_unit_test(stand_ins_are_as_large_and_as_near_as_what_they_stand_for),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
