/* Spatial splits (Stich, Friedrich, Dietrich 2009): where the two sides of the best object split overlap much, a plane through space may
 * be cheaper, and what it cuts is listed on both sides, each part by its own smaller box. The references of the range at hand are the
 * last ones of a stack, so that parts find room above them. */
#include "accel/bvh_draft.h"

#include <stdlib.h>
#include <string.h>

/* Overlap, as a share of the root's area, from which on planes are tried; and the references there may be, in percent. */
#define OVERLAP 1e-5f
enum { BUDGET = 150 };

struct bin {
	struct quad_box box;
	uint32_t enter, leave;
};

struct split {
	float cost, at; /* cost without the step; at: spatial */
	int axis;
	bool spatial;
	struct quad_box box[2];
	uint32_t bin;
	quad base, scale;
};

struct builder {
	struct bvh_draft *draft;
	const struct bvh_rules *rules;
	union bvh_ref *stack, *out;
	uint32_t waiting, emitted, room, nodes; /* room: for all references, waiting or emitted */
	float root_area;
};

static float weigh(const struct builder *b, struct quad_box box, uint32_t count)
{
	return count ? quad_box_half_area(box) * (float)bvh_blocks(count, b->rules->block) * b->rules->test : INFINITY;
}

static struct quad_box quad_box_common(struct quad_box a, struct quad_box b)
{
	return (struct quad_box){ quad_max(a.lo, b.lo), quad_min(a.hi, b.hi) };
}

static void extend(struct quad_box *b, const double p[3])
{
	for (int i = 0; i < 3; i++) {
		float x = (float)p[i];
		b->lo[i] = fminf(b->lo[i], nextafterf(x, -INFINITY));
		b->hi[i] = fmaxf(b->hi[i], nextafterf(x, INFINITY));
	}
}

/* The parts of a triangle on both sides of the plane. */
static void cut_triangle(const struct builder *b, const struct triangle *t, int axis, double at, struct quad_box part[2])
{
	const struct bvh_frame *f = &b->draft->frame;
	for (int k = 0; k < 3; k++) {
		struct vec v = vec_scale(vec_sub(t->v[k], f->center), f->scale), w = vec_scale(vec_sub(t->v[(k + 1) % 3], f->center), f->scale);
		double p = v.a[axis] - at, q = w.a[axis] - at;
		if (p <= 0)
			extend(&part[0], v.a);
		if (p >= 0)
			extend(&part[1], v.a);
		if ((p < 0 && q > 0) || (p > 0 && q < 0)) {
			struct vec c = vec_add(v, vec_scale(vec_sub(w, v), p / (p - q)));
			c.a[axis] = at;
			extend(&part[0], c.a);
			extend(&part[1], c.a);
		}
	}
}

/* A reference cut by a plane through its box. */
static void cut(const struct builder *b, const union bvh_ref *r, int axis, float at, union bvh_ref part[2])
{
	const struct primitive *p = &b->draft->primitives->all[r->id];
	struct quad_box box[2] = { quad_box_empty(), quad_box_empty() };
	if (p->kind == PRIMITIVE_TRIANGLE)
		cut_triangle(b, &p->triangle, axis, at, box);
	for (int side = 0; side < 2; side++) {
		part[side].box = p->kind == PRIMITIVE_TRIANGLE ? quad_box_common(box[side], r->box) : r->box;
		part[side].id = r->id;
		part[side].unused = 0;
	}
	part[0].hi[axis] = fminf(part[0].hi[axis], at);
	part[1].lo[axis] = fmaxf(part[1].lo[axis], at);
}

/* Whether the plane only cut the box, not what is inside. */
static bool is_empty(struct quad_box b)
{
	return b.lo[0] > b.hi[0] || b.lo[1] > b.hi[1] || b.lo[2] > b.hi[2];
}

static uint32_t bin_of(float x, float base, float scale, int bins)
{
	float at = (x - base) * scale;
	return at < 0 ? 0 : at >= (float)bins ? (uint32_t)bins - 1 : (uint32_t)at;
}

