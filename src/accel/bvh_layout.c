#include "accel/bvh.h"
#include "accel/root.h"

#include <stdlib.h>

struct layout {
	struct accel *accel;
	struct bvh *bvh;
	const struct bvh_draft *draft;
	uint32_t nodes, ids;
};

static uint32_t count_nodes(const struct bvh_draft *d, uint32_t node, int depth, int *deepest)
{
	const struct bvh_draft_node *n = &d->nodes[node];
	*deepest = depth > *deepest ? depth : *deepest;
	if (n->count || depth > BVH_DEEPEST)
		return 1;
	return 1 + count_nodes(d, n->first, depth + 1, deepest) + count_nodes(d, n->first + 1, depth + 1, deepest);
}

/* A box in the scene, larger by the slack: surface in a plane that splits space is inside on both sides of it, however the plane is
 * rounded. */
static struct box scene_box(const struct bvh_draft *d, const struct bvh_draft_node *n, double slack)
{
	struct box b;
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = n->lo[i] / d->frame.scale + d->frame.center.a[i] - slack;
		b.hi.a[i] = n->hi[i] / d->frame.scale + d->frame.center.a[i] + slack;
	}
	return b;
}

/* A leaf: its list, and the exact box of the primitives; of parts, the box the builder gave it. */
static void fill_leaf(struct layout *l, struct bvh_node *n, const struct bvh_draft_node *from)
{
	const struct bvh_draft *d = l->draft;
	n->first = l->ids;
	n->count = from->count;
	n->bounds = d->parts ? scene_box(d, from, l->accel->slack) : box_empty();
	for (uint32_t i = 0; i < from->count; i++) {
		uint32_t id = d->refs[from->first + i].id;
		struct box b = primitive_bounds(&d->primitives->all[id]);
		l->bvh->ids[l->ids++] = id;
		if (!d->parts)
			box_join(&n->bounds, &b);
	}
	l->accel->leaves++;
}

static void fill(struct layout *l, uint32_t node)
{
	const struct bvh_draft_node *from = &l->draft->nodes[node];
	struct bvh_node *n = &l->bvh->nodes[l->nodes++];
	if (from->count) {
		fill_leaf(l, n, from);
	} else {
		fill(l, from->first);
		n->right = l->nodes;
		fill(l, from->first + 1);
		n->bounds = n[1].bounds;
		box_join(&n->bounds, &l->bvh->nodes[n->right].bounds);
	}
	n->skip = l->nodes;
}

int bvh_lay_out(struct accel *a, struct bvh *b, const struct bvh_draft *d, struct err *e)
{
	struct layout l = { a, b, d, 0, 0 };
	uint32_t nodes = count_nodes(d, 0, 0, &a->depth);
	if (a->depth > BVH_DEEPEST)
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh: the tree is deeper than %d; another builder makes a shallower one",
		              (int)BVH_DEEPEST);
	b->nodes = NEW(&a->mem, struct bvh_node, nodes);
	b->ids = NEW(&a->mem, uint32_t, d->ref_count);
	if (!b->nodes || !b->ids)
		return err_memory(e, "bvh");
	fill(&l, 0);
	a->nodes = nodes;
	a->references = l.ids;
	return 0;
}
