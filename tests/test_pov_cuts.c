/* Combinations of POV-Ray's solids against inside(), and what becomes of all solids of a scene: spheres, domes, planets, budgets. */
#include "tests/pov_solids.h"

/* A cube as a mesh is a solid by its inside_vector. */
static void mesh_solids(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } }, { { { 0, 1, 0 } } }, { { { 1, 1, 0 } } },
		                        { { { 0, 0, 1 } } }, { { { 1, 0, 1 } } }, { { { 0, 1, 1 } } }, { { { 1, 1, 1 } } } };
	static const uint32_t c[] = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_MESH);
	s->shape.mesh = (struct pov_triangles){ p, c, NULL, 8, 12, vec(0.1, 0.2, 0.9) };
	seal(&b, s);
	mesh(&b, s);
	assert_near(volume(&b), 1, 1e-12);
	for (uint64_t i = 0; i < 2000; i++) {
		uint64_t key = rng_key(5, 0, i);
		struct vec q = vec(2 * rng_uniform(key, 0) - 0.5, 2 * rng_uniform(key, 1) - 0.5, 2 * rng_uniform(key, 2) - 0.5);
		bool want = q.x > 0 && q.x < 1 && q.y > 0 && q.y < 1 && q.z > 0 && q.z < 1;
		assert_int_equal(pov_solid_inside(s, q), want);
	}
	mesh(&b, combine(&b, POV_INTERSECTION, new_box(&b, vec(-1, -1, 0.5), vec(2, 2, 2)), s, NULL));
	assert_near(volume(&b), 0.5, 2e-2);
	struct err e = { 0 };
	struct pov_solid *bad = pov_solid_new(&b.mem, POV_MESH);
	bad->shape.mesh = (struct pov_triangles){ p, c, NULL, 7, 12, vec(0, 0, 0) };
	bad->file = "x.pov";
	bad->line = 3;
	assert_int_equal(pov_solid_seal(&b.mem, bad, &e), -1);
	assert_string_equal(e.text, "x.pov:3: mesh: corner 7 of 7 points");
	bench_close(&b);
}

/* Planes and boxes cut exactly: peeled, flush faces once, nothing left over. */
static void exact_cuts(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	mesh(&b, combine(&b, POV_DIFFERENCE, new_box(&b, vec(0, 0, 0), vec(2, 2, 2)), new_box(&b, vec(1, 1, 1), vec(3, 3, 3)), NULL));
	assert_near(volume(&b), 7, 1e-12);
	assert_near(area(&b), 24, 1e-12);
	mesh(&b, combine(&b, POV_DIFFERENCE, new_box(&b, vec(0, 0, 0), vec(2, 2, 2)), new_box(&b, vec(0.5, 0, 0.5), vec(1.5, 2, 1.5)), NULL));
	assert_near(volume(&b), 6, 1e-12);
	assert_near(area(&b), 4 * 4 + 2 * 3 + 4 * 2, 1e-12);
	struct pov_solid *corner = combine(&b, POV_INTERSECTION, new_plane(&b, -1, 0, 0, 0), new_plane(&b, 0, -1, 0, 0), new_plane(&b, 0, 0, -1, 0));
	mesh(&b, combine(&b, POV_INTERSECTION, corner, new_plane(&b, 1, 1, 1, sqrt(3)), NULL));
	assert_near(volume(&b), 27 / 6.0, 1e-9);
	assert_int_equal(b.tally.approximated, 0);
	mesh(&b, combine(&b, POV_DIFFERENCE, new_box(&b, vec(0, 0, 0), vec(2, 2, 2)), new_box(&b, vec(1, 1, 1), vec(3, 3, 3)),
	                 new_box(&b, vec(1, 0.5, 1), vec(3, 1.5, 3))));
	assert_near(volume(&b), 8 - 1.5, 1e-12);
	bench_close(&b);
}

