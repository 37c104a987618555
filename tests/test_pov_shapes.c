/* Shapes of POV-Ray: meshes against fields, closed forms and the facts of the language; combinations against inside(). */
#include "tests/check.h"

#include "base/rng.h"
#include "io/pov_image.h"
#include "io/pov_place.h"
#include "io/pov_shape.h"
#include "io/pov_solid.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

/* What a test makes lives until its end. */
struct bench {
	struct arena mem;
	struct scene scene;
	struct pov_tally tally;
	struct pov_mesh_options options;
};

static struct bench bench_open(int resolution)
{
	struct bench b = { .options = pov_mesh_defaults() };
	b.options.resolution = resolution;
	return b;
}

static void bench_close(struct bench *b)
{
	scene_free(&b->scene);
	arena_free(&b->mem);
}

static struct pov_solid *seal(struct bench *b, struct pov_solid *s)
{
	struct err e = { 0 };
	if (pov_solid_seal(&b->mem, s, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

static struct pov_solid *new_sphere(struct bench *b, double x, double y, double z, double r)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_SPHERE);
	s->shape.sphere = (struct pov_sphere){ vec(x, y, z), r };
	return seal(b, s);
}

static struct pov_solid *new_box(struct bench *b, struct vec p, struct vec q)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_BOX);
	s->shape.box = (struct pov_box){ { p, q } };
	return seal(b, s);
}

static struct pov_solid *new_cone(struct bench *b, struct vec p, double r, struct vec q, double t)
{
	struct pov_solid *s = pov_solid_new(&b->mem, r == t ? POV_CYLINDER : POV_CONE);
	s->shape.cone = (struct pov_cone){ { p, q }, { r, t } };
	return seal(b, s);
}

static struct pov_solid *new_plane(struct bench *b, double x, double y, double z, double d)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_PLANE);
	s->shape.plane = (struct pov_plane){ vec(x, y, z), d };
	return seal(b, s);
}

/* A combination of up to four parts, NULL-ended. */
static struct pov_solid *combine(struct bench *b, enum pov_kind kind, struct pov_solid *p, struct pov_solid *q, struct pov_solid *r)
{
	struct pov_solid *s = pov_solid_new(&b->mem, kind), *parts[] = { p, q, r }, **end = &s->child;
	for (int i = 0; i < 3 && parts[i]; i++) {
		*end = parts[i];
		end = &parts[i]->next;
	}
	return s;
}

static void mesh(struct bench *b, struct pov_solid *s)
{
	struct err e = { 0 };
	scene_free(&b->scene);
	if (pov_mesh(&b->scene, &s, 1, &b->options, &b->tally, &e) != 0)
		fail_msg("%s", e.text);
}

static const struct vec *triangle(const struct bench *b, size_t i)
{
	assert_int_equal(b->scene.objects[i].kind, OBJECT_POLYGON);
	assert_int_equal(b->scene.objects[i].count, 3);
	return b->scene.points + b->scene.objects[i].first;
}

static double volume(const struct bench *b)
{
	double sum = 0;
	for (size_t i = 0; i < b->scene.object_count; i++) {
		const struct vec *v = triangle(b, i);
		sum += vec_dot(v[0], vec_cross(v[1], v[2])) / 6;
	}
	return sum;
}

static double area(const struct bench *b)
{
	double sum = 0;
	for (size_t i = 0; i < b->scene.object_count; i++) {
		const struct vec *v = triangle(b, i);
		sum += vec_length(vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0]))) / 2;
	}
	return sum;
}

/* An edge from the lower corner to the higher, +1 for each triangle that has it so and -1 for each that has it the other way. */
struct edge {
	double from[3], to[3];
	int sense;
};

static int compare_edges(const void *a, const void *b)
{
	return memcmp(a, b, offsetof(struct edge, sense));
}

