/* Shapes of POV-Ray: meshes against fields and closed forms; what trace() and extents tell of them. */
#include "tests/pov_solids.h"

static const struct vec spindle[] = { { { { 0, -1, 0 } } }, { { { 2, 0, 0 } } }, { { { 0, 1, 0 } } } };
static const struct vec spool[] = { { { { 1, -1, 0 } } }, { { { 2, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 1, -1, 0 } } } };
static const struct vec post[] = { { { { 1, -1, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 1, 2, 0 } } } };

/* Shapes with a closed surface, their volumes and areas where there is a closed form (else 0), and by how much a facet of a curved one
 * at n segments may lie under it: bend / n^2. */
struct closed {
	const char *name;
	struct pov_solid *(*make)(struct bench *b);
	double volume, area, bend;
};

static struct pov_solid *make_ellipsoid(struct bench *b)
{
	struct matrix m = matrix_scale(1, 2, 1);
	struct pov_solid *s = new_sphere(b, 1, 2, 3, 1);
	pov_solid_move(s, &m);
	return s;
}

static struct pov_solid *make_box(struct bench *b)
{
	return new_box(b, vec(1, 2, 3), vec(-1, 0, 4));
}

static struct pov_solid *make_cylinder(struct bench *b)
{
	return new_cone(b, vec(1, 2, 3), 1, vec(1, 4, 3), 1);
}

static struct pov_solid *make_cone(struct bench *b)
{
	return new_cone(b, vec(1, 2, 3), 1, vec(1, 4, 5), 0);
}

static struct pov_solid *make_superellipsoid(struct bench *b)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_SUPERELLIPSOID);
	s->shape.superellipsoid = (struct pov_superellipsoid){ 1, 1 };
	return seal(b, s);
}

static struct pov_solid *make_sharp_superellipsoid(struct bench *b)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_SUPERELLIPSOID);
	s->shape.superellipsoid = (struct pov_superellipsoid){ 0.01, 0.01 };
	return seal(b, s);
}

static struct pov_solid *make_prism(struct bench *b)
{
	return new_profile(b, POV_PRISM, (struct pov_profile){ POV_LINEAR, false, 0, 1, square, 10 });
}

static struct pov_solid *make_conic(struct bench *b)
{
	return new_profile(b, POV_PRISM, (struct pov_profile){ POV_LINEAR, true, -0.5, 1, square, 10 });
}

static struct pov_solid *make_spindle(struct bench *b)
{
	return new_profile(b, POV_LATHE, (struct pov_profile){ POV_LINEAR, false, 0, 0, spindle, 3 });
}

static struct pov_solid *make_spool(struct bench *b)
{
	return new_profile(b, POV_LATHE, (struct pov_profile){ POV_LINEAR, false, 0, 0, spool, 4 });
}

static struct pov_solid *make_sor(struct bench *b)
{
	return new_profile(b, POV_SOR, (struct pov_profile){ POV_LINEAR, false, 0, 0, post, 4 });
}

static struct pov_solid *make_ball_quadric(struct bench *b)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_QUADRIC);
	s->shape.quadric = (struct pov_quadric){ { 1, 1, 1, 0, 0, 0, 0, 0, 0, -1 } };
	return seal(b, s);
}

/* (x^2 + y^2 + z^2 + 4 - 1/4)^2 = 16 (x^2 + z^2): a torus of radii 2 and 1/2. */
static struct pov_solid *make_torus_quartic(struct bench *b)
{
	double *c = NEW(&b->mem, double, 35), k = 3.75;
	struct pov_solid *s = pov_solid_new(&b->mem, POV_POLY);
	c[0] = c[20] = c[30] = 1;       /* x^4, y^4, z^4 */
	c[4] = c[7] = c[23] = 2;        /* x^2 y^2, x^2 z^2, y^2 z^2 */
	c[9] = c[32] = 2 * k - 16;      /* x^2, z^2 */
	c[25] = 2 * k;                  /* y^2 */
	c[34] = k * k;
	s->shape.poly = (struct pov_poly){ 4, c };
	return seal(b, s);
}

/* A ball of radius 1: strength (1 - d^2)^2 = 1/4 at d^2 = 1/2, scaled by sqrt 2. */
static struct pov_solid *make_blob(struct bench *b)
{
	struct pov_component *c = NEW(&b->mem, struct pov_component, 1);
	struct pov_solid *s = pov_solid_new(&b->mem, POV_BLOB);
	*c = (struct pov_component){ { vec(0, 0, 0), vec(0, 0, 0) }, sqrt(2), 1, matrix_identity() };
	s->shape.blob = (struct pov_blob){ 0.25, c, 1 };
	return seal(b, s);
}