/* Try the planes between bins; boxes of both sides into s where one is cheaper. */
static void sweep(const struct builder *b, const struct bin *bins, int axis, bool spatial, float base, float scale, struct split *s)
{
	int n = b->rules->bins;
	float right[BVH_BINS];
	struct quad_box beyond[BVH_BINS], box = quad_box_empty();
	uint32_t count = 0;
	for (int i = n - 1; i > 0; i--) {
		quad_box_join(&box, bins[i].box);
		count += bins[i].leave;
		right[i] = weigh(b, box, count);
		beyond[i] = box;
	}
	box = quad_box_empty();
	count = 0;
	for (int i = 1; i < n; i++) {
		quad_box_join(&box, bins[i - 1].box);
		count += bins[i - 1].enter;
		float cost = weigh(b, box, count) + right[i];
		if (cost < s->cost) {
			s->cost = cost;
			s->axis = axis;
			s->spatial = spatial;
			s->bin = (uint32_t)i;
			s->at = base + (float)i / scale;
			s->box[0] = box;
			s->box[1] = beyond[i];
		}
	}
}

static void clear_bins(struct bin *bins)
{
	for (int i = 0; i < BVH_BINS; i++)
		bins[i] = (struct bin){ quad_box_empty(), 0, 0 };
}

static void find_object_split(const struct builder *b, const union bvh_ref *refs, uint32_t count, struct split *s)
{
	struct quad_box centers = quad_box_empty();
	for (uint32_t i = 0; i < count; i++) {
		quad c = bvh_ref_center(&refs[i]);
		quad_box_join(&centers, (struct quad_box){ c, c });
	}
	for (int axis = 0; axis < 3; axis++) {
		struct bin bins[BVH_BINS];
		float extent = centers.hi[axis] - centers.lo[axis];
		s->base[axis] = centers.lo[axis];
		s->scale[axis] = extent > 1e-12f ? (float)b->rules->bins / extent : 0;
		if (s->scale[axis] == 0)
			continue;
		clear_bins(bins);
		for (uint32_t i = 0; i < count; i++) {
			struct bin *bin = &bins[bin_of(bvh_ref_center(&refs[i])[axis], s->base[axis], s->scale[axis], b->rules->bins)];
			quad_box_join(&bin->box, refs[i].box);
			bin->enter++;
			bin->leave++;
		}
		sweep(b, bins, axis, false, s->base[axis], s->scale[axis], s);
	}
}

static void find_spatial_split(const struct builder *b, const union bvh_ref *refs, uint32_t count, struct quad_box box, struct split *s)
{
	for (int axis = 0; axis < 3; axis++) {
		struct bin bins[BVH_BINS];
		float base = box.lo[axis], extent = box.hi[axis] - base, scale = (float)b->rules->bins / extent;
		if (!(extent > 1e-6f))
			continue;
		clear_bins(bins);
		for (uint32_t i = 0; i < count; i++) {
			uint32_t first = bin_of(refs[i].lo[axis], base, scale, b->rules->bins);
			uint32_t last = bin_of(refs[i].hi[axis], base, scale, b->rules->bins);
			union bvh_ref rest = refs[i];
			for (uint32_t k = first; k < last; k++) {
				union bvh_ref part[2];
				cut(b, &rest, axis, base + (float)(k + 1) / scale, part);
				quad_box_join(&bins[k].box, part[0].box);
				rest = part[1];
			}
			quad_box_join(&bins[last].box, rest.box);
			bins[first].enter++;
			bins[last].leave++;
		}
		sweep(b, bins, axis, true, base, scale, s);
	}
}

/* Left ones first, in order. */
static uint32_t divide(union bvh_ref *refs, uint32_t count, const struct split *s, int bins, union bvh_ref *scratch)
{
	uint32_t left = 0, right = 0;
	for (uint32_t i = 0; i < count; i++) {
		if (bin_of(bvh_ref_center(&refs[i])[s->axis], s->base[s->axis], s->scale[s->axis], bins) < s->bin)
			refs[left++] = refs[i];
		else
			scratch[right++] = refs[i];
	}
	memcpy(&refs[left], scratch, right * sizeof *refs);
	return left;
}

