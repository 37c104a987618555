/* Reinsertion (Bittner, Hapala, Havran 2013): take the nodes of large area out of the tree, one after the other, and put each where it
 * makes the tree cheapest, found by branch and bound. The tree's cost is the sum of the areas of its inner nodes. */
#include "accel/bvh_draft.h"

#include <stdlib.h>

/* Of all nodes, those of the largest area are moved in one round. */
enum { SHARE = 4 };

struct node {
	struct quad_box box;
	uint32_t parent, child[2]; /* inner: two; leaf: child[0] == 0, and the draft's node in child[1] */
	float area;
};

/* A place to look at: adding the box below 'node' costs at least 'cost' in growth above. */
struct place {
	float cost;
	uint32_t node;
};

struct tree {
	struct node *nodes;
	uint32_t count;
	struct place *heap;
	uint32_t waiting;
};

static void push(struct tree *t, struct place p)
{
	uint32_t i = t->waiting++;
	for (; i > 0 && p.cost < t->heap[(i - 1) / 2].cost; i = (i - 1) / 2)
		t->heap[i] = t->heap[(i - 1) / 2];
	t->heap[i] = p;
}

static struct place pop(struct tree *t)
{
	struct place least = t->heap[0], last = t->heap[--t->waiting];
	uint32_t i = 0;
	for (uint32_t k; (k = 2 * i + 1) < t->waiting; i = k) {
		k += k + 1 < t->waiting && t->heap[k + 1].cost < t->heap[k].cost;
		if (last.cost <= t->heap[k].cost)
			break;
		t->heap[i] = t->heap[k];
	}
	t->heap[i] = last;
	return least;
}

/* The node next to which a box of this area costs least. */
static uint32_t find_sibling(struct tree *t, struct quad_box box, float area)
{
	float least = INFINITY;
	uint32_t best = 0;
	t->waiting = 0;
	push(t, (struct place){ 0, 0 });
	while (t->waiting > 0) {
		struct place p = pop(t);
		if (p.cost + area >= least)
			break;
		const struct node *n = &t->nodes[p.node];
		struct quad_box joined = n->box;
		quad_box_join(&joined, box);
		float pair = quad_box_half_area(joined);
		if (p.cost + pair < least) {
			least = p.cost + pair;
			best = p.node;
		}
		float below = p.cost + pair - n->area;
		if (n->child[0] && below + area < least) {
			push(t, (struct place){ below, n->child[0] });
			push(t, (struct place){ below, n->child[1] });
		}
	}
	return best;
}

static void refit(struct tree *t, uint32_t at)
{
	for (;; at = t->nodes[at].parent) {
		struct node *n = &t->nodes[at];
		n->box = t->nodes[n->child[0]].box;
		quad_box_join(&n->box, t->nodes[n->child[1]].box);
		n->area = quad_box_half_area(n->box);
		if (at == 0)
			return;
	}
}

static void replace_child(struct tree *t, uint32_t parent, uint32_t old, uint32_t new)
{
	struct node *p = &t->nodes[parent];
	p->child[p->child[1] == old] = new;
	t->nodes[new].parent = parent;
}

/* Take out a node and its parent, whose place the sibling takes; then the parent joins the node and its new sibling. */
static void reinsert(struct tree *t, uint32_t at)
{
	uint32_t parent = t->nodes[at].parent;
	if (at == 0 || parent == 0)
		return;
	uint32_t sibling = t->nodes[parent].child[t->nodes[parent].child[0] == at], above = t->nodes[parent].parent;
	replace_child(t, above, parent, sibling);
	refit(t, above);
	uint32_t best = find_sibling(t, t->nodes[at].box, t->nodes[at].area);
	if (best == 0)
		best = sibling;
	replace_child(t, t->nodes[best].parent, best, parent);
	t->nodes[parent].child[0] = best;
	t->nodes[parent].child[1] = at;
	t->nodes[best].parent = t->nodes[at].parent = parent;
	refit(t, parent);
}

static uint32_t take(struct tree *t, const struct bvh_draft *d, uint32_t from, uint32_t parent)
{
	uint32_t at = t->count++;
	const struct bvh_draft_node *n = &d->nodes[from];
	struct quad_box box = bvh_node_box(n);
	t->nodes[at] = (struct node){ box, parent, { 0, from }, quad_box_half_area(box) };
	if (n->count == 0) {
		uint32_t left = take(t, d, n->first, at), right = take(t, d, n->first + 1, at);
		t->nodes[at].child[0] = left;
		t->nodes[at].child[1] = right;
	}
	return at;
}

static void emit(const struct tree *t, const struct bvh_draft_node *old, struct bvh_draft *d, uint32_t from, uint32_t to, uint32_t *count)
{
	const struct node *n = &t->nodes[from];
	if (!n->child[0]) {
		d->nodes[to] = old[n->child[1]];
		return;
	}
	uint32_t children = *count;
	*count += 2;
	bvh_node_set(&d->nodes[to], n->box, children, 0);
	emit(t, old, d, n->child[0], children, count);
	emit(t, old, d, n->child[1], children + 1, count);
}

/* The largest first, then the lower number. */
static int compare(const void *a, const void *b)
{
	const struct place *p = a, *q = b;
	return p->cost != q->cost ? (p->cost < q->cost) - (p->cost > q->cost) : (p->node > q->node) - (p->node < q->node);
}

static void optimise(struct tree *t, struct place *order, int rounds)
{
	for (int round = 0; round < rounds; round++) {
		for (uint32_t i = 0; i < t->count; i++)
			order[i] = (struct place){ t->nodes[i].area, i };
		qsort(order, t->count, sizeof *order, compare);
		for (uint32_t i = 0; i < t->count / SHARE; i++)
			reinsert(t, order[i].node);
	}
}

static uint32_t count_nodes(const struct bvh_draft *d, uint32_t node)
{
	const struct bvh_draft_node *n = &d->nodes[node];
	return n->count ? 1 : 1 + count_nodes(d, n->first) + count_nodes(d, n->first + 1);
}

int bvh_optimise(struct bvh_draft *d, int rounds)
{
	uint32_t nodes = count_nodes(d, 0), count = 1;
	struct tree t = { .nodes = arena_pages(nodes * sizeof *t.nodes), .heap = malloc(((size_t)nodes + 1) * sizeof *t.heap) };
	struct place *order = malloc(nodes * sizeof *order);
	struct bvh_draft_node *old = d->nodes, *new = aligned_alloc(64, ((size_t)nodes * sizeof *new + 63) & ~(size_t)63);
	int status = t.nodes && t.heap && order && new ? 0 : -1;
	if (status == 0) {
		take(&t, d, 0, 0);
		optimise(&t, order, rounds);
		d->nodes = new;
		emit(&t, old, d, 0, 0, &count);
		free(d->memory[0]);
		d->memory[0] = new;
	} else {
		free(new);
	}
	free(t.nodes);
	free(t.heap);
	free(order);
	return status;
}
