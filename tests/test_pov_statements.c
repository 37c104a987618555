/* POV-Ray's statements of shapes, told by the rays that trace() shoots at them: the numbers are those of POV-Ray 3.7. */
#include "tests/pov_text.h"

/* The first hit on an object of the ray "from, direction". */
static void assert_hit(const char *object, const char *ray, double x, double y, double z)
{
	char before[2048];
	snprintf(before, sizeof before, "#declare O_ = %s; #declare N_ = <0,0,0>; #declare P_ = trace(O_, %s, N_);", object, ray);
	assert_number(before, "vlength(N_)", 1);
	assert_vector(before, "P_", x, y, z);
}

/* The place and the normal of no hit are zero. */
static void assert_missed(const char *object, const char *ray)
{
	char before[2048];
	snprintf(before, sizeof before, "#declare O_ = %s; #declare N_ = <1,1,1>; #declare P_ = trace(O_, %s, N_);", object, ray);
	assert_vector(before, "P_", 0, 0, 0);
	assert_vector(before, "N_", 0, 0, 0);
}

static void no_hit(void **state)
{
	(void)state;
	assert_missed("sphere { 0, 1 }", "<5,5,5>, x");
	assert_hit("sphere { 0, 1 }", "<5,0,0>, -3*x", 1, 0, 0);
}

/* Commas in meshes are a matter of taste. */
static void separators(void **state)
{
	(void)state;
	static const char *const meshes[] = {
		"mesh2 { vertex_vectors { 4, <0,0,0>, <1,0,0>, <0,1,0>, <1,1,0> } face_indices { 2, <0,1,2>, <1,3,2> } }",
		"mesh2 { vertex_vectors { 4 <0,0,0> <1,0,0> <0,1,0> <1,1,0> } face_indices { 2 <0,1,2> <1,3,2> } }",
		"mesh2 { vertex_vectors { 4 0 x y x+y } face_indices { 2, <0,1,2> <1 3 2>, } }",
		"mesh2 { vertex_vectors { 4 0 x y x+y } texture_list { 2 texture { pigment { rgb 1 } } texture { pigment { rgb 0 } } }\n"
		"face_indices { 2 <0,1,2> 1 <1,3,2> 0 1 1 } }",
		"mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0> } triangle { x x+y y } }",
	};
	for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
		assert_hit(meshes[i], "<0.25,0.25,-5>, z", 0.25, 0.25, 0);
		assert_hit(meshes[i], "<0.75,0.75,-5>, z", 0.75, 0.75, 0);
		assert_missed(meshes[i], "<1.25,0.75,-5>, z");
	}
	struct scene s = read_with("mesh2 { vertex_vectors { 3 0 x y } face_indices { 2 <0,1,2> <1,1,2> } }", NULL);
	assert_int_equal(s.object_count, 1); /* a face that is an edge is left out */
	scene_free(&s);
}

/* Flatness and type say how POV-Ray computes a patch, not what it is. */
static void patch_types(void **state)
{
	(void)state;
	struct scene s[2];
	for (int type = 0; type < 2; type++) {
		char text[1024];
		snprintf(text, sizeof text, "bicubic_patch { type %d flatness %g u_steps 2 v_steps 3 <0,0,0> <1,0,2> <2,0,0> <3,0,1> <0,1,0> <1,1,1> "
		         "<2,1,3> <3,1,0> <0,2,1> <1,2,0> <2,2,0> <3,2,2> <0,3,0> <1,3,0> <2,3,1> <3,3,0> }", type, type / 100.0);
		s[type] = read_with(text, NULL);
	}
	assert_true(s[0].object_count > 0);
	assert_int_equal(s[0].point_count, s[1].point_count);
	assert_memory_equal(s[0].points, s[1].points, s[0].point_count * sizeof *s[0].points);
	scene_free(&s[0]);
	scene_free(&s[1]);
}

