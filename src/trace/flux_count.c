#include "trace/flux_count.h"

#include "accel/root.h"
#include "accel/walk.h"
#include "base/rng.h"

/* A segment on its way through the grid. */
struct passage {
	struct flux *flux;
	const struct ray *ray;
	struct vec per_d;
	double slack;
	size_t group;
	int32_t at[3]; /* the voxel */
};

static double plane_at(const struct flux *f, int axis, int32_t i)
{
	return f->root.lo.a[axis] + i * f->step.a[axis];
}

/* Go to the voxel of p: one within slack of a plane belongs to the voxel ahead. */
static void locate(struct passage *w, struct vec p)
{
	const struct flux *f = w->flux;
	for (int i = 0; i < 3; i++) {
		double x = fmin(FLUX_SIDE, fmax(0, (p.a[i] - f->root.lo.a[i]) / f->step.a[i]));
		int32_t nearest = (int32_t)(x + 0.5), cell = (int32_t)x;
		if (fabs(p.a[i] - plane_at(f, i, nearest)) <= w->slack)
			cell = nearest - (w->ray->d.a[i] < 0);
		w->at[i] = cell < 0 ? 0 : cell >= FLUX_SIDE ? FLUX_SIDE - 1 : cell;
	}
}

static void count_end(const struct passage *w, enum flux_end kind)
{
	w->flux->voxels[flux_at(w->at)].ends[kind][w->group]++;
}

/* Count a crossing of the side of the voxel that lies ahead along an axis, or behind. */
static void count_crossing(const struct passage *w, int axis, bool ahead)
{
	int32_t at[3] = { w->at[0], w->at[1], w->at[2] };
	at[axis] += ahead == (w->per_d.a[axis] > 0);
	w->flux->voxels[flux_at(at)].crossings[axis][w->group]++;
}

/* Count the start, or the side of the root through which the segment comes in: of those it starts on or outside of, the last.
 * Two cases are ends on a surface rather than crossings, for cells behind it are not visited: starting on one that lies in a side
 * of the root, and coming in just where the segment is hit. */
static void count_start(const struct passage *w, bool hit)
{
	const struct box *root = &w->flux->root;
	const struct ray *r = w->ray;
	double last = -INFINITY;
	int axis = -1;
	for (int i = 0; i < 3; i++) {
		double side = r->d.a[i] > 0 ? root->lo.a[i] : root->hi.a[i], t = (side - r->o.a[i]) * w->per_d.a[i];
		if (r->d.a[i] != 0 && t > last) {
			last = t;
			axis = i;
		}
	}
	bool outside = r->from == NO_PRIMITIVE ? last >= -w->slack : last > w->slack;
	if (!outside || (hit && r->t_max <= last + w->slack))
		count_end(w, r->from == NO_PRIMITIVE && !outside ? FLUX_FREE : FLUX_ON_SURFACE);
	else
		count_crossing(w, axis, false);
}

/* Go on to the next voxel; false where the segment ends before or leaves the root. */
static bool step_on(struct passage *w, bool hit)
{
	double least = INFINITY;
	int axis = 0;
	for (int i = 0; i < 3; i++) {
		bool upper = w->per_d.a[i] > 0;
		double t = (plane_at(w->flux, i, w->at[i] + upper) - w->ray->o.a[i]) * w->per_d.a[i];
		if (t < least) {
			least = t;
			axis = i;
		}
	}
	if (w->ray->t_max <= least + w->slack) {
		count_end(w, hit ? FLUX_ON_SURFACE : FLUX_FREE);
		return false;
	}
	count_crossing(w, axis, true);
	w->at[axis] += w->per_d.a[axis] > 0 ? 1 : -1;
	return w->at[axis] >= 0 && w->at[axis] < FLUX_SIDE;
}

void flux_count(struct flux *f, const struct segment *segments, size_t count, double slack)
{
	for (size_t i = 0; i < count; i++) {
		const struct ray *r = &segments[i].ray;
		struct passage w = { .flux = f, .ray = r, .slack = slack };
		struct vec start;
		w.per_d = vec(1 / nonzero(r->d.x), 1 / nonzero(r->d.y), 1 / nonzero(r->d.z));
		if (!root_enter(&f->root, r, w.per_d, slack, &start))
			continue;
		w.group = (size_t)(rng_uniform(rng_key(0, 0, segments[i].sample), 0) * FLUX_GROUPS);
		f->segments[w.group]++;
		locate(&w, start);
		count_start(&w, segments[i].hit);
		while (step_on(&w, segments[i].hit))
			;
	}
}