/* How many edges are not met by as many triangles one way as the other. */
static size_t open_edges(const struct bench *b)
{
	size_t n = 0, open = 0;
	struct edge *all = calloc(3 * b->scene.object_count + 1, sizeof *all);
	for (size_t i = 0; i < b->scene.object_count; i++)
		for (int k = 0; k < 3; k++, n++) {
			const struct vec *v = triangle(b, i);
			for (int a = 0; a < 3; a++) {
				all[n].from[a] = v[k].a[a] + 0.0;
				all[n].to[a] = v[(k + 1) % 3].a[a] + 0.0;
			}
			all[n].sense = 1;
			if (memcmp(all[n].from, all[n].to, sizeof all[n].from) > 0) {
				struct edge e = all[n];
				memcpy(all[n].from, e.to, sizeof e.to);
				memcpy(all[n].to, e.from, sizeof e.from);
				all[n].sense = -1;
			}
		}
	qsort(all, n, sizeof *all, compare_edges);
	for (size_t i = 0, j; i < n; i = j) {
		int sum = 0;
		for (j = i; j < n && compare_edges(&all[i], &all[j]) == 0; j++)
			sum += all[j].sense;
		open += sum != 0;
	}
	free(all);
	return open;
}

/* How far the corners are from the zero of the shape's field, at most. */
static double worst_corner(const struct bench *b, const struct pov_solid *s)
{
	double worst = 0;
	struct matrix back;
	pov_place_invert(&s->place, &back);
	for (size_t i = 0; i < b->scene.object_count; i++)
		for (int k = 0; k < 3; k++)
			worst = fmax(worst, fabs(pov_shape_of(s)->field(s, matrix_point(triangle(b, i)[k], &back))));
	return worst;
}

static struct box bounds(const struct bench *b)
{
	struct box all = box_empty();
	for (size_t i = 0; i < b->scene.point_count; i++)
		box_extend(&all, b->scene.points[i]);
	return all;
}

/* Whether a point is inside the triangles: the solid angle they fill, in full spheres, is 1 inside and 0 outside (van Oosterom and
 * Strackee 1983). */
static double winding(const struct bench *b, struct vec p)
{
	double sum = 0;
	for (size_t i = 0; i < b->scene.object_count; i++) {
		const struct vec *v = triangle(b, i);
		struct vec x = vec_sub(v[0], p), y = vec_sub(v[1], p), z = vec_sub(v[2], p);
		double a = vec_length(x), c = vec_length(y), d = vec_length(z);
		sum += 2 * atan2(vec_dot(x, vec_cross(y, z)), a * c * d + vec_dot(x, y) * d + vec_dot(y, z) * a + vec_dot(z, x) * c);
	}
	return sum / (4 * pi);
}

/* Whether the point is nearer than 'tolerance' to the surface of any leaf, by its field (slope at most 1). */
static bool near_surface(const struct pov_solid *s, struct vec p, double tolerance)
{
	struct matrix back;
	pov_place_invert(&s->place, &back);
	p = matrix_point(p, &back);
	for (const struct pov_solid *c = s->child; c; c = c->next)
		if (near_surface(c, p, tolerance))
			return true;
	return s->kind < POV_UNION && fabs(pov_shape_of(s)->field(s, p)) <= tolerance;
}

/* Random points about the mesh, those near a surface left out: inside the mesh and inside() must agree. */
static void agree(const struct bench *b, const struct pov_solid *s, double tolerance, uint64_t seed)
{
	struct box all = bounds(b);
	int n = b->scene.object_count > 4000 ? 200 : 600, checked = 0;
	for (int i = 0; i < n; i++) {
		struct vec p;
		for (int a = 0; a < 3; a++)
			p.a[a] = all.lo.a[a] + (all.hi.a[a] - all.lo.a[a]) * (1.2 * rng_uniform(rng_key(seed, 1, (uint64_t)i), (uint64_t)a) - 0.1);
		if (near_surface(s, p, tolerance))
			continue;
		checked++;
		if ((winding(b, p) > 0.5) != pov_solid_inside(s, p))
			fail_msg("seed %d: (%g, %g, %g) is %s the mesh only", (int)seed, p.x, p.y, p.z, winding(b, p) > 0.5 ? "inside" : "outside");
	}
	assert_true(checked > n / 4);
}