/* Volumes and areas of curved cuts against closed forms; the errors fall with the resolution. */
static void curved_cuts(void **state)
{
	(void)state;
	double error[2][4];
	for (int fine = 0; fine < 2; fine++) {
		struct bench b = bench_open(fine ? 128 : 32);
		double r = 1.2, h = r - 1, caps = 6 * pi * h * h * (3 * r - h) / 3;
		struct pov_solid *s = combine(&b, POV_INTERSECTION, new_sphere(&b, 0, 0, 0, 1), new_box(&b, vec(0, 0, 0), vec(2, 2, 2)), NULL);
		mesh(&b, s);
		error[fine][0] = volume(&b) - pi / 6;
		error[fine][1] = area(&b) - (pi / 2 + 3 * pi / 4);
		if (!fine)
			agree(&b, s, 0.02, 4);
		s = combine(&b, POV_DIFFERENCE, new_box(&b, vec(-1, -1, -1), vec(1, 1, 1)), new_sphere(&b, 0, 0, 0, r), NULL);
		mesh(&b, s);
		error[fine][2] = volume(&b) - (8 - (4 * pi * r * r * r / 3 - caps));
		if (!fine)
			agree(&b, s, 0.02, 5);
		s = combine(&b, POV_DIFFERENCE, new_box(&b, vec(-1, -1, -1), vec(1, 1, 1)), new_cone(&b, vec(0, -1, 0), 0.5, vec(0, 1, 0), 0.5),
		            new_cone(&b, vec(0, 0, -2), 0.5, vec(0, 0, 2), 0.5));
		mesh(&b, s);
		error[fine][3] = volume(&b) - (8 - 2 * (2 * pi * 0.25) + 16 * 0.125 / 3);
		if (!fine)
			agree(&b, s, 0.02, 6);
		assert_true(b.tally.approximated > 0);
		bench_close(&b);
	}
	for (int k = 0; k < 4; k++)
		if (fabs(error[0][k]) > 0.03 || fabs(error[1][k]) > 0.2 * fabs(error[0][k]))
			fail_msg("case %d: off by %g, then %g", k, error[0][k], error[1][k]);
}

/* The part of a sphere inside a solid and the part outside are the whole sphere; where one shape cuts, without an open edge. */
static void cuts_meet(void **state)
{
	double whole = 0;
	(void)state;
	for (int k = 0; k < 4; k++) {
		struct bench b = bench_open(32);
		struct pov_solid *in = new_sphere(&b, 0, 0, 0, 1);
		in->clip = k == 0   ? new_cone(&b, vec(0, -2, 0), 0.5, vec(0, 2, 0), 0.5)
		           : k == 1 ? make_torus(&b)
		           : k == 2 ? combine(&b, POV_INTERSECTION, new_sphere(&b, 1, 0, 0, 1), new_box(&b, vec(-1, -1, -1), vec(1, 1, 0.1)), NULL)
		                    : combine(&b, POV_UNION, new_sphere(&b, 1, 0, 0, 0.5), new_sphere(&b, 0, 1, 0.2, 0.5), NULL);
		struct matrix aside = matrix_translation(1.3, 0, 0);
		if (k == 1)
			pov_solid_move(in->clip, &aside);
		struct pov_solid *out = pov_solid_copy(&b.mem, in);
		out->clip->inverse = true;
		mesh(&b, combine(&b, POV_UNION, in, out, NULL));
		if (k < 2)
			assert_int_equal(open_edges(&b), 0);
		whole = k ? whole : volume(&b);
		assert_near(volume(&b), whole, 1e-12);
		assert_int_equal(b.tally.spheres, 0);
		bench_close(&b);
	}
}

/* A clip takes away without a cap, stays as it is when the solid is turned inside out, and moves with later transforms only. */
static void clips(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct matrix up = matrix_translation(0, 1, 0), down = matrix_translation(0, -1, 0);
	struct pov_solid *s = new_sphere(&b, 0, 0, 0, 1);
	pov_solid_move(s, &up);
	s->clip = new_plane(&b, 0, 1, 0, 1);
	pov_solid_move(s, &down);
	mesh(&b, s);
	assert_near(area(&b), 2 * pi, 3e-2);
	assert_near(bounds(&b).hi.y, 0, 1e-9);
	assert_true(pov_solid_inside(s, vec(0, -0.5, 0)));
	assert_false(pov_solid_inside(s, vec(0, 0.5, 0)));
	struct pov_solid *d = combine(&b, POV_DIFFERENCE, new_box(&b, vec(-3, -3, -3), vec(3, 3, 3)), s, NULL);
	assert_false(pov_solid_inside(d, vec(0, -0.5, 0)));
	assert_false(pov_solid_inside(d, vec(0, 2, 0)));
	assert_true(pov_solid_inside(d, vec(0, -2, 0)));
	mesh(&b, d);
	assert_near(bounds(&b).hi.y, 0, 1e-9);
	assert_near(area(&b), 36 + 4 * 18 + 2 * pi, 5e-2);
	bench_close(&b);
}

