#include "accel/bvh_draft.h"

#include "base/par.h"

#include <stdlib.h>

enum { CHUNK = 1 << 15 };

static struct bvh_frame frame_make(const struct box *root)
{
	int exponent;
	frexp(box_diagonal(root), &exponent);
	return (struct bvh_frame){ vec_scale(vec_add(root->lo, root->hi), 0.5), ldexp(1, -exponent) };
}

/* The float next to x on the side of 'toward', unless x is one itself. */
static float round_to(double x, float toward)
{
	float f = (float)x;
	return (toward < 0 ? f > x : f < x) ? nextafterf(f, toward) : f;
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
			r->lo[k] = round_to((b.lo.a[k] - f->center.a[k]) * f->scale, -INFINITY);
			r->hi[k] = round_to((b.hi.a[k] - f->center.a[k]) * f->scale, INFINITY);
		}
	}
}

int bvh_draft_make(struct bvh_draft *d, const struct accel *a, enum bvh_builder b, const struct bvh_rules *rules, struct err *e)
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
	return build[b](d, rules) == 0 ? 0 : err_memory(e, "bvh");
}

void bvh_draft_free(struct bvh_draft *d)
{
	for (int i = 0; i < 3; i++)
		free(d->memory[i]);
	*d = (struct bvh_draft){ 0 };
}