static double ball(void *context, const double *x)
{
	(void)context;
	return x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
}

static struct pov_solid *new_isosurface(struct bench *b, double threshold, double side)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_ISOSURFACE);
	s->shape.isosurface.function = (struct pov_function){ ball, NULL };
	s->shape.isosurface.threshold = threshold;
	s->shape.isosurface.box = (struct pov_box){ { vec(-side, -side, -side), vec(side, side, side) } };
	return seal(b, s);
}

static struct pov_solid *make_isosurface(struct bench *b)
{
	return new_isosurface(b, 1, 1.5);
}

static const struct closed closed_shapes[] = {
	{ "ellipsoid", make_ellipsoid, 8 * 3.141592653589793 / 3, 0, 20 },
	{ "box", make_box, 4, 16, 0 },
	{ "cylinder", make_cylinder, 2 * 3.141592653589793, 6 * 3.141592653589793, 6 },
	{ "cone", make_cone, 3.141592653589793 * 2.8284271247461903 / 3, 4 * 3.141592653589793, 6 },
	{ "torus", make_torus, 3.141592653589793 * 3.141592653589793, 4 * 3.141592653589793 * 3.141592653589793, 16 },
	{ "superellipsoid", make_superellipsoid, 4 * 3.141592653589793 / 3, 4 * 3.141592653589793, 6 },
	{ "sharp superellipsoid", make_sharp_superellipsoid, 0, 0, 6 },
	{ "prism", make_prism, 3, 18, 0 },
	{ "conic prism", make_conic, 1.125, 0, 0 },
	{ "spindle lathe", make_spindle, 8 * 3.141592653589793 / 3, 0, 12 },
	{ "spool lathe", make_spool, 8 * 3.141592653589793 / 3, 0, 12 },
	{ "sor", make_sor, 3.141592653589793, 4 * 3.141592653589793, 6 },
	{ "quadric", make_ball_quadric, 4 * 3.141592653589793 / 3, 4 * 3.141592653589793, 12 },
	{ "quartic", make_torus_quartic, 3.141592653589793 * 3.141592653589793, 4 * 3.141592653589793 * 3.141592653589793, 60 },
	{ "blob", make_blob, 4 * 3.141592653589793 / 3, 4 * 3.141592653589793, 31 },
	{ "isosurface", make_isosurface, 4 * 3.141592653589793 / 3, 4 * 3.141592653589793, 12 },
};

enum { CLOSED = sizeof closed_shapes / sizeof *closed_shapes };

/* Every edge is met once each way, the corners lie on the surface, the inside is where the field is negative, and volume and area go to
 * the closed form, by an order of at least 1.5 (2 but for how a grid happens to lie: 2^-1.5 = 0.35). */
static void closed_surfaces(void **state)
{
	(void)state;
	for (size_t i = 0; i < CLOSED; i++) {
		const struct closed *c = &closed_shapes[i];
		double error[2][2] = { { 0 } };
		for (int fine = 0; fine < 2; fine++) {
			int n = fine ? 64 : 32;
			struct bench b = bench_open(n);
			struct pov_solid *s = c->make(&b);
			mesh(&b, s);
			if (open_edges(&b))
				fail_msg("%s: %zu open edges", c->name, open_edges(&b));
			if (worst_corner(&b, s) > 1e-9)
				fail_msg("%s: a corner at %g", c->name, worst_corner(&b, s));
			error[fine][0] = c->volume ? c->volume - volume(&b) : 0;
			error[fine][1] = c->area ? c->area - area(&b) : 0;
			if (!fine)
				agree(&b, s, c->bend / (n * n) + 1e-9, i);
			bench_close(&b);
		}
		for (int k = 0; k < 2; k++) {
			if (fabs(error[0][k]) > 0.03 * fmax(c->volume, c->area) || fabs(error[1][k]) > 0.35 * fabs(error[0][k]) + 1e-12)
				fail_msg("%s: %s off by %g, then %g", c->name, k ? "area" : "volume", error[0][k], error[1][k]);
		}
	}
}

