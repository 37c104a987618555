/* Uniform grid (ARTS: Fujimoto, Tanaka, Iwata 1986), walked cell by cell (Cleary and Wyvill 1988): the next cell is behind the nearest
 * of three planes ahead. Where a plane is met is computed from the plane, not by adding up steps, so that nothing drifts.
 *
 * In the terms of the literature on grids the columns leaves, empty_leaves and references are N_V, N_EV and N_OIV; actual_tests and
 * actual_leaves are N_IT and N_ETS. */
#include "accel/grid.h"
#include "accel/check.h"
#include "accel/mailbox.h"

static const char *const root_words[] = { "cube", "box", NULL };
static const char *const mailbox_words[] = { "none", "one", "full", NULL };
static const char *const stop_words[] = { "none", "model", "exact", NULL };
static const char *const setting_words[] = { "given", "woo", "homogeneous", "heterogeneous", NULL };
#define AT(field) offsetof(struct grid_options, field)
static const struct key keys[] = {
	{ "setting", KEY_WORD, AT(setting), 0, 0, GRID_GIVEN, setting_words,
	  "cells along each axis: given; woo: three times the cube root of the primitives on the longest; homogeneous: as many on each, "
	  "heterogeneous: near to cubes, by density" },
	{ "resolution", KEY_INT, AT(resolution), 1, GRID_SIDE_MOST, 32, NULL, "given: cells along x" },
	{ "resolution_y", KEY_INT, AT(resolution_y), 0, GRID_SIDE_MOST, 0, NULL, "given: cells along y; 0: as along x" },
	{ "resolution_z", KEY_INT, AT(resolution_z), 0, GRID_SIDE_MOST, 0, NULL, "given: cells along z; 0: as along x" },
	{ "density", KEY_REAL, AT(density), 1e-6, 1e6, 1, NULL, "homogeneous, heterogeneous: cells a primitive" },
	{ "root", KEY_WORD, AT(root), 0, 0, ROOT_BOX, root_words, "the region: bounding cube or tight bounding box" },
	{ "mailbox", KEY_WORD, AT(mailbox), 0, 0, MAILBOX_NONE, mailbox_words,
	  "tests spared: none, of what the last cell listed too, of all the ray has been tested against" },
	{ "stop", KEY_WORD, AT(stop), 0, 0, STOP_NONE, stop_words,
	  "given: nothing, or the best of 1, 2, 4, ... cells along x, up to the resolution, by the model or the exact expectation" },
	{ 0 }
};

static bool applies(const void *opt, const char *key)
{
	const struct grid_options *o = opt;
	if (strncmp(key, "resolution", 10) == 0 || strcmp(key, "stop") == 0)
		return o->setting == GRID_GIVEN;
	return strcmp(key, "density") != 0 || o->setting == GRID_HOMOGENEOUS || o->setting == GRID_HETEROGENEOUS;
}

static int cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	const struct grid *g = a->impl;
	uint32_t i = 0;
	for (int32_t z = 0; z < g->n[2]; z++)
		for (int32_t y = 0; y < g->n[1]; y++)
			for (int32_t x = 0; x < g->n[0]; x++, i++) {
				struct cell c = { .bounds.lo = vec(g->plane[0][x], g->plane[1][y], g->plane[2][z]),
					          .bounds.hi = vec(g->plane[0][x + 1], g->plane[1][y + 1], g->plane[2][z + 1]),
					          .ids = g->ids + g->first[i], .count = g->first[i + 1] - g->first[i], .leaf = true };
				c.area = box_area(&c.bounds);
				int status = fn(ctx, &c);
				if (status != 0)
					return status;
			}
	return 0;
}

/* Cell of p on one axis: one that is within slack of a plane belongs to the cell ahead. */
static inline int32_t locate(const struct accel *a, const struct grid *g, int axis, double p, double d)
{
	const double *plane = g->plane[axis];
	int32_t last = g->n[axis] - 1;
	double x = (p - plane[0]) * g->per_step.a[axis];
	int32_t i = x < 0 ? 0 : x > last ? last : (int32_t)x;
	while (i > 0 && p < plane[i])
		i--;
	while (i < last && p >= plane[i + 1])
		i++;
	if (d < 0 && i > 0 && p - plane[i] <= a->slack)
		return i - 1;
	return d >= 0 && i < last && plane[i + 1] - p <= a->slack ? i + 1 : i;
}

/* A ray on its way: its cell, and where it meets the next plane of each axis. */
struct walker {
	struct vec o, per_d;
	double exit[3];
	int32_t at[3], step[3], upper[3];
	uint32_t cell, stride[3];
};

static inline void find_exit(struct walker *w, const struct grid *g, int axis)
{
	w->exit[axis] = (g->plane[axis][w->at[axis] + w->upper[axis]] - w->o.a[axis]) * w->per_d.a[axis];
}

static inline void walk_start(struct walker *w, const struct accel *a, const struct grid *g, const struct ray *r, struct vec start)
{
	w->o = r->o;
	w->stride[0] = 1;
	w->stride[1] = (uint32_t)g->n[0];
	w->stride[2] = (uint32_t)g->n[0] * (uint32_t)g->n[1];
	w->cell = 0;
	for (int i = 0; i < 3; i++) {
		w->upper[i] = w->per_d.a[i] > 0;
		w->step[i] = w->upper[i] ? 1 : -1;
		w->at[i] = locate(a, g, i, start.a[i], r->d.a[i]);
		w->cell += (uint32_t)w->at[i] * w->stride[i];
		find_exit(w, g, i);
		if (r->d.a[i] == 0) /* it may run in a side */
			w->exit[i] = INFINITY;
	}
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct mailbox *m, struct tally *tally, const bool count)
{
	const struct grid *g = a->impl;
	struct walker w;
	struct vec start;
	*h = hit_none(r);
	for (int i = 0; i < 3; i++)
		w.per_d.a[i] = 1 / nonzero(r->d.a[i]);
	if (!root_enter(&a->root, r, w.per_d, a->slack, &start))
		return false;
	mailbox_next(m);
	walk_start(&w, a, g, r, start);
	for (;;) {
		int axis = w.exit[1] < w.exit[0];
		axis = w.exit[2] < w.exit[axis] ? 2 : axis;
		visit_leaf(a, g->ids + g->first[w.cell], g->first[w.cell + 1] - g->first[w.cell], r, h, m, tally, count);
		if (h->t <= w.exit[axis] + a->slack)
			break;
		w.at[axis] += w.step[axis];
		if (w.at[axis] < 0 || w.at[axis] >= g->n[axis])
			break;
		w.cell += (uint32_t)w.step[axis] * w.stride[axis];
		find_exit(&w, g, axis);
	}
	if (r->through)
		*h = hit_none(r);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}
WALK_WITH_MAILBOX(walk)

const struct accel_ops accel_grid = {
	"grid", "equal cells in rows, columns and layers", keys, sizeof(struct grid_options), applies,
	grid_build, cells, shoot, shoot_counted, shoot_many, check_lists, NULL
};