static const struct vec square[] = { { { { 0, 0, 0 } } }, { { { 2, 0, 0 } } }, { { { 2, 2, 0 } } }, { { { 0, 2, 0 } } },
	                             { { { 0, 0, 0 } } }, { { { 0.5, 0.5, 0 } } }, { { { 1.5, 0.5, 0 } } }, { { { 1.5, 1.5, 0 } } },
	                             { { { 0.5, 1.5, 0 } } }, { { { 0.5, 0.5, 0 } } } };
static const struct vec spindle[] = { { { { 0, -1, 0 } } }, { { { 2, 0, 0 } } }, { { { 0, 1, 0 } } } };
static const struct vec spool[] = { { { { 1, -1, 0 } } }, { { { 2, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 1, -1, 0 } } } };
static const struct vec post[] = { { { { 1, -1, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 1, 2, 0 } } } };

static struct pov_solid *new_profile(struct bench *b, enum pov_kind kind, struct pov_profile p)
{
	struct pov_solid *s = pov_solid_new(&b->mem, kind);
	s->shape.profile = p;
	return seal(b, s);
}

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

static struct pov_solid *make_torus(struct bench *b)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_TORUS);
	s->shape.torus = (struct pov_torus){ 2, 0.5 };
	return seal(b, s);
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

/* Whether some corner of the mesh is at a point. */
static bool has_corner(const struct bench *b, struct vec p)
{
	for (size_t i = 0; i < b->scene.point_count; i++)
		if (vec_length(vec_sub(b->scene.points[i], p)) < 1e-9)
			return true;
	return false;
}

/* Middles of segments by the formulas of the language. */
static void splines(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 1, 0, 0 } } }, { { { 2, 1, 0 } } }, { { { 1, 2, 0 } } }, { { { 3, 3, 0 } } } };
	static const struct { enum pov_spline kind; double weight[4]; } cases[] = {
		{ POV_LINEAR, { 0, 1, 0, 0 } },
		{ POV_QUADRATIC, { -0.125, 0.75, 0.375, 0 } },
		{ POV_CUBIC, { -0.0625, 0.5625, 0.5625, -0.0625 } },
		{ POV_BEZIER, { 0.125, 0.375, 0.375, 0.125 } },
	};
	for (size_t i = 0; i < 4; i++) {
		struct bench b = bench_open(32);
		struct vec at = vec(0, 0, 0);
		for (int k = 0; k < 4; k++)
			at = vec_add(at, vec_scale(p[k], cases[i].weight[k]));
		mesh(&b, new_profile(&b, POV_LATHE, (struct pov_profile){ cases[i].kind, false, 0, 0, p, 4 }));
		assert_true(has_corner(&b, at));
		/* Controls are not reached. */
		assert_int_equal(has_corner(&b, p[0]), cases[i].kind == POV_LINEAR || cases[i].kind == POV_BEZIER);
		assert_int_equal(has_corner(&b, p[3]), cases[i].kind != POV_CUBIC);
		bench_close(&b);
	}
}

/* The squared radius is Hermite's cubic in the height. */
static void sor_formula(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0.5, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 2, 2, 0 } } }, { { { 1, 4, 0 } } } };
	struct bench b = bench_open(32);
	struct pov_solid *s = new_profile(&b, POV_SOR, (struct pov_profile){ POV_LINEAR, false, 0, 0, p, 4 });
	double slope[2] = { 2 * 1 * (2 - 0.5) / 2, 2 * 2 * (1 - 1) / 3.0 };
	double middle = (1 + 4) / 2.0 + (slope[0] - slope[1]) / 8;
	mesh(&b, s);
	assert_true(has_corner(&b, vec(sqrt(middle), 1.5, 0)));
	assert_int_equal(open_edges(&b), 0);
	struct box all = bounds(&b);
	assert_near(all.lo.y, 1, 0);
	assert_near(all.hi.y, 2, 0);
	s->open = true;
	mesh(&b, s);
	assert_true(open_edges(&b) > 0);
	bench_close(&b);
}