/* Mirrored shapes still face outward; scaled and turned ones keep their volume. */
static void faces_outward(void **state)
{
	(void)state;
	for (size_t i = 0; i < CLOSED; i++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = closed_shapes[i].make(&b);
		mesh(&b, s);
		double before = volume(&b);
		struct matrix mirror = matrix_scale(1, -1, 1), turn = matrix_axis_rotation(vec_unit(vec(1, 2, 3)), 1), moved = matrix_translation(3, 4, 5);
		pov_solid_move(s, &mirror);
		mesh(&b, s);
		assert_near(volume(&b), before, 1e-2 * before);
		pov_solid_move(s, &turn);
		pov_solid_move(s, &moved);
		mesh(&b, s);
		assert_near(volume(&b), before, 1e-2 * before);
		assert_int_equal(open_edges(&b), 0);
		bench_close(&b);
	}
}

static void plane_distance(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = new_plane(&b, 0, 2, 0, 3);
	mesh(&b, s);
	assert_true(b.scene.object_count >= 2);
	for (size_t i = 0; i < b.scene.point_count; i++)
		assert_near(b.scene.points[i].y, 3, 1e-12);
	const struct vec *v = triangle(&b, 0);
	assert_true(vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0])).y > 0);
	assert_true(pov_solid_inside(s, vec(0, 2.9, 0)));
	assert_false(pov_solid_inside(s, vec(0, 3.1, 0)));
	assert_int_equal(b.tally.planes, 1);
	b.options.planes = false;
	mesh(&b, s);
	assert_int_equal(b.scene.object_count, 0);
	assert_int_equal(b.tally.planes, 1);
	bench_close(&b);
}

/* bounded_by is where an unbounded surface ends. */
static void plane_bound(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = new_plane(&b, 0, 1, 0, 0);
	s->bound = new_box(&b, vec(-1, -1, -1), vec(2, 1, 3));
	mesh(&b, s);
	assert_near(area(&b), 12, 1e-9);
	bench_close(&b);
}

/* The strength of a cylinder is that of the distance to its segment: its ends are round. */
static void blob_cylinder(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct pov_component c = { { vec(0, 0, 0), vec(3, 0, 0) }, 1, 2, matrix_identity() };
	struct pov_solid *s = pov_solid_new(&b.mem, POV_BLOB);
	s->shape.blob = (struct pov_blob){ 0.5, &c, 1 };
	mesh(&b, seal(&b, s));
	double r = sqrt(1 - sqrt(0.25));
	struct box all = bounds(&b);
	assert_near(all.hi.x, 3 + r, 2e-3);
	assert_near(all.lo.x, -r, 2e-3);
	assert_near(all.hi.y, r, 2e-3);
	assert_near(volume(&b), pi * r * r * 3 + 4 * pi * r * r * r / 3, 2e-2);
	bench_close(&b);
}

/* Components have transforms of their own, and negative strength takes away. */
static void blob_components(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_component c[2] = { { { vec(0, 0, 0), vec(0, 0, 0) }, 1, 1, matrix_translation(5, 0, 0) },
		                      { { vec(6, 0, 0), vec(6, 0, 0) }, 1, -1, matrix_identity() } };
	struct pov_solid *s = pov_solid_new(&b.mem, POV_BLOB);
	s->shape.blob = (struct pov_blob){ 0.25, c, 2 };
	seal(&b, s);
	assert_true(pov_solid_inside(s, vec(4.5, 0, 0)));
	assert_false(pov_solid_inside(s, vec(5.5, 0, 0)));
	assert_false(pov_solid_inside(s, vec(0, 0, 0)));
	bench_close(&b);
}

/* The container caps an isosurface, but not an open one. */
static void isosurface_caps(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	double d = 0.5, r2 = 1 - d * d, cap = pi * (2 + d) * (1 - d) * (1 - d) / 3;
	struct pov_solid *s = new_isosurface(&b, 1, d + 0.0);
	s->shape.isosurface.box = (struct pov_box){ { vec(-2, -2, -2), vec(2, 2, d) } };
	seal(&b, s);
	mesh(&b, s);
	assert_near(volume(&b), 4 * pi / 3 - cap, 2e-2);
	assert_near(area(&b), 2 * pi * (1 + d) + pi * r2, 5e-2);
	assert_false(pov_solid_inside(s, vec(0, 0, 0.6)));
	assert_true(pov_solid_inside(s, vec(0, 0, 0.4)));
	s->open = true;
	mesh(&b, s);
	assert_near(area(&b), 2 * pi * (1 + d), 5e-2);
	bench_close(&b);
}

