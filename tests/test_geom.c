/* Shapes: areas inside boxes add up and agree with closed forms, overlap agrees with clipping, hits are where they should be. */
#include "tests/check.h"

#include "base/rng.h"
#include "geom/hit.h"
#include "geom/sphere.h"
#include "geom/triangle.h"

static const double pi = 3.14159265358979323846;

static double random_in(uint64_t index, uint64_t dimension, double low, double high)
{
	return low + (high - low) * rng_uniform(rng_key(2002, 1, index), dimension);
}

static struct vec random_point(uint64_t index, uint64_t dimension, double reach)
{
	return vec(random_in(index, dimension, -reach, reach), random_in(index, dimension + 1, -reach, reach),
	           random_in(index, dimension + 2, -reach, reach));
}

static struct primitive random_triangle(uint64_t i)
{
	return (struct primitive){ .kind = PRIMITIVE_TRIANGLE,
		                   .triangle = { { random_point(i, 0, 1.5), random_point(i, 3, 1.5), random_point(i, 6, 1.5) } } };
}

static struct primitive random_sphere(uint64_t i)
{
	return (struct primitive){ .kind = PRIMITIVE_SPHERE,
		                   .sphere = { random_point(i, 0, 1), random_in(i, 3, 0.01, 1.5) } };
}

/* Sum over a 3 x 4 x 5 grid of uneven cells that holds everything. */
static double area_over_grid(const struct primitive *p)
{
	static const double x[] = { -4, -0.3, 0.7, 4 }, y[] = { -4, -1, 0, 0.4, 4 }, z[] = { -4, -0.5, 0, 0.1, 1.2, 4 };
	double sum = 0;
	for (int i = 0; i < 60; i++) {
		int a = i % 3, b = i / 3 % 4, c = i / 12;
		struct box box = { vec(x[a], y[b], z[c]), vec(x[a + 1], y[b + 1], z[c + 1]) };
		double area = primitive_area_inside(p, &box);
		if (area > 1e-12 && !primitive_touches(p, &box))
			fail_msg("surface inside a box it does not touch");
		sum += area;
	}
	return sum;
}

static void triangle_areas_add_up(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 2000; i++) {
		struct primitive p = random_triangle(i);
		assert_near(area_over_grid(&p), primitive_area(&p), 1e-12);
	}
}

static void sphere_areas_add_up(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 500; i++) {
		struct primitive p = random_sphere(i);
		assert_near(area_over_grid(&p) / primitive_area(&p), 1, 1e-9);
	}
}

static void sphere_caps_and_octants(void **state)
{
	(void)state;
	struct primitive p = { .kind = PRIMITIVE_SPHERE, .sphere = { vec(0.1, 0.2, 0.3), 2 } };
	for (int axis = 0; axis < 3; axis++)
		for (double height = 0.05; height < 4; height += 0.31) {
			struct box b = { vec(-9, -9, -9), vec(9, 9, 9) };
			b.lo.a[axis] = p.sphere.center.a[axis] + 2 - height;
			assert_near(primitive_area_inside(&p, &b), 2 * pi * 2 * height, 1e-9 * 16 * pi);
		}
	struct box octant = { p.sphere.center, vec(9, 9, 9) };
	assert_near(primitive_area_inside(&p, &octant), 2 * pi, 1e-9 * 16 * pi);
	struct box inner = { vec(-0.5, -0.5, -0.5), vec(0.5, 0.5, 0.5) };
	assert_near(primitive_area_inside(&p, &inner), 0, 0);
	assert_false(primitive_touches(&p, &inner));
}

/* A sphere of radius 1 whose six caps stick out of a cube of half side h: each cap has 2 pi (1 - h). */
static void sphere_in_cube(void **state)
{
	(void)state;
	struct primitive p = { .kind = PRIMITIVE_SPHERE, .sphere = { vec(0, 0, 0), 1 } };
	for (double h = 0.75; h < 1; h += 0.05) {
		struct box b = { vec(-h, -h, -h), vec(h, h, h) };
		assert_near(primitive_area_inside(&p, &b), 4 * pi - 12 * pi * (1 - h), 1e-9 * 4 * pi);
	}
}

/* Where clipping leaves nothing the overlap test may say yes only for touching. */
static void overlap_agrees_with_clipping(void **state)
{
	(void)state;
	int yes = 0, no = 0;
	for (uint64_t i = 0; i < 20000; i++) {
		struct primitive p = random_triangle(i);
		struct vec c = random_point(i, 20, 2), h = vec(random_in(i, 23, 0.01, 0.8), random_in(i, 24, 0.01, 0.8), 0.3);
		struct box b = { vec_sub(c, h), vec_add(c, h) };
		bool inside = triangle_area_inside(&p.triangle, &b) > 0, touches = triangle_touches(&p.triangle, &b);
		assert_int_equal(inside, touches);
		yes += touches;
		no += !touches;
	}
	assert_true(yes > 1000 && no > 1000);
}