/* Loops of quadratic and cubic prisms close at their second point. */
static void prism_loops(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0, 1, 0 } } }, { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 0, 1, 0 } } },
		                        { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } } };
	for (int cubic = 0; cubic < 2; cubic++) {
		struct bench b = bench_open(32);
		struct pov_profile profile = { cubic ? POV_CUBIC : POV_QUADRATIC, false, 0, 1, p, 6 + (size_t)cubic };
		struct pov_solid *s = new_profile(&b, POV_PRISM, profile);
		mesh(&b, s);
		assert_int_equal(open_edges(&b), 0);
		assert_true(has_corner(&b, vec(0, 0, 0)) && has_corner(&b, vec(1, 1, 1)));
		assert_true(pov_solid_inside(s, vec(0.5, 0.5, 0.5)));
		assert_false(pov_solid_inside(s, vec(0.5, 1.5, 0.5)));
		agree(&b, s, 0.01, 1);
		bench_close(&b);
	}
}

static void sweep_controls(void **state)
{
	(void)state;
	static const struct pov_sphere p[] = { { { { { 0, 0, 0 } } }, 1 }, { { { { 4, 0, 0 } } }, 1 }, { { { { 8, 0, 0 } } }, 1 },
		                               { { { { 12, 0, 0 } } }, 1 } };
	static const struct { enum pov_spline kind; double low, high; } cases[] = { { POV_LINEAR, -1, 13 }, { POV_CUBIC, 3, 9 },
		                                                                    { POV_B_SPLINE, 3, 9 } };
	for (int i = 0; i < 3; i++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = pov_solid_new(&b.mem, POV_SPHERE_SWEEP);
		s->shape.sweep = (struct pov_sphere_sweep){ cases[i].kind, p, 4 };
		mesh(&b, seal(&b, s));
		struct box all = bounds(&b);
		assert_near(all.lo.x, cases[i].low, 1e-9);
		assert_near(all.hi.x, cases[i].high, 1e-9);
		assert_true(pov_solid_inside(s, vec(cases[i].low + 0.01, 0, 0)));
		assert_false(pov_solid_inside(s, vec(cases[i].low - 0.01, 0, 0)));
		agree(&b, s, 0.03, 2);
		bench_close(&b);
	}
}

/* Between spheres of unlike radii is the cone that touches both. */
static void sweep_cone(void **state)
{
	(void)state;
	static const struct pov_sphere p[] = { { { { { 0, 0, 0 } } }, 2 }, { { { { 4, 0, 0 } } }, 1 } };
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_SPHERE_SWEEP);
	s->shape.sweep = (struct pov_sphere_sweep){ POV_LINEAR, p, 2 };
	mesh(&b, seal(&b, s));
	/* Over x = 2 the line that touches both circles: 2 / cos a - 2 tan a with sin a = 1/4. */
	double cosine = sqrt(15) / 4, high = 2 / cosine - 2 * 0.25 / cosine;
	assert_true(pov_solid_inside(s, vec(2, high - 1e-9, 0)));
	assert_false(pov_solid_inside(s, vec(2, high + 1e-9, 0)));
	agree(&b, s, 0.02, 3);
	bench_close(&b);
}

static struct pov_solid *new_hills(struct bench *b, const double *h, int width, int height, double level)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_HEIGHT_FIELD);
	s->shape.height_field = (struct pov_height_field){ h, width, height, false, level };
	return seal(b, s);
}

static double height_at(struct bench *b, struct pov_solid *s, double x, double z)
{
	struct vec at, normal;
	assert_true(pov_solid_trace(&b->mem, s, vec(x, 5, z), vec(0, -2, 0), &at, &normal));
	assert_true(normal.y > 0);
	return at.y;
}