/* A random solid: combinations of boxes, spheres and cylinders, some inverse, moved and turned. */
static struct pov_solid *random_solid(struct bench *b, uint64_t key, int depth)
{
	struct pov_solid *s;
	double u[7];
	for (uint64_t i = 0; i < 7; i++)
		u[i] = rng_uniform(key, i);
	struct vec at = vec(2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1);
	if (depth == 0) {
		s = u[3] < 0.4   ? new_box(b, vec_sub(at, vec(0.8, 0.9, 1)), vec_add(at, vec(0.7, 0.8, 0.6)))
		    : u[3] < 0.7 ? new_sphere(b, at.x, at.y, at.z, 0.8 + 0.4 * u[4])
		                 : new_cone(b, at, 0.6, vec_add(at, vec(0.5, 1.5, 0.2)), 0.6);
	} else {
		static const enum pov_kind kinds[] = { POV_MERGE, POV_MERGE, POV_INTERSECTION, POV_DIFFERENCE, POV_DIFFERENCE };
		s = combine(b, kinds[(int)(u[3] * 5)], random_solid(b, rng_mix(key + 1), depth - 1), random_solid(b, rng_mix(key + 2), depth - 1),
		            u[5] < 0.5 ? random_solid(b, rng_mix(key + 3), depth - 1) : NULL);
	}
	struct matrix turn = matrix_axis_rotation(vec_unit(vec(u[4] + 0.1, u[5], u[6])), 3 * u[4]);
	pov_solid_move(s, &turn);
	return s;
}

/* Random combinations, and their complements in a box, against inside(). */
static void random_combinations(void **state)
{
	(void)state;
	int meshed = 0;
	for (uint64_t seed = 0; seed < 40; seed++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = random_solid(&b, rng_key(11, 0, seed), 2);
		b.options.merge_exact = true;
		if (seed % 2) {
			s->inverse = true;
			s = combine(&b, POV_INTERSECTION, new_box(&b, vec(-2.1, -2.2, -2.3), vec(2.4, 2.5, 2.6)), s, NULL);
		}
		mesh(&b, s);
		if (b.scene.object_count > 0) {
			bool spheres = b.tally.spheres > 0;
			if (!spheres)
				agree(&b, s, 0.03, seed);
			meshed += !spheres;
		}
		bench_close(&b);
	}
	assert_true(meshed > 20);
}

/* De Morgan: the complement of an intersection is inside where any complement is. */
static void de_morgan(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *p = new_sphere(&b, 0.3, 0, 0, 1), *q = new_box(&b, vec(0, 0, 0), vec(2, 2, 2));
	struct pov_solid *s = combine(&b, POV_INTERSECTION, pov_solid_copy(&b.mem, p), pov_solid_copy(&b.mem, q), NULL);
	s->inverse = true;
	p->inverse = q->inverse = true;
	struct pov_solid *t = combine(&b, POV_UNION, p, q, NULL);
	for (uint64_t i = 0; i < 1000; i++) {
		uint64_t key = rng_key(3, 0, i);
		struct vec v = vec(4 * rng_uniform(key, 0) - 2, 4 * rng_uniform(key, 1) - 2, 4 * rng_uniform(key, 2) - 2);
		assert_int_equal(pov_solid_inside(s, v), pov_solid_inside(t, v));
	}
	/* Their surfaces are one, facing inward. */
	mesh(&b, s);
	double turned = volume(&b);
	s->inverse = false;
	mesh(&b, s);
	assert_near(turned, -volume(&b), 1e-9);
	bench_close(&b);
}

/* A union keeps all surfaces; an exact merge only the outer ones. */
static void merges(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = combine(&b, POV_MERGE, new_box(&b, vec(0, 0, 0), vec(2, 2, 2)), new_box(&b, vec(1, 0, 1), vec(3, 2, 3)), NULL);
	mesh(&b, s);
	assert_near(volume(&b), 16, 1e-12);
	b.options.merge_exact = true;
	mesh(&b, s);
	assert_near(volume(&b), 14, 1e-12);
	assert_near(area(&b), 2 * 7 + 12 * 2, 1e-12); /* the flush tops overlap, and are there once */
	bench_close(&b);
}

