#include "trace/flux_count.h"

#include "accel/root.h"
#include "accel/walk.h"

/* A segment on its way through the grid. */
struct way {
	struct flux *flux;
	const struct ray *ray;
	struct vec per_d;
	double slack;
	int32_t at[3]; /* the voxel */
};

static double plane(const struct flux *f, int axis, int32_t i)
{
	return f->root.lo.a[axis] + i * f->step.a[axis];
}

/* The voxel of p: one within slack of a plane belongs to the voxel ahead. */
static void locate(struct way *w, struct vec p)
{
	const struct flux *f = w->flux;
	for (int i = 0; i < 3; i++) {
		double x = fmin(f->side, fmax(0, (p.a[i] - f->root.lo.a[i]) / f->step.a[i]));
		int32_t near = (int32_t)(x + 0.5), cell = (int32_t)x;
		if (fabs(p.a[i] - plane(f, i, near)) <= w->slack)
			cell = near - (w->ray->d.a[i] < 0);
		w->at[i] = cell < 0 ? 0 : cell >= f->side ? f->side - 1 : cell;
	}
}

/* Count the start, or the side of the root through which the segment comes in: the one it crosses last. */
static void count_start(const struct way *w)
{
	const struct box *root = &w->flux->root;
	double last = 0;
	int axis = -1;
	for (int i = 0; i < 3; i++) {
		double below = root->lo.a[i] - w->ray->o.a[i], above = root->hi.a[i] - w->ray->o.a[i];
		double t = (below > 0 ? below : above < 0 ? above : 0) * w->per_d.a[i];
		if (t > last) {
			last = t;
			axis = i;
		}
	}
	if (axis < 0) {
		flux_add_end(w->flux, w->ray->from == NO_PRIMITIVE ? FLUX_FREE : FLUX_ON_SURFACE, w->at);
		return;
	}
	int32_t crossed[3] = { w->at[0], w->at[1], w->at[2] };
	crossed[axis] = w->per_d.a[axis] > 0 ? 0 : w->flux->side;
	flux_add_crossing(w->flux, axis, crossed);
}

/* Go on to the next voxel over the nearest plane; false where the segment ends before or leaves the root. */
static bool step(struct way *w, bool hit)
{
	struct flux *f = w->flux;
	double least = INFINITY;
	int axis = 0;
	for (int i = 0; i < 3; i++) {
		double t = (plane(f, i, w->at[i] + (w->per_d.a[i] > 0)) - w->ray->o.a[i]) * w->per_d.a[i];
		if (t < least) {
			least = t;
			axis = i;
		}
	}
	if (w->ray->t_max <= least + w->slack) {
		flux_add_end(f, hit ? FLUX_ON_SURFACE : FLUX_FREE, w->at);
		return false;
	}
	bool upper = w->per_d.a[axis] > 0;
	int32_t crossed[3] = { w->at[0], w->at[1], w->at[2] };
	crossed[axis] += upper;
	flux_add_crossing(f, axis, crossed);
	w->at[axis] += upper ? 1 : -1;
	return w->at[axis] >= 0 && w->at[axis] < f->side;
}

void flux_count(struct flux *f, const struct segment *segments, size_t count, double slack)
{
	for (size_t i = 0; i < count; i++) {
		const struct ray *r = &segments[i].ray;
		struct way w = { .flux = f, .ray = r, .slack = slack };
		struct vec start;
		w.per_d = vec(1 / nonzero(r->d.x), 1 / nonzero(r->d.y), 1 / nonzero(r->d.z));
		if (!root_enter(&f->root, r, w.per_d, slack, &start))
			continue;
		f->segments++;
		locate(&w, start);
		count_start(&w);
		while (step(&w, segments[i].hit))
			;
	}
}
