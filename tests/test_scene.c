/* From objects to primitives: polygons of any shape are covered exactly once, what has no surface is left out. */
#include "tests/check.h"

#include "base/rng.h"
#include "scene/triangulate.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

/* Area vectors of a polygon and of its triangles agree, and every triangle is turned like the polygon. */
static void check_cover(const struct vec *p, size_t n, double tolerance)
{
	struct arena scratch = { 0 };
	uint32_t *t = NEW(&scratch, uint32_t, 3 * n);
	struct vec whole = vec(0, 0, 0);
	double parts = 0;
	assert_int_equal(triangulate_polygon(p, n, t, &scratch), 0);
	for (size_t i = 1; i + 1 < n; i++)
		whole = vec_add(whole, vec_cross(vec_sub(p[i], p[0]), vec_sub(p[i + 1], p[0])));
	struct vec up = vec_unit(whole);
	for (size_t i = 0; i + 2 < n; i++, t += 3) {
		double twice = vec_dot(vec_cross(vec_sub(p[t[1]], p[t[0]]), vec_sub(p[t[2]], p[t[0]])), up);
		assert_true(twice >= -tolerance);
		parts += twice;
	}
	assert_near(parts, vec_length(whole), tolerance);
	arena_free(&scratch);
}

static void gear_caps_are_covered(void **state)
{
	(void)state;
	struct scene s = { 0 };
	struct err e = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = 1;
	assert_int_equal(spd_generate(&s, spd_find("gears"), &o, &e), 0);
	int caps = 0;
	for (size_t i = 0; i < s.object_count; i++)
		if (s.objects[i].count == 144) {
			check_cover(&s.points[s.objects[i].first], 144, 1e-12);
			caps++;
		}
	assert_int_equal(caps, 2);
	scene_free(&s);
	struct primitives p = make_spd("gears", 1, false);
	assert_int_equal(p.count, 574);
	primitives_free(&p);
}

/* Stars with random radii, in random planes, both ways round, with repeated and collinear corners. */
static void stars_are_covered(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 500; i++) {
		struct vec p[128];
		uint64_t key = rng_key(1, 1, i);
		size_t n = 0, spokes = 3 + i % 40;
		struct vec u = vec_unit(vec(rng_uniform(key, 0) - 0.5, rng_uniform(key, 1) - 0.5, rng_uniform(key, 2) - 0.4));
		struct vec v = vec_unit(vec_cross(u, vec(0.3, rng_uniform(key, 3), 1)));
		for (size_t k = 0; k < spokes; k++) {
			double angle = (i % 2 ? 2 : -2) * pi * (double)k / (double)spokes, r = 0.1 + rng_uniform(key, 10 + k);
			p[n++] = vec_add(vec_scale(u, r * cos(angle)), vec_scale(v, r * sin(angle)));
			if (k % 5 == 4) { /* the same corner again, and one half-way to the first */
				p[n] = p[n - 1];
				n++;
			}
		}
		check_cover(p, n, 1e-12);
	}
}

static void combs_are_covered(void **state)
{
	(void)state;
	struct vec p[403];
	size_t n = 0;
	for (int i = 0; i <= 200; i++) {
		p[n++] = vec(i, i % 2 ? 0.01 : 5, 2);
	}
	p[n++] = vec(200, -1, 2);
	p[n++] = vec(0, -1, 2);
	check_cover(p, n, 1e-9);
}

static void crossing_polygons_end(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 300; i++) {
		struct arena scratch = { 0 };
		struct vec p[20];
		uint32_t t[54];
		for (uint64_t k = 0; k < 20; k++)
			p[k] = vec(rng_uniform(rng_key(2, 2, i), 2 * k), rng_uniform(rng_key(2, 2, i), 2 * k + 1), 0);
		assert_int_equal(triangulate_polygon(p, 20, t, &scratch), 0);
		for (int k = 0; k < 54; k++)
			assert_true(t[k] < 20);
		arena_free(&scratch);
	}
}

static void what_has_no_surface_is_left_out(void **state)
{
	(void)state;
	struct scene s = { 0 };
	const struct vec flat[3] = { vec(0, 0, 0), vec(1, 1, 1), vec(2, 2, 2) };
	scene_add_polygon(&s, flat, 3);
	scene_add_sphere(&s, vec(0, 0, 0), 0);
	scene_add_cone(&s, vec(1, 1, 1), 2, vec(1, 1, 1), 1);
	scene_add_sphere(&s, vec(0, 0, 0), -2);
	scene_add_cone(&s, vec(0, 0, 0), -1, vec(0, 0, 3), -1);
	struct primitives p = make_primitives(&s);
	assert_int_equal(p.skipped, 3);
	assert_int_equal(p.spheres, 1);
	assert_int_equal(p.triangles, 8 * SPD_RESOLUTION);
	assert_near(p.bounds.hi.z, 3, 1e-12);
	primitives_free(&p);
	struct err e = { 0 };
	struct scene nothing = { 0 };
	assert_int_equal(primitives_make(&p, &nothing, CURVES_KEEP, 3, "nothing.nff", &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	assert_non_null(strstr(e.text, "nothing.nff"));
}

/* A tessellated sphere has 12 R^2 triangles on it, facing outward; its area approaches the sphere's. */
static void tessellation_approaches(void **state)
{
	(void)state;
	double before = 0;
	for (int r = 1; r <= 16; r *= 2) {
		struct scene s = { 0 };
		tessellate_sphere(&s, vec(1, 2, 3), 2, r);
		tessellate_cone(&s, vec(0, 0, 0), 1, vec(1, 2, 3), 0.5, r);
		assert_int_equal(s.object_count, 12 * r * r + 8 * r);
		double area = 0;
		for (int i = 0; i < 12 * r * r; i++) {
			const struct vec *p = &s.points[s.objects[i].first];
			struct vec n = vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0]));
			assert_true(vec_dot(n, vec_sub(p[0], vec(1, 2, 3))) > 0);
			assert_near(vec_length(vec_sub(p[0], vec(1, 2, 3))), 2, 1e-12);
			area += vec_length(n) / 2;
		}
		assert_true(area > before && area < 16 * pi);
		before = area;
		scene_free(&s);
	}
	assert_near(before, 16 * pi, 0.2);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(gear_caps_are_covered),
		cmocka_unit_test(stars_are_covered),
		cmocka_unit_test(combs_are_covered),
		cmocka_unit_test(crossing_polygons_end),
		cmocka_unit_test(what_has_no_surface_is_left_out),
		cmocka_unit_test(tessellation_approaches),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
