/* What a POV-Ray scene says beside its shapes: transforms, cameras, looks, and how old ones say it. */
#include "tests/pov_text.h"

static void transforms(void **state)
{
	(void)state;
	ASSERT_LIGHTS("light_source { z rgb 1 rotate 90*y }", 1);
	ASSERT_LIGHTS("light_source { <1,2,3> rgb 1 translate 2 scale <3,0,1> }", 9);
	ASSERT_LIGHTS("light_source { <1,2,3> rgb 1 matrix <1,0,0, 10,1,0, 100,0,1, 1000,0,0> }", 1 + 20 + 300 + 1000);
	ASSERT_LIGHTS("#declare T = transform { translate x scale 2 } light_source { x rgb 1 T } light_source { x rgb 1 transform T } "
	              "light_source { x rgb 1 transform { T inverse } }", 4, 4, -0.5);
	ASSERT_LIGHTS("light_source { <1 2 3> rgb 1 scale 2 3 4 rotate 0 0 -90 translate -1 -2 -3 }", 5);
	/* Children first, then the parent. */
	ASSERT_LIGHTS("union { light_source { x rgb 1 translate x } light_source { 0 rgb 1 } scale 5 translate x }", 11, 1);
	ASSERT_LIGHTS("#declare L = light_source { 0 rgb 1 translate 3*x } light_source { L scale 2 } object { L translate x }", 6, 4);
}

/* The ray through (x, y) of the scene's view. */
static void assert_ray(const char *camera, double x, double y, const double *from, const double *toward)
{
	struct scene s = read_with(camera, NULL);
	const struct view *v = &s.view;
	assert_true(v->given && v->window);
	struct vec aside = vec_add(vec_scale(v->right, x - 0.5), vec_scale(v->window_up, 0.5 - y));
	struct vec o = v->parallel ? vec_add(v->from, aside) : v->from;
	struct vec d = vec_unit(v->parallel ? v->direction : vec_add(v->direction, aside));
	for (int i = 0; i < 3; i++) {
		assert_near(o.a[i], from[i], 1e-9);
		assert_near(d.a[i], toward[i], 1e-9);
	}
	scene_free(&s);
}

#define ASSERT_RAY(camera, x, y, ox, oy, oz, dx, dy, dz) \
	assert_ray(camera, x, y, (const double[]){ ox, oy, oz }, (const double[]){ dx, dy, dz })

static void cameras(void **state)
{
	(void)state;
	double h = 1.33 / 2, n = sqrt(1 + h * h + 0.25), r = sqrt(0.5);
	/* The defaults; left-handed: right is +x when looking along +z. */
	ASSERT_RAY("camera { }", 0.5, 0.5, 0, 0, 0, 0, 0, 1);
	ASSERT_RAY("camera { }", 1, 0, 0, 0, 0, h / n, 0.5 / n, 1 / n);
	/* angle spans the width, whatever comes first; 0 leaves direction alone. */
	ASSERT_RAY("camera { angle 90 right 2*x }", 1, 0.5, 0, 0, 0, r, 0, r);
	ASSERT_RAY("camera { right 2*x angle 90 }", 0, 0.5, 0, 0, 0, -r, 0, r);
	ASSERT_RAY("camera { angle 0 }", 1, 0.5, 0, 0, 0, h / sqrt(1 + h * h), 0, 1 / sqrt(1 + h * h));
	ASSERT_RAY("camera { location <0,0,-5> look_at <5,0,-5> }", 0.5, 0.5, 0, 0, -5, 1, 0, 0);
	ASSERT_RAY("camera { right 2*x location <0,0,-5> look_at <5,0,-5> }", 1, 0.5, 0, 0, -5, r, 0, -r);
	/* A right-handed window stays right-handed. */
	ASSERT_RAY("camera { right -2*x look_at <5,0,0> }", 1, 0.5, 0, 0, 0, r, 0, r);
	ASSERT_RAY("camera { right 2*x up 2*y sky x look_at z*3 }", 0.5, 0, 0, 0, 0, r, 0, r);
	/* Transforms act after all else. */
	ASSERT_RAY("camera { rotate 90*y translate x location 2*z }", 0.5, 0.5, 3, 0, 0, 1, 0, 0);
	/* Parallel: without right and up the window grows with the distance of what is looked at. */
	ASSERT_RAY("camera { orthographic location -4*z look_at 0 }", 1, 0, 4 * h, 2, -4, 0, 0, 1);
	ASSERT_RAY("camera { orthographic location -4*z right 2*x up 2*y look_at 0 }", 1, 0, 1, 1, -4, 0, 0, 1);
	ASSERT_RAY("camera { orthographic location -4*z right 2*x up 2*y look_at 0 angle 90 }", 1, 0, 4, 4, -4, 0, 0, 1);
	ASSERT_RAY("#declare C = camera { location x } camera { C translate y }", 0.5, 0.5, 1, 1, 0, 0, 0, 1);
	/* The last one counts, and NFF's words say nearly the same. */
	struct scene s = read_with("camera { location x } camera { up 2*y location y look_at y + z }", NULL);
	assert_near(s.view.from.y, 1, 0);
	assert_near(s.view.angle, 90, 1e-9);
	assert_near(s.view.at.z, 1, 1e-12);
	scene_free(&s);
}

