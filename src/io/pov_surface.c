#include "io/pov_surface.h"

#include "io/pov_place.h"

#include <stdlib.h>

enum { N_LEAST = 8, FINER_MOST = 4, LOOK_LEVELS = 12 };

static const double look = 0.002; /* a sphere's facets may miss it by this part of their distance from the eye */

static void collect(struct pov_surface *s, struct pov_term *t, const struct box *within, bool turned, struct pov_facets *out);

/* n sqrt(size / scene), from the least part of n to 4 n. */
static int segments(const struct pov_surface *s, const struct pov_term *t)
{
	double n = box_is_finite(&t->extent) && s->size > 0 ? s->n * sqrt(box_diagonal(&t->extent) / s->size) : s->n;
	n = fmin(fmax(n, s->least * s->n), FINER_MOST * s->n);
	return n < N_LEAST ? N_LEAST : (int)(n / 2) * 2;
}

static struct pov_facets open_facets(const struct pov_facets *like)
{
	return (struct pov_facets){ .most = like->most };
}

static void append(struct pov_facets *to, const struct pov_facets *from)
{
	to->lost = to->lost || from->lost;
	to->full = to->full || from->full;
	for (size_t i = 0; i < from->count; i++)
		pov_facets_add(to, from->all[i].v, from->all[i].material);
}

/* Facets of a large sphere near the eye, halved edge by edge until they are near enough to it; whether an edge is halved depends on
 * the edge alone, so that no gaps open. */
struct looker {
	const struct pov_term *sphere;
	struct vec eye;
	double radius; /* of the sphere, in the scene */
	struct pov_facets *out;
	uint32_t material;
};

static bool too_long(const struct looker *l, struct vec p, struct vec q, struct vec *middle)
{
	const struct pov_sphere *s = &l->sphere->shape->shape.sphere;
	double square = vec_dot(vec_sub(q, p), vec_sub(q, p));
	*middle = vec_scale(vec_add(p, q), 0.5);
	double distance = fmax(0, vec_length(vec_sub(*middle, l->eye)) - sqrt(square));
	if (square / (8 * l->radius) <= look * distance || square <= 1e-8 * l->radius * l->radius)
		return false;
	struct vec out = vec_sub(matrix_point(*middle, &l->sphere->back), s->center);
	*middle = matrix_point(vec_add(s->center, vec_scale(out, s->radius / vec_length(out))), &l->sphere->place);
	return true;
}

static void look_at(const struct looker *l, const struct vec *v, int level)
{
	struct vec m[3];
	bool split[3];
	int n = 0, t = 0;
	for (int i = 0; i < 3; i++)
		n += split[i] = level < LOOK_LEVELS && too_long(l, v[i], v[(i + 1) % 3], &m[i]);
	if (n == 0) {
		pov_facets_add(l->out, v, l->material);
		return;
	}
	while (n < 3 && split[t] != (n == 1))
		t++;
	struct vec p = v[t], q = v[(t + 1) % 3], r = v[(t + 2) % 3], pq = m[t], qr = m[(t + 1) % 3], rp = m[(t + 2) % 3];
	struct vec parts[3][4][3] = { { { p, pq, r }, { pq, q, r } },
		                      { { qr, r, rp }, { p, q, qr }, { p, qr, rp } },
		                      { { qr, r, rp }, { p, pq, rp }, { pq, q, qr }, { pq, qr, rp } } };
	for (int i = 0; i <= n; i++)
		look_at(l, parts[n - 1][i], level + 1);
}

static void refine_sphere(const struct pov_surface *s, const struct pov_term *t, const struct pov_facets *from, struct pov_facets *out)
{
	double least, most;
	pov_place_stretch(&t->place, &least, &most);
	struct looker l = { t, *s->eye, t->shape->shape.sphere.radius * most, out, 0 };
	for (size_t i = 0; i < from->count; i++) {
		l.material = from->all[i].material;
		look_at(&l, from->all[i].v, 0);
	}
	out->lost = out->lost || from->lost;
	out->full = out->full || from->full;
}

static void draw_leaf(struct pov_surface *s, struct pov_term *t, const struct box *within, bool turned, struct pov_facets *out)
{
	bool endless = !box_is_finite(&t->extent);
	struct box world = box_common(within, &t->bound), local;
	if (endless && !t->half_count)
		world = box_common(&world, &s->close);
	struct pov_drawing d = { .out = out, .place = &t->place, .turn = turned != (pov_place_determinant(&t->place) < 0),
		                 .material = t->material, .plain = s->plain, .even = s->even, .n = segments(s, t), .scratch = s->scratch };
	local = pov_place_box(&world, &t->back);
	d.region = local;
	if (endless && box_is_empty(&world))
		return;
	if (!endless && !(t->shape->kind == POV_SPHERE && s->eye)) {
		pov_shape_of(t->shape)->mesh(t->shape, &d);
		return;
	}
	struct pov_facets whole = open_facets(out);
	d.out = &whole;
	pov_shape_of(t->shape)->mesh(t->shape, &d);
	if (endless) {
		s->unbounded++;
		pov_cut_box(&whole, &world, out);
	} else {
		refine_sphere(s, t, &whole, out);
	}
	pov_facets_free(&whole);
}

