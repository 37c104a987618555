/* Building a uniform grid: every primitive is put into the cells it meets, then the pairs are sorted by cell by counting. */
#include "accel/grid.h"
#include "geom/triangle.h"

#include <stdlib.h>

struct pair {
	uint32_t cell, id;
};

/* A grid being filled: pairs grow, from malloc. */
struct filling {
	const struct accel *accel;
	struct grid *grid;
	struct pair *pairs;
	size_t count, room;
};

static int64_t limit(double n)
{
	return n < 1 ? 1 : n > GRID_SIDE_MOST ? GRID_SIDE_MOST : (int64_t)(n + 0.5);
}

static void choose_resolution(struct grid *g, const struct accel *a, const struct grid_options *o)
{
	struct vec size = vec_sub(a->root.hi, a->root.lo);
	double longest = fmax(size.x, fmax(size.y, size.z)), n = a->primitives->count;
	const int64_t given[3] = { o->resolution, o->resolution_y ? o->resolution_y : o->resolution,
		                   o->resolution_z ? o->resolution_z : o->resolution };
	for (int i = 0; i < 3; i++) {
		int64_t side = given[i];
		if (o->setting == GRID_WOO)
			side = limit(3 * cbrt(n) * size.a[i] / longest);
		if (o->setting == GRID_HOMOGENEOUS)
			side = limit(cbrt(o->density * n));
		if (o->setting == GRID_HETEROGENEOUS)
			side = limit(size.a[i] * cbrt(o->density * n / (size.x * size.y * size.z)));
		/* Never thinner than some 60 slacks. */
		double most = size.a[i] / (longest * 0x1p-24);
		g->n[i] = (int32_t)((double)side > most ? limit(most) : side);
	}
}

static int make_planes(struct grid *g, struct accel *a, struct err *e)
{
	for (int i = 0; i < 3; i++) {
		double side = a->root.hi.a[i] - a->root.lo.a[i];
		g->plane[i] = NEW(&a->mem, double, (size_t)g->n[i] + 1);
		if (!g->plane[i])
			return err_memory(e, "grid");
		for (int k = 0; k < g->n[i]; k++)
			g->plane[i][k] = a->root.lo.a[i] + side * k / g->n[i];
		g->plane[i][g->n[i]] = a->root.hi.a[i];
		g->per_step.a[i] = g->n[i] / side;
	}
	return 0;
}

/* The cells along an axis that come within slack of [low, high]. */
static void find_range(const struct filling *f, int axis, double low, double high, int32_t *from, int32_t *upto)
{
	const struct grid *g = f->grid;
	const double *plane = g->plane[axis], slack = f->accel->slack, origin = f->accel->root.lo.a[axis];
	int32_t last = g->n[axis] - 1, i = (int32_t)fmin(last, fmax(0, (low - origin) * g->per_step.a[axis]));
	int32_t k = (int32_t)fmin(last, fmax(0, (high - origin) * g->per_step.a[axis]));
	while (i > 0 && plane[i] >= low - slack)
		i--;
	while (i < last && plane[i + 1] < low - slack)
		i++;
	while (k < last && plane[k + 1] <= high + slack)
		k++;
	while (k > i && plane[k] > high + slack)
		k--;
	*from = i;
	*upto = k;
}

static int add_pair(struct filling *f, uint32_t cell, uint32_t id, struct err *e)
{
	if (f->count == f->room) {
		size_t want = f->room ? 2 * f->room : 4 * (size_t)f->accel->primitives->count + 1024;
		struct pair *grown = want > UINT32_MAX ? NULL : realloc(f->pairs, want * sizeof *grown);
		if (!grown)
			return err_memory(e, "grid");
		f->pairs = grown;
		f->room = want;
	}
	f->pairs[f->count++] = (struct pair){ cell, id };
	f->grid->first[cell + 1]++;
	return 0;
}

static bool meets(const struct filling *f, const struct primitive *p, const int32_t *at)
{
	const struct grid *g = f->grid;
	const double slack = f->accel->slack;
	struct box b;
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = g->plane[i][at[i]] - slack;
		b.hi.a[i] = g->plane[i][at[i] + 1] + slack;
	}
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_touches_inner(&p->triangle, &b) : primitive_touches(p, &b);
}

static int add_primitive(struct filling *f, uint32_t id, struct err *e)
{
	const struct primitive *p = &f->accel->primitives->all[id];
	const struct grid *g = f->grid;
	struct box b = primitive_bounds(p);
	int32_t from[3], upto[3], at[3], wide = 0;
	for (int i = 0; i < 3; i++) {
		find_range(f, i, b.lo.a[i], b.hi.a[i], &from[i], &upto[i]);
		wide += from[i] < upto[i];
	}
	/* A triangle that passes along one row of cells meets each of them. */
	bool all = wide == 0 || (wide == 1 && p->kind == PRIMITIVE_TRIANGLE);
	for (at[2] = from[2]; at[2] <= upto[2]; at[2]++)
		for (at[1] = from[1]; at[1] <= upto[1]; at[1]++)
			for (at[0] = from[0]; at[0] <= upto[0]; at[0]++) {
				uint32_t cell = ((uint32_t)at[2] * (uint32_t)g->n[1] + (uint32_t)at[1]) * (uint32_t)g->n[0] + (uint32_t)at[0];
				if ((all || meets(f, p, at)) && add_pair(f, cell, id, e) != 0)
					return -1;
			}
	return 0;
}

/* Lists from pairs: first[c + 1] holds the length of list c and becomes its end. */
static int sort_pairs(struct filling *f, struct accel *a, size_t cells, struct err *e)
{
	struct grid *g = f->grid;
	g->ids = NEW(&a->mem, uint32_t, f->count);
	uint32_t *next = malloc((cells + 1) * sizeof *next);
	if (!g->ids || !next) {
		free(next);
		return err_memory(e, "grid");
	}
	for (size_t c = 0; c < cells; c++) {
		a->empty_leaves += g->first[c + 1] == 0;
		g->first[c + 1] += g->first[c];
		next[c] = g->first[c];
	}
	for (size_t i = 0; i < f->count; i++)
		g->ids[next[f->pairs[i].cell]++] = f->pairs[i].id;
	free(next);
	a->nodes = a->leaves = cells;
	a->references = f->count;
	return 0;
}

int grid_build(struct accel *a, const void *opt, struct err *e)
{
	const struct grid_options *o = opt;
	struct grid *g = NEW(&a->mem, struct grid, 1);
	struct filling f = { .accel = a, .grid = g };
	if (!g)
		return err_memory(e, "grid");
	a->root = root_box(&a->primitives->bounds, (enum root_kind)o->root);
	a->slack = 1e-9 * box_diagonal(&a->root);
	a->plane_tests = true;
	a->mailbox = (enum mailbox_kind)o->mailbox;
	a->impl = g;
	choose_resolution(g, a, o);
	double cells = (double)g->n[0] * g->n[1] * g->n[2];
	if (cells > GRID_CELLS_MOST)
		return err_at(e, STATUS_INPUT, NULL, 0, "grid: %d x %d x %d cells are more than 2^28", g->n[0], g->n[1], g->n[2]);
	g->first = NEW(&a->mem, uint32_t, (size_t)cells + 1);
	if (!g->first)
		return err_memory(e, "grid");
	int status = make_planes(g, a, e);
	for (uint32_t i = 0; status == 0 && i < a->primitives->count; i++)
		status = add_primitive(&f, i, e);
	if (status == 0)
		status = sort_pairs(&f, a, (size_t)cells, e);
	free(f.pairs);
	return status;
}
