#include "cost/image.h"

#include "cost/surface.h"

#include <stdlib.h>

/* Sides of boxes in voxels, and areas over each other, are known better than this. */
static const double rounding = 1e-6;

struct image_sums {
	const struct flux *flux;
	const struct accel *accel;
	struct err *err;
	double alpha, beta;
	/* Surface in the leaves inside voxels on whose surfaces segments end: of every leaf, in the order of the cells, and by voxel. */
	double *leaf_areas, *voxel_areas;
	size_t leaf;
	bool boxes; /* all leaves so far are, and partition the root */
	double cost[FLUX_GROUPS];
};

/* The voxel that holds box b, given in voxels, and is larger. False where there is none. */
static bool voxel_around(const struct box *b, int32_t at[3])
{
	double volume = 1;
	for (int i = 0; i < 3; i++) {
		at[i] = (int32_t)((b->lo.a[i] + b->hi.a[i]) / 2);
		if (b->lo.a[i] < at[i] - rounding || b->hi.a[i] > at[i] + 1 + rounding)
			return false;
		volume *= b->hi.a[i] - b->lo.a[i];
	}
	return volume < 1 - rounding;
}

static bool any(const uint32_t counts[FLUX_GROUPS])
{
	for (int g = 0; g < FLUX_GROUPS; g++)
		if (counts[g])
			return true;
	return false;
}

/* First pass. */
static int measure_leaf(void *ctx, const struct cell *c)
{
	struct image_sums *s = ctx;
	struct surface surface;
	int32_t at[3];
	if (!c->leaf)
		return 0;
	double *area = &s->leaf_areas[s->leaf++];
	struct box b = flux_place(s->flux, &c->bounds);
	if (c->count == 0 || !voxel_around(&b, at) || !any(s->flux->voxels[flux_at(at)].ends[FLUX_ON_SURFACE]))
		return 0;
	if (surface_measure(&surface, s->accel, c, s->err) != 0)
		return -1;
	*area = surface.open;
	for (int f = 0; f < 6; f++)
		*area += surface.in_face[f];
	s->voxel_areas[flux_at(at)] += *area;
	return 0;
}

/* Ends on surfaces in a leaf, b in voxels. */
static void share_surface(const struct image_sums *s, const struct box *b, double area, double ends[FLUX_GROUPS])
{
	int32_t at[3];
	if (!voxel_around(b, at) || s->voxel_areas[flux_at(at)] == 0) {
		flux_ends(s->flux, FLUX_ON_SURFACE, b, ends);
		return;
	}
	double share = area / s->voxel_areas[flux_at(at)];
	for (int g = 0; g < FLUX_GROUPS; g++)
		ends[g] = share * s->flux->voxels[flux_at(at)].ends[FLUX_ON_SURFACE][g];
}

/* Second pass. */
static int add_leaf(void *ctx, const struct cell *c)
{
	struct image_sums *s = ctx;
	double crossings[FLUX_GROUPS], free_ends[FLUX_GROUPS], surface_ends[FLUX_GROUPS];
	if (!c->leaf)
		return 0;
	s->boxes = s->boxes && c->area > (1 - rounding) * box_area(&c->bounds);
	struct box b = flux_place(s->flux, &c->bounds);
	flux_crossings(s->flux, &b, crossings);
	flux_ends(s->flux, FLUX_FREE, &b, free_ends);
	share_surface(s, &b, s->leaf_areas[s->leaf++], surface_ends);
	for (int g = 0; g < FLUX_GROUPS; g++)
		s->cost[g] += (s->alpha + s->beta * c->count) * (crossings[g] + free_ends[g] + surface_ends[g]) / 2;
	return 0;
}

static struct estimate estimate_of(const double cost[FLUX_GROUPS], const uint64_t segments[FLUX_GROUPS])
{
	const double student = 2.364624; /* 97.5 % with FLUX_GROUPS - 1 degrees of freedom */
	_Static_assert(FLUX_GROUPS == 8, "Student's t is that of 8 groups");
	double costs = 0, count = 0, square = 0;
	for (int g = 0; g < FLUX_GROUPS; g++) {
		costs += cost[g];
		count += (double)segments[g];
	}
	if (count == 0)
		return (struct estimate){ NAN, NAN, NAN };
	double mean = costs / count;
	for (int g = 0; g < FLUX_GROUPS; g++) {
		double far = cost[g] - mean * (double)segments[g];
		square += far * far;
	}
	double half = student * sqrt(square * FLUX_GROUPS / (FLUX_GROUPS - 1)) / count;
	return (struct estimate){ mean, mean - half, mean + half };
}

int cost_predict_image(struct estimate *out, const struct flux *f, const struct accel *a, double alpha, double beta, struct err *e)
{
	struct image_sums s = { .flux = f, .accel = a, .err = e, .alpha = alpha, .beta = beta, .boxes = !a->volumes };
	const int32_t most[3] = { FLUX_SIDE, FLUX_SIDE, FLUX_SIDE };
	s.leaf_areas = calloc(a->leaves, sizeof *s.leaf_areas);
	s.voxel_areas = calloc(flux_at(most) + 1, sizeof *s.voxel_areas);
	int status = s.leaf_areas && s.voxel_areas ? a->ops->cells(a, measure_leaf, &s) : err_memory(e, "prediction");
	s.leaf = 0;
	if (status == 0)
		status = a->ops->cells(a, add_leaf, &s);
	*out = s.boxes ? estimate_of(s.cost, f->segments) : (struct estimate){ NAN, NAN, NAN };
	free(s.leaf_areas);
	free(s.voxel_areas);
	return status;
}