/* Cells are split from (x0, z1) to (x1, z0); no walls and no floor; the solid is all below. */
static void height_field(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	static const double corner[] = { 0, 0, 0, 1 }, ramp[] = { 0, 1, 0, 1 };
	struct pov_solid *s = new_hills(&b, corner, 2, 2, 0);
	mesh(&b, s);
	assert_int_equal(b.scene.object_count, 2);
	assert_near(height_at(&b, s, 0.501, 0.5), 0.001, 1e-9);
	assert_near(height_at(&b, s, 0.75, 0.75), 0.5, 1e-9);
	assert_near(height_at(&b, s, 0.25, 0.25), 0, 1e-9);
	assert_true(pov_solid_inside(s, vec(0.75, 0.4, 0.75)));
	assert_true(pov_solid_inside(s, vec(0.75, -9, 0.75)));
	assert_false(pov_solid_inside(s, vec(0.75, 0.6, 0.75)));
	assert_false(pov_solid_inside(s, vec(1.1, -9, 0.75)));
	mesh(&b, new_hills(&b, ramp, 2, 2, 0.5));
	assert_near(area(&b), sqrt(2) / 2, 1e-9);
	assert_near(bounds(&b).lo.y, 0.5, 0);
	bench_close(&b);
}

static double slope_function(void *context, const double *x)
{
	(void)context;
	return 0.1 * x[0] + 0.5 * x[1];
}

/* Functions count rows from the top, z = 1. */
static void height_function(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	double *h = pov_heights_sample(&b.mem, (struct pov_function){ slope_function, NULL }, 3, 5);
	struct pov_solid *s = new_hills(&b, h, 3, 5, 0);
	assert_near(height_at(&b, s, 0.25, 0.75), 0.1 * 0.25 + 0.5 * 0.25, 1e-9);
	bench_close(&b);
}

