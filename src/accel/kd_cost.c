/* Planes of least expected cost: greedily, as if both halves stayed leaves,
 *   C = p C_T + p_lower N_lower C_I + p_upper N_upper C_I,
 * against p N C_I of a leaf (MacDonald and Booth 1990; eq. (1) of Fabianowski, Fowler, Dingliana 2009). What p is makes the rule:
 * geom/interior.h. C changes least where a primitive begins or ends, so that planes stand just off these places: both ends of every
 * primitive's part in the cell are sorted and swept (Wald and Havran 2006). A plane that cuts off a large enough empty part goes before
 * others (Hurley, Kapustin, Reshetov, Soupikov 2002). Of equal planes the first axis's lowest is taken.
 *
 * Eq. (4) and the exact value take a microsecond and more; they choose between the planes, one an axis, that eq. (5) finds best, and the exact
 * value does so only where eq. (5) leaves it in doubt. */
#include "accel/kd_split.h"
#include "base/order.h"
#include "geom/clip.h"
#include "geom/interior.h"

#include <string.h>

struct metric {
	double (*chance)(const struct box *scene, const struct box *node);
	struct interior_slide (*slide)(const struct box *scene, const struct box *node, int axis);
	bool slides;   /* 'slide' is of 'chance' itself */
	bool is_exact; /* 'chance' is interior_exact: cuts are quicker than parts */
};

struct candidate {
	int axis;
	double plane, cost; /* cost: INFINITY where there is no plane */
	uint32_t lower, upper;
	bool empties;       /* cuts off a large empty part */
};

static bool is_better(const struct candidate *c, const struct candidate *d)
{
	return c->empties != d->empties ? c->empties : c->cost < d->cost;
}

/* Bounding box of the part of a primitive in a cell. */
static struct box bound_part(const struct plane_builder *b, const struct box *cell, uint32_t id)
{
	const struct primitive *p = &b->accel->primitives->all[id];
	struct box part = b->bounds[id];
	bool within = true;
	for (int i = 0; i < 3; i++)
		within &= part.lo.a[i] >= cell->lo.a[i] && part.hi.a[i] <= cell->hi.a[i];
	if (within)
		return part;
	if (p->kind == PRIMITIVE_TRIANGLE) {
		struct polygon cut;
		cut.count = 3;
		memcpy(cut.corner, p->triangle.v, sizeof p->triangle.v); /* the rest of it is no one's */
		polygon_cut_box(&cut, cell);
		if (cut.count > 0)
			part = box_empty();
		for (int i = 0; i < cut.count; i++)
			box_extend(&part, cut.corner[i]);
	}
	for (int i = 0; i < 3; i++) {
		part.lo.a[i] = fmin(fmax(part.lo.a[i], cell->lo.a[i]), cell->hi.a[i]);
		part.hi.a[i] = fmin(fmax(part.hi.a[i], cell->lo.a[i]), cell->hi.a[i]);
	}
	return part;
}

static void sort_ends(struct plane_builder *b, const struct plane_cell *c)
{
	for (uint32_t i = 0; i < c->count; i++) {
		struct box part = bound_part(b, &c->bounds, c->ids[i]);
		for (int k = 0; k < 3; k++) {
			b->low[k][i] = part.lo.a[k];
			b->high[k][i] = part.hi.a[k];
		}
	}
	for (int k = 0; k < 3; k++) {
		reals_sort(b->low[k], b->spare, c->count);
		reals_sort(b->high[k], b->spare, c->count);
	}
}

/* Cost of a candidate whose halves are met with these chances; a leaf of the cell costs 'leaf'. */
static void weigh(const struct kd_options *o, struct candidate *k, const struct box *cell, double chance, const double half[2], double leaf)
{
	double low = cell->lo.a[k->axis], high = cell->hi.a[k->axis], empty = fmax(k->lower ? 0 : k->plane - low, k->upper ? 0 : high - k->plane);
	k->cost = chance * o->step + o->test * (half[0] * k->lower + half[1] * k->upper);
	k->empties = empty > 0 && empty >= o->empty_cutoff * (high - low) && k->cost < leaf;
}

