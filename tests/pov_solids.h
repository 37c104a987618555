/* What tests of POV-Ray's shapes share: solids made by hand, their meshes, and what can be said of a mesh: volume, area, open edges, which
 * points are inside. */
#ifndef TESTS_POV_SOLIDS_H
#define TESTS_POV_SOLIDS_H

#include "tests/check.h"

#include "base/rng.h"
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

static inline struct bench bench_open(int resolution)
{
	struct bench b = { .options = pov_mesh_defaults() };
	b.options.resolution = resolution;
	return b;
}

static inline void bench_close(struct bench *b)
{
	scene_free(&b->scene);
	arena_free(&b->mem);
}

static inline struct pov_solid *seal(struct bench *b, struct pov_solid *s)
{
	struct err e = { 0 };
	if (pov_solid_seal(&b->mem, s, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

static inline struct pov_solid *new_sphere(struct bench *b, double x, double y, double z, double r)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_SPHERE);
	s->shape.sphere = (struct pov_sphere){ vec(x, y, z), r };
	return seal(b, s);
}

static inline struct pov_solid *new_box(struct bench *b, struct vec p, struct vec q)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_BOX);
	s->shape.box = (struct pov_box){ { p, q } };
	return seal(b, s);
}

static inline struct pov_solid *new_cone(struct bench *b, struct vec p, double r, struct vec q, double t)
{
	struct pov_solid *s = pov_solid_new(&b->mem, r == t ? POV_CYLINDER : POV_CONE);
	s->shape.cone = (struct pov_cone){ { p, q }, { r, t } };
	return seal(b, s);
}

static inline struct pov_solid *new_plane(struct bench *b, double x, double y, double z, double d)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_PLANE);
	s->shape.plane = (struct pov_plane){ vec(x, y, z), d };
	return seal(b, s);
}

/* A combination of up to four parts, NULL-ended. */
static inline struct pov_solid *combine(struct bench *b, enum pov_kind kind, struct pov_solid *p, struct pov_solid *q, struct pov_solid *r)
{
	struct pov_solid *s = pov_solid_new(&b->mem, kind), *parts[] = { p, q, r }, **end = &s->child;
	for (int i = 0; i < 3 && parts[i]; i++) {
		*end = parts[i];
		end = &parts[i]->next;
	}
	return s;
}

static inline void mesh(struct bench *b, struct pov_solid *s)
{
	struct err e = { 0 };
	scene_free(&b->scene);
	if (pov_mesh(&b->scene, &s, 1, &b->options, &b->tally, &e) != 0)
		fail_msg("%s", e.text);
}

static inline const struct vec *triangle(const struct bench *b, size_t i)
{
	assert_int_equal(b->scene.objects[i].kind, OBJECT_POLYGON);
	assert_int_equal(b->scene.objects[i].count, 3);
	return b->scene.points + b->scene.objects[i].first;
}

static inline double volume(const struct bench *b)
{
	double sum = 0;
	for (size_t i = 0; i < b->scene.object_count; i++) {
		const struct vec *v = triangle(b, i);
		sum += vec_dot(v[0], vec_cross(v[1], v[2])) / 6;
	}
	return sum;
}

static inline double area(const struct bench *b)
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

static inline int compare_edges(const void *a, const void *b)
{
	return memcmp(a, b, offsetof(struct edge, sense));
}

/* How many edges are not met by as many triangles one way as the other. */
static inline size_t open_edges(const struct bench *b)
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
static inline double worst_corner(const struct bench *b, const struct pov_solid *s)
{
	double worst = 0;
	struct matrix back;
	pov_place_invert(&s->place, &back);
	for (size_t i = 0; i < b->scene.object_count; i++)
		for (int k = 0; k < 3; k++)
			worst = fmax(worst, fabs(pov_shape_of(s)->field(s, matrix_point(triangle(b, i)[k], &back))));
	return worst;
}

static inline struct box bounds(const struct bench *b)
{
	struct box all = box_empty();
	for (size_t i = 0; i < b->scene.point_count; i++)
		box_extend(&all, b->scene.points[i]);
	return all;
}

/* Whether a point is inside the triangles: the solid angle they fill, in full spheres, is 1 inside and 0 outside (van Oosterom and
 * Strackee 1983). */
static inline double winding(const struct bench *b, struct vec p)
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
static inline bool near_surface(const struct pov_solid *s, struct vec p, double tolerance)
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
static inline void agree(const struct bench *b, const struct pov_solid *s, double tolerance, uint64_t seed)
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

/* Whether some corner of the mesh is at a point. */
static inline bool has_corner(const struct bench *b, struct vec p)
{
	for (size_t i = 0; i < b->scene.point_count; i++)
		if (vec_length(vec_sub(b->scene.points[i], p)) < 1e-9)
			return true;
	return false;
}

/* A square of side 2 with a hole of side 1: loops, closed by their first point. */
static const struct vec square[] = { { { { 0, 0, 0 } } }, { { { 2, 0, 0 } } }, { { { 2, 2, 0 } } }, { { { 0, 2, 0 } } },
	                             { { { 0, 0, 0 } } }, { { { 0.5, 0.5, 0 } } }, { { { 1.5, 0.5, 0 } } }, { { { 1.5, 1.5, 0 } } },
	                             { { { 0.5, 1.5, 0 } } }, { { { 0.5, 0.5, 0 } } } };

static inline struct pov_solid *new_profile(struct bench *b, enum pov_kind kind, struct pov_profile p)
{
	struct pov_solid *s = pov_solid_new(&b->mem, kind);
	s->shape.profile = p;
	return seal(b, s);
}

static inline struct pov_solid *make_torus(struct bench *b)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_TORUS);
	s->shape.torus = (struct pov_torus){ 2, 0.5 };
	return seal(b, s);
}

#endif
