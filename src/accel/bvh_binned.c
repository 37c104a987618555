/* Binned surface area heuristic (Wald 2007): sort centroids into equal bins on every axis, try the planes between bins. Large ranges
 * are binned and divided in chunks by all threads, small ones are left to one thread each; neither changes the tree. */
#include "accel/bvh_plane.h"
#include "base/par.h"

#include <stdlib.h>
#include <string.h>

/* References a chunk; a range of at most TASK is one thread's work. */
enum { CHUNK = 1 << 14, TASK = 1 << 14 };

/* References that become a subtree: its root, and where its other nodes go. */
struct range {
	union bvh_ref *refs; /* of the buffer they are in */
	uint32_t first, count, node, slots;
	int depth;
	struct quad_box box;
};

struct builder {
	const struct bvh_rules *rules;
	struct bvh_draft *draft;
	union bvh_ref *buffer[2]; /* the draft's refs, and as many */
	struct range *tasks;
	size_t task_count;
	bool failed;
};

static inline quad_int bin_of(const union bvh_ref *r, quad base, quad scale)
{
	return __builtin_convertvector((bvh_ref_center(r) - base) * scale, quad_int);
}

static void bins_clear(struct bvh_bins *b, int bins)
{
	for (int axis = 0; axis < 3; axis++)
		for (int i = 0; i < bins; i++) {
			b->box[axis][i] = quad_box_empty();
			b->count[axis][i] = 0;
		}
}

static inline void bins_add_one(struct bvh_bins *b, const union bvh_ref *r, quad base, quad scale)
{
	quad_int at = bin_of(r, base, scale);
	for (int axis = 0; axis < 3; axis++) {
		quad_box_join(&b->box[axis][at[axis]], r->box);
		b->count[axis][at[axis]]++;
	}
}

static void bins_merge(struct bvh_bins *b, const struct bvh_bins *c, int bins)
{
	for (int axis = 0; axis < 3; axis++)
		for (int k = 0; k < bins; k++) {
			quad_box_join(&b->box[axis][k], c->box[axis][k]);
			b->count[axis][k] += c->count[axis][k];
		}
}

/* Neighbours in the list mostly share their bins: every other goes into bins of its own, so that none waits for the one before. */
static void bins_add(struct bvh_bins *b, const union bvh_ref *refs, uint32_t count, quad base, quad scale, int bins)
{
	struct bvh_bins odd;
	uint32_t i = 0;
	if (count >= 128) {
		bins_clear(&odd, bins);
		for (; i + 2 <= count; i += 2) {
			bins_add_one(b, &refs[i], base, scale);
			bins_add_one(&odd, &refs[i + 1], base, scale);
		}
		bins_merge(b, &odd, bins);
	}
	for (; i < count; i++)
		bins_add_one(b, &refs[i], base, scale);
}

static struct quad_box bound_centers(const union bvh_ref *refs, uint32_t count)
{
	struct quad_box c = quad_box_empty();
	for (uint32_t i = 0; i < count; i++) {
		quad center = bvh_ref_center(&refs[i]);
		quad_box_join(&c, (struct quad_box){ center, center });
	}
	return c;
}

/* From centroids to bins; the largest one stays below 'bins'. An axis without extent has all in bin 0. */
static void place_bins(struct bvh_plane *s, const struct quad_box *centers, int bins)
{
	s->base = centers->lo;
	s->scale = quad_of(0);
	for (int axis = 0; axis < 3; axis++) {
		float extent = centers->hi[axis] - centers->lo[axis];
		s->scale[axis] = extent > 1e-12f ? (float)bins * 0.99999f / extent : 0;
	}
	s->base[3] = 0;
}

static float weigh(const struct bvh_rules *r, struct quad_box box, uint32_t count)
{
	return quad_box_half_area(box) * (float)bvh_blocks(count, r->block);
}

static inline bool goes_left(const union bvh_ref *r, const struct bvh_plane *s)
{
	float at = (bvh_ref_center(r)[s->axis] - s->base[s->axis]) * s->scale[s->axis];
	return (int32_t)at < s->bin;
}

/* Left ones first, in order; scratch has room for all. */
static void divide(union bvh_ref *refs, uint32_t count, const struct bvh_plane *s, union bvh_ref *scratch)
{
	uint32_t left = 0, right = 0;
	for (uint32_t i = 0; i < count; i++) {
		union bvh_ref r = refs[i];
		bool goes = goes_left(&r, s);
		refs[left] = r;
		scratch[right] = r;
		left += goes;
		right += !goes;
	}
	memcpy(&refs[left], scratch, right * sizeof *refs);
}