/* Many holes: what a difference takes away is found by a tree. */
static void many_holes(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = combine(&b, POV_DIFFERENCE, new_box(&b, vec(0, 0, 0), vec(10, 1, 10)), NULL, NULL), **end = &s->child->next;
	for (int i = 0; i < 100; i++) {
		double x = i / 10, z = i % 10;
		*end = new_box(&b, vec(x + 0.25, -1, z + 0.25), vec(x + 0.75, 2, z + 0.75));
		end = &(*end)->next;
	}
	mesh(&b, s);
	assert_near(volume(&b), 75, 1e-9);
	assert_near(area(&b), 2 * 75 + 40 + 200, 1e-9);
	bench_close(&b);
}

/* Nothing is inside a shape that has no inside, its complement included, as POV-Ray takes it: of a combination its own surface stays,
 * within the other parts, and theirs go. */
static void no_inside(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { -1, 0, -1 } } }, { { { 1, 0, -1 } } }, { { { 1, 0, 1 } } } };
	static const uint32_t corners[] = { 0, 1, 2 };
	struct bench b = bench_open(64);
	struct pov_solid *sheet = pov_solid_new(&b.mem, POV_MESH), *ball = new_sphere(&b, 0, 0, 0, 0.5), *box = new_box(&b, vec(0, -1, -1), vec(1, 1, 1));
	sheet->shape.mesh = (struct pov_triangles){ p, corners, NULL, 3, 1, vec(0, 0, 0) };
	seal(&b, sheet);
	struct pov_solid *all[] = {
		combine(&b, POV_INTERSECTION, pov_solid_copy(&b.mem, box), pov_solid_copy(&b.mem, sheet), NULL),
		combine(&b, POV_DIFFERENCE, pov_solid_copy(&b.mem, box), pov_solid_copy(&b.mem, sheet), NULL),
		combine(&b, POV_DIFFERENCE, pov_solid_copy(&b.mem, box),
		        combine(&b, POV_UNION, pov_solid_copy(&b.mem, ball), pov_solid_copy(&b.mem, sheet), NULL), NULL),
	};
	/* The triangle's part in the box; the ball takes 3/8 of its disc. */
	const double areas[] = { 1.5, 1.5, 1.5 - 3 * pi / 32 };
	for (int i = 0; i < 3; i++) {
		mesh(&b, all[i]);
		assert_near(area(&b), areas[i], i == 2 ? 1e-3 : 1e-12);
		for (size_t k = 0; k < b.scene.point_count; k++)
			assert_near(b.scene.points[k].y, 0, 1e-12);
		assert_false(pov_solid_inside(all[i], vec(0.9, 0.5, 0.5)));
	}
	/* In a union the other parts stay. */
	struct pov_solid *u = combine(&b, POV_UNION, pov_solid_copy(&b.mem, box), sheet, NULL);
	assert_true(pov_solid_inside(u, vec(0.9, 0.5, 0.5)));
	mesh(&b, combine(&b, POV_INTERSECTION, new_box(&b, vec(-3, -3, -3), vec(3, 3, 3)), u, NULL));
	assert_near(area(&b), 16 + 2, 1e-12);
	b.options.merge_exact = true;
	mesh(&b, combine(&b, POV_MERGE, pov_solid_copy(&b.mem, box), pov_solid_copy(&b.mem, sheet), NULL));
	assert_near(area(&b), 16 + 0.5, 1e-12);
	bench_close(&b);
}

/* What cannot be meshed is dropped: alone from a union and from what is taken away, with all of an intersection. */
static void unknown_shapes(void **state)
{
	(void)state;
	static const struct { enum pov_kind kind; bool first; double volume; } cases[] = {
		{ POV_UNION, false, 1 }, { POV_DIFFERENCE, false, 1 }, { POV_DIFFERENCE, true, 0 }, { POV_INTERSECTION, false, 0 },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct bench b = bench_open(32);
		struct pov_solid *u = pov_solid_new(&b.mem, POV_UNKNOWN), *box = new_box(&b, vec(0, 0, 0), vec(1, 1, 1));
		u->shape.unknown = "julia_fractal";
		mesh(&b, combine(&b, cases[i].kind, cases[i].first ? u : box, cases[i].first ? box : u, NULL));
		assert_near(volume(&b), cases[i].volume, 1e-12);
		assert_int_equal(b.tally.skipped, 1);
		assert_string_equal(b.tally.reasons[0].reason, "julia_fractal");
		assert_int_equal(b.tally.reasons[0].count, 1);
		assert_int_equal(b.tally.objects, 2);
		bench_close(&b);
	}
}

