/* Halves of the list sorted by centroid, the axes in turn (Smits 1999, figure 1). */
#include "accel/bvh_draft.h"

#include <stdlib.h>
#include <string.h>

struct place {
	float at;
	uint32_t id, ref;
};

static int compare(const void *a, const void *b)
{
	const struct place *p = a, *q = b;
	return p->at != q->at ? (p->at > q->at) - (p->at < q->at) : (p->id > q->id) - (p->id < q->id);
}

struct builder {
	struct bvh_draft *draft;
	const struct bvh_rules *rules;
	struct place *places;
	union bvh_ref *scratch;
	uint32_t nodes;
};

static void sort(struct builder *b, uint32_t first, uint32_t count, int axis)
{
	union bvh_ref *refs = &b->draft->refs[first];
	for (uint32_t i = 0; i < count; i++)
		b->places[i] = (struct place){ bvh_ref_center(&refs[i])[axis], refs[i].id, i };
	qsort(b->places, count, sizeof *b->places, compare);
	for (uint32_t i = 0; i < count; i++)
		b->scratch[i] = refs[b->places[i].ref];
	memcpy(refs, b->scratch, count * sizeof *refs);
}

static struct quad_box build(struct builder *b, uint32_t node, uint32_t first, uint32_t count, int axis)
{
	struct quad_box box = quad_box_empty();
	if (count <= b->rules->most) {
		for (uint32_t i = 0; i < count; i++)
			quad_box_join(&box, b->draft->refs[first + i].box);
		bvh_node_set(&b->draft->nodes[node], box, first, count);
		return box;
	}
	uint32_t left = (count + 1) / 2, children = b->nodes;
	b->nodes += 2;
	sort(b, first, count, axis);
	box = build(b, children, first, left, (axis + 1) % 3);
	quad_box_join(&box, build(b, children + 1, first + left, count - left, (axis + 1) % 3));
	bvh_node_set(&b->draft->nodes[node], box, children, 0);
	return box;
}

int bvh_build_median(struct bvh_draft *d, const struct bvh_rules *rules)
{
	struct builder b = { .draft = d, .rules = rules, .nodes = 1 };
	b.places = malloc((size_t)d->ref_count * sizeof *b.places);
	b.scratch = aligned_alloc(64, ((size_t)d->ref_count * sizeof *b.scratch + 63) & ~(size_t)63);
	int status = b.places && b.scratch ? 0 : -1;
	if (status == 0)
		build(&b, 0, 0, d->ref_count, 0);
	free(b.places);
	free(b.scratch);
	return status;
}
