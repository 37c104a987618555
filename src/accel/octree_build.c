/* Building an octree: split while the criterion wants it, optionally balance, then lay nodes and lists out depth first
 * and link the leaves. */
#include "accel/octree.h"
#include "accel/screen.h"
#include "base/grow.h"
#include "geom/triangle.h"

#include <stdlib.h>
#include <string.h>

struct box octree_bounds(const struct box *root, const struct octree *o, const struct octree_node *n)
{
	struct box b;
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = octree_plane(root, o, i, n->cell[i]);
		b.hi.a[i] = octree_plane(root, o, i, n->cell[i] + octree_side(n->depth));
	}
	return b;
}

static int reserve_refs(struct octree_builder *b, size_t more, struct err *e)
{
	void *refs = b->tree.refs;
	int status = array_reserve(&refs, b->tree.ref_count, &b->ref_room, more, sizeof *b->tree.refs, "octree", e);
	b->tree.refs = refs;
	return status;
}

static int reserve_nodes(struct octree_builder *b, size_t more, struct err *e)
{
	void *nodes = b->tree.nodes;
	int status = array_reserve(&nodes, b->tree.node_count, &b->node_room, more, sizeof *b->tree.nodes, "octree", e);
	b->tree.nodes = nodes;
	return status;
}

/* The half space boxes of a split: child boxes widened by slack, and the middle. */
struct split {
	struct box child[8];
	struct vec middle;
	double slack;
};

static struct split make_split(const struct octree_builder *b, const struct octree_node *n)
{
	struct split s = { .slack = b->slack };
	struct box whole = octree_bounds(b->root, &b->tree, n);
	int32_t half = octree_side(n->depth) / 2;
	for (int i = 0; i < 3; i++)
		s.middle.a[i] = octree_plane(b->root, &b->tree, i, n->cell[i] + half);
	for (int c = 0; c < 8; c++)
		for (int i = 0; i < 3; i++) {
			bool upper = c >> i & 1;
			s.child[c].lo.a[i] = (upper ? s.middle.a[i] : whole.lo.a[i]) - b->slack;
			s.child[c].hi.a[i] = (upper ? whole.hi.a[i] : s.middle.a[i]) + b->slack;
		}
	return s;
}

/* The children, as bits, whose widened boxes a primitive of the parent's list meets. Where the bounding box leaves one child only,
 * that child it is: the primitive meets the parent, and the rest of the parent is out of its reach. */
static unsigned meets_children(const struct octree_builder *b, const struct split *s, uint32_t id)
{
	static const unsigned lower[3] = { 0x55, 0x33, 0x0f };
	const struct box *box = &b->bounds[id];
	unsigned mask = 0xff;
	for (int i = 0; i < 3; i++) {
		if (box->lo.a[i] > s->middle.a[i] + s->slack)
			mask &= ~lower[i];
		if (box->hi.a[i] < s->middle.a[i] - s->slack)
			mask &= lower[i];
	}
	if (b->tree.options.overlap == OVERLAP_BBOX || (mask & (mask - 1)) == 0)
		return mask;
	const struct primitive *p = &b->primitives->all[id];
	for (int c = 0; c < 8; c++)
		if (mask >> c & 1 && !(p->kind == PRIMITIVE_TRIANGLE ? triangle_touches_inner(&p->triangle, &s->child[c])
		                                                     : primitive_touches(p, &s->child[c])))
			mask &= ~(1u << c);
	return mask;
}

static int add_children(struct octree_builder *b, uint32_t n, struct err *e)
{
	if (reserve_nodes(b, 8, e) != 0)
		return -1;
	struct octree_node *parent = &b->tree.nodes[n];
	parent->inner = true;
	parent->child = b->tree.node_count;
	int32_t half = octree_side(parent->depth) / 2;
	for (int c = 0; c < 8; c++) {
		struct octree_node *child = &b->tree.nodes[b->tree.node_count++];
		*child = (struct octree_node){ .depth = (uint8_t)(parent->depth + 1) };
		for (int i = 0; i < 3; i++)
			child->cell[i] = parent->cell[i] + (c >> i & 1) * half;
	}
	return 0;
}

