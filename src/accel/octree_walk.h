/* The steps of a ray's way through an octree, from leaf to leaf over links to the same-or-larger node across each face. */
#ifndef ACCEL_OCTREE_WALK_H
#define ACCEL_OCTREE_WALK_H

#include "accel/octree.h"
#include "accel/screen.h"
#include "accel/walk.h"

/* A ray on its way through the tree. */
struct walker {
	axes o, d, per_d;         /* origin, direction, 1 / d where a zero counts as positive */
	axes_int upper;           /* all ones where it leaves cells through the upper side */
	axes_int at;              /* the grid cell it is heading for below 'node' */
	struct screen_ray screened;
	const struct ray *ray;
	const struct octree_node *node, *from; /* where it is; the leaf it came from, NULL at first */
	const struct octree_node *next;        /* once the exit is known: what lies across it, NULL outside */
	double exit;              /* t where it leaves the leaf */
	int axis;                 /* of the face through which it leaves */
	struct hit hit;
	struct tally tally;
};

INLINED axes_int octree_cell(const struct octree_node *n)
{
	axes_int cell; /* the fourth lane holds what follows the cell */
	memcpy(&cell, (const char *)n + offsetof(struct octree_node, cell), sizeof cell);
	return cell;
}

/* The grid cell of p: one within slack of a plane belongs to the cell ahead. */
INLINED axes_int octree_locate(const struct octree *o, axes p, axes d, double slack)
{
	axes x = (p - o->lo) * o->per_step, most = axes_all(OCTREE_CELLS), none = axes_all(0);
	x = axes_pick(x > none, x, none);
	x = axes_pick(x < most, x, most);
	axes_int plane = __builtin_convertvector(x + axes_all(0.5), axes_int), cell = __builtin_convertvector(x, axes_int);
	axes off = p - (o->lo + __builtin_convertvector(plane, axes) * o->step);
	axes_int close = axes_narrow((off <= axes_all(slack)) & (off >= axes_all(-slack)));
	cell = axes_pick_int(close, plane + axes_narrow(d < none), cell);
	return axes_clamp(cell, (axes_int){ 0 }, (axes_int){ 0 } + (OCTREE_CELLS - 1));
}

/* Where the ray starts inside the root, as root_enter. */
INLINED bool walk_enter(struct walker *w, const struct accel *a, const struct octree *o, axes *start)
{
	axes below = o->lo - w->o, above = o->hi - w->o, none = axes_all(0);
	if (axes_any(((w->d < none) & (below >= axes_all(-a->slack))) | ((w->d > none) & (above <= axes_all(a->slack)))))
		return false;
	*start = w->o;
	if (!axes_any((below > none) | (above < none)))
		return true;
	struct vec in;
	bool enters = root_enter(&a->root, w->ray, vec(w->per_d[0], w->per_d[1], w->per_d[2]), a->slack, &in);
	*start = axes_of(in, 0);
	return enters;
}

/* False when the ray misses the root. */
INLINED bool walk_start(struct walker *w, const struct accel *a, const struct ray *r)
{
	const struct octree *o = a->impl;
	w->hit = hit_none(r);
	w->tally = (struct tally){ 0 };
	w->ray = r;
	w->from = NULL;
	w->o = axes_of(r->o, 0);
	w->d = axes_of(r->d, 0);
	w->per_d = 1 / axes_pick(w->d == axes_all(0), axes_all(1e-300), w->d);
	w->upper = axes_narrow(w->per_d > axes_all(0));
	axes start;
	if (!walk_enter(w, a, o, &start))
		return false;
	w->screened = screen_ray(r, o->center, o->diagonal);
	w->at = octree_locate(o, start, w->d, a->slack);
	int shift = OCTREE_LEVELS - o->start_depth;
	w->node = &o->nodes[o->start[(w->at[0] >> shift) | (w->at[1] >> shift) << o->start_depth |
	                             (w->at[2] >> shift) << 2 * o->start_depth]];
	__builtin_prefetch(w->node);
	return true;
}

INLINED void find_exit(struct walker *w, const struct octree *o)
{
	const struct octree_node *n = w->node;
	axes_int side = (axes_int){ 0 } + octree_side(n->depth);
	axes plane = o->lo + __builtin_convertvector(octree_cell(n) + (w->upper & side), axes) * o->step;
	axes t = (plane - w->o) * w->per_d;
	double x = t[0], y = t[1], z = t[2], least = y < x ? y : x;
	w->axis = z < least ? 2 : y < x;
	w->exit = z < least ? z : least;
	uint32_t link = n->link[2 * w->axis - w->upper[w->axis]];
	w->next = link == NO_NODE ? NULL : &o->nodes[link];
}

/* Grid cell behind the face through which the ray left its last leaf: exact on the face's axis, within the face on the others. */
INLINED void find_crossing(struct walker *w, const struct octree *o)
{
	const struct octree_node *from = w->from;
	int32_t side = octree_side(from->depth);
	axes x = (w->o + axes_all(w->exit) * w->d - o->lo) * o->per_step;
	axes_int low = octree_cell(from);
	w->at = axes_clamp(__builtin_convertvector(x, axes_int), low, low + (side - 1));
	w->at[w->axis] = from->cell[w->axis] + (w->upper[w->axis] ? side : -1);
}

/* From an inner node one down. */
INLINED void descend(struct walker *w, const struct octree *o)
{
	/* A node as large as the last leaf is the first below its link: the crossing is not known yet. */
	if (w->from && w->node->depth == w->from->depth)
		find_crossing(w, o);
	const int32_t at[3] = { w->at[0], w->at[1], w->at[2] };
	w->node = &o->nodes[octree_child_toward(w->node, at)];
}

/* Count a leaf, with the inner nodes passed on the way: the path from the root, or from the link, which is as deep as the last
 * leaf or a leaf itself. */
INLINED void count_leaf(struct walker *w, const bool count)
{
	struct tally *tally = &w->tally;
	const struct octree_node *n = w->node;
	COUNT(leaves, 1);
	COUNT(tests, n->count);
	if (!w->from)
		COUNT(inner_start, n->depth);
	else
		COUNT(inner_step, n->depth > w->from->depth ? (uint64_t)(n->depth - w->from->depth) : 0);
}

INLINED void test_leaf(struct walker *w, const struct accel *a, const struct octree *o)
{
	const struct octree_node *n = w->node;
	screen_test(o->screens, a->primitives->all, octree_list(o, n), n->count, w->ray, &w->screened, w->exit + a->slack, &w->hit);
}

#endif
