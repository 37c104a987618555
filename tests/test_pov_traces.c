/* trace() of blobs and isosurfaces, which rays meet without a mesh: closed forms, what the fields say, and the meshes. */
#include "tests/pov_solids.h"

enum { RAYS = 400 };

static double ball(void *context, const double *p)
{
	(void)context;
	return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static double height(void *context, const double *p)
{
	(void)context;
	return 0.6 * p[0] + 0.8 * p[1];
}

/* Steepest where the sines are: 1 + 0.15 sqrt(49 + 36). */
static double waves(void *context, const double *p)
{
	return ball(context, p) + 0.15 * sin(7 * p[0]) * sin(6 * p[1] + 1);
}

static struct pov_solid *new_isosurface(struct bench *b, double (*value)(void *, const double *), double threshold, double gradient)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_ISOSURFACE);
	s->shape.isosurface = (struct pov_isosurface){ .function = { value, NULL }, .threshold = threshold, .accuracy = 0.001,
		                                       .gradient = gradient, .box = { { vec(-2, -2, -2), vec(2, 2, 2) } } };
	return seal(b, s);
}

static struct pov_solid *new_blob(struct bench *b, double threshold, const struct pov_component *c, size_t count)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_BLOB);
	s->shape.blob = (struct pov_blob){ threshold, c, count };
	return seal(b, s);
}

/* Spheres and cylinders that overlap, are stretched, and take away. */
static struct pov_solid *new_lump(struct bench *b)
{
	struct pov_component *c = NEW(&b->mem, struct pov_component, 4);
	c[0] = (struct pov_component){ { vec(0, 0, 0), vec(0, 0, 0) }, 1.5, 1, matrix_identity() };
	c[1] = (struct pov_component){ { vec(-1, 0, 0), vec(1, 1, 0) }, 0.8, 1.5, matrix_scale(1, 1, 2) };
	c[2] = (struct pov_component){ { vec(0, 0, 0), vec(0, 0, 0) }, 1, -0.7, matrix_translation(0, 0.6, -0.5) };
	c[3] = (struct pov_component){ { vec(1, 1, 1), vec(-1, -1, 1) }, 0.6, 1, matrix_rotation(1, 0.4) };
	return new_blob(b, 0.6, c, 4);
}

static struct vec random_point(uint64_t set, uint64_t i, uint64_t which, double side)
{
	struct vec p;
	for (uint64_t a = 0; a < 3; a++)
		p.a[a] = side * (2 * rng_uniform(rng_key(7 + set, i, which), a) - 1);
	return p;
}

static void assert_point(struct vec got, struct vec want, double tolerance)
{
	assert_near(vec_length(vec_sub(got, want)), 0, tolerance);
}

/* A turned and evenly scaled ball of radius r about the origin, from outside and from within. */
static void assert_ball(struct bench *b, struct pov_solid *s, double r)
{
	struct vec at, normal;
	size_t hits = 0;
	for (uint64_t i = 0; i < RAYS; i++) {
		struct vec from = random_point(0, i, 0, 3), toward = vec_unit(vec_sub(random_point(0, i, 1, 1.5), from));
		double middle = -vec_dot(from, toward), off = r * r - vec_dot(from, from) + middle * middle;
		double half = sqrt(fmax(0, off)), t = middle - half > 0 ? middle - half : middle + half;
		bool hit = off > 0 && t > 0;
		assert_int_equal(pov_solid_trace(&b->mem, s, from, toward, &at, &normal), hit);
		if (!hit)
			continue;
		struct vec want = vec_add(from, vec_scale(toward, t));
		assert_point(at, want, 1e-9);
		assert_point(normal, vec_unit(want), 1e-6);
		hits++;
	}
	assert_true(hits > RAYS / 4 && hits < RAYS);
}

static void balls(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_component c = { { vec(0, 0, 0), vec(0, 0, 0) }, 2, 3, matrix_identity() };
	assert_ball(&b, new_blob(&b, 1, &c, 1), 2 * sqrt(1 - sqrt(1.0 / 3)));
	assert_ball(&b, new_isosurface(&b, ball, 1.25, 1), 1.25);
	bench_close(&b);
}