int octree_split(struct octree_builder *b, uint32_t n, struct err *e)
{
	uint32_t count = b->tree.nodes[n].count, first = b->tree.nodes[n].first, sum[8] = { 0 };
	uint8_t few[256], *mask = count <= sizeof few ? few : malloc(count);
	if (!mask)
		return err_memory(e, "octree");
	struct split s = make_split(b, &b->tree.nodes[n]);
	size_t total = 0;
	for (uint32_t i = 0; i < count; i++) {
		mask[i] = (uint8_t)meets_children(b, &s, b->tree.refs[first + i]);
		for (int c = 0; c < 8; c++)
			sum[c] += mask[i] >> c & 1;
	}
	for (int c = 0; c < 8; c++)
		total += sum[c];
	int status = add_children(b, n, e) != 0 || reserve_refs(b, total, e) != 0 ? -1 : 0;
	for (int c = 0; status == 0 && c < 8; c++) {
		struct octree_node *child = &b->tree.nodes[b->tree.nodes[n].child + (uint32_t)c];
		child->first = b->tree.ref_count;
		child->count = sum[c];
		for (uint32_t i = 0; i < count; i++)
			if (mask[i] >> c & 1)
				b->tree.refs[b->tree.ref_count++] = b->tree.refs[first + i];
	}
	if (mask != few)
		free(mask);
	return status;
}

int octree_builder_open(struct octree_builder *b, const struct accel *a, const struct octree_options *o, struct err *e)
{
	*b = (struct octree_builder){ .primitives = a->primitives, .root = &a->root, .slack = a->slack, .tree.options = *o };
	/* In the fourth lane nothing is ever outside. */
	b->tree.lo = axes_of(a->root.lo, -INFINITY);
	b->tree.hi = axes_of(a->root.hi, INFINITY);
	b->tree.step = (b->tree.hi - b->tree.lo) / OCTREE_CELLS;
	b->tree.per_step = 1 / b->tree.step;
	b->tree.center = vec_scale(vec_add(a->root.lo, a->root.hi), 0.5);
	b->tree.diagonal = box_diagonal(&a->root);
	uint32_t count = a->primitives->count;
	b->bounds = malloc((count + 1) * sizeof *b->bounds);
	if (!b->bounds)
		return err_memory(e, "octree");
	if (reserve_nodes(b, 64, e) != 0 || reserve_refs(b, 2 * (size_t)count, e) != 0)
		return -1;
	b->tree.nodes[b->tree.node_count++] = (struct octree_node){ .count = count };
	for (uint32_t i = 0; i < count; i++) {
		b->bounds[i] = primitive_bounds(&a->primitives->all[i]);
		b->tree.refs[b->tree.ref_count++] = i;
	}
	for (uint32_t n = 0; n < b->tree.node_count; n++) {
		const struct octree_node *node = &b->tree.nodes[n];
		if (octree_wants_split(b->primitives, b->root, &b->tree, node, b->tree.refs + node->first) && octree_split(b, n, e) != 0)
			return -1;
	}
	return 0;
}

void octree_builder_close(struct octree_builder *b)
{
	free(b->bounds);
	free(b->tree.nodes);
	free(b->tree.refs);
}

/* Copy node 'from' of the builder to place 'to' of the tree, then what lies below it. */
static void lay_out(struct octree *to_tree, uint32_t to, const struct octree *from_tree, uint32_t from)
{
	struct octree_node *n = &to_tree->nodes[to];
	const struct octree_node *old = &from_tree->nodes[from];
	*n = *old;
	if (!n->inner) {
		bool is_short = n->count <= OCTREE_SHORT;
		memcpy(is_short ? n->ids : to_tree->refs + to_tree->ref_count, from_tree->refs + old->first, n->count * sizeof *n->ids);
		if (!is_short) {
			n->first = to_tree->ref_count;
			to_tree->ref_count += n->count;
		}
		return;
	}
	n->child = to_tree->node_count;
	n->count = 0;
	to_tree->node_count += 8;
	for (uint32_t c = 0; c < 8; c++)
		lay_out(to_tree, n->child + c, from_tree, old->child + c);
}