/* Images: the bottom row is z = 0, the left column x = 0. */
static void images(void **state)
{
	(void)state;
	static const struct { const char *bytes; size_t n; const char *type; double at[4]; } cases[] = {
		{ "P2 2 2 255\n1 2\n3 4\n", 19, NULL, { 3 / 255.0, 4 / 255.0, 1 / 255.0, 2 / 255.0 } },
		{ "P5 2 2 255\n\x01\x02\x03\x04", 15, NULL, { 3 / 255.0, 4 / 255.0, 1 / 255.0, 2 / 255.0 } },
		{ "P5 2 2 65535\n\x01\x02\x03\x04\x05\x06\x07\x08", 21, NULL, { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "P6 2 2 255\n\x01\x02\x09\x03\x04\x09\x05\x06\x09\x07\x08\x09", 23, NULL,
		  { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x02\0\x18\0\x09\x06\x05\x09\x08\x07\x09\x02\x01\x09\x04\x03", 30, "tga",
		  { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "GIF87a\x02\0\x02\0\x81\0\0\0\0\0\x01\x01\x01\x02\x02\x02\x03\x03\x03,\0\0\0\0\x02\0\x02\0\0\x02\x03\x44\x34\x05\0;", 42, NULL,
		  { 2 / 255.0, 3 / 255.0, 0, 1 / 255.0 } },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct arena mem = { 0 };
		int width, height;
		const char *why;
		double *h = pov_image_heights(&mem, cases[i].bytes, cases[i].n, cases[i].type, &width, &height, &why);
		if (!h)
			fail_msg("image %zu: %s", i, why);
		assert_int_equal(width, 2);
		assert_int_equal(height, 2);
		for (int k = 0; k < 4; k++)
			assert_near(h[k], cases[i].at[k], 1e-12);
		arena_free(&mem);
	}
}

/* Damaged images are refused, whatever they hold. */
static void bad_images(void **state)
{
	(void)state;
	static const char *const marks[] = { "\x89PNG\r\n\x1a\n", "\xff\xd8\xff\xe0", "GIF89a", "BM", "P2 ", "P5 9 9 255 ", "P6 3 3 65535 ", "" };
	for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
		for (uint64_t k = 0; k < 200; k++) {
			unsigned char bytes[200];
			struct arena mem = { 0 };
			int width, height;
			const char *why;
			size_t n = strlen(marks[i]);
			for (size_t j = 0; j < sizeof bytes; j++)
				bytes[j] = (unsigned char)(rng_uniform(rng_key(k, i, j), 0) * (k % 2 ? 256 : 4));
			memcpy(bytes, marks[i], n);
			double *h = pov_image_heights(&mem, bytes, n + k, i % 2 ? "tga" : "pot", &width, &height, &why);
			assert_true(h ? width >= 2 && height >= 2 : why[0] != '\0');
			arena_free(&mem);
		}
}

/* Terms of polynomials: powers of x fall, then those of y, then those of z. */
static void poly_terms(void **state)
{
	(void)state;
	static const char *const names[] = { "xx xy xz x yy yz y zz z ",
		                             "xxx xxy xxz xx xyy xyz xy xzz xz x yyy yyz yy yzz yz y zzz zz z " };
	struct vec p = vec(1.25, -0.75, 0.5);
	for (int order = 2; order <= 3; order++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = pov_solid_new(&b.mem, POV_POLY);
		double c[20], want = 0, term = 1;
		int i = 0;
		for (const char *n = names[order - 2]; *n; n++)
			if (*n == ' ') {
				c[i] = i * i - 3 * i + 1;
				want += c[i++] * term;
				term = 1;
			} else {
				term *= p.a[*n - 'x'];
			}
		c[i] = 7;
		s->shape.poly = (struct pov_poly){ order, c };
		seal(&b, s);
		assert_near(pov_shape_of(s)->field(s, p), want + 7, 1e-12);
		bench_close(&b);
	}
}

static void quadric_terms(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_QUADRIC);
	double x = 1.25, y = -0.75, z = 0.5;
	s->shape.quadric = (struct pov_quadric){ { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 } };
	seal(&b, s);
	assert_near(pov_shape_of(s)->field(s, vec(x, y, z)),
	            x * x + 2 * y * y + 3 * z * z + 4 * x * y + 5 * x * z + 6 * y * z + 7 * x + 8 * y + 9 * z + 10, 1e-12);
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

static void bicubic(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_BICUBIC_PATCH);
	struct vec middle = vec(0, 0, 0);
	static const double weight[4] = { 0.125, 0.375, 0.375, 0.125 };
	for (int i = 0; i < 16; i++) {
		s->shape.bicubic.points[i] = vec(i % 4, i / 4, (i * 7) % 5);
		middle = vec_add(middle, vec_scale(s->shape.bicubic.points[i], weight[i / 4] * weight[i % 4]));
	}
	s->shape.bicubic.u_steps = 3;
	s->shape.bicubic.v_steps = 9;
	mesh(&b, seal(&b, s));
	assert_int_equal(b.scene.object_count, 8 * 16 * 2);
	assert_true(has_corner(&b, middle));
	for (int i = 0; i < 16; i += i == 0 || i == 12 ? 3 : 9)
		assert_true(has_corner(&b, s->shape.bicubic.points[i]));
	bench_close(&b);
}

static struct pov_solid *new_polygon(struct bench *b, const struct vec *points, size_t n)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_POLYGON);
	s->shape.polygon = (struct pov_polygon){ points, n };
	return seal(b, s);
}

/* Loops by even-odd, an open last one closed; stars that cross themselves; bent ones are left out. */
static void polygons(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	mesh(&b, new_polygon(&b, square, 10));
	assert_near(area(&b), 3, 1e-12);
	mesh(&b, new_polygon(&b, square, 9));
	assert_near(area(&b), 3, 1e-12);
	struct vec star[5], bent[4] = { vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0.1), vec(0, 1, 0) };
	for (int i = 0; i < 5; i++)
		star[i] = vec(cos(4 * pi * i / 5), sin(4 * pi * i / 5), 0);
	mesh(&b, new_polygon(&b, star, 5));
	/* The five points of a pentagram without the pentagon in its middle. */
	double inner = cos(2 * pi / 5) / cos(pi / 5), whole = 5 * inner * sin(pi / 5), pentagon = 2.5 * inner * inner * sin(2 * pi / 5);
	assert_near(area(&b), whole - pentagon, 1e-9);
	mesh(&b, new_polygon(&b, bent, 4));
	assert_int_equal(b.tally.skipped, 1);
	assert_string_equal(b.tally.reasons[0].reason, "polygon that is not flat");
	bench_close(&b);
}

