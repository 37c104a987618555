/* The boxes of combinations. An intersection's is that of the polyhedron of its planes within the boxes of its other parts, tightened by
 * its quadrics. */
#include "io/pov_place.h"
#include "io/pov_poly.h"
#include "io/pov_term.h"

enum { TREE_LEAST = 8, ROUNDS = 2, LEVELS = 1, FACE_MOST = 256 };

/* Where unbounded polyhedra are cut off to find whether they are bounded, and other boxes. */
static const double far = 1e6, farther = 1e12;

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

/* The planes in a row of parts, and 'levels' of intersections among them deep, as half spaces that face outward; returns how many there
 * are. halves: NULL to count them. */
static size_t gather_planes(const struct pov_term *row, int levels, struct pov_half *halves)
{
	size_t n = 0;
	for (const struct pov_term *c = row; c; c = c->next) {
		if (c->kind == TERM_MEET && !c->inverse && levels > 0)
			n += gather_planes(c->child, levels - 1, halves ? halves + n : NULL);
		if (c->kind != TERM_LEAF || c->half_count != 1)
			continue;
		if (halves)
			halves[n] = c->inverse ? (struct pov_half){ vec_scale(c->halves->normal, -1), -c->halves->offset } : *c->halves;
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

/* A side at 'far' or nearly so counts as none. */
static struct box without_far_sides(struct box b, double least)
{
	for (int a = 0; a < 3; a++) {
		b.lo.a[a] = b.lo.a[a] <= -least ? -INFINITY : b.lo.a[a];
		b.hi.a[a] = b.hi.a[a] >= least ? INFINITY : b.hi.a[a];
	}
	return b;
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
	found = without_far_sides(found, far * (1 - 1e-9));
	return box_common(&found, within);
}

/* By the planes and by intervals in the quadric's own space, where what is turned lies straight. Boxes are finite on the way: the zeros of
 * a turn by 90 degrees are 1e-17, and would let infinity through. own: room for the planes there. */
static struct box tighten_by(const struct pov_term *q, const struct pov_half *halves, size_t n, struct pov_half *own, const struct box *b)
{
	struct box all = { vec(-farther, -farther, -farther), vec(farther, farther, farther) }, within = box_common(b, &all);
	for (size_t i = 0; i < n; i++) {
		struct vec foot = matrix_point(vec_scale(halves[i].normal, halves[i].offset / vec_dot(halves[i].normal, halves[i].normal)), &q->back);
		own[i].normal = vec_unit(matrix_normal(halves[i].normal, &q->back));
		own[i].offset = vec_dot(own[i].normal, foot);
	}
	within = pov_place_box(&within, &q->back);
	if (n)
		within = polyhedron_box(own, n, &within);
	within = pov_quadric_tighten(q->shape, q->inverse, &within);
	within = without_far_sides(pov_place_box(&within, &q->place), far);
	return box_common(&within, b);
}

/* The box of what is in all parts of a row. */
static int common_box(struct arena *a, const struct pov_term *row, struct box *b)
{
	size_t planes = gather_planes(row, LEVELS, NULL);
	struct pov_half *halves = NEW(a, struct pov_half, 2 * planes + 1);
	*b = box_infinite();
	if (!halves)
		return -1;
	for (const struct pov_term *c = row; c; c = c->next) {
		struct box part = pov_term_box(c);
		if (decides(c))
			*b = box_common(b, &part);
	}
	gather_planes(row, LEVELS, halves);
	for (int round = 0; round < ROUNDS && !box_is_empty(b); round++) {
		if (planes)
			*b = polyhedron_box(halves, planes, b);
		for (const struct pov_term *c = row; c; c = c->next)
			if (c->kind == TERM_LEAF && c->shape->kind == POV_QUADRIC)
				*b = tighten_by(c, halves, planes, halves + planes, b);
	}
	return 0;
}

int pov_term_meet_box(struct arena *a, struct pov_term *t)
{
	struct box surface = box_empty();
	if (common_box(a, t->child, &t->box) != 0)
		return -1;
	for (const struct pov_term *c = t->child; c; c = c->next)
		box_join(&surface, &c->extent);
	t->extent = box_common(&surface, &t->box);
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

int pov_term_clip_box(struct arena *a, struct pov_term *t)
{
	struct box clips, own = pov_term_box(t->child);
	if (common_box(a, t->child->next, &clips) != 0)
		return -1;
	t->box = box_common(&own, &clips);
	t->extent = box_common(&t->child->extent, &clips);
	return 0;
}
