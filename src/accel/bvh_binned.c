/* Binned surface area heuristic (Wald 2007): sort centroids into equal bins on every axis, try the planes between bins. Large ranges
 * are binned and divided in chunks by all threads, small ones are left to one thread each; neither changes the tree. */
#include "accel/bvh_draft.h"
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

struct bins {
	struct quad_box box[3][BVH_BINS];
	uint32_t count[3][BVH_BINS];
};

/* A plane: references whose bin on 'axis' is below 'bin' go left. base, scale: from centroids to bins. */
struct split {
	quad base, scale;
	int axis, bin;
	float cost; /* without the step; INFINITY: none */
	uint32_t left;
	struct quad_box box[2];
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

static void bins_clear(struct bins *b, int bins)
{
	for (int axis = 0; axis < 3; axis++)
		for (int i = 0; i < bins; i++) {
			b->box[axis][i] = quad_box_empty();
			b->count[axis][i] = 0;
		}
}

static inline void bins_add_one(struct bins *b, const union bvh_ref *r, quad base, quad scale)
{
	quad_int at = bin_of(r, base, scale);
	for (int axis = 0; axis < 3; axis++) {
		quad_box_join(&b->box[axis][at[axis]], r->box);
		b->count[axis][at[axis]]++;
	}
}

static void bins_merge(struct bins *b, const struct bins *c, int bins)
{
	for (int axis = 0; axis < 3; axis++)
		for (int k = 0; k < bins; k++) {
			quad_box_join(&b->box[axis][k], c->box[axis][k]);
			b->count[axis][k] += c->count[axis][k];
		}
}

/* Neighbours in the list mostly share their bins: every other goes into bins of its own, so that none waits for the one before. */
static void bins_add(struct bins *b, const union bvh_ref *refs, uint32_t count, quad base, quad scale, int bins)
{
	struct bins odd;
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
static void place_bins(struct split *s, const struct quad_box *centers, int bins)
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

/* What is in a bin of every axis, or in several of them: lane i is axis i. */
struct by_axis {
	quad lo[3], hi[3];
	quad_int count;
};

/* Lane i of the outcome k is coordinate k of v[i]. */
static inline void transpose(quad a, quad b, quad c, quad out[3])
{
	quad low = __builtin_shuffle(a, b, (quad_int){ 0, 4, 1, 5 }), high = __builtin_shuffle(a, b, (quad_int){ 2, 6, 2, 6 });
	out[0] = __builtin_shuffle(low, c, (quad_int){ 0, 1, 4, 4 });
	out[1] = __builtin_shuffle(low, c, (quad_int){ 2, 3, 5, 5 });
	out[2] = __builtin_shuffle(high, c, (quad_int){ 0, 1, 6, 6 });
}

static inline struct by_axis bin_by_axis(const struct bins *b, int i)
{
	struct by_axis a;
	transpose(b->box[0][i].lo, b->box[1][i].lo, b->box[2][i].lo, a.lo);
	transpose(b->box[0][i].hi, b->box[1][i].hi, b->box[2][i].hi, a.hi);
	a.count = (quad_int){ (int32_t)b->count[0][i], (int32_t)b->count[1][i], (int32_t)b->count[2][i], 0 };
	return a;
}

static inline struct by_axis none_by_axis(void)
{
	quad high = quad_of(INFINITY), low = quad_of(-INFINITY);
	return (struct by_axis){ { high, high, high }, { low, low, low }, { 0 } };
}

static inline void join_by_axis(struct by_axis *a, const struct by_axis *b)
{
	for (int i = 0; i < 3; i++) {
		a->lo[i] = quad_min(a->lo[i], b->lo[i]);
		a->hi[i] = quad_max(a->hi[i], b->hi[i]);
	}
	a->count += b->count;
}

static inline quad quad_select(quad_int where, quad yes, quad no)
{
	return (quad)(((quad_int)yes & where) | ((quad_int)no & ~where));
}

/* As weigh, INFINITY where there is nothing. shift: of the primitives of a block. */
static inline quad weigh_by_axis(const struct by_axis *a, int shift)
{
	quad x = a->hi[0] - a->lo[0], y = a->hi[1] - a->lo[1], z = a->hi[2] - a->lo[2];
	quad_int blocks = (a->count + ((1 << shift) - 1)) >> shift;
	return quad_select(a->count > 0, (x * y + y * z + z * x) * __builtin_convertvector(blocks, quad), quad_of(INFINITY));
}

/* The cheapest plane of every axis, and what is on its left. */
static inline void sweep(const struct bins *b, int bins, int shift, quad *cost, quad_int *bin, quad_int *left)
{
	struct by_axis all[BVH_BINS], side = none_by_axis();
	quad right[BVH_BINS];
	for (int i = 0; i < bins; i++)
		all[i] = bin_by_axis(b, i);
	for (int i = bins - 1; i > 0; i--) {
		join_by_axis(&side, &all[i]);
		right[i] = weigh_by_axis(&side, shift);
	}
	side = none_by_axis();
	*cost = quad_of(INFINITY);
	*bin = *left = (quad_int){ 0 };
	for (int i = 1; i < bins; i++) {
		join_by_axis(&side, &all[i - 1]);
		quad at = weigh_by_axis(&side, shift) + right[i];
		quad_int better = at < *cost;
		*cost = quad_select(better, at, *cost);
		*bin = (better & i) | (~better & *bin);
		*left = (better & side.count) | (~better & *left);
	}
}

/* The cheapest plane between bins; s->base and s->scale are set. */
static void find_plane(struct split *s, const struct bins *b, int bins, const struct bvh_rules *rules)
{
	quad cost;
	quad_int bin, left;
	s->cost = INFINITY;
	sweep(b, bins, __builtin_ctz(rules->block), &cost, &bin, &left);
	for (int axis = 0; axis < 3; axis++)
		if (s->scale[axis] != 0 && cost[axis] < s->cost) {
			s->cost = cost[axis];
			s->axis = axis;
			s->bin = bin[axis];
			s->left = (uint32_t)left[axis];
		}
	if (s->cost == INFINITY)
		return;
	s->box[0] = s->box[1] = quad_box_empty();
	for (int i = 0; i < bins; i++)
		quad_box_join(&s->box[i >= s->bin], b->box[s->axis][i]);
}

static inline bool goes_left(const union bvh_ref *r, const struct split *s)
{
	float at = (bvh_ref_center(r)[s->axis] - s->base[s->axis]) * s->scale[s->axis];
	return (int32_t)at < s->bin;
}

/* Left ones first, in order; scratch has room for all. */
static void divide(union bvh_ref *refs, uint32_t count, const struct split *s, union bvh_ref *scratch)
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
static void halve(struct split *s, const struct range *r)
{
	s->left = r->count / 2;
	s->box[0] = s->box[1] = quad_box_empty();
	for (uint32_t i = 0; i < r->count; i++)
		quad_box_join(&s->box[i >= s->left], r->refs[r->first + i].box);
}

/* Whether the range is cheaper as a leaf, or can be nothing else. */
static bool is_leaf(const struct range *r, const struct split *s, const struct bvh_rules *rules)
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
static void make_inner(struct builder *b, const struct range *r, const struct split *s, uint32_t children, struct range side[2])
{
	bvh_node_set(&b->draft->nodes[r->node], r->box, children, 0);
	side[0] = (struct range){ r->refs, r->first, s->left, children, 0, r->depth + 1, s->box[0] };
	side[1] = (struct range){ r->refs, r->first + s->left, r->count - s->left, children + 1, 0, r->depth + 1, s->box[1] };
}

/* One thread's work: *slot is where the next node goes. */
static void build_range(struct builder *b, struct range r, struct bins *bins, uint32_t *slot, union bvh_ref *scratch)
{
	const struct bvh_rules *rules = b->rules;
	for (;;) {
		struct split s = { .cost = INFINITY };
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
			find_plane(&s, bins, n, rules);
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
	struct bins bins;
	union bvh_ref *home = &b->buffer[0][r.first], *scratch = &b->buffer[1][r.first];
	if (r.refs != b->buffer[0])
		memcpy(home, scratch, r.count * sizeof *home);
	r.refs = b->buffer[0];
	build_range(b, r, &bins, &r.slots, scratch);
}

/* Work on one large range, chunk by chunk. */
struct pass {
	const struct range *range;
	const struct split *split;
	int bins;
	struct chunk {
		struct quad_box centers;
		struct bins bins;
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
static void split_large(struct builder *b, const struct range *r, struct split *s, struct pass *p)
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
	struct bins all;
	bins_clear(&all, n);
	for (size_t i = 0; i < chunks; i++)
		bins_merge(&all, &p->chunks[i].bins, n);
	find_plane(s, &all, n, b->rules);
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
		struct split s;
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