/* Left, right and cut ones; returns how many are left, *total how many there are now. What is cut may be cheaper whole on one side. */
static uint32_t divide_space(struct builder *b, union bvh_ref *refs, uint32_t count, struct split *s, union bvh_ref *scratch, uint32_t *total)
{
	uint32_t left = 0, right = 0;
	float area[2] = { quad_box_half_area(s->box[0]), quad_box_half_area(s->box[1]) };
	for (uint32_t i = 0; i < count; i++) {
		union bvh_ref r = refs[i], part[2];
		bool below = r.hi[s->axis] <= s->at, above = r.lo[s->axis] >= s->at;
		if (!below && !above) {
			struct quad_box all[2] = { s->box[0], s->box[1] };
			quad_box_join(&all[0], r.box);
			quad_box_join(&all[1], r.box);
			float grow[2] = { quad_box_half_area(all[0]) - area[0], quad_box_half_area(all[1]) - area[1] };
			below = grow[0] <= 0 && grow[0] <= grow[1];
			above = !below && grow[1] <= 0;
		}
		if (below) {
			refs[left++] = r;
		} else if (above || b->waiting + b->emitted + 1 > b->room) {
			scratch[right++] = r;
		} else {
			cut(b, &r, s->axis, s->at, part);
			bool empty = is_empty(part[0].box);
			if (!empty)
				refs[left++] = part[0];
			if (empty || !is_empty(part[1].box))
				scratch[right++] = part[1];
			b->waiting += !empty && !is_empty(part[1].box);
		}
	}
	memcpy(&refs[left], scratch, right * sizeof *refs);
	*total = left + right;
	return left;
}

static void make_leaf(struct builder *b, uint32_t node, struct quad_box box, uint32_t count)
{
	b->waiting -= count;
	memcpy(&b->out[b->emitted], &b->stack[b->waiting], count * sizeof *b->out);
	bvh_node_set(&b->draft->nodes[node], box, b->emitted, count);
	b->emitted += count;
}

static void build(struct builder *b, uint32_t node, uint32_t count, int depth, union bvh_ref *scratch)
{
	union bvh_ref *refs = &b->stack[b->waiting - count];
	struct split s = { .cost = INFINITY };
	struct quad_box box = quad_box_empty();
	for (uint32_t i = 0; i < count; i++)
		quad_box_join(&box, refs[i].box);
	if (count > 1 && depth < BVH_DEPTH - 33) {
		find_object_split(b, refs, count, &s);
		struct quad_box common = s.cost < INFINITY ? quad_box_common(s.box[0], s.box[1]) : box;
		if (!is_empty(common) && quad_box_half_area(common) > OVERLAP * b->root_area && b->waiting + b->emitted < b->room)
			find_spatial_split(b, refs, count, box, &s);
	}
	if (count == 1 || (count <= b->rules->most && weigh(b, box, count) <= b->rules->step * quad_box_half_area(box) + s.cost)) {
		make_leaf(b, node, box, count);
		return;
	}
	uint32_t total = count, left = count / 2;
	if (s.cost < INFINITY && s.spatial)
		left = divide_space(b, refs, count, &s, scratch, &total);
	else if (s.cost < INFINITY)
		left = divide(refs, count, &s, b->rules->bins, scratch);
	if (left == 0 || left == total)
		left = total / 2;
	uint32_t children = b->nodes;
	b->nodes += 2;
	bvh_node_set(&b->draft->nodes[node], box, children, 0);
	build(b, children + 1, total - left, depth + 1, scratch);
	build(b, children, left, depth + 1, scratch);
}

int bvh_build_spatial(struct bvh_draft *d, const struct bvh_rules *rules)
{
	uint32_t n = d->ref_count, room = (uint32_t)((uint64_t)n * BUDGET / 100);
	struct builder b = { .draft = d, .rules = rules, .waiting = n, .room = room, .nodes = 1 };
	struct bvh_draft_node *nodes = aligned_alloc(64, 2 * ((size_t)room + 1) / 2 * 2 * sizeof *nodes);
	union bvh_ref *scratch = arena_pages((size_t)room * sizeof *scratch);
	b.stack = arena_pages((size_t)room * sizeof *b.stack);
	b.out = arena_pages((size_t)room * sizeof *b.out);
	int status = nodes && scratch && b.stack && b.out ? 0 : -1;
	if (status == 0) {
		struct quad_box all = quad_box_empty();
		for (uint32_t i = 0; i < n; i++)
			quad_box_join(&all, d->refs[i].box);
		b.root_area = quad_box_half_area(all);
		memcpy(b.stack, d->refs, (size_t)n * sizeof *b.stack);
		free(d->memory[0]);
		free(d->memory[1]);
		d->nodes = d->memory[0] = nodes;
		d->refs = d->memory[1] = b.out;
		build(&b, 0, n, 0, scratch);
		d->ref_count = b.emitted;
		d->parts = b.emitted > n;
	} else {
		free(nodes);
		free(b.out);
	}
	free(scratch);
	free(b.stack);
	return status;
}
