/* Bounding volume hierarchies. This file: options, the ordered walk, cells and invariants. */
#include "accel/bvh.h"
#include "accel/root.h"
#include "accel/walk.h"

#include <string.h>

static const char *const builder_words[] = { "binned", "sah", "median", "insertion", "spatial", NULL };
static const char *const traversal_words[] = { "ordered", "point", "slabs", "sibling", "skip", "array", "any", "cache", NULL };

#define AT(field) offsetof(struct bvh_options, field)
static const struct key keys[] = {
	{ "builder", KEY_WORD, AT(builder), 0, 0, BVH_BINNED, builder_words,
	  "surface area heuristic between bins or at every centroid, halves, one primitive after the other, or parts of primitives" },
	{ "max_objects", KEY_INT, AT(max_objects), 1, 1e6, 4, NULL, "what a leaf may list" },
	{ "bins", KEY_INT, AT(bins), 2, BVH_BINS, 16, NULL, "binned, spatial: bins an axis" },
	{ "step", KEY_REAL, AT(step), 0, 1e6, 1.2, NULL, "what builders take an inner node to cost" },
	{ "test", KEY_REAL, AT(test), 0, 1e6, 1, NULL, "what builders take a primitive in a leaf to cost" },
	{ "optimise", KEY_INT, AT(optimise), 0, 100, 0, NULL, "rounds of reinsertion after building" },
	{ "traversal", KEY_WORD, AT(traversal), 0, 0, BVH_ORDERED, traversal_words, "ordered, or one of the steps of Smits 1999" },
	{ 0 }
};
#undef AT

static bool applies(const void *opt, const char *key)
{
	const struct bvh_options *o = opt;
	if (strcmp(key, "bins") == 0)
		return o->builder == BVH_BINNED || o->builder == BVH_SPATIAL;
	if (strcmp(key, "max_objects") == 0 || strcmp(key, "step") == 0 || strcmp(key, "test") == 0)
		return o->builder != BVH_MEDIAN || o->optimise || strcmp(key, "max_objects") == 0;
	return true;
}

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct bvh_options *o = opt;
	const struct bvh_rules rules = { (float)o->step, (float)o->test, 1, (uint32_t)o->max_objects, (int)o->bins, a->threads };
	struct bvh *b = NEW(&a->mem, struct bvh, 1);
	struct bvh_draft draft;
	a->root = root_box(&a->primitives->bounds, ROOT_BOX);
	a->slack = 1e-9 * box_diagonal(&a->root);
	a->volumes = true;
	a->impl = b;
	if (!b)
		return err_memory(e, "bvh");
	b->traversal = o->traversal;
	a->to_hit = o->traversal == BVH_ORDERED;
	int status = bvh_draft_make(&draft, a, (enum bvh_builder)o->builder, (int)o->optimise, &rules, e);
	if (status == 0)
		status = bvh_lay_out(a, b, &draft, e);
	bvh_draft_free(&draft);
	if (status == 0 && o->traversal != BVH_ORDERED && smits_link(a, b) != 0)
		status = err_memory(e, "bvh");
	return status;
}

static int cells_from(const struct accel *a, uint32_t node, uint16_t depth, cell_fn *fn, void *ctx)
{
	const struct bvh *b = a->impl;
	const struct bvh_node *n = &b->nodes[node];
	int stop = fn(ctx, &(struct cell){ .bounds = n->bounds, .area = box_area(&n->bounds), .ids = n->count ? &b->ids[n->first] : NULL,
	                                   .count = n->count, .depth = depth, .leaf = n->count > 0 });
	if (stop == 0 && !n->count)
		stop = cells_from(a, node + 1, depth + 1, fn, ctx);
	if (stop == 0 && !n->count)
		stop = cells_from(a, n->right, depth + 1, fn, ctx);
	return stop;
}

static int cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	return cells_from(a, 0, 0, fn, ctx);
}

/* A node put off, and where the ray comes into its box. */
struct later {
	uint32_t node;
	double t;
};

/* Nodes that wait in order, at most. Where the ray goes through so many boxes at once, those of a single path wait on top of them, as
 * they come: visited in any order, nodes give the same hit. */
enum { SORTED = 128 };

/* Put a node off until after those that the ray comes into before it. Returns the new top of the stack. */
static inline struct later *put_off(struct later *bottom, struct later *top, struct later l, bool in_order)
{
	struct later *place = top;
	if (in_order && top < bottom + SORTED)
		for (; place > bottom && place[-1].t < l.t; place--)
			*place = place[-1];
	*place = l;
	return top + 1;
}