/* Where no plane parts them, halves of the list do. */
static void halve(struct bvh_plane *s, const struct range *r)
{
	s->left = r->count / 2;
	s->box[0] = s->box[1] = quad_box_empty();
	for (uint32_t i = 0; i < r->count; i++)
		quad_box_join(&s->box[i >= s->left], r->refs[r->first + i].box);
}

/* Whether the range is cheaper as a leaf, or can be nothing else. */
static bool is_leaf(const struct range *r, const struct bvh_plane *s, const struct bvh_rules *rules)
{
	float leaf = weigh(rules, r->box, r->count) * rules->test;
	return r->count <= rules->most && leaf <= quad_box_half_area(r->box) * rules->step + s->cost * rules->test;
}

static int count_bins(const struct bvh_rules *rules, uint32_t count)
{
	int bins = 4 + (int)(count / 4);
	return bins < rules->bins ? bins : rules->bins;
}

static void make_leaf(struct builder *b, const struct range *r)
{
	bvh_node_set(&b->draft->nodes[r->node], r->box, r->first, r->count);
}

/* The two sides of a divided range; its node becomes inner. */
static void make_inner(struct builder *b, const struct range *r, const struct bvh_plane *s, uint32_t children, struct range side[2])
{
	bvh_node_set(&b->draft->nodes[r->node], r->box, children, 0);
	side[0] = (struct range){ r->refs, r->first, s->left, children, 0, r->depth + 1, s->box[0] };
	side[1] = (struct range){ r->refs, r->first + s->left, r->count - s->left, children + 1, 0, r->depth + 1, s->box[1] };
}

/* One thread's work: *slot is where the next node goes. */
static void build_range(struct builder *b, struct range r, struct bvh_bins *bins, uint32_t *slot, union bvh_ref *scratch)
{
	const struct bvh_rules *rules = b->rules;
	for (;;) {
		struct bvh_plane s = { .cost = INFINITY };
		struct range side[2];
		union bvh_ref *refs = &r.refs[r.first];
		if (r.count == 1 || (r.count <= rules->block && r.count <= rules->most)) {
			make_leaf(b, &r);
			return;
		}
		if (r.depth < BVH_DEPTH - 33) {
			struct quad_box centers = bound_centers(refs, r.count);
			int n = count_bins(rules, r.count);
			place_bins(&s, &centers, n);
			bins_clear(bins, n);
			bins_add(bins, refs, r.count, s.base, s.scale, n);
			bvh_find_plane(&s, bins, n, rules);
		}
		if (is_leaf(&r, &s, rules)) {
			make_leaf(b, &r);
			return;
		}
		if (s.cost == INFINITY)
			halve(&s, &r);
		else
			divide(refs, r.count, &s, scratch);
		make_inner(b, &r, &s, *slot, side);
		*slot += 2;
		build_range(b, side[0], bins, slot, scratch);
		r = side[1];
	}
}

static void build_task(void *ctx, size_t i)
{
	struct builder *b = ctx;
	struct range r = b->tasks[i];
	struct bvh_bins bins;
	union bvh_ref *home = &b->buffer[0][r.first], *scratch = &b->buffer[1][r.first];
	if (r.refs != b->buffer[0])
		memcpy(home, scratch, r.count * sizeof *home);
	r.refs = b->buffer[0];
	build_range(b, r, &bins, &r.slots, scratch);
}

/* Work on one large range, chunk by chunk. */
struct pass {
	const struct range *range;
	const struct bvh_plane *split;
	int bins;
	struct chunk {
		struct quad_box centers;
		struct bvh_bins bins;
		uint32_t left, to_left, to_right;
	} *chunks;
	union bvh_ref *to;
};

static uint32_t chunk_size(const struct pass *p, size_t i)
{
	uint32_t left = p->range->count - (uint32_t)i * CHUNK;
	return left < CHUNK ? left : CHUNK;
}

static void pass_centers(void *ctx, size_t i)
{
	struct pass *p = ctx;
	p->chunks[i].centers = bound_centers(&p->range->refs[p->range->first + i * CHUNK], chunk_size(p, i));
}