static void discs(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_DISC);
	s->shape.disc = (struct pov_disc){ vec(1, 2, 3), vec(0, 5, 0), 2, 1 };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 3 * pi, 2e-2);
	/* As a solid it is the half space behind it. */
	assert_true(pov_solid_inside(s, vec(50, 1.9, 0)));
	assert_false(pov_solid_inside(s, vec(1, 2.1, 3)));
	bench_close(&b);
}

static double sphere_x(void *context, const double *u)
{
	(void)context;
	return cos(u[0]) * cos(u[1]);
}

static double sphere_y(void *context, const double *u)
{
	(void)context;
	return sin(u[0]) * cos(u[1]);
}

static double sphere_z(void *context, const double *u)
{
	(void)context;
	return sin(u[1]);
}

static void parametric(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_PARAMETRIC);
	s->shape.parametric = (struct pov_parametric){ .function = { { sphere_x, NULL }, { sphere_y, NULL }, { sphere_z, NULL } },
		                                       .low = { 0, -pi / 2 }, .high = { 2 * pi, pi / 2 } };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 4 * pi, 1e-2);
	s->shape.parametric.contained = true;
	s->shape.parametric.box = (struct pov_box){ { vec(-2, -2, 0), vec(2, 2, 2) } };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 2 * pi, 1e-2);
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

/* A TrueType font of two glyphs: none, and for 'o' a square ring from 100 to 600 of 1000 with a hole from 200 to 500; advance 800. */
struct font {
	unsigned char bytes[600];
	size_t n;
};

static void put16(struct font *f, int count, const int *values)
{
	for (int i = 0; i < count; i++) {
		f->bytes[f->n++] = (unsigned char)(values[i] >> 8 & 255);
		f->bytes[f->n++] = (unsigned char)(values[i] & 255);
	}
}

static struct font make_font(void)
{
	static const int cmap[] = { 0, 1, 3, 1, 0, 12, 4, 32, 0, 4, 4, 1, 0, 'o', 0xffff, 0, 'o', 0xffff, 1 - 'o', 1, 0, 0 };
	static const int head[] = { 1, 0, 1, 0, 0, 0, 0x5f0f, 0x3cf5, 0, 1000, 0, 0, 0, 0, 0, 0, 0, 0, 100, 0, 600, 500, 0, 8, 2, 0, 0 };
	static const int hhea[] = { 1, 0, 800, 0, 0, 800, 100, 200, 600, 1, 0, 0, 0, 0, 0, 0, 0, 2 };
	static const int hmtx[] = { 800, 0, 800, 100 }, loca[] = { 0, 0, 29 };
	static const int maxp[] = { 1, 0, 2, 8, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0 };
	/* Contours, box, ends, instructions, flags; then the points, each from the last: x, y. */
	static const int glyf[] = { 2, 100, 0, 600, 500, 3, 7, 0, 0x0101, 0x0101, 0x0101, 0x0101, 100, 500, 0, -500, 100, 0, 300, 0,
		                    0, 0, 500, 0, -400, 300, 0, -300, 0 };
	static const struct { const char *tag; const int *data; int words; } tables[] = {
		{ "cmap", cmap, 22 }, { "glyf", glyf, 29 }, { "head", head, 27 }, { "hhea", hhea, 18 },
		{ "hmtx", hmtx, 4 },  { "loca", loca, 3 },  { "maxp", maxp, 16 },
	};
	struct font f = { .n = 0 };
	int offset = 12 + 7 * 16;
	put16(&f, 6, (int[]){ 1, 0, 7, 64, 2, 48 });
	for (int i = 0; i < 7; i++) {
		memcpy(f.bytes + f.n, tables[i].tag, 4);
		f.n += 4;
		put16(&f, 6, (int[]){ 0, 0, 0, offset, 0, 2 * tables[i].words });
		offset += (2 * tables[i].words + 3) / 4 * 4;
	}
	for (int i = 0; i < 7; i++) {
		put16(&f, tables[i].words, tables[i].data);
		f.n = (f.n + 3) / 4 * 4;
	}
	return f;
}

