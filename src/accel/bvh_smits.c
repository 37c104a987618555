/* The steps of Smits 1999 ("Efficiency issues for ray tracing", sections 4 and 5), each a traversal of its own: they visit a subtree
 * in a fixed order, and differ in how a box is tested, how the next node is found, and when they stop. */
#include "accel/bvh.h"
#include "accel/root.h"
#include "accel/walk.h"

/* A node as a recursive builder leaves it. skip: the node after its subtree. */
struct smits_node {
	struct box bounds;
	const struct smits_node *left, *sibling, *parent, *skip;
	const uint32_t *ids;
	uint32_t count;
};

/* What a traversal carries along. cached: the primitive that ended the last ray, or NO_PRIMITIVE. */
struct smits_walk {
	const struct accel *accel;
	const struct bvh *bvh;
	const struct ray *ray;
	struct bvh_ray packed;
	struct hit *hit;
	uint32_t cached;
};

int smits_link(struct accel *a, struct bvh *b)
{
	struct smits_node *all = NEW(&a->mem, struct smits_node, a->nodes);
	if (!all)
		return -1;
	b->links = all;
	for (uint32_t i = 0; i < a->nodes; i++) {
		const struct bvh_node *n = &b->nodes[i];
		all[i].bounds = n->bounds;
		all[i].skip = n->skip < a->nodes ? &all[n->skip] : NULL;
		all[i].ids = &b->ids[n->first];
		all[i].count = n->count;
		if (n->count)
			continue;
		all[i].left = &all[i + 1];
		all[i + 1].sibling = &all[n->right];
		all[i + 1].parent = all[n->right].parent = &all[i];
	}
	return 0;
}

/* Section 4.1, the slow way: the point where the ray comes in, on the one of the sides facing it whose plane is farthest (Woo 1990). */
static inline bool meets_point(const struct box *b, const struct smits_walk *w)
{
	const struct ray *r = w->ray;
	bool inside = true;
	double t = 0;
	for (int i = 0; i < 3; i++) {
		double plane = r->d.a[i] > 0 ? b->lo.a[i] : b->hi.a[i];
		bool outside = r->d.a[i] > 0 ? r->o.a[i] < plane : r->o.a[i] > plane;
		if (r->d.a[i] == 0 && (r->o.a[i] < b->lo.a[i] - r->slack || r->o.a[i] > b->hi.a[i] + r->slack))
			return false;
		if (!outside || r->d.a[i] == 0)
			continue;
		inside = false;
		double at = (plane - r->o.a[i]) / r->d.a[i];
		t = at > t ? at : t;
	}
	if (!inside && t > w->hit->t + r->slack)
		return false;
	struct vec p = vec_add(r->o, vec_scale(r->d, t));
	for (int i = 0; i < 3; i++)
		if (p.a[i] < b->lo.a[i] - r->slack || p.a[i] > b->hi.a[i] + r->slack)
			return false;
	return true;
}

static inline __attribute__((always_inline)) bool meets(const struct box *b, const struct smits_walk *w, struct tally *tally,
                                                        const bool count, const bool by_point)
{
	double t;
	COUNT(boxes, 1);
	return by_point ? meets_point(b, w) : bvh_meets(b, &w->packed, w->hit->t, &t);
}

/* The primitives of a leaf; true when the ray ends here. */
static inline __attribute__((always_inline)) bool test_leaf(const struct smits_walk *w, const uint32_t *ids, uint32_t n,
                                                            struct tally *tally, const bool count, const bool any)
{
	COUNT(leaves, 1);
	COUNT(tests, n);
	if (!w->ray->through)
		test_all(w->accel->primitives->all, ids, n, w->ray, w->hit);
	return any && w->ray->any && w->hit->id != NO_PRIMITIVE;
}

