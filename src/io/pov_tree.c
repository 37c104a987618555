#include "io/pov_tree.h"

#include "io/pov_facets.h"

enum { LEAF_MOST = 4 };

struct builder {
	struct pov_tree *t;
	const struct box *boxes;
};

static double middle(const struct builder *b, uint32_t i, int axis)
{
	return b->boxes[i].lo.a[axis] + b->boxes[i].hi.a[axis];
}

static bool before(const struct builder *b, uint32_t i, uint32_t j, int axis)
{
	double x = middle(b, i, axis), y = middle(b, j, axis);
	return x < y || (x == y && i < j);
}

/* Hoare's selection: no thing before the k-th comes after one behind it. */
static void halve(const struct builder *b, uint32_t *o, ptrdiff_t n, ptrdiff_t k, int axis)
{
	ptrdiff_t low = 0, high = n - 1;
	while (low < high) {
		uint32_t pivot = o[low + (high - low) / 2];
		ptrdiff_t i = low, j = high;
		while (i <= j) {
			while (before(b, o[i], pivot, axis))
				i++;
			while (before(b, pivot, o[j], axis))
				j--;
			if (i > j)
				break;
			uint32_t swap = o[i];
			o[i++] = o[j];
			o[j--] = swap;
		}
		if (k <= j)
			high = j;
		else if (k >= i)
			low = i;
		else
			return;
	}
}

static void build(struct builder *b, uint32_t first, uint32_t count)
{
	uint32_t self = b->t->node_count++;
	struct box box = box_empty();
	int axis = 0;
	for (uint32_t i = first; i < first + count; i++)
		box_join(&box, &b->boxes[b->t->order[i]]);
	struct vec side = vec_sub(box.hi, box.lo);
	for (int i = 1; i < 3; i++)
		axis = side.a[i] > side.a[axis] ? i : axis;
	b->t->nodes[self] = (struct pov_tree_node){ .box = box, .first = first };
	if (count <= LEAF_MOST) {
		b->t->nodes[self].count = count;
	} else {
		halve(b, b->t->order + first, count, count / 2, axis);
		build(b, first, count / 2);
		build(b, first + count / 2, count - count / 2);
	}
	b->t->nodes[self].skip = b->t->node_count;
}

int pov_tree_build(struct pov_tree *t, struct arena *a, const struct box *boxes, uint32_t n)
{
	struct builder b = { t, boxes };
	uint32_t kept = 0;
	*t = (struct pov_tree){ .nodes = NEW(a, struct pov_tree_node, n + 1), .order = NEW(a, uint32_t, n) };
	if (!t->nodes || !t->order)
		return -1;
	for (uint32_t i = 0; i < n; i++)
		if (!box_is_empty(&boxes[i]))
			t->order[kept++] = i;
	if (kept)
		build(&b, 0, kept);
	return 0;
}

void pov_tree_visit(const struct pov_tree *t, pov_tree_enter_fn *enter, pov_tree_leaf_fn *leaf, void *context)
{
	for (uint32_t i = 0; i < t->node_count;) {
		const struct pov_tree_node *node = &t->nodes[i];
		if (!enter(context, &node->box)) {
			i = node->skip;
			continue;
		}
		for (uint32_t k = 0; k < node->count; k++)
			leaf(context, t->order[node->first + k]);
		i++;
	}
}
