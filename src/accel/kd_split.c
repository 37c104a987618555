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

static void count_sides(const struct plane_builder *b, uint32_t n, double plane, uint32_t *below, uint32_t *above)
{
	double low = plane - b->slack, high = plane + b->slack;
	uint32_t under = 0, over = 0;
	for (uint32_t i = 0; i < n; i++) {
		under += b->high[i] < low;
		over += b->low[i] > high;
	}
	*below = under;
	*above = over;
}

static void search_axis(const struct plane_builder *b, const struct plane_cell *c, int axis, struct candidate *best)
{
	double low = c->bounds.lo.a[axis], high = c->bounds.hi.a[axis];
	const double least = low + b->margin, most = high - b->margin, side = high - low;
	for (uint32_t i = 0; i < c->count; i++) {
		b->low[i] = b->bounds[c->ids[i]].lo.a[axis];
		b->high[i] = b->bounds[c->ids[i]].hi.a[axis];
	}
	for (int i = 0; i < SEARCH; i++) {
		struct candidate k = { .axis = axis, .plane = low + (high - low) / 2, .side = side };
		uint32_t below, above;
		if (!(k.plane >= least && k.plane <= most))
			break;
		count_sides(b, c->count, k.plane, &below, &above);
		k.longer = c->count - (below < above ? below : above);
		k.shared = c->count - below - above;
		if (below + above > 0 && below < c->count && above < c->count && is_better(&k, best))
			*best = k;
		if (below == above)
			break;
		*(below > above ? &high : &low) = k.plane;
	}
}

static bool choose_balance(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	const struct kd_options *o = b->options;
	struct candidate best = { .longer = UINT32_MAX };
	if (c->count <= (uint32_t)o->common.max_objects)
		return false;
	for (int i = 0; i < 3; i++)
		search_axis(b, c, i, &best);
	*axis = best.axis;
	*plane = best.plane;
	return best.longer < UINT32_MAX;
}

const char *const kd_split_words[] = { "balance", NULL };
plane_rule *const kd_split_rules[] = { choose_balance };