/* Of all nodes known the ray comes into the next one first, so that it visits those up to its hit and no others. A ray that any hit ends
 * keeps to the nearer child instead, which finds one sooner. */
WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	const struct bvh *b = a->impl;
	const struct bvh_ray packed = bvh_ray(r);
	struct later later[SORTED + BVH_DEEPEST], *top = later;
	uint32_t node = 0;
	double t[2];
	*h = hit_none(r);
	COUNT(boxes, 1);
	bool going = bvh_meets(&b->nodes[0].bounds, &packed, h->t, t), in_order = !r->any;
	while (going) {
		const struct bvh_node *n = &b->nodes[node];
		bool meets[2] = { false, false };
		if (n->count) {
			COUNT(leaves, 1);
			COUNT(tests, n->count);
			if (!r->through)
				test_all(a->primitives->all, &b->ids[n->first], n->count, r, h);
			if (r->any && h->id != NO_PRIMITIVE)
				break;
		} else {
			COUNT(inner_step, 1);
			COUNT(boxes, 2);
			meets[0] = bvh_meets(&n[1].bounds, &packed, h->t, &t[0]);
			meets[1] = bvh_meets(&b->nodes[n->right].bounds, &packed, h->t, &t[1]);
		}
		if (meets[0] & meets[1]) {
			int far = t[0] <= t[1];
			top = put_off(later, top, (struct later){ far ? n->right : node + 1, t[far] }, in_order);
			node = far ? node + 1 : n->right;
			t[0] = t[!far];
		} else if (meets[0] | meets[1]) {
			node = meets[0] ? node + 1 : n->right;
			t[0] = meets[0] ? t[0] : t[1];
		} else {
			while (top > later && top[-1].t > h->t + r->slack)
				top--;
			going = top > later;
			node = going ? (--top)->node : 0;
			continue;
		}
		if (in_order && top > later && top[-1].t < t[0]) {
			struct later first = *--top;
			top = put_off(later, top, (struct later){ node, t[0] }, true);
			node = first.node;
		}
	}
	root_drop_hit(&a->root, r, a->slack, h);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}
WALK_TWICE(walk)

static bool shoot_any(const struct accel *a, const struct ray *r, struct hit *h)
{
	const struct bvh *b = a->impl;
	return b->traversal == BVH_ORDERED ? shoot(a, r, h) : smits_shoot(a, r, h);
}

static bool shoot_any_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n)
{
	const struct bvh *b = a->impl;
	return b->traversal == BVH_ORDERED ? shoot_counted(a, r, h, n) : smits_shoot_counted(a, r, h, n);
}

static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	const struct bvh *b = a->impl;
	if (b->traversal != BVH_ORDERED) {
		smits_shoot_many(a, r, count, h, n);
		return;
	}
	for (size_t i = 0; i < count; i++) {
		n[i] = (struct tally){ 0 };
		shoot_counted(a, &r[i], &h[i], &n[i]);
	}
}

static int check_node(const struct accel *a, uint32_t node, unsigned char *seen, struct err *e)
{
	const struct bvh *b = a->impl;
	const struct bvh_node *n = &b->nodes[node];
	if (n->count) {
		for (uint32_t i = 0; i < n->count; i++)
			seen[b->ids[n->first + i]] = 1;
		return n->skip == node + 1 ? 0 : err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh: node %u skips wrongly", node);
	}
	for (int side = 0; side < 2; side++) {
		uint32_t child = side ? n->right : node + 1;
		const struct box *c = &b->nodes[child].bounds;
		for (int i = 0; i < 3; i++)
			if (c->lo.a[i] < n->bounds.lo.a[i] || c->hi.a[i] > n->bounds.hi.a[i])
				return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh: node %u sticks out of node %u", child, node);
		if (check_node(a, child, seen, e) != 0)
			return -1;
	}
	if (b->nodes[node + 1].skip != n->right || b->nodes[n->right].skip != n->skip)
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh: node %u skips wrongly", node);
	return 0;
}

static int check(const struct accel *a, struct err *e)
{
	struct arena mem = { 0 };
	uint32_t n = a->primitives->count;
	unsigned char *seen = NEW(&mem, unsigned char, n);
	int status = seen ? check_node(a, 0, seen, e) : err_memory(e, "bvh");
	for (uint32_t i = 0; status == 0 && i < n; i++)
		if (!seen[i])
			status = err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh: primitive %u is in no leaf", i);
	arena_free(&mem);
	return status;
}

const struct accel_ops accel_bvh = {
	"bvh", "a binary tree of boxes that may overlap", keys, sizeof(struct bvh_options), applies, build, cells, shoot_any, shoot_any_counted,
	shoot_many, check, NULL
};