/* Give node n the nodes across its faces: a sibling, or what lies across the parent's face, or its child there. */
static void link_node(struct octree *o, uint32_t n, const uint32_t *across)
{
	struct octree_node *node = &o->nodes[n];
	for (int f = 0; f < 6; f++)
		node->link[f] = across[f];
	for (uint32_t c = 0; node->inner && c < 8; c++) {
		uint32_t next[6];
		for (uint32_t f = 0; f < 6; f++) {
			uint32_t bit = 1u << f / 2, upper = f & 1;
			if ((c & bit ? 1u : 0u) != upper)
				next[f] = node->child + (c ^ bit);
			else if (across[f] != NO_NODE && o->nodes[across[f]].inner)
				next[f] = o->nodes[across[f]].child + (c ^ bit);
			else
				next[f] = across[f];
		}
		link_node(o, node->child + c, next);
	}
}

static void sum_up(struct accel *a, const struct octree *o)
{
	a->nodes = o->node_count;
	for (uint32_t i = 0; i < o->node_count; i++) {
		const struct octree_node *n = &o->nodes[i];
		if (n->inner)
			continue;
		a->leaves++;
		a->empty_leaves += n->count == 0;
		a->references += n->count;
		a->depth = n->depth > a->depth ? n->depth : a->depth;
	}
}

/* The table that spares rays the first levels: no more entries than leaves, so that it stays small beside the tree. */
static int make_start(struct accel *a, struct octree *o, struct err *e)
{
	while (o->start_depth < 6 && (uint64_t)8 << 3 * o->start_depth <= a->leaves)
		o->start_depth++;
	uint32_t count = 1u << 3 * o->start_depth, low = (1u << o->start_depth) - 1;
	o->start = NEW(&a->mem, uint32_t, count);
	if (!o->start)
		return err_memory(e, "octree");
	for (uint32_t i = 0; i < count; i++) {
		int shift = OCTREE_LEVELS - o->start_depth;
		const int32_t at[3] = { (int32_t)((i & low) << shift), (int32_t)((i >> o->start_depth & low) << shift),
			                (int32_t)((i >> 2 * o->start_depth) << shift) };
		uint32_t n = 0;
		while (o->nodes[n].inner && o->nodes[n].depth < o->start_depth)
			n = octree_child_toward(&o->nodes[n], at);
		o->start[i] = n;
	}
	return 0;
}

static int finish(struct accel *a, const struct octree_builder *b, struct err *e)
{
	size_t refs = 0;
	for (uint32_t n = 0; n < b->tree.node_count; n++)
		if (!b->tree.nodes[n].inner && b->tree.nodes[n].count > OCTREE_SHORT)
			refs += b->tree.nodes[n].count;
	struct octree *o = NEW(&a->mem, struct octree, 1);
	if (!o)
		return err_memory(e, "octree");
	*o = b->tree;
	o->nodes = NEW(&a->mem, struct octree_node, b->tree.node_count);
	o->refs = NEW(&a->mem, uint32_t, refs);
	o->screens = screens_make(&a->mem, a->primitives, o->center);
	if (!o->nodes || !o->refs || !o->screens)
		return err_memory(e, "octree");
	o->node_count = 1;
	o->ref_count = 0;
	lay_out(o, 0, &b->tree, 0);
	link_node(o, 0, (const uint32_t[6]){ NO_NODE, NO_NODE, NO_NODE, NO_NODE, NO_NODE, NO_NODE });
	a->impl = o;
	sum_up(a, o);
	return make_start(a, o, e);
}

int octree_build(struct accel *a, const void *opt, struct err *e)
{
	const struct octree_options *o = opt;
	a->root = root_box(&a->primitives->bounds, (enum root_kind)o->root);
	a->slack = 1e-9 * box_diagonal(&a->root);
	struct octree_builder b;
	int status = octree_builder_open(&b, a, o, e);
	if (status == 0 && o->balanced)
		status = octree_balance(&b, e);
	if (status == 0)
		status = finish(a, &b, e);
	octree_builder_close(&b);
	return status;
}