static void pass_bins(void *ctx, size_t i)
{
	struct pass *p = ctx;
	bins_clear(&p->chunks[i].bins, p->bins);
	bins_add(&p->chunks[i].bins, &p->range->refs[p->range->first + i * CHUNK], chunk_size(p, i), p->split->base,
	         p->split->scale, p->bins);
}

static void pass_divide(void *ctx, size_t i)
{
	struct pass *p = ctx;
	const union bvh_ref *refs = &p->range->refs[p->range->first + i * CHUNK];
	union bvh_ref *to[2] = { &p->to[p->chunks[i].to_right], &p->to[p->chunks[i].to_left] };
	for (uint32_t k = 0; k < chunk_size(p, i); k++)
		*to[goes_left(&refs[k], p->split)]++ = refs[k];
}

/* The best plane of a large range; the chunks' counts give every chunk its places on both sides. */
static void split_large(struct builder *b, const struct range *r, struct bvh_plane *s, struct pass *p)
{
	size_t chunks = (r->count + CHUNK - 1) / CHUNK;
	struct quad_box centers = quad_box_empty();
	int threads = b->rules->threads, n = b->rules->bins;
	*p = (struct pass){ r, s, n, p->chunks, b->buffer[r->refs == b->buffer[0]] };
	par_for(threads, chunks, pass_centers, p);
	for (size_t i = 0; i < chunks; i++)
		quad_box_join(&centers, p->chunks[i].centers);
	place_bins(s, &centers, n);
	par_for(threads, chunks, pass_bins, p);
	struct bvh_bins all;
	bins_clear(&all, n);
	for (size_t i = 0; i < chunks; i++)
		bins_merge(&all, &p->chunks[i].bins, n);
	bvh_find_plane(s, &all, n, b->rules);
	if (s->cost == INFINITY)
		return;
	uint32_t left = r->first, right = r->first + s->left;
	for (size_t i = 0; i < chunks; i++) {
		uint32_t goes = 0;
		for (int k = 0; k < s->bin; k++)
			goes += p->chunks[i].bins.count[s->axis][k];
		p->chunks[i].to_left = left;
		p->chunks[i].to_right = right;
		left += goes;
		right += chunk_size(p, i) - goes;
	}
}

/* Divide large ranges until all are tasks. Nodes of a range of n take the 2 n - 2 slots from its own on. */
static void build_top(struct builder *b, struct range all, struct chunk *chunks)
{
	struct range open[BVH_DEPTH];
	int count = 0;
	open[count++] = all;
	while (count > 0) {
		struct range r = open[--count], side[2];
		struct bvh_plane s;
		struct pass p = { .chunks = chunks };
		if (r.count <= TASK || r.depth >= BVH_DEPTH / 2) {
			b->tasks[b->task_count++] = r;
			continue;
		}
		split_large(b, &r, &s, &p);
		if (s.cost == INFINITY) {
			halve(&s, &r);
		} else {
			par_for(b->rules->threads, (r.count + CHUNK - 1) / CHUNK, pass_divide, &p);
			r.refs = p.to;
		}
		make_inner(b, &r, &s, r.slots, side);
		side[0].slots = r.slots + 2;
		side[1].slots = side[0].slots + 2 * side[0].count - 2;
		open[count++] = side[1];
		open[count++] = side[0];
	}
}

int bvh_build_binned(struct bvh_draft *d, const struct bvh_rules *rules)
{
	uint32_t n = d->ref_count;
	struct builder b = { .rules = rules, .draft = d, .buffer = { d->refs } };
	struct range all = { d->refs, 0, n, 0, 1, 0, quad_box_empty() };
	size_t chunk_count = (n + CHUNK - 1) / CHUNK;
	struct chunk *chunks = aligned_alloc(64, chunk_count * ((sizeof *chunks + 63) & ~(size_t)63));
	b.buffer[1] = arena_pages((size_t)n * sizeof *d->refs);
	b.tasks = malloc((size_t)n * sizeof *b.tasks / (TASK / 64) + 4096 * sizeof *b.tasks);
	int status = chunks && b.buffer[1] && b.tasks ? 0 : -1;
	if (status == 0) {
		for (uint32_t i = 0; i < n; i++)
			quad_box_join(&all.box, d->refs[i].box);
		build_top(&b, all, chunks);
		par_for(rules->threads, b.task_count, build_task, &b);
	}
	free(b.tasks);
	free(b.buffer[1]);
	free(chunks);
	return status;
}
