/* POV-Ray files as the SPD programs print them, for POV-Ray 1 (-r 2) and 2 (-r 3), hold the scene of their NFF.
 *
 * The files are printed here from our own generators, in the form SPD's have. Where SPD's own files are not the NFF scene the fault is
 * theirs, and nothing of it can be mended by a reader: tree -c -r 2 puts spheres at the wrong ends of branches, sombrero is an image with
 * heights of its own, sample -c -r 2 moves a disc and turns it by "nan", which counts as 0 here (last test). */
#include "tests/check.h"

#include "io/pov.h"
#include "trace/camera.h"

#include <string.h>

/* A vector as each version separates it. */
static void print_vec(struct text *t, struct vec v, bool old)
{
	text_print(t, old ? "<%.17g %.17g %.17g>" : "<%.17g, %.17g, %.17g>", v.x, v.y, v.z);
}

static void print_color(struct text *t, struct color c)
{
	text_print(t, "color red %.17g green %.17g blue %.17g", c.r, c.g, c.b);
}

static void print_setting(struct text *t, const struct scene *s, bool old)
{
	const struct view *v = &s->view;
	struct vec toward = vec_unit(vec_sub(v->at, v->from)), right = vec_unit(vec_cross(toward, v->up)), up = vec_cross(right, toward);
	double size = 2 * tan(v->angle / 2 * 3.14159265358979323846 / 180);
	const char *const words[] = { "location", "direction", "right", "up" };
	const struct vec vectors[] = { v->from, toward, vec_scale(right, size), vec_scale(up, size) };
	if (old) {
		text_print(t, "// POV-Ray 1.0 scene file\n// background color:\nobject {\n    sphere { <0 0 0> 9000  texture { ambient 1 diffuse 0 ");
		print_color(t, s->background);
		text_print(t, " } }\n} // object - background\n");
	} else {
		text_print(t, "// POV-Ray 2 scene file\nbackground { ");
		print_color(t, s->background);
		text_print(t, " }\n");
	}
	text_print(t, "camera {\n");
	for (int i = 0; i < 4; i++) {
		text_print(t, "    %-10s", words[i]);
		print_vec(t, vectors[i], old);
		text_print(t, "\n");
	}
	text_print(t, "} // camera\n");
	for (size_t i = 0; i < s->light_count; i++) {
		text_print(t, old ? "object {\n    light_source {\n        " : "light_source {\n    ");
		print_vec(t, s->lights[i].at, old);
		text_print(t, " ");
		print_color(t, (struct color){ 0.5, 0.5, 0.5 });
		text_print(t, old ? "\n    } // light\n} // object\n" : "\n} // light\n");
	}
}

static void print_material(struct text *t, const struct material *m, size_t number, bool old)
{
	text_print(t, "#declare txt%03zu = texture {\n", number);
	if (!old)
		text_print(t, "    pigment {\n");
	print_color(t, m->color);
	if (m->transmit > 0)
		text_print(t, old ? " alpha %.17g" : " filter %.17g", m->transmit);
	text_print(t, old ? "\n" : "\n    } // pigment\n    // normal { bumps, ripples, etc. }\n    finish {\n");
	text_print(t, "    ambient 0.1\n    diffuse %.17g\n    phong 0.5  phong_size %.17g\n", m->kd, m->shine);
	if (m->ks > 0)
		text_print(t, "    reflection %.17g\n", m->ks);
	if (m->transmit > 0)
		text_print(t, "    refraction 1.0 ior %.17g\n", m->ior);
	text_print(t, old ? "} // texture\n" : "    } // finish\n} // texture\n");
}

static void print_primitive(struct text *t, const struct primitive *p, bool old)
{
	if (p->kind == PRIMITIVE_SPHERE) {
		text_print(t, old ? "object { sphere { " : "sphere { ");
		print_vec(t, p->sphere.center, old);
		text_print(t, old ? " %.17g }  texture { txt%03u } }\n" : ", %.17g  texture { txt%03u } }\n", p->sphere.radius, p->material);
		return;
	}
	text_print(t, "object {\n    triangle {\n");
	for (int i = 0; i < 3; i++) {
		print_vec(t, p->triangle.v[i], old);
		text_print(t, "%s\n", old || i == 2 ? "" : ",");
	}
	text_print(t, "    } // tri\n    texture { txt%03u }\n} // object\n", p->material);
}