/* Spheres stay spheres where nothing cuts them or scales them unevenly. */
static void native_spheres(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct matrix even = matrix_scale(2, -2, 2), uneven = matrix_scale(1, 2, 1), turn = matrix_rotation(1, 1);
	struct pov_solid *p = new_sphere(&b, 1, 2, 3, 1), *q = new_sphere(&b, 5, 0, 0, 1);
	pov_solid_move(p, &turn);
	pov_solid_move(p, &even);
	pov_solid_move(q, &uneven);
	p->material = 7;
	mesh(&b, combine(&b, POV_UNION, p, q, NULL));
	assert_int_equal(b.tally.spheres, 1);
	assert_int_equal(b.scene.objects[0].kind, OBJECT_SPHERE);
	assert_int_equal(b.scene.objects[0].material, 7);
	assert_near(b.scene.objects[0].radius[0], 2, 1e-12);
	assert_true(b.tally.triangles > 100);
	assert_int_equal(b.tally.triangles + 1, b.scene.object_count);
	bench_close(&b);
}

/* A sphere about the eye, far larger than the rest, is the sky. */
static void domes(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = combine(&b, POV_UNION, new_box(&b, vec(-1, -1, -1), vec(1, 1, 1)), new_sphere(&b, 0, 0, 0, 1000), NULL);
	b.options.eye = vec(0, 0, -5);
	b.options.eye_given = true;
	mesh(&b, s);
	assert_int_equal(b.tally.domes, 1);
	assert_int_equal(b.tally.spheres, 0);
	b.options.keep_domes = true;
	mesh(&b, s);
	assert_int_equal(b.tally.domes, 0);
	assert_int_equal(b.tally.spheres, 1);
	bench_close(&b);
}

/* A planet that is cut: its facets near the eye miss it by less than 0.002 of their distance. */
static void planets(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	double radius = 6000;
	struct pov_solid *s = combine(&b, POV_INTERSECTION, new_sphere(&b, 0, -radius, 0, radius), new_plane(&b, 0, 0, 1, 1e4), NULL);
	b.options.eye = vec(0, 2, 0);
	b.options.eye_given = true;
	mesh(&b, s);
	assert_int_equal(b.tally.domes, 0);
	for (size_t i = 0; i < b.scene.object_count; i++) {
		const struct vec *v = triangle(&b, i);
		struct vec middle = vec_scale(vec_add(v[0], vec_add(v[1], v[2])), 1 / 3.0);
		double off = radius - vec_length(vec_sub(middle, vec(0, -radius, 0))), far = vec_length(vec_sub(middle, b.options.eye));
		assert_true(off <= 0.004 * far + 1);
	}
	assert_true(b.scene.object_count < 20000);
	bench_close(&b);
}

/* The same input gives the same bytes; too many triangles are an error. */
static void budgets(void **state)
{
	(void)state;
	struct bench b = bench_open(32), c = bench_open(32);
	mesh(&b, random_solid(&b, 5, 2));
	mesh(&c, random_solid(&c, 5, 2));
	assert_true(b.scene.point_count > 0);
	assert_int_equal(b.scene.point_count, c.scene.point_count);
	assert_memory_equal(b.scene.points, c.scene.points, b.scene.point_count * sizeof *b.scene.points);
	struct err e = { 0 };
	struct pov_solid *s = make_torus(&b);
	b.options.most_triangles = 100;
	assert_int_equal(pov_mesh(&b.scene, &s, 1, &b.options, &b.tally, &e), -1);
	assert_string_equal(e.text, "more than 100 triangles, the budget");
	bench_close(&b);
	bench_close(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(mesh_solids), cmocka_unit_test(exact_cuts), cmocka_unit_test(curved_cuts),
		cmocka_unit_test(cuts_meet), cmocka_unit_test(clips), cmocka_unit_test(random_combinations),
		cmocka_unit_test(de_morgan), cmocka_unit_test(merges), cmocka_unit_test(many_holes),
		cmocka_unit_test(no_inside), cmocka_unit_test(unknown_shapes), cmocka_unit_test(native_spheres), cmocka_unit_test(domes),
		cmocka_unit_test(planets), cmocka_unit_test(budgets),
	};
	return cmocka_run_group_tests_name("pov_cuts", tests, NULL, NULL);
}