/* Letters stand where their advances put them, the first at the edge of its ink; holes are holes. Without FreeType, or a font, text is
 * skipped and counted. */
static void letters(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct font f = make_font();
	static const uint32_t codes[] = { 'o', 'o' };
	struct pov_solid *s = pov_solid_new(&b.mem, POV_TEXT), *bad = pov_solid_new(&b.mem, POV_TEXT);
	s->shape.text = (struct pov_text){ f.bytes, f.n, codes, 2, 2, vec(0.25, 0, 0) };
	bad->shape.text = (struct pov_text){ f.bytes, 40, codes, 2, 2, vec(0, 0, 0) };
	mesh(&b, seal(&b, bad));
	assert_int_equal(b.tally.skipped, 1);
	bool without = strcmp(b.tally.reasons[0].reason, "text, without FreeType") == 0;
	assert_true(without || strcmp(b.tally.reasons[0].reason, "text whose font cannot be read") == 0);
	mesh(&b, seal(&b, s));
	assert_int_equal(b.tally.skipped, without);
	if (!without) {
		struct box all = bounds(&b);
		assert_near(all.lo.x, 0, 1e-12);
		assert_near(all.hi.x, 0.8 + 0.25 + 0.5, 1e-12);
		assert_near(all.lo.z, 0, 0);
		assert_near(all.hi.z, 2, 0);
		assert_near(volume(&b), 2 * 2 * (0.25 - 0.09), 1e-12);
		assert_int_equal(open_edges(&b), 0);
		assert_true(pov_solid_inside(s, vec(0.05, 0.25, 1)));
		assert_false(pov_solid_inside(s, vec(0.25, 0.25, 1)));
		agree(&b, s, 1e-9, 9);
	}
	bench_close(&b);
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

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closed_surfaces), cmocka_unit_test(faces_outward), cmocka_unit_test(plane_distance),
		cmocka_unit_test(plane_bound), cmocka_unit_test(blob_cylinder), cmocka_unit_test(blob_components),
		cmocka_unit_test(splines), cmocka_unit_test(sor_formula), cmocka_unit_test(prism_loops),
		cmocka_unit_test(sweep_controls), cmocka_unit_test(sweep_cone), cmocka_unit_test(height_field),
		cmocka_unit_test(height_function), cmocka_unit_test(images), cmocka_unit_test(bad_images),
		cmocka_unit_test(poly_terms), cmocka_unit_test(quadric_terms), cmocka_unit_test(reaches),
		cmocka_unit_test(bicubic), cmocka_unit_test(polygons), cmocka_unit_test(discs),
		cmocka_unit_test(parametric), cmocka_unit_test(isosurface_caps), cmocka_unit_test(mesh_solids),
		cmocka_unit_test(exact_cuts), cmocka_unit_test(curved_cuts), cmocka_unit_test(cuts_meet),
		cmocka_unit_test(clips), cmocka_unit_test(random_combinations), cmocka_unit_test(de_morgan),
		cmocka_unit_test(merges), cmocka_unit_test(many_holes), cmocka_unit_test(unknown_shapes),
		cmocka_unit_test(native_spheres), cmocka_unit_test(domes), cmocka_unit_test(planets),
		cmocka_unit_test(budgets), cmocka_unit_test(traces), cmocka_unit_test(extents),
		cmocka_unit_test(quadric_bounds), cmocka_unit_test(letters),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