/* The best plane across an axis. */
static struct candidate sweep(const struct plane_builder *b, const struct plane_cell *c, const struct metric *m, int axis)
{
	const struct interior_slide slide = m->slide(&b->accel->root, &c->bounds, axis);
	const double least = slide.low + b->margin, most = slide.high - b->margin, *low = b->low[axis], *high = b->high[axis];
	const double chance = interior_slide_to(&slide, slide.high, 0), leaf = ((const struct kd_options *)b->options)->test * chance * c->count;
	struct candidate best = { .axis = axis, .cost = INFINITY };
	uint32_t i = 0, j = 0, begun = 0, ended = 0; /* next planes; primitives that begin before the plane, that end before it */
	while (i < c->count || j < c->count) {
		bool begins = i < c->count && (j == c->count || low[i] - b->margin <= high[j] + b->margin);
		struct candidate k = { .axis = axis, .plane = begins ? low[i++] - b->margin : high[j++] + b->margin };
		if (!(k.plane >= least && k.plane <= most))
			continue;
		while (begun < c->count && low[begun] <= k.plane + b->slack)
			begun++;
		while (ended < c->count && high[ended] < k.plane - b->slack)
			ended++;
		k.lower = begun;
		k.upper = c->count - ended;
		const double half[2] = { interior_slide_to(&slide, k.plane, 0), interior_slide_to(&slide, k.plane, 1) };
		weigh(b->options, &k, &c->bounds, chance, half, leaf);
		if (is_better(&k, &best))
			best = k;
	}
	return best;
}

/* Judge a candidate by the metric itself; parts: of the cell, where it is exact. */
static void judge(const struct plane_builder *b, const struct plane_cell *c, const struct metric *m, struct candidate *k,
                  const struct interior_parts *parts, double leaf)
{
	struct box lower = c->bounds, upper = c->bounds;
	double half[2];
	lower.hi.a[k->axis] = upper.lo.a[k->axis] = k->plane;
	if (m->is_exact) {
		interior_cut(&b->accel->root, &c->bounds, parts, k->axis, k->plane, half);
	} else {
		half[0] = m->chance(&b->accel->root, &lower);
		half[1] = m->chance(&b->accel->root, &upper);
	}
	weigh(b->options, k, &c->bounds, parts->all, half, leaf);
}

/* The best by eq. (5) is beyond doubt where no other plane comes within a tenth of it, nor does a leaf: then the exact value is not asked. */
static const double doubt = 0.1;

static bool is_close(const struct candidate *k, const struct candidate *best)
{
	return k->cost < INFINITY && k->empties == best->empties && k->cost <= (1 + doubt) * best->cost;
}

static bool is_beyond_doubt(const struct candidate *k, const struct candidate *best, double leaf)
{
	int close = 0;
	for (int i = 0; i < 3; i++)
		close += is_close(&k[i], best);
	return close <= 1 && fabs(best->cost - leaf) > doubt * leaf;
}

static struct candidate find_best(const struct candidate *k)
{
	struct candidate best = { .cost = INFINITY };
	for (int i = 0; i < 3; i++)
		if (is_better(&k[i], &best))
			best = k[i];
	return best;
}

/* Judge what the slide has found best by the metric itself; *leaf: what a leaf of the cell costs, by the slide and then by the metric. */
static struct candidate judge_all(const struct plane_builder *b, const struct plane_cell *c, const struct metric *m, struct candidate *k,
                                  double *leaf)
{
	const struct candidate best = find_best(k);
	if (m->is_exact && is_beyond_doubt(k, &best, *leaf))
		return best;
	const struct interior_parts parts = m->is_exact ? interior_measure(&b->accel->root, &c->bounds)
		                                        : (struct interior_parts){ .all = m->chance(&b->accel->root, &c->bounds) };
	*leaf *= parts.all / interior_fast6(&b->accel->root, &c->bounds);
	for (int i = 0; i < 3; i++) {
		if (m->is_exact && !is_close(&k[i], &best))
			k[i] = (struct candidate){ .cost = INFINITY };
		if (k[i].cost < INFINITY)
			judge(b, c, m, &k[i], &parts, *leaf);
	}
	return find_best(k);
}

static bool choose(struct plane_builder *b, const struct plane_cell *c, const struct metric *m, int *axis, double *plane)
{
	if (c->count == 0)
		return false;
	struct candidate k[3], best;
	double leaf = ((const struct kd_options *)b->options)->test * (m->slides ? m->chance : interior_fast6)(&b->accel->root, &c->bounds) * c->count;
	sort_ends(b, c);
	for (int i = 0; i < 3; i++)
		k[i] = sweep(b, c, m, i);
	best = m->slides ? find_best(k) : judge_all(b, c, m, k, &leaf);
	*axis = best.axis;
	*plane = best.plane;
	return best.cost < leaf;
}

static const struct metric sah = { interior_sah, interior_slide_sah, true, false }, fast6 = { interior_fast6, interior_slide_fast6, true, false },
	hq26 = { interior_hq26, interior_slide_fast6, false, false }, exact = { interior_exact, interior_slide_fast6, false, true };

bool kd_choose_sah(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	return choose(b, c, &sah, axis, plane);
}

bool kd_choose_hq26(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	return choose(b, c, &hq26, axis, plane);
}

bool kd_choose_fast6(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	return choose(b, c, &fast6, axis, plane);
}

bool kd_choose_exact(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	return choose(b, c, &exact, axis, plane);
}
