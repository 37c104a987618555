/* Building a tree of planes, depth first: lists wait on a stack, nodes and leaves' lists go straight to where they stay.
 *
 * Of a large scene only the top is built that way: a cell that lists a small share of the primitives is put aside with its list. These
 * parts are built on several threads, each as a tree of its own, and then appended in the order in which they were put aside. Which
 * cells they are does not depend on the threads, nor then does the tree. */
#include "accel/planes.h"
#include "base/grow.h"
#include "base/par.h"
#include "geom/triangle.h"

#include <stdlib.h>
#include <string.h>

const char *const plane_root_words[] = { "cube", "box", NULL };
const char *const plane_travel_words[] = { "recursive", "restart", NULL };
const char *const plane_mailbox_words[] = { "none", "one", "full", NULL };
const char *const plane_stop_words[] = { "none", "model", "exact", NULL };

/* The same for each of the builder's arrays. */
#define RESERVE(what, array, count, room) \
	static int reserve_##what(struct plane_builder *b, size_t more, struct err *e) \
	{ \
		void *grown = b->array; \
		int status = array_reserve(&grown, b->count, &b->room, more, sizeof *b->array, "tree of planes", e); \
		b->array = grown; \
		return status; \
	}
RESERVE(ids, ids, id_count, id_room)
RESERVE(nodes, tree.nodes, tree.node_count, node_room)
RESERVE(boxes, tree.boxes, tree.box_count, box_room)
RESERVE(refs, tree.refs, tree.ref_count, ref_room)

/* A cell on the way down: node n, its list at ids[first .. first + count). */
struct task {
	struct box bounds;
	size_t first;
	uint32_t count, node;
	int level;
};

/* A part put aside: where its root is to go, and its list. */
struct part {
	struct task task;
	uint32_t *ids; /* from malloc */
	struct plane_builder builder;
	struct err err;
	int status;
};

/* Cells that list up to 'share' primitives are put aside; in scenes of fewer than PARTS_LEAST none are. */
enum { PARTS = 16, PARTS_LEAST = 4096 };

struct plane_parts {
	struct part *all;
	size_t count, room;
	uint32_t share;
};

static int put_aside(struct plane_builder *b, const struct task *t, struct err *e)
{
	struct plane_parts *parts = b->parts;
	void *grown = parts->all;
	int status = array_reserve(&grown, parts->count, &parts->room, 1, sizeof *parts->all, "tree of planes", e);
	parts->all = grown;
	if (status != 0)
		return -1;
	struct part *p = &parts->all[parts->count];
	*p = (struct part){ .task = *t, .ids = malloc((t->count + (size_t)1) * sizeof *p->ids) };
	if (!p->ids)
		return err_memory(e, "tree of planes");
	memcpy(p->ids, b->ids + t->first, t->count * sizeof *p->ids);
	parts->count++;
	return 0;
}

static int make_leaf(struct plane_builder *b, const struct task *t, struct err *e)
{
	struct plane_node *n = &b->tree.nodes[t->node];
	if (reserve_refs(b, t->count, e) != 0)
		return -1;
	if (t->count > 0)
		memcpy(b->tree.refs + b->tree.ref_count, b->ids + t->first, t->count * sizeof *b->ids);
	n->kind = NODE_LEAF;
	n->first = b->tree.ref_count;
	n->count = t->count;
	b->tree.ref_count += t->count;
	return 0;
}

/* The box around what a cell lists, standing off by the margin, within the cell; *infinite: the same with infinite sides where it
 * ends with the cell. False when it is not small enough to be worth a node. */
