#include "cost/image.h"

#include "cost/surface.h"

#include <stdlib.h>

struct image_sums {
	const struct flux *flux;
	const struct accel *accel;
	struct err *err;
	double alpha, beta;
	/* Surface in the leaves that lie inside a voxel, in the order of the cells, and by voxel; 0 where no segment ends on one. */
	double *leaf_areas, *voxel_areas;
	size_t leaf;
	double cost;
};

/* The voxel around a box in voxels that is smaller than one, or -1 where it reaches into several or fills it. */
static int64_t voxel_around(const struct flux *f, const struct box *b)
{
	const double rounding = 1e-6;
	int64_t voxel = 0;
	double volume = 1;
	for (int i = 2; i >= 0; i--) {
		double low = floor((b->lo.a[i] + b->hi.a[i]) / 2);
		if (b->lo.a[i] < low - rounding || b->hi.a[i] > low + 1 + rounding)
			return -1;
		voxel = voxel * f->side + (int64_t)low;
		volume *= b->hi.a[i] - b->lo.a[i];
	}
	return volume < 1 - rounding ? voxel : -1;
}

static struct box voxel_box(const struct flux *f, int64_t voxel)
{
	struct vec lo = vec((double)(voxel % f->side), (double)(voxel / f->side % f->side), (double)(voxel / f->side / f->side));
	return (struct box){ lo, vec_add(lo, vec(1, 1, 1)) };
}

/* First pass: how much surface every leaf in a voxel has, and the voxel's leaves together. */
static int measure_leaf(void *ctx, const struct cell *c)
{
	struct image_sums *s = ctx;
	if (!c->leaf)
		return 0;
	struct box b = flux_place(s->flux, &c->bounds);
	int64_t voxel = voxel_around(s->flux, &b);
	double *area = &s->leaf_areas[s->leaf++];
	if (voxel < 0 || c->count == 0)
		return 0;
	struct box around = voxel_box(s->flux, voxel);
	if (flux_ends(s->flux, FLUX_ON_SURFACE, &around) == 0)
		return 0;
	struct surface surface;
	if (surface_measure(&surface, s->accel, c, s->err) != 0)
		return -1;
	*area = surface.open;
	for (int f = 0; f < 6; f++)
		*area += surface.in_face[f];
	s->voxel_areas[voxel] += *area;
	return 0;
}

/* Second pass. */
static int add_leaf(void *ctx, const struct cell *c)
{
	struct image_sums *s = ctx;
	if (!c->leaf)
		return 0;
	struct box b = flux_place(s->flux, &c->bounds);
	int64_t voxel = voxel_around(s->flux, &b);
	double area = s->leaf_areas[s->leaf++], on_surface;
	if (voxel >= 0 && s->voxel_areas[voxel] > 0) {
		struct box around = voxel_box(s->flux, voxel);
		on_surface = area > 0 ? flux_ends(s->flux, FLUX_ON_SURFACE, &around) * area / s->voxel_areas[voxel] : 0;
	} else {
		on_surface = flux_ends(s->flux, FLUX_ON_SURFACE, &b);
	}
	double visits = (flux_crossings(s->flux, &b) + flux_ends(s->flux, FLUX_FREE, &b) + on_surface) / 2;
	s->cost += (s->alpha + s->beta * c->count) * visits;
	return 0;
}

int image_predict(double *cost, const struct flux *f, const struct accel *a, double alpha, double beta, struct err *e)
{
	struct image_sums s = { .flux = f, .accel = a, .err = e, .alpha = alpha, .beta = beta };
	size_t side = (size_t)f->side;
	s.leaf_areas = calloc(a->leaves, sizeof *s.leaf_areas);
	s.voxel_areas = calloc(side * side * side, sizeof *s.voxel_areas);
	int status = s.leaf_areas && s.voxel_areas ? a->ops->cells(a, measure_leaf, &s) : err_memory(e, "prediction");
	s.leaf = 0;
	if (status == 0)
		status = a->ops->cells(a, add_leaf, &s);
	*cost = f->segments > 0 ? s.cost / (double)f->segments : NAN;
	free(s.leaf_areas);
	free(s.voxel_areas);
	return status;
}