static void touching_counts(void **state)
{
	(void)state;
	struct box b = { vec(0, 0, 0), vec(1, 1, 1) };
	struct triangle face = { { vec(0.2, 0.2, 1), vec(0.8, 0.2, 1), vec(0.2, 0.8, 1) } };
	struct triangle corner = { { vec(1, 1, 1), vec(2, 1, 1), vec(1, 2, 3) } };
	struct triangle above = { { vec(0.2, 0.2, 1.001), vec(0.8, 0.2, 1.001), vec(0.2, 0.8, 1.001) } };
	struct triangle past_edge = { { vec(1.6, 0.5, 0.5), vec(0.5, 1.6, 0.5), vec(1.6, 1.6, 0.5) } };
	struct sphere beside = { vec(2, 0.5, 0.5), 1 }, around = { vec(0.5, 0.5, 0.5), 0.9 }, beyond = { vec(0.5, 0.5, 0.5), 0.8 };
	assert_true(triangle_touches(&face, &b));
	assert_true(triangle_touches(&corner, &b));
	assert_false(triangle_touches(&above, &b));
	assert_false(triangle_touches(&past_edge, &b));
	assert_true(sphere_touches(&beside, &b));
	assert_false(sphere_touches(&around, &b));
	assert_true(sphere_touches(&beyond, &b));
}

static struct hit shoot_at(const struct primitive *p, uint32_t id, struct vec o, struct vec d, uint32_t from)
{
	struct ray r = { .o = o, .d = d, .t_max = INFINITY, .slack = 1e-9, .from = from };
	struct hit h = { INFINITY, NO_PRIMITIVE };
	primitive_hit(p, id, &r, &h);
	return h;
}

static void hits_of_a_sphere(void **state)
{
	(void)state;
	struct primitive p = { .kind = PRIMITIVE_SPHERE, .sphere = { vec(0, 0, 0), 1 } };
	assert_near(shoot_at(&p, 5, vec(-3, 0, 0), vec(1, 0, 0), NO_PRIMITIVE).t, 2, 0);
	assert_near(shoot_at(&p, 5, vec(0, 0, 0), vec(1, 0, 0), NO_PRIMITIVE).t, 1, 0);
	assert_near(shoot_at(&p, 5, vec(-1, 0, 0), vec(1, 0, 0), 5).t, 2, 0); /* inward from its own surface: the far side */
	assert_int_equal(shoot_at(&p, 5, vec(1, 0, 0), vec(1, 0, 0), 5).id, NO_PRIMITIVE); /* outward: nothing */
	assert_int_equal(shoot_at(&p, 5, vec(-3, 2, 0), vec(1, 0, 0), NO_PRIMITIVE).id, NO_PRIMITIVE);
	assert_int_equal(shoot_at(&p, 5, vec(3, 0, 0), vec(1, 0, 0), NO_PRIMITIVE).id, NO_PRIMITIVE);
}

static void hits_of_a_triangle(void **state)
{
	(void)state;
	struct primitive p = { .kind = PRIMITIVE_TRIANGLE, .triangle = { { vec(0, 0, 1), vec(1, 0, 1), vec(0, 1, 1) } } };
	assert_near(shoot_at(&p, 5, vec(0.2, 0.2, 0), vec(0, 0, 1), NO_PRIMITIVE).t, 1, 0);
	assert_near(shoot_at(&p, 5, vec(0.2, 0.2, 3), vec(0, 0, -1), NO_PRIMITIVE).t, 2, 0);
	assert_int_equal(shoot_at(&p, 5, vec(0.6, 0.6, 0), vec(0, 0, 1), NO_PRIMITIVE).id, NO_PRIMITIVE);
	assert_int_equal(shoot_at(&p, 5, vec(0.2, 0.2, 0), vec(1, 0, 0), NO_PRIMITIVE).id, NO_PRIMITIVE);
	assert_int_equal(shoot_at(&p, 5, vec(0.2, 0.2, 1), vec(0, 0, 1), 5).id, NO_PRIMITIVE);
}

/* A zero-length ray between coincident surfaces exists from the lower id to the higher one only. */
static void coincident_surfaces_are_ordered(void **state)
{
	(void)state;
	struct primitive p = { .kind = PRIMITIVE_TRIANGLE, .triangle = { { vec(0, 0, 1), vec(1, 0, 1), vec(0, 1, 1) } } };
	assert_int_equal(shoot_at(&p, 5, vec(0.2, 0.2, 1), vec(0, 0, 1), 4).id, 5);
	assert_int_equal(shoot_at(&p, 5, vec(0.2, 0.2, 1), vec(0, 0, 1), 6).id, NO_PRIMITIVE);
	assert_int_equal(shoot_at(&p, 5, vec(0.2, 0.2, 1), vec(0, 0, 1), NO_PRIMITIVE).id, 5);
	struct hit h = { 1, 3 };
	assert_true(hit_better(1, 2, &h));
	assert_false(hit_better(1, 4, &h));
	assert_true(hit_better(0.5, 4, &h));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(triangle_areas_add_up),
		cmocka_unit_test(sphere_areas_add_up),
		cmocka_unit_test(sphere_caps_and_octants),
		cmocka_unit_test(sphere_in_cube),
		cmocka_unit_test(overlap_agrees_with_clipping),
		cmocka_unit_test(touching_counts),
		cmocka_unit_test(hits_of_a_sphere),
		cmocka_unit_test(hits_of_a_triangle),
		cmocka_unit_test(coincident_surfaces_are_ordered),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