static bool find_box(const struct plane_builder *b, const struct task *t, struct box *inside, struct box *infinite)
{
	struct box all = box_empty();
	if (b->tree.options.boxes <= 0 || t->count == 0)
		return false;
	for (uint32_t i = 0; i < t->count; i++)
		box_join(&all, &b->bounds[b->ids[t->first + i]]);
	for (int i = 0; i < 3; i++) {
		double low = all.lo.a[i] - b->margin, high = all.hi.a[i] + b->margin;
		bool ends_low = low <= t->bounds.lo.a[i] + b->margin, ends_high = high >= t->bounds.hi.a[i] - b->margin;
		inside->lo.a[i] = ends_low ? t->bounds.lo.a[i] : low;
		inside->hi.a[i] = ends_high ? t->bounds.hi.a[i] : high;
		infinite->lo.a[i] = ends_low ? -INFINITY : low;
		infinite->hi.a[i] = ends_high ? INFINITY : high;
	}
	return box_area(inside) < b->tree.options.boxes * box_area(&t->bounds);
}

/* Put a node with a box above the task's node. */
static int add_box(struct plane_builder *b, struct task *t, struct err *e)
{
	struct box inside, infinite;
	if (!find_box(b, t, &inside, &infinite))
		return 0;
	if (reserve_boxes(b, 1, e) != 0 || reserve_nodes(b, 1, e) != 0)
		return -1;
	struct plane_node *n = &b->tree.nodes[t->node];
	n->kind = NODE_BOX;
	n->child = b->tree.node_count;
	n->first = b->tree.box_count;
	b->tree.boxes[b->tree.box_count++] = infinite;
	b->tree.nodes[b->tree.node_count] = (struct plane_node){ .depth = (uint8_t)(n->depth + 1) };
	t->node = b->tree.node_count++;
	t->bounds = inside;
	return 0;
}

/* How much farther into a cell than to within slack of it a primitive must come to be listed. */
static double find_depth(const struct plane_builder *b, const struct box *own, int axis)
{
	return accel_wants_inside(b->accel, own, axis) ? 2 * b->slack : 0;
}

/* half: widened by slack. */
static bool touches(const struct plane_builder *b, uint32_t id, const struct box *half)
{
	const struct primitive *p = &b->accel->primitives->all[id];
	struct box inner;
	if (b->accel->inner_lists) {
		inner = *half;
		for (int i = 0; i < 3; i++) {
			double depth = find_depth(b, &b->bounds[id], i);
			inner.lo.a[i] += depth;
			inner.hi.a[i] -= depth;
		}
		half = &inner;
	}
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_touches_inner(&p->triangle, half) : primitive_touches(p, half);
}

static struct box widen(struct box b, double slack)
{
	const struct vec by = vec(slack, slack, slack);
	return (struct box){ vec_sub(b.lo, by), vec_add(b.hi, by) };
}

/* Share the task's list out between its halves: what lies clear of the plane by its bounding box, the rest by its surface. The lists
 * follow each other behind the stack; nothing is popped. */
static int share_out(struct plane_builder *b, const struct task *t, int axis, struct task *half, struct err *e)
{
	const struct box wide[2] = { widen(half[0].bounds, b->slack), widen(half[1].bounds, b->slack) };
	const double low = wide[1].lo.a[axis], high = wide[0].hi.a[axis];
	if (reserve_ids(b, 2 * (size_t)t->count, e) != 0)
		return -1;
	const uint32_t *from = b->ids + t->first;
	uint32_t *lower = b->ids + b->id_count, *upper = lower + t->count, n = 0, m = 0;
	for (uint32_t i = 0; i < t->count; i++) {
		const struct box *s = &b->bounds[from[i]];
		double depth = find_depth(b, s, axis);
		bool below = s->hi.a[axis] < low + depth, above = s->lo.a[axis] > high - depth;
		lower[n] = from[i];
		n += below || (!above && touches(b, from[i], &wide[0]));
		upper[m] = from[i];
		m += above || (!below && touches(b, from[i], &wide[1]));
	}
	memmove(lower + n, upper, m * sizeof *upper);
	half[0].first = b->id_count;
	half[0].count = n;
	half[1].first = b->id_count + n;
	half[1].count = m;
	b->id_count += (size_t)n + m;
	return 0;
}

