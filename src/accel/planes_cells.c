/* The cells of a tree of planes. */
#include "accel/planes.h"

/* The part of a cell inside a box whose infinite sides cut nothing. */
static struct box cut(const struct box *cell, const struct box *b)
{
	struct box c = *cell;
	for (int i = 0; i < 3; i++) {
		c.lo.a[i] = fmax(c.lo.a[i], b->lo.a[i]);
		c.hi.a[i] = fmin(c.hi.a[i], b->hi.a[i]);
	}
	return c;
}

static int visit(const struct planes *p, uint32_t at, const struct box *bounds, cell_fn *fn, void *ctx)
{
	const struct plane_node *n = &p->nodes[at];
	struct cell c = { .bounds = *bounds, .area = box_area(bounds), .depth = n->depth, .leaf = n->kind == NODE_LEAF,
		          .box = n->kind == NODE_BOX };
	if (c.leaf) {
		c.ids = p->refs + n->first;
		c.count = n->count;
	}
	int status = fn(ctx, &c);
	if (status != 0 || c.leaf)
		return status;
	if (c.box) {
		struct box inside = cut(bounds, &p->boxes[n->first]);
		return visit(p, n->child, &inside, fn, ctx);
	}
	struct box half = *bounds;
	half.hi.a[n->kind] = n->plane;
	status = visit(p, n->child, &half, fn, ctx);
	half = *bounds;
	half.lo.a[n->kind] = n->plane;
	return status == 0 ? visit(p, n->child + 1, &half, fn, ctx) : status;
}

int planes_cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	return visit(a->impl, 0, &a->root, fn, ctx);
}
