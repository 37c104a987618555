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

/* Two coordinates at once: x and y of a vec, or z twice. */
typedef double pair __attribute__((vector_size(16)));
typedef int64_t pair_int __attribute__((vector_size(16)));
typedef float half_quad __attribute__((vector_size(8)));

static inline pair pair_select(pair_int where, pair yes, pair no)
{
	return (pair)(((pair_int)yes & where) | ((pair_int)no & ~where));
}

/* x in floats, and where they are above it or below. Not a branch, for no processor can guess which way a number is rounded. */
static inline half_quad round_pair(pair x, pair_int *above, pair_int *below)
{
	half_quad f = __builtin_convertvector(x, half_quad);
	pair back = __builtin_convertvector(f, pair);
	*above = back > x;
	*below = back < x;
	return f;
}

static inline quad join_halves(half_quad a, half_quad b)
{
	return (quad){ a[0], a[1], b[0], b[1] };
}

/* 2^-24 where a comparison of pairs is true. */
static inline quad step_where(pair_int a, pair_int b)
{
	quad_int where = __builtin_shufflevector((quad_int)a, (quad_int)b, 0, 2, 4, 6);
	return (quad)(where & (quad_int)quad_of(0x1p-24f));
}

/* The floats next to a box, outside it; those of its numbers that are floats stay. Coordinates are at most 1. */
static inline void set_box(union bvh_ref *r, const pair lo[2], const pair hi[2])
{
	pair_int above[2], below[2], unused;
	half_quad low[2], high[2];
	for (int k = 0; k < 2; k++) {
		low[k] = round_pair(lo[k], &above[k], &unused);
		high[k] = round_pair(hi[k], &unused, &below[k]);
	}
	r->box.lo = join_halves(low[0], low[1]) - step_where(above[0], above[1]);
	r->box.hi = join_halves(high[0], high[1]) + step_where(below[0], below[1]);
}

static inline void load_pairs(pair p[2], const struct vec *v)
{
	p[0] = (pair){ v->x, v->y };
	p[1] = (pair){ v->z, v->z };
}

/* The box of a primitive's corners, or of its bounds. */
static inline void fill_ref(union bvh_ref *r, const struct vec *corner, int corners, const struct bvh_frame *f)
{
	pair lo[2], hi[2], v[2], center[2];
	load_pairs(center, &f->center);
	load_pairs(lo, &corner[0]);
	load_pairs(hi, &corner[0]);
	for (int i = 1; i < corners; i++) {
		load_pairs(v, &corner[i]);
		for (int k = 0; k < 2; k++) {
			lo[k] = pair_select(v[k] < lo[k], v[k], lo[k]);
			hi[k] = pair_select(v[k] > hi[k], v[k], hi[k]);
		}
	}
	for (int k = 0; k < 2; k++) {
		lo[k] = (lo[k] - center[k]) * f->scale;
		hi[k] = (hi[k] - center[k]) * f->scale;
	}
	set_box(r, lo, hi);
}

static void fill_refs(void *ctx, size_t chunk)
{
	struct bvh_draft *d = ctx;
	uint32_t first = (uint32_t)chunk * CHUNK, end = first + CHUNK < d->ref_count ? first + CHUNK : d->ref_count;
	for (uint32_t i = first; i < end; i++) {
		const struct primitive *p = &d->primitives->all[i];
		union bvh_ref *r = &d->refs[i];
		if (p->kind == PRIMITIVE_TRIANGLE) {
			fill_ref(r, p->triangle.v, 3, &d->frame);
		} else {
			struct box b = primitive_bounds(p);
			fill_ref(r, (struct vec[]){ b.lo, b.hi }, 2, &d->frame);
		}
		r->id = i;
		r->unused = 0;
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
