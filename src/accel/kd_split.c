/* BALANCE is the rule of Subramanian and Fussell 1990, section 2: on every axis a plane is searched by halving the cell, towards the
 * side that holds more primitives entirely; of all planes looked at, the best balances the halves and is met by fewest primitives.
 * What it makes least is the longer of the two lists. A plane must leave a primitive on either side, one of them entirely. */
#include "accel/kd_split.h"

enum { SEARCH = 16 };

/* A plane looked at. */
struct candidate {
	int axis;
	double plane, side; /* side: of the cell along the axis */
	uint32_t longer, shared;
};

/* The better of two planes that both will do: shorter lists, fewer primitives shared, across the longer side. */
static bool is_better(const struct candidate *c, const struct candidate *d)
{
	if (c->longer != d->longer)
		return c->longer < d->longer;
	if (c->shared != d->shared)
		return c->shared < d->shared;
	return c->side > d->side;
}

/* Primitives entirely on either side of a plane. */
struct sides {
	uint32_t below, above;
};

static struct sides count_sides(const struct plane_builder *b, int axis, uint32_t n, double plane)
{
	const double *begin = b->low[axis], *end = b->high[axis], low = plane - b->slack, high = plane + b->slack;
	uint64_t below = 0, above = 0; /* as wide as what is compared, so that the loop becomes vectors */
	for (uint32_t i = 0; i < n; i++) {
		below += end[i] < low;
		above += begin[i] > high;
	}
	return (struct sides){ (uint32_t)below, (uint32_t)above };
}

static void search_axis(const struct plane_builder *b, const struct plane_cell *c, int axis, struct candidate *best)
{
	double low = c->bounds.lo.a[axis], high = c->bounds.hi.a[axis];
	const double least = low + b->margin, most = high - b->margin, side = high - low;
	struct sides at_low = { 0, c->count }, at_high = { c->count, 0 };
	for (int i = 0; i < SEARCH; i++) {
		struct candidate k = { .axis = axis, .plane = low + (high - low) / 2, .side = side };
		if (!(k.plane >= least && k.plane <= most))
			break;
		struct sides s = count_sides(b, axis, c->count, k.plane);
		k.longer = c->count - (s.below < s.above ? s.below : s.above);
		k.shared = c->count - s.below - s.above;
		if (s.below + s.above > 0 && s.below < c->count && s.above < c->count && is_better(&k, best))
			*best = k;
		if (s.below == s.above)
			break;
		*(s.below > s.above ? &high : &low) = k.plane;
		*(s.below > s.above ? &at_high : &at_low) = s;
		if (at_low.below == at_high.below && at_low.above == at_high.above)
			break; /* nothing begins or ends between them */
	}
}

static bool choose_balance(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	const struct kd_options *o = b->options;
	struct candidate best = { .longer = UINT32_MAX };
	if (c->count <= (uint32_t)o->common.max_objects)
		return false;
	for (uint32_t i = 0; i < c->count; i++)
		for (int k = 0; k < 3; k++) {
			b->low[k][i] = b->bounds[c->ids[i]].lo.a[k];
			b->high[k][i] = b->bounds[c->ids[i]].hi.a[k];
		}
	for (int i = 0; i < 3; i++)
		search_axis(b, c, i, &best);
	*axis = best.axis;
	*plane = best.plane;
	return best.longer < UINT32_MAX;
}

const char *const kd_split_words[] = { "balance", "sah", "hq26", "fast6", "exact", NULL };
plane_rule *const kd_split_rules[] = { choose_balance, kd_choose_sah, kd_choose_hq26, kd_choose_fast6, kd_choose_exact };