/* The reach of a field bounds its change, on random balls. */
static void reaches(void **state)
{
	(void)state;
	for (size_t i = 0; i < CLOSED; i++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = closed_shapes[i].make(&b);
		for (uint64_t k = 0; k < 300; k++) {
			struct vec p, q;
			uint64_t key = rng_key(1, i, k);
			double r = rng_uniform(key, 9);
			for (int a = 0; a < 3; a++) {
				p.a[a] = 6 * rng_uniform(key, (uint64_t)a) - 3;
				q.a[a] = 2 * rng_uniform(key, 3 + (uint64_t)a) - 1;
			}
			q = vec_add(p, vec_scale(vec_unit(q), r));
			double change = fabs(pov_shape_of(s)->field(s, q) - pov_shape_of(s)->field(s, p));
			if (!(change <= pov_shape_reach(s, p, r) * (1 + 1e-9)))
				fail_msg("%s: a change of %g within %g, more than %g", closed_shapes[i].name, change, r, pov_shape_reach(s, p, r));
		}
		bench_close(&b);
	}
}

/* The inside of a capped quadric cylinder is found from its planes. */
static void quadric_bounds(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_QUADRIC);
	s->shape.quadric = (struct pov_quadric){ { 1, -1, 1, 0, 0, 0, 0, 0, 0, 0 } };
	seal(&b, s);
	mesh(&b, combine(&b, POV_INTERSECTION, s, new_plane(&b, 0, 1, 0, 2), new_plane(&b, 0, -1, 0, 0)));
	assert_near(volume(&b), pi * 8 / 3, 5e-2);
	struct box all = bounds(&b);
	assert_near(all.hi.x, 2, 1e-2);
	bench_close(&b);
}

static struct pov_solid *new_quadric(struct bench *b, struct pov_quadric q)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_QUADRIC);
	s->shape.quadric = q;
	return seal(b, s);
}

/* An endless cone within an endless cylinder and two planes, however they lie: between them is little, and that is looked at closely. */
static void turned_bounds(void **state)
{
	(void)state;
	struct matrix turns[] = { matrix_identity(), matrix_rotation(0, pi / 2), matrix_axis_rotation(vec_unit(vec(1, 2, 3)), 1) };
	for (int clipped = 0; clipped < 2; clipped++)
		for (int i = 0; i < 3; i++) {
			struct bench b = bench_open(32);
			struct pov_solid *cone = new_quadric(&b, (struct pov_quadric){ { 1, -1, 1, 0, 0, 0, 0, 0, 0, 0 } });
			struct pov_solid *tube = new_quadric(&b, (struct pov_quadric){ { 1, 0, 1, 0, 0, 0, 0, 0, 0, -1 } }), *s = cone;
			tube->next = combine(&b, POV_INTERSECTION, new_plane(&b, 0, 1, 0, 2), new_plane(&b, 0, -1, 0, 0), NULL);
			if (clipped) {
				cone->clip = tube;
			} else {
				cone->next = tube;
				s = pov_solid_new(&b.mem, POV_INTERSECTION);
				s->child = cone;
			}
			pov_solid_move(s, &turns[i]);
			mesh(&b, s);
			/* The cone up to y = 1; without a clip the cylinder from there to 2, and a lid. */
			double want = pi * sqrt(2) + (clipped ? 0 : 2 * pi + pi);
			assert_near(area(&b), want, 5e-3 * want);
			bench_close(&b);
		}
}

/* bounded_by tells where a surface without end is to be looked for. */
static void bounded_surfaces(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = new_quadric(&b, (struct pov_quadric){ { 1, 0, 1, 0, 0, 0, 0, 0, 0, -900 } });
	s->bound = new_box(&b, vec(-40, -40, -40), vec(40, 40, 40));
	mesh(&b, s);
	assert_near(area(&b), 2 * pi * 30 * 80, 1e-2 * 2 * pi * 30 * 80);
	bench_close(&b);
}

static void assert_traced(struct bench *b, struct pov_solid *s, struct vec from, struct vec toward, struct vec want, struct vec normal)
{
	struct vec at, n;
	assert_true(pov_solid_trace(&b->mem, s, from, toward, &at, &n));
	assert_near(vec_length(vec_sub(at, want)), 0, 1e-6);
	assert_near(vec_length(vec_sub(n, normal)), 0, 1e-3);
}