/* Figure 3 (a). */
static void recurse(const struct smits_walk *w, const struct smits_node *n, struct tally *tally, bool by_point)
{
	const bool count = tally;
	if (!meets(&n->bounds, w, tally, count, by_point))
		return;
	if (n->count) {
		test_leaf(w, n->ids, n->count, tally, count, false);
		return;
	}
	COUNT(inner_step, 1);
	recurse(w, n->left, tally, by_point);
	recurse(w, n->left->sibling, tally, by_point);
}

/* Figure 4. */
static inline __attribute__((always_inline)) void walk_siblings(const struct smits_walk *w, struct tally *tally, const bool count)
{
	const struct smits_node *n = w->bvh->links;
	while (n) {
		if (meets(&n->bounds, w, tally, count, false)) {
			if (!n->count) {
				COUNT(inner_step, 1);
				n = n->left;
				continue;
			}
			test_leaf(w, n->ids, n->count, tally, count, false);
		}
		while (n && !n->sibling)
			n = n->parent;
		n = n ? n->sibling : NULL;
	}
}

/* Figure 5. */
static inline __attribute__((always_inline)) void walk_skips(const struct smits_walk *w, struct tally *tally, const bool count)
{
	const struct smits_node *n = w->bvh->links;
	while (n) {
		bool met = meets(&n->bounds, w, tally, count, false);
		if (met && !n->count) {
			COUNT(inner_step, 1);
			n = n->left;
			continue;
		}
		if (met)
			test_leaf(w, n->ids, n->count, tally, count, false);
		n = n->skip;
	}
}

/* Figure 6. */
static inline __attribute__((always_inline)) void walk_array(const struct smits_walk *w, struct tally *tally, const bool count,
                                                             const bool any)
{
	const struct bvh_node *n = w->bvh->nodes, *all = n, *stop = n + n->skip;
	while (n < stop) {
		if (!meets(&n->bounds, w, tally, count, false)) {
			n = all + n->skip;
			continue;
		}
		if (!n->count)
			COUNT(inner_step, 1);
		else if (test_leaf(w, &w->bvh->ids[n->first], n->count, tally, count, any))
			return;
		n++;
	}
}

/* Section 4.4: what ended the last ray is tested before anything else. */
static inline __attribute__((always_inline)) bool ends_in_cached(const struct smits_walk *w, struct tally *tally, const bool count)
{
	if (w->cached == NO_PRIMITIVE || !w->ray->any || w->ray->through)
		return false;
	COUNT(tests, 1);
	primitive_hit(&w->accel->primitives->all[w->cached], w->cached, w->ray, w->hit);
	return w->hit->id != NO_PRIMITIVE;
}

static inline __attribute__((always_inline)) bool walk(const struct accel *a, const struct ray *r, struct hit *h, uint32_t cached,
                                                       struct tally *tally, const bool count)
{
	const struct bvh *b = a->impl;
	const struct smits_walk w = { a, b, r, bvh_ray(r), h, cached };
	*h = hit_none(r);
	switch (b->traversal) {
	case BVH_POINT: recurse(&w, b->links, tally, true); break;
	case BVH_SLABS: recurse(&w, b->links, tally, false); break;
	case BVH_SIBLING: walk_siblings(&w, tally, count); break;
	case BVH_SKIP: walk_skips(&w, tally, count); break;
	case BVH_ARRAY: walk_array(&w, tally, count, false); break;
	case BVH_ANY: walk_array(&w, tally, count, true); break;
	case BVH_CACHE:
		if (!ends_in_cached(&w, tally, count))
			walk_array(&w, tally, count, true);
		break;
	}
	root_drop_hit(&a->root, r, a->slack, h);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}

bool smits_shoot(const struct accel *a, const struct ray *r, struct hit *h)
{
	return walk(a, r, h, NO_PRIMITIVE, NULL, false);
}

bool smits_shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n)
{
	return walk(a, r, h, NO_PRIMITIVE, n, true);
}

void smits_shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	uint32_t cached = NO_PRIMITIVE;
	for (size_t i = 0; i < count; i++) {
		n[i] = (struct tally){ 0 };
		if (walk(a, &r[i], &h[i], cached, &n[i], true))
			cached = h[i].id;
	}
}