/* Whether the term cuts other than along planes. */
static bool is_bent(const struct pov_term *t)
{
	if (t->kind == TERM_LEAF)
		return t->half_count == 0 && pov_shape_has_inside(t->shape);
	for (const struct pov_term *c = t->child; c; c = c->next)
		if (is_bent(c))
			return true;
	return false;
}

/* How many of the parts are bent, which decides whether the others are drawn evenly. */
static int count_bent(const struct pov_term *t)
{
	int n = 0;
	for (const struct pov_term *c = t->child; c; c = c->next)
		n += is_bent(c);
	return n;
}

static void turn_facets(struct pov_facets *f)
{
	for (size_t i = 0; i < f->count; i++) {
		struct vec v = f->all[i].v[1];
		f->all[i].v[1] = f->all[i].v[2];
		f->all[i].v[2] = v;
	}
}

/* What of *f, which is within 'here', is inside 'by'. */
static void keep(const struct pov_surface *s, struct pov_facets *f, const struct box *here, struct pov_term *by,
                 const struct pov_term *except, bool flush)
{
	struct pov_cutter cutter = { .region = box_common(here, &s->close), .within = *here, .n = s->n, .size = s->size, .least = s->least, .flush = flush };
	struct pov_facets kept = open_facets(f);
	pov_cut(&cutter, f, by, except, &kept, NULL);
	pov_facets_free(f);
	*f = kept;
}

/* Each part outside its siblings, which is inside the complements of them: facets face the way of those complements for the cut. */
static void collect_exact(struct pov_surface *s, struct pov_term *t, const struct box *within, bool turned, struct pov_facets *out)
{
	int bent = count_bent(t);
	for (struct pov_term *c = t->child; c; c = c->next) {
		struct pov_facets part = open_facets(out);
		bool inverse = t->inverse, even = s->even;
		s->even = even || bent > is_bent(c);
		collect(s, c, within, turned, &part);
		s->even = even;
		if (!turned)
			turn_facets(&part);
		t->inverse = true;
		keep(s, &part, within, t, c, false);
		t->inverse = inverse;
		if (!turned)
			turn_facets(&part);
		append(out, &part);
		pov_facets_free(&part);
	}
}

/* Each part of an intersection inside the others, the exact cuts first; of a clip the first part only. The facets face outward for
 * the cut. */
static void collect_meet(struct pov_surface *s, struct pov_term *t, const struct box *within, bool turned, struct pov_facets *out)
{
	struct box here = box_common(within, t->kind == TERM_CLIP ? &t->extent : &t->box);
	int bent = count_bent(t);
	for (struct pov_term *c = t->child; c && !box_is_empty(&here); c = c->next) {
		struct pov_facets part = open_facets(out);
		bool even = s->even;
		s->even = even || bent > is_bent(c);
		collect(s, c, &here, turned, &part);
		s->even = even;
		if (turned)
			turn_facets(&part);
		for (int pass = 0; pass < 2; pass++)
			for (struct pov_term *by = t->child; by; by = by->next)
				if (by != c && (by->half_count > 0) == (pass == 0))
					keep(s, &part, &here, by, NULL, by->index > c->index);
		if (turned)
			turn_facets(&part);
		append(out, &part);
		pov_facets_free(&part);
		if (t->kind == TERM_CLIP)
			return;
	}
}

/* 'turned' where an odd number of complements is about the term: facets face the other way, and of unions only what is outside all
 * parts is a boundary. */
static void collect(struct pov_surface *s, struct pov_term *t, const struct box *within, bool turned, struct pov_facets *out)
{
	turned = turned != t->inverse;
	if (t->kind == TERM_LEAF)
		draw_leaf(s, t, within, turned, out);
	else if (t->kind == TERM_MEET || t->kind == TERM_CLIP)
		collect_meet(s, t, within, turned, out);
	else if (t->kind == TERM_UNION && (t->exact || turned))
		collect_exact(s, t, within, turned, out);
	else
		for (struct pov_term *c = t->child; c; c = c->next)
			collect(s, c, within, turned, out);
}

void pov_surface(struct pov_surface *s, struct pov_term *t, bool turned, struct pov_facets *out)
{
	collect(s, t, &s->region, turned, out);
}