static struct material read_material(const char *text)
{
	struct scene s = read_with(text, NULL);
	assert_true(s.material_count > 0);
	struct material m = s.materials[0];
	scene_free(&s);
	return m;
}

static void looks(void **state)
{
	(void)state;
	struct material m = read_material("sphere { 0, 1 }");
	assert_true(m.color.r == 0 && m.kd == 0.6 && m.ks == 0 && m.transmit == 0);
	m = read_material("sphere { 0, 1 pigment { rgbt <1, 0.5, 0.25, 0.75> } finish { diffuse 0.3 phong 1 phong_size 50 reflection { 0.1, 0.4 } } "
	                  "interior { ior 1.5 } }");
	assert_true(m.color.g == 0.5 && m.transmit == 0.75 && m.kd == 0.3 && m.shine == 50 && m.ks == 0.1 && m.ior == 1.5);
	/* The first colour of a map; identifiers carry what was captured, and what is written weighs more. */
	m = read_material("sphere { 0, 1 texture { pigment { gradient x color_map { [0 rgb <0,1,0>] [1 rgb 1] } } } }");
	assert_true(m.color.r == 0 && m.color.g == 1);
	m = read_material("#declare P = pigment { color rgb <0,0,1> } #declare T = texture { pigment { P } finish { diffuse 0.25 } }\n"
	                  "sphere { 0, 1 texture { T } }");
	assert_true(m.color.b == 1 && m.kd == 0.25);
	m = read_material("#declare T = texture { pigment { rgb 1 } finish { diffuse 0.25 } } sphere { 0, 1 texture { T pigment { rgb <0,1,0> } } }");
	assert_true(m.color.r == 0 && m.color.g == 1 && m.kd == 0.25);
	m = read_material("sphere { 0, 1 texture { color red 1 green 0.5 alpha 0.9 ambient 0 diffuse 0.1 phong 0.4 phong_size 101 reflection 0.2 "
	                  "refraction 1.0 ior 1.5 } }");
	assert_true(m.color.g == 0.5 && m.transmit == 0.9 && m.kd == 0.1 && m.shine == 101 && m.ks == 0.2 && m.ior == 1.5);
	/* Nothing in a block that is passed over is an error, and #default changes what is not said. */
	m = read_material("#default { finish { diffuse 0.9 } } sphere { 0, 1 texture { pigment { Unknown_Color foo bar rgb Nothing } } }");
	assert_true(m.kd == 0.9 || m.color.r == 0);
}

static void old_syntax(void **state)
{
	(void)state;
	struct scene s = read_with("// background:\nobject { sphere { <0 0 0> 9000  texture { ambient 1 diffuse 0 color red 0.078 green 0.361 blue 0.753 } } }\n"
	                           "object { light_source { <4 3 2> color red 0.5 green 0.25 blue 0.125 } }\n"
	                           "camera { location <2.1 1.3 1.7> direction <-1 -0 -0> right <-0 1 -0> up <-0 -0.5 1> }", NULL);
	assert_true(s.background_given && s.background.g == 0.361 && s.object_count == 0);
	assert_true(s.light_count == 1 && s.lights[0].at.y == 3 && s.lights[0].color.b == 0.125);
	assert_true(s.view.direction.x == -1 && s.view.right.y == 1 && s.view.window_up.y == -0.5 && s.view.window_up.z == 1);
	scene_free(&s);
	s = read_with("background { color red 0.078 green 0.361 blue 0.753 }", NULL);
	assert_true(s.background_given && s.background.b == 0.753);
	scene_free(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(transforms), cmocka_unit_test(cameras), cmocka_unit_test(looks), cmocka_unit_test(old_syntax),
	};
	return cmocka_run_group_tests_name("pov_scenes", tests, NULL, NULL);
}
