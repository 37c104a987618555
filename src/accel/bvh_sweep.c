/* Surface area heuristic over every plane between two centroids: the lists are sorted once on each axis and kept sorted while they are
 * divided (Wald 2007). */
#include "accel/bvh_draft.h"

#include <stdlib.h>
#include <string.h>

struct place {
	float at;
	uint32_t ref;
};

static int compare(const void *a, const void *b)
{
	const struct place *p = a, *q = b;
	return p->at != q->at ? (p->at > q->at) - (p->at < q->at) : (p->ref > q->ref) - (p->ref < q->ref);
}

struct builder {
	struct bvh_draft *draft;
	const struct bvh_rules *rules;
	union bvh_ref *refs;          /* in the order given */
	uint32_t *order[3], *scratch; /* refs, sorted on each axis */
	float *right;
	unsigned char *goes_left;
	uint32_t nodes;
};

struct split {
	float cost;
	int axis;
	uint32_t left;
};

static float weigh(const struct builder *b, struct quad_box box, uint32_t count)
{
	return quad_box_half_area(box) * (float)bvh_blocks(count, b->rules->block) * b->rules->test;
}

static struct split find_split(struct builder *b, uint32_t first, uint32_t count)
{
	struct split best = { INFINITY, 0, 0 };
	for (int axis = 0; axis < 3; axis++) {
		const uint32_t *order = &b->order[axis][first];
		struct quad_box box = quad_box_empty();
		for (uint32_t i = count - 1; i > 0; i--) {
			quad_box_join(&box, b->refs[order[i]].box);
			b->right[i] = weigh(b, box, count - i);
		}
		box = quad_box_empty();
		for (uint32_t i = 1; i < count; i++) {
			quad_box_join(&box, b->refs[order[i - 1]].box);
			float cost = weigh(b, box, i) + b->right[i];
			if (cost < best.cost)
				best = (struct split){ cost, axis, i };
		}
	}
	return best;
}

/* Divide the two other orders as the best one is, keeping them sorted. */
static void divide(struct builder *b, uint32_t first, uint32_t count, const struct split *s)
{
	for (uint32_t i = 0; i < count; i++)
		b->goes_left[b->order[s->axis][first + i]] = i < s->left;
	for (int axis = 0; axis < 3; axis++) {
		uint32_t *order = &b->order[axis][first], left = 0, right = 0;
		if (axis == s->axis)
			continue;
		for (uint32_t i = 0; i < count; i++) {
			uint32_t ref = order[i];
			order[left] = ref;
			b->scratch[right] = ref;
			left += b->goes_left[ref];
			right += !b->goes_left[ref];
		}
		memcpy(&order[left], b->scratch, right * sizeof *order);
	}
}

static void build(struct builder *b, uint32_t node, uint32_t first, uint32_t count, int depth)
{
	struct quad_box box = quad_box_empty();
	for (uint32_t i = 0; i < count; i++)
		quad_box_join(&box, b->refs[b->order[0][first + i]].box);
	struct split s = { INFINITY, 0, count / 2 };
	if (count > 1 && depth < BVH_DEPTH - 33)
		s = find_split(b, first, count);
	if (count <= b->rules->most &&
	    weigh(b, box, count) <= (count > 1 ? b->rules->step * quad_box_half_area(box) + s.cost : INFINITY)) {
		for (uint32_t i = 0; i < count; i++)
			b->draft->refs[first + i] = b->refs[b->order[0][first + i]];
		bvh_node_set(&b->draft->nodes[node], box, first, count);
		return;
	}
	uint32_t children = b->nodes;
	b->nodes += 2;
	bvh_node_set(&b->draft->nodes[node], box, children, 0);
	divide(b, first, count, &s);
	build(b, children, first, s.left, depth + 1);
	build(b, children + 1, first + s.left, count - s.left, depth + 1);
}

static int sort(struct builder *b, int axis)
{
	uint32_t n = b->draft->ref_count;
	struct place *places = malloc((size_t)n * sizeof *places);
	if (!places)
		return -1;
	for (uint32_t i = 0; i < n; i++)
		places[i] = (struct place){ bvh_ref_center(&b->refs[i])[axis], i };
	qsort(places, n, sizeof *places, compare);
	for (uint32_t i = 0; i < n; i++)
		b->order[axis][i] = places[i].ref;
	free(places);
	return 0;
}

int bvh_build_sweep(struct bvh_draft *d, const struct bvh_rules *rules)
{
	size_t n = d->ref_count;
	struct builder b = { .draft = d, .rules = rules, .nodes = 1 };
	uint32_t *orders = malloc(4 * n * sizeof *orders);
	b.refs = aligned_alloc(64, (n * sizeof *b.refs + 63) & ~(size_t)63);
	b.right = malloc(n * sizeof *b.right);
	b.goes_left = malloc(n);
	int status = orders && b.refs && b.right && b.goes_left ? 0 : -1;
	if (status == 0) {
		memcpy(b.refs, d->refs, n * sizeof *b.refs);
		for (int axis = 0; axis < 3; axis++)
			b.order[axis] = &orders[(size_t)axis * n];
		b.scratch = &orders[3 * n];
	}
	for (int axis = 0; status == 0 && axis < 3; axis++)
		status = sort(&b, axis);
	if (status == 0)
		build(&b, 0, 0, d->ref_count, 0);
	free(orders);
	free(b.refs);
	free(b.right);
	free(b.goes_left);
	return status;
}