/* From corner to corner of the unit square, no walls, no floor, and all below is inside. */
static void height_fields(void **state)
{
	(void)state;
	const char *ramp = "height_field { function 3, 3 { x } }", *steps = "height_field { function 2, 5 { y } }";
	assert_hit(ramp, "<0.5,-5,0.5>, y", 0.5, 0.5, 0.5);
	assert_hit(ramp, "<2,0.25,0.5>, -x", 0.25, 0.25, 0.5);
	assert_hit(ramp, "<1e-6,5,1e-6>, -y", 1e-6, 1e-6, 1e-6);
	assert_hit(ramp, "<0.999999,5,0.999999>, -y", 0.999999, 0.999999, 0.999999);
	assert_missed(ramp, "<1.000001,5,0.5>, -y");
	assert_missed(ramp, "<0.5,5,-0.000001>, -y");
	assert_hit(steps, "<0.5,5,0.25>, -y", 0.5, 0.75, 0.25);
	const char *before = "#declare O_ = height_field { function 3, 3 { x } };";
	assert_number(before, "inside(O_, <0.5,-3,0.5>)", 1);
	assert_number(before, "inside(O_, <0.5,0.6,0.5>)", 0);
	assert_vector(before, "min_extent(O_)*<1,0,1>", 0, 0, 0);
	assert_vector(before, "max_extent(O_)*<1,0,1>", 1, 0, 1);
}

/* A clip moves with the transforms behind it, not with those before. */
static void clips_move(void **state)
{
	(void)state;
	assert_hit("sphere { 0, 1 clipped_by { plane { y, 0 } } translate 5*y }", "<0,20,0>, -y", 0, 4, 0);
	assert_missed("sphere { 0, 1 translate 5*y clipped_by { plane { y, 0 } } }", "<0,20,0>, -y");
	assert_hit("sphere { 0, 1 translate 5*y clipped_by { plane { y, 5 } } }", "<0,20,0>, -y", 0, 4, 0);
}

/* What a light looks like stands where the light is. */
static void lamps(void **state)
{
	(void)state;
	const char *lamp = "union { sphere { 0, 1 } light_source { <3,0,0> rgb 1 looks_like { sphere { <0,1,0>, 0.5 } } translate y } }";
	assert_hit(lamp, "<3,9,0>, -y", 3, 2.5, 0);
	struct scene s = read_with("light_source { <3,0,0> rgb 1 looks_like { sphere { <0,1,0>, 0.5 } } translate y }", NULL);
	assert_int_equal(s.object_count, 1);
	assert_near(s.points[s.objects[0].first].x, 3, 0);
	assert_near(s.points[s.objects[0].first].y, 2, 0);
	scene_free(&s);
}

static void bent_polygons(void **state)
{
	(void)state;
	assert_missed("polygon { 5, <0,0,0>, <1,0,0>, <1,1,0.3>, <0,1,0>, <0,0,0> }", "<0.3,0.3,-5>, z");
	assert_hit("polygon { 5, <0,0,0>, <1,0,0>, <1,1,0>, <0,1,0>, <0,0,0> }", "<0.3,0.3,-5>, z", 0.3, 0.3, 0);
}

/* Shapes without an inside leave of a combination their own surface only. */
static void patches_in_combinations(void **state)
{
	(void)state;
	static const char *const combinations[] = { "intersection { triangle { <-5,0.1,0>, <5,0.1,0>, <0,0.1,5> } sphere { 0, 1 } }",
		                                    "intersection { sphere { 0, 1 } mesh { triangle { <-5,0.1,0>, <5,0.1,0>, <0,0.1,5> } } }",
		                                    "difference { sphere { 0, 1 } mesh { triangle { <-5,0.1,0>, <5,0.1,0>, <0,0.1,5> } } }" };
	for (int i = 0; i < 3; i++) {
		assert_hit(combinations[i], "<0,5,0.5>, -y", 0, 0.1, 0.5);
		assert_hit(combinations[i], "<0,-5,0.5>, y", 0, 0.1, 0.5);
		assert_missed(combinations[i], "<0,5,3>, -y");
	}
	/* A disc has one: all that is behind its plane. */
	assert_hit("intersection { sphere { 0, 1 } disc { 0.1*y, y, 3 } }", "<0,5,0.5>, -y", 0, 0.1, 0.5);
	assert_hit("intersection { sphere { 0, 1 } disc { 0.1*y, y, 3 } }", "<0,-5,0.6>, y", 0, -0.8, 0.6);
	assert_hit("difference { triangle { <-5,0.1,0>, <5,0.1,0>, <0,0.1,5> } sphere { 0, 1 } }", "<0,5,3>, -y", 0, 0.1, 3);
	assert_missed("difference { triangle { <-5,0.1,0>, <5,0.1,0>, <0,0.1,5> } sphere { 0, 1 } }", "<0,5,0.5>, -y");
}