/* A ray along a cylinder meets its round ends, one across it the side. */
static void cylinders(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_component c = { { vec(0, 0, 0), vec(3, 0, 0) }, 1, 2, matrix_identity() };
	struct pov_solid *s = new_blob(&b, 0.5, &c, 1);
	double r = sqrt(0.5);
	struct vec at, n;
	for (int side = -1; side <= 1; side += 2) {
		assert_true(pov_solid_trace(&b.mem, s, vec(1.3, 4 * side, 0.2), vec(0, -side, 0), &at, &n));
		assert_point(at, vec(1.3, side * sqrt(r * r - 0.04), 0.2), 1e-9);
		assert_true(pov_solid_trace(&b.mem, s, vec(1.5 + 9 * side, 0.3, 0), vec(-side, 0, 0), &at, &n));
		assert_point(at, vec(1.5 + side * (1.5 + sqrt(r * r - 0.09)), 0.3, 0), 1e-9);
	}
	assert_true(pov_solid_trace(&b.mem, s, vec(1.5, 0, 0), vec(1, 0, 0), &at, &n));
	assert_point(at, vec(3 + r, 0, 0), 1e-9);
	assert_point(n, vec(1, 0, 0), 1e-6);
	assert_false(pov_solid_trace(&b.mem, s, vec(-9, 0.8, 0), vec(1, 0, 0), &at, &n));
	bench_close(&b);
}

/* A half space in its container, whose sides are its caps, but where it is open. */
static void containers(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = new_isosurface(&b, height, 0.4, 1);
	struct vec at, n;
	assert_true(pov_solid_trace(&b.mem, s, vec(0.5, 5, 0.3), vec(0, -2, 0), &at, &n));
	assert_point(at, vec(0.5, (0.4 - 0.3) / 0.8, 0.3), 1e-9);
	assert_point(n, vec(0.6, 0.8, 0), 1e-6);
	assert_true(pov_solid_trace(&b.mem, s, vec(0.5, -5, 0.3), vec(0, 1, 0), &at, &n));
	assert_point(at, vec(0.5, -2, 0.3), 1e-9);
	assert_point(n, vec(0, -1, 0), 0);
	s = pov_solid_copy(&b.mem, s);
	s->open = true;
	assert_true(pov_solid_trace(&b.mem, s, vec(0.5, -5, 0.3), vec(0, 1, 0), &at, &n));
	assert_point(at, vec(0.5, (0.4 - 0.3) / 0.8, 0.3), 1e-9);
	s = pov_solid_copy(&b.mem, s);
	s->open = false;
	s->inverse = true;
	assert_true(pov_solid_trace(&b.mem, s, vec(0.5, 5, 0.3), vec(0, -2, 0), &at, &n));
	assert_point(n, vec(-0.6, -0.8, 0), 1e-6);
	s = new_isosurface(&b, ball, 1.25, 1);
	s->shape.isosurface.spherical = true;
	s->shape.isosurface.sphere = (struct pov_sphere){ vec(0, 1, 0), 1 };
	assert_true(pov_solid_trace(&b.mem, s, vec(0.1, -3, 0), vec(0, 1, 0), &at, &n));
	assert_point(at, vec(0.1, 1 - sqrt(0.99), 0), 1e-9);
	assert_true(pov_solid_trace(&b.mem, s, vec(0.1, 3, 0), vec(0, -1, 0), &at, &n));
	assert_point(at, vec(0.1, sqrt(1.25 * 1.25 - 0.01), 0), 1e-9);
	bench_close(&b);
}