/* As the smooth triangles of tessellated scenes. */
static void print_patch(struct text *t, const struct vec *v, size_t material, bool old)
{
	text_print(t, "object {\n    smooth_triangle {\n");
	for (int i = 0; i < 3; i++) {
		print_vec(t, v[i], old);
		text_print(t, " ");
		print_vec(t, v[3 + i], old);
		text_print(t, "%s\n", old || i == 2 ? "" : ",");
	}
	text_print(t, "    } // tri\n    texture { txt%03zu }\n} // object\n", material);
}

static void print_scene(struct text *t, const struct scene *s, const struct primitives *p, bool old)
{
	print_setting(t, s, old);
	for (size_t i = 0; i < s->material_count; i++)
		print_material(t, &s->materials[i], i, old);
	bool patches = s->object_count == p->count;
	for (uint32_t i = 0; i < p->count; i++)
		if (patches && s->objects[i].kind == OBJECT_PATCH && s->objects[i].count == 3)
			print_patch(t, &s->points[s->objects[i].first], s->objects[i].material, old);
		else
			print_primitive(t, &p->all[i], old);
}

static bool same_vec(struct vec a, struct vec b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool same_primitive(const struct primitive *a, const struct primitive *b)
{
	if (a->kind != b->kind)
		return false;
	if (a->kind == PRIMITIVE_SPHERE)
		return same_vec(a->sphere.center, b->sphere.center) && a->sphere.radius == b->sphere.radius;
	for (int i = 0; i < 3; i++) {
		bool same = true;
		for (int k = 0; k < 3; k++)
			same = same && same_vec(a->triangle.v[k], b->triangle.v[(k + i) % 3]);
		if (same)
			return true;
	}
	return false;
}

static void assert_same_setting(const struct scene *want, const struct scene *got)
{
	struct box nothing = { { { { 0, 0, 0 } } }, { { { 1, 1, 1 } } } };
	struct camera a = camera_make(&want->view, &nothing, 1, 1), b = camera_make(&got->view, &nothing, 1, 1);
	for (int i = 0; i < 9; i++) {
		double x = i % 3 / 2.0, y = i / 3 / 2.0;
		assert_near(vec_length(vec_sub(camera_direction(&a, x, y), camera_direction(&b, x, y))), 0, 1e-12);
		assert_true(same_vec(camera_origin(&a, x, y), camera_origin(&b, x, y)));
	}
	assert_int_equal(want->light_count, got->light_count);
	for (size_t i = 0; i < want->light_count; i++)
		assert_true(same_vec(want->lights[i].at, got->lights[i].at));
	assert_true(want->background.r == got->background.r && want->background.g == got->background.g && want->background.b == got->background.b);
}

static void assert_same_material(const struct material *a, const struct material *b)
{
	assert_true(a->color.r == b->color.r && a->color.g == b->color.g && a->color.b == b->color.b);
	assert_true(a->kd == b->kd && a->ks == b->ks && a->transmit == b->transmit && a->shine == b->shine);
	assert_true(a->transmit == 0 || a->ior == b->ior);
}

static int load_nothing(void *context, const char *path, struct text *t)
{
	(void)context;
	(void)path;
	(void)t;
	return -1;
}

static void read_pov(struct scene *s, const struct text *t)
{
	struct err e = { 0 };
	struct pov_summary m;
	struct pov_options o = pov_defaults();
	o.access.load = load_nothing;
	o.mesh.keep_domes = true;
	if (pov_read(s, "a.pov", t->bytes, t->size, &o, &m, &e) != 0)
		fail_msg("%s", e.text);
}

static void check_family(const char *family, int size, bool tessellate)
{
	struct err e = { 0 };
	struct scene scene = { 0 };
	struct primitives want = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = tessellate;
	if (spd_generate(&scene, spd_find(family), &o, &e) != 0 ||
	    primitives_make(&want, &scene, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0)
		fail_msg("%s", e.text);
	for (int old = 0; old <= 1; old++) {
		struct text t = { 0 };
		struct scene read = { 0 };
		struct primitives got = { 0 };
		print_scene(&t, &scene, &want, old);
		read_pov(&read, &t);
		assert_same_setting(&scene, &read);
		if (primitives_make(&got, &read, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0)
			fail_msg("%s", e.text);
		assert_int_equal(got.count, want.count);
		for (uint32_t i = 0; i < want.count; i++) {
			if (!same_primitive(&want.all[i], &got.all[i]))
				fail_msg("%s -r %d: primitive %u differs", family, old ? 2 : 3, (unsigned)i);
			assert_same_material(&scene.materials[want.all[i].material], &read.materials[got.all[i].material]);
		}
		primitives_free(&got);
		scene_free(&read);
		text_free(&t);
	}
	primitives_free(&want);
	scene_free(&scene);
}

static void families(void **state)
{
	(void)state;
	static const char *const names[] = { "balls", "gears", "mount", "shells", "tetra", "teapot", "nurbtst" };
	for (size_t i = 0; i < sizeof names / sizeof *names; i++)
		check_family(names[i], 1, false);
}

static void tessellated(void **state)
{
	(void)state;
	static const char *const names[] = { "jacks", "lattice", "rings", "tree", "sombrero", "balls" };
	for (size_t i = 0; i < sizeof names / sizeof *names; i++)
		check_family(names[i], 1, true);
}

/* Cylinders and cones: open cones, or for POV-Ray 1 a quadric between two planes, then put in place. The same surface both ways. */
static void cones(void **state)
{
	(void)state;
	static const char *const files[] = {
		"cone { <0, 0, 3>, 0.5, <0, 0, 1>, 0.5 open }",
		"object { quadric { <1 1 0> <0 0 0> <0 0 0> -1 } clipped_by { intersection { plane { <0 0 -1> 0 } plane { <0 0  1> 1 } } }\n"
		"scale <0.5 0.5 1> scale <1 1 2> rotate <-0 -0 0> translate <0 0 1> }",
		"cone { <0, 0, 3>, 1, <0, 0, 1>, 0.5 open }",
		"object { quadric{ <1 1 -1> <0 0 0> <0 0 0> 0 } clipped_by { intersection { plane { <0 0 -1> -0.5} plane { <0 0  1> 1} } }\n"
		"translate <0 0 -0.5> scale <1 1 4> rotate <-0 0 0> translate <0 0 1> }",
	};
	const double pi = 3.14159265358979323846, areas[] = { 2 * pi, 2 * pi, pi * 1.5 * sqrt(4.25), pi * 1.5 * sqrt(4.25) };
	for (size_t i = 0; i < 4; i++) {
		struct err e = { 0 };
		struct text t = { 0 };
		struct scene s = { 0 };
		struct primitives p = { 0 };
		text_print(&t, "%s", files[i]);
		read_pov(&s, &t);
		if (primitives_make(&p, &s, CURVES_KEEP, SPD_RESOLUTION, "cone", &e) != 0)
			fail_msg("%s", e.text);
		assert_near(p.area, areas[i], 0.01 * areas[i]);
		assert_near(p.bounds.lo.z, 1, 1e-6);
		assert_near(p.bounds.hi.z, 3, 1e-6);
		primitives_free(&p);
		scene_free(&s);
		text_free(&t);
	}
}

static void not_a_number(void **state)
{
	(void)state;
	struct text t = { 0 };
	struct scene s = { 0 };
	text_print(&t, "object { light_source { <1 2 3> color red 1 } rotate <-90 -nan 0> }");
	read_pov(&s, &t);
	assert_near(s.lights[0].at.y, 3, 1e-12);
	assert_near(s.lights[0].at.z, -2, 1e-12);
	text_free(&t);
	scene_free(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(families), cmocka_unit_test(tessellated), cmocka_unit_test(cones),
		                            cmocka_unit_test(not_a_number) };
	return cmocka_run_group_tests_name("pov_spd", tests, NULL, NULL);
}
