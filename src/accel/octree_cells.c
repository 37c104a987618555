/* An octree as others see it: its cells, and whether its invariants hold. */
#include "accel/octree.h"

static int visit(const struct accel *a, uint32_t n, cell_fn *fn, void *ctx)
{
	const struct octree *o = a->impl;
	const struct octree_node *node = &o->nodes[n];
	struct cell c = { .bounds = octree_bounds(&a->root, o, node), .depth = node->depth, .leaf = !node->inner };
	c.area = box_area(&c.bounds);
	if (c.leaf) {
		c.ids = octree_list(o, node);
		c.count = node->count;
		for (int f = 0; f < 6; f++) {
			const struct octree_node *across = node->link[f] == NO_NODE ? NULL : &o->nodes[node->link[f]];
			if (across && !across->inner)
				c.steps[f] = node->depth - across->depth;
		}
	}
	int status = fn(ctx, &c);
	for (uint32_t i = 0; status == 0 && node->inner && i < 8; i++)
		status = visit(a, node->child + i, fn, ctx);
	return status;
}

int octree_cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	return visit(a, 0, fn, ctx);
}

/* A leaf's link must be the node of its own size across the face, or the larger leaf that covers it. */
static bool link_holds(const struct octree *o, const struct octree_node *n, int f)
{
	int axis = f / 2;
	int32_t at[3] = { n->cell[0], n->cell[1], n->cell[2] };
	at[axis] += f % 2 ? octree_side(n->depth) : -1;
	if (at[axis] < 0 || at[axis] >= OCTREE_CELLS)
		return n->link[f] == NO_NODE;
	uint32_t m = 0;
	while (o->nodes[m].inner && o->nodes[m].depth < n->depth)
		m = octree_child_toward(&o->nodes[m], at);
	return n->link[f] == m;
}

static bool list_holds(const struct accel *a, const struct octree_node *n)
{
	const struct octree *o = a->impl;
	struct box b = octree_bounds(&a->root, o, n);
	uint32_t found = 0;
	for (uint32_t id = 0; id < a->primitives->count; id++) {
		bool listed = found < n->count && octree_list(o, n)[found] == id;
		if (!listed && primitive_touches(&a->primitives->all[id], &b))
			return false;
		found += listed;
	}
	return found == n->count;
}

static bool is_balanced(const struct octree *o, const struct octree_node *n)
{
	for (int f = 0; f < 6; f++)
		if (n->link[f] != NO_NODE && !o->nodes[n->link[f]].inner && n->depth > o->nodes[n->link[f]].depth + 1)
			return false;
	return true;
}

int octree_check(const struct accel *a, struct err *e)
{
	const struct octree *o = a->impl;
	for (uint32_t i = 0; i < o->node_count; i++) {
		const struct octree_node *n = &o->nodes[i];
		if (n->inner)
			continue;
		if (octree_wants_split(a->primitives, &a->root, o, n, octree_list(o, n)))
			return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "octree: leaf %u should have been split", i);
		for (int f = 0; f < 6; f++)
			if (!link_holds(o, n, f))
				return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "octree: link %d of leaf %u is wrong", f, i);
		if (!list_holds(a, n))
			return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "octree: the list of leaf %u is not what it meets", i);
		if (o->options.balanced && !is_balanced(o, n))
			return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "octree: leaf %u is unbalanced", i);
	}
	return 0;
}
