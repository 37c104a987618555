/* The boxes of combinations. An intersection's is that of the polyhedron of its planes within the boxes of its other parts, tightened by
 * its quadrics. */
#include "io/pov_place.h"
#include "io/pov_poly.h"
#include "io/pov_term.h"

enum { TREE_LEAST = 8, ROUNDS = 2, FACE_MOST = 256 };

static const double far = 1e6; /* where unbounded polyhedra are cut off to find whether they are bounded */

struct box pov_term_box(const struct pov_term *t)
{
	if (t->kind == TERM_EMPTY)
		return t->inverse ? box_infinite() : box_empty();
	return t->inverse ? box_infinite() : t->box;
}

/* Whether a part of an intersection bounds its surface: shapes without an inside leave their own. */
static bool decides(const struct pov_term *t)
{
	return t->kind != TERM_LEAF || pov_shape_has_inside(t->shape);
}

/* The planes among the parts, as half spaces that face outward. */
static size_t gather_planes(const struct pov_term *t, struct pov_half *halves)
{
	size_t n = 0;
	for (const struct pov_term *c = t->child; c; c = c->next)
		if (c->kind == TERM_LEAF && c->half_count == 1) {
			halves[n] = *c->halves;
			if (c->inverse)
				halves[n] = (struct pov_half){ vec_scale(halves[n].normal, -1), -halves[n].offset };
			n++;
		}
	return n;
}

/* A face of a polyhedron, which may have many sides; one with too many is cut no more, and only larger for it. */
struct face {
	int count;
	struct vec corner[FACE_MOST];
};

static void cut_face(struct face *p, const struct pov_half *h)
{
	struct face kept = { 0 };
	if (p->count + 1 > FACE_MOST)
		return;
	for (int i = 0; i < p->count; i++) {
		struct vec a = p->corner[i], b = p->corner[i + 1 < p->count ? i + 1 : 0];
		double f = vec_dot(h->normal, a) - h->offset, g = vec_dot(h->normal, b) - h->offset;
		if (f <= 0)
			kept.corner[kept.count++] = a;
		if ((f < 0 && g > 0) || (f > 0 && g < 0))
			kept.corner[kept.count++] = vec_add(a, vec_scale(vec_sub(b, a), f / (f - g)));
	}
	*p = kept;
}

/* A square of side 4 'far' in the plane of a half space. */
static struct face plane_square(const struct pov_half *h)
{
	struct vec u, v, foot = vec_scale(h->normal, h->offset);
	pov_place_frame(h->normal, &u, &v);
	u = vec_scale(u, 2 * far);
	v = vec_scale(v, 2 * far);
	return (struct face){ 4, { vec_sub(vec_sub(foot, u), v), vec_sub(vec_add(foot, u), v), vec_add(vec_add(foot, u), v),
		                      vec_add(vec_sub(foot, u), v) } };
}

/* The polyhedron of the half spaces within a box: its box, from its faces. What reaches 'far' counts as unbounded. */
static struct box polyhedron_box(const struct pov_half *halves, size_t n, const struct box *within)
{
	struct box found = box_empty();
	for (size_t i = 0; i < n + 6; i++) {
		int axis = i < n ? 0 : (int)(i - n) / 2, side = (int)(i - n) % 2;
		struct pov_half h = { vec(0, 0, 0), 0 };
		if (i < n) {
			h = halves[i];
		} else {
			h.normal.a[axis] = side ? 1 : -1;
			h.offset = side ? fmin(far, within->hi.a[axis]) : fmin(far, -within->lo.a[axis]);
		}
		struct face p = plane_square(&h);
		for (size_t j = 0; j < n; j++)
			if (j != i)
				cut_face(&p, &halves[j]);
		for (int a = 0; a < 6; a++)
			if (i < n || a / 2 != axis) {
				struct pov_half wall = { vec(0, 0, 0), a % 2 ? fmin(far, within->hi.a[a / 2]) : fmin(far, -within->lo.a[a / 2]) };
				wall.normal.a[a / 2] = a % 2 ? 1 : -1;
				cut_face(&p, &wall);
			}
		for (int k = 0; k < p.count; k++)
			box_extend(&found, p.corner[k]);
	}
	for (int a = 0; a < 3; a++) {
		double edge = far * (1 - 1e-9);
		found.lo.a[a] = found.lo.a[a] <= -edge ? within->lo.a[a] : found.lo.a[a];
		found.hi.a[a] = found.hi.a[a] >= edge ? within->hi.a[a] : found.hi.a[a];
	}
	return found;
}

/* By intervals in the quadric's own space. */
static struct box tighten_by(const struct pov_term *q, const struct box *b)
{
	struct box own = pov_place_box(b, &q->back);
	own = pov_quadric_tighten(q->shape, q->inverse, &own);
	own = pov_place_box(&own, &q->place);
	return box_common(&own, b);
}

int pov_term_meet_box(struct arena *a, struct pov_term *t)
{
	struct pov_half *halves = NEW(a, struct pov_half, t->child_count);
	struct box b = box_infinite(), surface = box_empty();
	if (!halves)
		return -1;
	for (const struct pov_term *c = t->child; c; c = c->next) {
		struct box part = pov_term_box(c);
		box_join(&surface, &c->extent);
		if (decides(c))
			b = box_common(&b, &part);
	}
	size_t n = gather_planes(t, halves);
	for (int round = 0; round < ROUNDS && !box_is_empty(&b); round++) {
		if (n)
			b = polyhedron_box(halves, n, &b);
		for (const struct pov_term *c = t->child; c; c = c->next)
			if (c->kind == TERM_LEAF && c->shape->kind == POV_QUADRIC)
				b = tighten_by(c, &b);
	}
	t->box = b;
	t->extent = box_common(&surface, &b);
	return 0;
}

int pov_term_union_box(struct arena *a, struct pov_term *t)
{
	uint32_t n = 0;
	for (const struct pov_term *c = t->child; c; c = c->next) {
		struct box part = pov_term_box(c);
		box_join(&t->box, &part);
		box_join(&t->extent, &c->extent);
	}
	if (t->child_count < TREE_LEAST)
		return 0;
	struct box *boxes = NEW(a, struct box, t->child_count);
	t->children = NEW(a, struct pov_term *, t->child_count);
	for (struct pov_term *c = t->child; boxes && t->children && c; c = c->next) {
		boxes[n] = pov_term_box(c);
		t->children[n++] = c;
	}
	return boxes && t->children ? pov_tree_build(&t->tree, a, boxes, n) : -1;
}

void pov_term_clip_box(struct pov_term *t)
{
	t->box = pov_term_box(t->child);
	t->extent = t->child->extent;
	for (const struct pov_term *c = t->child->next; c; c = c->next) {
		struct box part = pov_term_box(c);
		t->box = box_common(&t->box, &part);
		t->extent = box_common(&t->extent, &part);
	}
}