/* Two reads of a scene give the same bytes, whatever memory holds before. */
static void same_triangles(void **state)
{
	(void)state;
	const char *text = "#declare R = seed(7); #for (I, 1, 6) sphere { <rand(R), rand(R), rand(R)>*5, 0.4 scale <1, 1.5, 1> pigment { rgb rand(R) } } #end\n"
	                   "difference { box { -1, 1 } cylinder { -2*y, 2*y, 0.5 } torus { 1, 0.3 rotate 30*x } }\n"
	                   "blob { threshold 0.4 sphere { 0, 1, 1 } cylinder { x, 2*x, 0.5, 1 } translate 3*y }\n"
	                   "isosurface { function { x*x + y*y*y - z } contained_by { box { -1, 1 } } translate 6*x }\n"
	                   "quadric { <1, 0, 1>, 0, 0, -1 } plane { y, -2 } superellipsoid { <0.3, 2> translate -5*x }\n"
	                   "sor { 5, <0.2, -1>, <1, 0>, <0.5, 1>, <1, 2>, <1, 3> translate 7*z } camera { location -9*z look_at 0 }";
	struct scene s[2];
	for (int i = 0; i < 2; i++) {
		s[i] = read_with(text, NULL);
		void *dirty = malloc(1 << 20);
		memset(dirty, 0x5a, 1 << 20);
		free(dirty);
	}
	assert_true(s[0].object_count > 10000);
	assert_int_equal(s[0].object_count, s[1].object_count);
	assert_int_equal(s[0].point_count, s[1].point_count);
	assert_memory_equal(s[0].points, s[1].points, s[0].point_count * sizeof *s[0].points);
	for (size_t i = 0; i < s[0].object_count; i++)
		assert_true(s[0].objects[i].kind == s[1].objects[i].kind && s[0].objects[i].first == s[1].objects[i].first &&
		            s[0].objects[i].count == s[1].objects[i].count && s[0].objects[i].material == s[1].objects[i].material);
	scene_free(&s[0]);
	scene_free(&s[1]);
}

/* Blobs and isosurfaces, and what is cut of them, where POV-Ray meets them when told to look closely. */
static void fields(void **state)
{
	(void)state;
	const char *blob = "blob { threshold 0.6 sphere { 0, 1, 1 } cylinder { -x, y, 0.5, 1.5 scale <1, 1, 2> } "
	                   "sphere { 0, 1, -0.7 scale <0.3, 0.45, 0.8> translate 0.3*y } rotate 30*z }";
	const char *ridges = "isosurface { function { sqrt(x*x + pow(y/1.5, 2) + z*z) - 1 - sin(atan2(x, z)*8)*0.1 } max_gradient 3 "
	                     "accuracy 1e-9 contained_by { sphere { 0, 1.2 } } rotate 20*x }";
	char cut[512];
	snprintf(cut, sizeof cut, "difference { %s plane { y, 0 } plane { x, 0.1 inverse } }", blob);
	assert_hit(blob, "<0.1, 0.2, -4>, z", 0.1, 0.2, -0.392782662);
	assert_hit(cut, "<-0.1, -4, 0.1>, y", -0.1, 0, 0.1);
	assert_hit(ridges, "<0.3, 0.2, -4>, z", 0.3, 0.2, -0.880034364);
	assert_hit(ridges, "<0.3, 4, 0.2>, -y", 0.3, 1.144552314, 0.2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(no_hit), cmocka_unit_test(separators), cmocka_unit_test(patch_types), cmocka_unit_test(height_fields),
		cmocka_unit_test(clips_move), cmocka_unit_test(lamps), cmocka_unit_test(bent_polygons), cmocka_unit_test(patches_in_combinations),
		cmocka_unit_test(same_triangles), cmocka_unit_test(fields),
	};
	return cmocka_run_group_tests_name("pov_statements", tests, NULL, NULL);
}