/* A hit parts what is inside from what is not, and none does before it: steps along the ray are all on one side. */
static void assert_first(struct bench *b, struct pov_solid *s)
{
	enum { STEPS = 200 };
	size_t hits = 0;
	for (uint64_t i = 0; i < RAYS; i++) {
		struct vec from = random_point(1, i, 0, 3), toward = vec_unit(vec_sub(random_point(1, i, 1, 1), from)), at, n;
		bool hit = pov_solid_trace(&b->mem, s, from, toward, &at, &n), in = pov_solid_inside(s, from);
		double end = hit ? vec_length(vec_sub(at, from)) : 12;
		for (int k = 0; k < STEPS; k++)
			assert_int_equal(pov_solid_inside(s, vec_add(from, vec_scale(toward, end * k / STEPS))), in);
		if (!hit)
			continue;
		hits++;
		assert_int_equal(pov_solid_inside(s, vec_add(at, vec_scale(toward, -1e-7))), in);
		assert_int_equal(pov_solid_inside(s, vec_add(at, vec_scale(toward, 1e-7))), !in);
		assert_int_equal(vec_dot(n, toward) > 0, in);
	}
	assert_true(hits > RAYS / 4 && hits < RAYS);
}

static struct pov_solid *new_cut(struct bench *b, struct pov_solid *s)
{
	struct pov_solid *cut = combine(b, POV_DIFFERENCE, s, new_plane(b, 0.3, 1, 0, -0.4), new_sphere(b, 0.4, 0.7, -0.8, 0.6));
	struct matrix place = { { { 1, 0.2, 0 }, { 0, 1.3, 0 }, { 0, 0, -0.9 }, { 0.1, 0.2, 0 } } };
	pov_solid_move(cut, &place);
	return cut;
}

static struct pov_solid *new_union(struct bench *b)
{
	return combine(b, POV_UNION, new_cut(b, new_lump(b)), new_box(b, vec(-1.5, -1.2, -0.2), vec(-0.4, 0.1, 0.3)), NULL);
}

/* What lies between a box and a union of both kinds, so that a union is turned inside out. */
static struct pov_solid *new_hollow(struct bench *b)
{
	struct pov_solid *both = combine(b, POV_UNION, new_lump(b), new_isosurface(b, waves, 1, 2.4), NULL);
	return combine(b, POV_DIFFERENCE, new_box(b, vec(-1.1, -1.2, -1.3), vec(1.2, 0.7, 1)), both, NULL);
}

static void first_hits(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	assert_first(&b, new_lump(&b));
	assert_first(&b, new_isosurface(&b, waves, 1, 2.4));
	assert_first(&b, new_cut(&b, new_lump(&b)));
	assert_first(&b, new_cut(&b, new_isosurface(&b, waves, 1, 2.4)));
	assert_first(&b, new_hollow(&b));
	bench_close(&b);
}

/* A solid beside a cone far off is meshed: but near outlines, where a mesh may miss, hits agree within a quarter of its cells, which are 0.11
 * wide, for nothing here is bent more than the cells can follow. */
static void assert_meshed(struct bench *b, struct pov_solid *s)
{
	struct pov_solid *twin = combine(b, POV_UNION, pov_solid_copy(&b->mem, s), new_cone(b, vec(90, 0, 0), 1, vec(91, 0, 0), 0.5), NULL);
	size_t compared = 0, apart = 0;
	for (uint64_t i = 0; i < RAYS; i++) {
		struct vec from = vec_scale(vec_unit(random_point(2, i, 0, 1)), 4), toward = vec_unit(vec_sub(random_point(2, i, 1, 0.8), from));
		struct vec at, n, met, m;
		if (!pov_solid_trace(&b->mem, s, from, toward, &at, &n) || vec_dot(n, toward) > -0.5)
			continue;
		compared++;
		apart += !pov_solid_trace(&b->mem, twin, from, toward, &met, &m) || vec_length(vec_sub(at, met)) > 0.03;
	}
	assert_true(compared > RAYS / 4);
	/* Where a ray passes an edge of a cut closely it may meet either side. */
	assert_true(apart * 50 <= compared);
}

static void meshes(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	assert_meshed(&b, new_lump(&b));
	assert_meshed(&b, new_isosurface(&b, waves, 1, 2.4));
	assert_meshed(&b, new_cut(&b, new_lump(&b)));
	assert_meshed(&b, new_union(&b));
	bench_close(&b);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(balls), cmocka_unit_test(cylinders), cmocka_unit_test(containers), cmocka_unit_test(first_hits), cmocka_unit_test(meshes),
	};
	return cmocka_run_group_tests_name("pov_traces", tests, NULL, NULL);
}