static int split(struct plane_builder *b, struct task t, struct err *e)
{
	int axis;
	double plane;
	if (b->parts && t.count <= b->parts->share)
		return put_aside(b, &t, e);
	if (add_box(b, &t, e) != 0)
		return -1;
	const struct plane_cell c = { t.bounds, b->ids + t.first, t.count, t.level };
	if (t.level >= b->tree.options.max_depth || !b->rule(b, &c, &axis, &plane))
		return make_leaf(b, &t, e);
	if (reserve_nodes(b, 2, e) != 0)
		return -1;
	struct plane_node *n = &b->tree.nodes[t.node];
	*n = (struct plane_node){ .plane = plane, .child = b->tree.node_count, .kind = (uint8_t)axis, .depth = n->depth };
	struct task half[2] = { { .bounds = t.bounds, .node = n->child, .level = t.level + 1 },
		                { .bounds = t.bounds, .node = n->child + 1, .level = t.level + 1 } };
	half[0].bounds.hi.a[axis] = half[1].bounds.lo.a[axis] = plane;
	for (int i = 0; i < 2; i++)
		b->tree.nodes[b->tree.node_count++] = (struct plane_node){ .depth = (uint8_t)(n->depth + 1) };
	size_t mark = b->id_count;
	if (share_out(b, &t, axis, half, e) != 0 || split(b, half[0], e) != 0 || split(b, half[1], e) != 0)
		return -1;
	b->id_count = mark;
	return 0;
}

/* Copy the finished tree to where it stays, and sum up. */
static int finish(struct accel *a, const struct plane_builder *b, struct err *e)
{
	struct planes *p = NEW(&a->mem, struct planes, 1);
	if (!p)
		return err_memory(e, "tree of planes");
	*p = b->tree;
	p->nodes = NEW(&a->mem, struct plane_node, p->node_count);
	p->boxes = NEW(&a->mem, struct box, p->box_count);
	p->refs = NEW(&a->mem, uint32_t, p->ref_count);
	if (!p->nodes || !p->boxes || !p->refs)
		return err_memory(e, "tree of planes");
	memcpy(p->nodes, b->tree.nodes, p->node_count * sizeof *p->nodes);
	if (p->box_count)
		memcpy(p->boxes, b->tree.boxes, p->box_count * sizeof *p->boxes);
	if (p->ref_count)
		memcpy(p->refs, b->tree.refs, p->ref_count * sizeof *p->refs);
	a->impl = p;
	a->nodes = p->node_count;
	a->references = p->ref_count;
	for (uint32_t i = 0; i < p->node_count; i++) {
		const struct plane_node *n = &p->nodes[i];
		a->leaves += n->kind == NODE_LEAF;
		a->empty_leaves += n->kind == NODE_LEAF && n->count == 0;
		a->depth = n->depth > a->depth ? n->depth : a->depth;
	}
	return 0;
}

/* Room for the lists of 'count' primitives, and the root. */
static int open_builder(struct plane_builder *b, const uint32_t *ids, uint32_t count, int depth, struct err *e)
{
	bool lost = !(b->spare = malloc((count + (size_t)1) * sizeof *b->spare));
	for (int i = 0; i < 3; i++) {
		lost |= !(b->low[i] = malloc((count + (size_t)1) * sizeof *b->low[i]));
		lost |= !(b->high[i] = malloc((count + (size_t)1) * sizeof *b->high[i]));
	}
	if (lost)
		return err_memory(e, "tree of planes");
	if (reserve_ids(b, count + (size_t)1, e) != 0 || reserve_nodes(b, 64, e) != 0)
		return -1;
	b->tree.nodes[b->tree.node_count++] = (struct plane_node){ .depth = (uint8_t)depth };
	for (uint32_t i = 0; i < count; i++)
		b->ids[b->id_count++] = ids ? ids[i] : i;
	return 0;
}

static void close_builder(struct plane_builder *b)
{
	free(b->spare);
	for (int i = 0; i < 3; i++) {
		free(b->low[i]);
		free(b->high[i]);
	}
	free(b->ids);
	free(b->tree.nodes);
	free(b->tree.boxes);
	free(b->tree.refs);
}

