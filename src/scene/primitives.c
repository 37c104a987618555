#include "scene/primitives.h"

#include "base/rng.h"
#include "scene/tessellate.h"
#include "scene/triangulate.h"

#include <string.h>

/* One scene being turned into primitives. */
struct maker {
	struct primitives *out;
	const struct scene *scene;
	enum curves curves;
	int resolution;
	size_t room;
	bool patches; /* the scene has some */
	bool lost;    /* memory ran out */
};

static bool reserve(struct maker *m)
{
	if (m->lost || m->out->count < m->room)
		return !m->lost;
	size_t want = m->room ? m->room * 2 : 256;
	void *grown = want > INT32_MAX ? NULL : arena_grow(&m->out->mem, m->out->all, m->out->count, want, sizeof *m->out->all);
	if (!grown) {
		m->lost = true;
		return false;
	}
	m->out->all = grown;
	if (m->patches) {
		m->out->normals = arena_grow(&m->out->mem, m->out->normals, m->out->count, want, sizeof *m->out->normals);
		m->lost = !m->out->normals;
	}
	m->room = want;
	return !m->lost;
}

/* normals: of the three corners, or NULL. */
static void add(struct maker *m, const struct primitive *p, const struct vec *normals)
{
	double area = primitive_area(p);
	if (!(area > 0) || !isfinite(area)) {
		m->out->skipped++;
		return;
	}
	if (!reserve(m))
		return;
	for (int i = 0; normals && i < 3; i++)
		m->out->normals[m->out->count][i] = normals[i];
	m->out->all[m->out->count++] = *p;
	m->out->triangles += p->kind == PRIMITIVE_TRIANGLE;
	m->out->spheres += p->kind == PRIMITIVE_SPHERE;
}

static void add_triangle(struct maker *m, uint32_t material, struct vec a, struct vec b, struct vec c)
{
	add(m, &(struct primitive){ .kind = PRIMITIVE_TRIANGLE, .material = material, .triangle = { { a, b, c } } }, NULL);
}

/* Corners i, j, k of a polygon or patch. */
static void add_corners(struct maker *m, const struct object *o, const struct vec *p, uint32_t i, uint32_t j, uint32_t k)
{
	const struct primitive t = { .kind = PRIMITIVE_TRIANGLE, .material = o->material, .triangle = { { p[i], p[j], p[k] } } };
	if (o->kind == OBJECT_PATCH) {
		const struct vec *n = p + o->count;
		add(m, &t, (const struct vec[3]){ n[i], n[j], n[k] });
	} else {
		add(m, &t, NULL);
	}
}

static void add_polygon(struct maker *m, const struct object *o, const struct vec *p)
{
	if (o->count == 3) {
		add_corners(m, o, p, 0, 1, 2);
		return;
	}
	struct arena scratch = { 0 };
	uint32_t *t = o->count > 3 ? NEW(&scratch, uint32_t, 3 * ((size_t)o->count - 2)) : NULL;
	if (o->count < 3)
		m->out->skipped++;
	else if (!t || triangulate_polygon(p, o->count, t, &scratch) != 0)
		m->lost = true;
	else
		for (size_t i = 0; i + 2 < o->count; i++, t += 3)
			add_corners(m, o, p, t[0], t[1], t[2]);
	arena_free(&scratch);
}

static void add_curve(struct maker *m, const struct object *o, const struct vec *p)
{
	double r0 = fabs(o->radius[0]), r1 = fabs(o->radius[1]);
	if (o->kind == OBJECT_SPHERE && m->curves == CURVES_KEEP) {
		add(m, &(struct primitive){ .kind = PRIMITIVE_SPHERE, .material = o->material, .sphere = { p[0], r0 } }, NULL);
		return;
	}
	struct scene curve = { 0 };
	if (o->kind == OBJECT_SPHERE ? r0 > 0 : vec_length(vec_sub(p[1], p[0])) > 0) {
		if (o->kind == OBJECT_SPHERE)
			tessellate_sphere(&curve, p[0], r0, m->resolution);
		else
			tessellate_cone(&curve, p[0], r0, p[1], r1, m->resolution);
	} else {
		m->out->skipped++;
	}
	for (size_t i = 0; i < curve.object_count; i++) {
		const struct vec *q = &curve.points[curve.objects[i].first];
		add_triangle(m, o->material, q[0], q[1], q[2]);
	}
	m->lost |= curve.lost;
	scene_free(&curve);
}

static uint64_t hash_numbers(uint64_t hash, const double *x, int n)
{
	for (int i = 0; i < n; i++) {
		uint64_t bits;
		memcpy(&bits, &x[i], sizeof bits);
		hash = rng_mix(hash ^ bits);
	}
	return hash;
}

static void sum_up(struct primitives *p)
{
	p->bounds = box_empty();
	for (uint32_t i = 0; i < p->count; i++) {
		const struct primitive *q = &p->all[i];
		struct box b = primitive_bounds(q);
		box_join(&p->bounds, &b);
		p->area += primitive_area(q);
		p->hash = rng_mix(p->hash ^ (uint64_t)q->kind);
		if (q->kind == PRIMITIVE_TRIANGLE)
			for (int k = 0; k < 3; k++)
				p->hash = hash_numbers(p->hash, q->triangle.v[k].a, 3);
		else {
			p->hash = hash_numbers(p->hash, q->sphere.center.a, 3);
			p->hash = hash_numbers(p->hash, &q->sphere.radius, 1);
		}
	}
}

/* Whether what is near to each other, 1e-9 of the scene's diagonal (geom/ray.h), is still some roundings of a coordinate; and whether
 * products of three lengths are still numbers. */
static bool is_resolved(const struct box *b)
{
	double far = 0, diagonal = box_diagonal(b);
	for (int i = 0; i < 3; i++)
		far = fmax(far, fmax(fabs(b->lo.a[i]), fabs(b->hi.a[i])));
	return diagonal <= 1e100 && far * 0x1p-50 <= 1e-9 * diagonal;
}

int primitives_make(struct primitives *p, const struct scene *s, enum curves curves, int resolution, const char *name,
                    struct err *e)
{
	struct maker m = { .out = p, .scene = s, .curves = curves, .resolution = resolution };
	for (size_t i = 0; i < s->object_count; i++)
		m.patches |= s->objects[i].kind == OBJECT_PATCH;
	for (size_t i = 0; i < s->object_count && !m.lost; i++) {
		const struct object *o = &s->objects[i];
		if (o->kind == OBJECT_POLYGON || o->kind == OBJECT_PATCH)
			add_polygon(&m, o, &s->points[o->first]);
		else
			add_curve(&m, o, &s->points[o->first]);
	}
	if (m.lost) {
		primitives_free(p);
		return err_memory(e, name);
	}
	if (p->count == 0) {
		primitives_free(p);
		return err_at(e, STATUS_INPUT, name, 0, "nothing with a surface in the scene");
	}
	sum_up(p);
	if (!is_resolved(&p->bounds)) {
		primitives_free(p);
		return err_at(e, STATUS_INPUT, name, 0, "the scene is too large, or lies too far from the origin for its size");
	}
	return 0;
}

void primitives_free(struct primitives *p)
{
	arena_free(&p->mem);
	*p = (struct primitives){ 0 };
}
