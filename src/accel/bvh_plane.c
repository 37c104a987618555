/* The cheapest plane between bins: all three axes are swept at once, a lane each. */
#include "accel/bvh_plane.h"

/* What is in a bin of every axis, or in several of them: lane i is axis i. */
struct by_axis {
	quad lo[3], hi[3];
	quad_int count;
};

/* Lanes 0, 1 and 2 of out[k] are coordinate k of a, b and c. */
static inline void transpose(quad a, quad b, quad c, quad out[3])
{
	quad low = __builtin_shufflevector(a, b, 0, 4, 1, 5), high = __builtin_shufflevector(a, b, 2, 6, 2, 6);
	out[0] = __builtin_shufflevector(low, c, 0, 1, 4, 4);
	out[1] = __builtin_shufflevector(low, c, 2, 3, 5, 5);
	out[2] = __builtin_shufflevector(high, c, 0, 1, 6, 6);
}

static inline struct by_axis bin_by_axis(const struct bvh_bins *b, int i)
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

/* Half the surface times the blocks; INFINITY where there is nothing. shift: 2^shift primitives are a block. */
static inline quad weigh_by_axis(const struct by_axis *a, int shift)
{
	quad x = a->hi[0] - a->lo[0], y = a->hi[1] - a->lo[1], z = a->hi[2] - a->lo[2];
	quad_int blocks = (a->count + ((1 << shift) - 1)) >> shift;
	return quad_select(a->count > 0, (x * y + y * z + z * x) * __builtin_convertvector(blocks, quad), quad_of(INFINITY));
}

/* The cheapest plane of every axis, and what is on its left. */
static inline void sweep(const struct bvh_bins *b, int bins, int shift, quad *cost, quad_int *bin, quad_int *left)
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

void bvh_find_plane(struct bvh_plane *p, const struct bvh_bins *b, int bins, const struct bvh_rules *rules)
{
	quad cost;
	quad_int bin, left;
	p->cost = INFINITY;
	sweep(b, bins, __builtin_ctz(rules->block), &cost, &bin, &left);
	for (int axis = 0; axis < 3; axis++)
		if (p->scale[axis] != 0 && cost[axis] < p->cost) {
			p->cost = cost[axis];
			p->axis = axis;
			p->bin = bin[axis];
			p->left = (uint32_t)left[axis];
		}
	if (p->cost == INFINITY)
		return;
	p->box[0] = p->box[1] = quad_box_empty();
	for (int i = 0; i < bins; i++)
		quad_box_join(&p->box[i >= p->bin], b->box[p->axis][i]);
}