static void build_part(void *ctx, size_t i)
{
	const struct plane_builder *top = ctx;
	struct part *p = &top->parts->all[i];
	struct plane_builder *b = &p->builder;
	*b = (struct plane_builder){ .accel = top->accel, .options = top->options, .rule = top->rule, .slack = top->slack, .margin = top->margin,
		                     .bounds = top->bounds, .tree.options = top->tree.options };
	p->status = open_builder(b, p->ids, p->task.count, top->tree.nodes[p->task.node].depth, &p->err);
	if (p->status == 0)
		p->status = split(b, (struct task){ .bounds = p->task.bounds, .count = p->task.count, .level = p->task.level }, &p->err);
}

/* Append a part's nodes, its root in the place that waits for it, its boxes and its lists. */
static int append_part(struct plane_builder *b, const struct part *p, struct err *e)
{
	const struct planes *from = &p->builder.tree;
	struct planes *to = &b->tree;
	if (reserve_nodes(b, from->node_count, e) != 0 || reserve_boxes(b, from->box_count, e) != 0 || reserve_refs(b, from->ref_count, e) != 0)
		return -1;
	for (uint32_t i = 0; i < from->node_count; i++) {
		struct plane_node n = from->nodes[i];
		n.child = n.kind == NODE_LEAF ? 0 : n.child - 1 + to->node_count;
		n.first += n.kind == NODE_LEAF ? to->ref_count : n.kind == NODE_BOX ? to->box_count : 0;
		to->nodes[i == 0 ? p->task.node : to->node_count + i - 1] = n;
	}
	if (from->box_count)
		memcpy(to->boxes + to->box_count, from->boxes, from->box_count * sizeof *from->boxes);
	if (from->ref_count)
		memcpy(to->refs + to->ref_count, from->refs, from->ref_count * sizeof *from->refs);
	to->node_count += from->node_count - 1;
	to->box_count += from->box_count;
	to->ref_count += from->ref_count;
	return 0;
}

/* The top, then the parts that it has put aside. */
static int build_tree(struct plane_builder *b, struct err *e)
{
	const struct accel *a = b->accel;
	struct plane_parts parts = { .share = a->primitives->count / PARTS };
	b->parts = a->primitives->count >= PARTS_LEAST ? &parts : NULL;
	int status = open_builder(b, NULL, a->primitives->count, 0, e);
	if (status == 0)
		status = split(b, (struct task){ .bounds = a->root, .count = a->primitives->count }, e);
	if (status == 0)
		par_for(a->threads, parts.count, build_part, b);
	for (size_t i = 0; i < parts.count; i++) {
		struct part *p = &parts.all[i];
		if (status == 0 && p->status != 0)
			*e = p->err;
		if (status == 0)
			status = p->status == 0 ? append_part(b, p, e) : -1;
		close_builder(&p->builder);
		free(p->ids);
	}
	free(parts.all);
	b->parts = NULL;
	return status;
}

int planes_build(struct accel *a, const void *options, const struct plane_options *common, plane_rule *rule, struct err *e)
{
	const struct primitives *p = a->primitives;
	struct plane_builder b = { .accel = a, .options = options, .rule = rule, .tree.options = *common };
	struct vec size;
	a->root = root_box(&p->bounds, (enum root_kind)common->root);
	a->slack = 1e-9 * box_diagonal(&a->root);
	a->plane_tests = true;
	a->travel = TRAVEL_RECURSIVE + (enum travel)common->travel;
	a->mailbox = (enum mailbox_kind)common->mailbox;
	size = vec_sub(a->root.hi, a->root.lo);
	b.slack = a->slack;
	b.margin = fmax(size.x, fmax(size.y, size.z)) * 0x1p-24;
	b.bounds = malloc(p->count * sizeof *b.bounds);
	int status = b.bounds ? 0 : err_memory(e, "tree of planes");
	for (uint32_t i = 0; b.bounds && i < p->count; i++)
		b.bounds[i] = primitive_bounds(&p->all[i]);
	if (status == 0)
		status = build_tree(&b, e);
	if (status == 0)
		status = finish(a, &b, e);
	close_builder(&b);
	free(b.bounds);
	return status;
}