/* Hits are exact though the surface is meshed; normals face outward, inward of what is inverse. */
static void traces(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct vec at, n;
	struct pov_solid *s = new_sphere(&b, 0, 0, 0, 1);
	assert_traced(&b, s, vec(0, 0, -5), vec(0, 0, 3), vec(0, 0, -1), vec(0, 0, -1));
	assert_traced(&b, s, vec(0, 0, 0), vec(0, 0, 1), vec(0, 0, 1), vec(0, 0, 1));
	assert_traced(&b, s, vec(0.3, 0.4, -5), vec(0, 0, 1), vec(0.3, 0.4, -sqrt(0.75)), vec(0.3, 0.4, -sqrt(0.75)));
	assert_false(pov_solid_trace(&b.mem, s, vec(0, 2, -5), vec(0, 0, 1), &at, &n));
	assert_near(vec_length(n), 0, 0);
	s = pov_solid_copy(&b.mem, s);
	s->inverse = true;
	assert_traced(&b, s, vec(0, 0, -5), vec(0, 0, 1), vec(0, 0, -1), vec(0, 0, 1));
	struct matrix up = matrix_translation(0, 3, 0);
	pov_solid_move(s, &up);
	assert_false(pov_solid_trace(&b.mem, s, vec(0, 0, -5), vec(0, 0, 1), &at, &n));
	assert_traced(&b, new_plane(&b, 0, 1, 0, 1), vec(500, 20, 0), vec(1, -1, 0), vec(519, 1, 0), vec(0, 1, 0));
	s = combine(&b, POV_DIFFERENCE, new_box(&b, vec(-2, -2, -2), vec(2, 2, 2)), new_sphere(&b, 0, 0, 0, 1), NULL);
	assert_traced(&b, s, vec(0, 0, 0), vec(0, 0, 1), vec(0, 0, 1), vec(0, 0, -1));
	assert_traced(&b, s, vec(0.5, 0.5, -9), vec(0, 0, 1), vec(0.5, 0.5, -2), vec(0, 0, -1));
	bench_close(&b);
}

static void assert_extent(const struct pov_solid *s, struct vec lo, struct vec hi)
{
	struct box b = pov_solid_extent(s);
	for (int a = 0; a < 3; a++) {
		assert_near(b.lo.a[a], lo.a[a], 1e-9);
		assert_near(b.hi.a[a], hi.a[a], 1e-9);
	}
}

/* As POV-Ray answers min_extent and max_extent. */
static void extents(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct matrix turn = matrix_axis_rotation(vec_unit(vec(1, 2, 3)), 1);
	struct pov_solid *s = new_sphere(&b, 0, 0, 0, 1);
	struct vec low = vec(-1, -1, -1), high = vec(1, 1, 1);
	pov_solid_move(s, &turn);
	assert_extent(s, low, high);
	s->clip = new_plane(&b, 0, 1, 0, 0);
	s->inverse = true;
	assert_extent(s, low, high);
	assert_extent(combine(&b, POV_DIFFERENCE, new_sphere(&b, 0, 0, 0, 1), new_box(&b, vec(-2, -2, -2), vec(2, 0, 2)), NULL), low, high);
	s = combine(&b, POV_INTERSECTION, new_box(&b, vec(-1, -1, -1), vec(5, 5, 1)), new_plane(&b, 1, 0, 0, 1), new_plane(&b, 0, 1, 0, 1));
	assert_extent(s, low, high);
	assert_extent(make_ball_quadric(&b), low, high);
	assert_extent(new_plane(&b, 0, 1, 0, 1), vec(-1e10, -1e10, -1e10), vec(1e10, 1, 1e10));
	bench_close(&b);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closed_surfaces), cmocka_unit_test(faces_outward), cmocka_unit_test(plane_distance),
		cmocka_unit_test(plane_bound), cmocka_unit_test(blob_cylinder), cmocka_unit_test(blob_components),
		cmocka_unit_test(isosurface_caps), cmocka_unit_test(reaches), cmocka_unit_test(quadric_bounds), cmocka_unit_test(turned_bounds), cmocka_unit_test(bounded_surfaces),
		cmocka_unit_test(traces), cmocka_unit_test(extents),
	};
	return cmocka_run_group_tests_name("pov_shapes", tests, NULL, NULL);
}
