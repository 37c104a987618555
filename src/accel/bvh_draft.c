#include "accel/bvh_draft.h"

#include "base/par.h"

#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 15 };

static struct bvh_frame frame_make(const struct box *root)
{
	int exponent;
	frexp(box_diagonal(root), &exponent);
	return (struct bvh_frame){ vec_scale(vec_add(root->lo, root->hi), 0.5), ldexp(1, -exponent) };
}

/* A float not above x, and one not below: x itself where it is one. Coordinates are at most 1. */
static inline float round_down(double x)
{
	float f = (float)x;
	return f > x ? f - 0x1p-24f : f;
}

static inline float round_up(double x)
{
	float f = (float)x;
	return f < x ? f + 0x1p-24f : f;
}

static void fill_refs(void *ctx, size_t chunk)
{
	struct bvh_draft *d = ctx;
	const struct bvh_frame *f = &d->frame;
	uint32_t first = (uint32_t)chunk * CHUNK, end = first + CHUNK < d->ref_count ? first + CHUNK : d->ref_count;
	for (uint32_t i = first; i < end; i++) {
		struct box b = primitive_bounds(&d->primitives->all[i]);
		union bvh_ref *r = &d->refs[i];
		r->id = i;
		r->unused = 0;
		for (int k = 0; k < 3; k++) {
			r->lo[k] = round_down((b.lo.a[k] - f->center.a[k]) * f->scale);
			r->hi[k] = round_up((b.hi.a[k] - f->center.a[k]) * f->scale);
		}
	}
}

/* What merging a subtree knows of it: refs[first .. first + count) of the new order. */
struct merged {
	uint32_t first, count;
	float cost;
};

static struct merged merge(struct bvh_draft *d, const struct bvh_rules *rules, uint32_t node, union bvh_ref *refs, uint32_t *used)
{
	struct bvh_draft_node *n = &d->nodes[node];
	float area = quad_box_half_area(bvh_node_box(n));
	struct merged m = { *used, n->count, 0 };
	if (n->count) {
		memcpy(&refs[*used], &d->refs[n->first], n->count * sizeof *refs);
		n->first = *used;
		*used += n->count;
	} else {
		struct merged left = merge(d, rules, n->first, refs, used), right = merge(d, rules, n->first + 1, refs, used);
		m.count = left.count + right.count;
		m.cost = rules->step * area + left.cost + right.cost;
	}
	float leaf = rules->test * (float)bvh_blocks(m.count, rules->block) * area;
	if (n->count || (m.count <= rules->most && leaf <= m.cost)) {
		n->first = m.first;
		n->count = m.count;
		m.cost = leaf;
	}
	return m;
}

/* Subtrees that are cheaper as leaves become some. */
static int merge_leaves(struct bvh_draft *d, const struct bvh_rules *rules)
{
	uint32_t used = 0;
	union bvh_ref *refs = arena_pages((size_t)d->ref_count * sizeof *refs);
	if (!refs)
		return -1;
	merge(d, rules, 0, refs, &used);
	free(d->memory[1]);
	d->refs = d->memory[1] = refs;
	return 0;
}

int bvh_draft_make(struct bvh_draft *d, const struct accel *a, enum bvh_builder b, int optimise, const struct bvh_rules *rules,
                   struct err *e)
{
	static int (*const build[])(struct bvh_draft *, const struct bvh_rules *) = {
		bvh_build_binned, bvh_build_sweep, bvh_build_median, bvh_build_insertion, bvh_build_spatial
	};
	uint32_t n = a->primitives->count;
	*d = (struct bvh_draft){ .primitives = a->primitives, .frame = frame_make(&a->root), .ref_count = n };
	/* Most nodes remain unused, their pages untouched: none of the large ones. */
	d->nodes = d->memory[0] = aligned_alloc(64, 2 * (size_t)n * sizeof *d->nodes);
	d->refs = d->memory[1] = arena_pages((size_t)n * sizeof *d->refs);
	if (!d->nodes || !d->refs)
		return err_memory(e, "bvh");
	par_for(rules->threads, (n + CHUNK - 1) / CHUNK, fill_refs, d);
	int status = build[b](d, rules);
	if (status == 0 && optimise > 0)
		status = bvh_optimise(d, optimise);
	if (status == 0 && (optimise > 0 || b == BVH_INSERTION))
		status = merge_leaves(d, rules);
	return status == 0 ? 0 : err_memory(e, "bvh");
}

void bvh_draft_free(struct bvh_draft *d)
{
	for (int i = 0; i < 2; i++)
		free(d->memory[i]);
	*d = (struct bvh_draft){ 0 };
}
