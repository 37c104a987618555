/* The region a structure partitions. */
#ifndef ACCEL_ROOT_H
#define ACCEL_ROOT_H

#include "geom/box.h"
#include "geom/ray.h"

enum root_kind { ROOT_CUBE, ROOT_BOX };

/* The tight box of the bounds, or the cube about its centre. A side without length gets a small one (1e-6 of the longest), so
 * that every cell has a volume. lo + (hi - lo) == hi in every coordinate, so that a grid from lo ends exactly at hi. */
struct box root_box(const struct box *bounds, enum root_kind kind);

/* Whether a ray that goes d along an axis, below and above away from the two sides, leads out of one from within slack of it. */
static inline bool side_left(double d, double below, double above, double slack)
{
	return (d < 0 && below >= -slack) || (d > 0 && above <= slack);
}

/* For structures whose boxes are met by a ray that leads out of the root from within slack of a side, or from beyond it: it hits
 * nothing, though surfaces may lie in that side. */
static inline void root_drop_hit(const struct box *root, const struct ray *r, double slack, struct hit *h)
{
	bool left = false;
	if (h->id == NO_PRIMITIVE)
		return;
	for (int i = 0; i < 3; i++)
		left |= side_left(r->d.a[i], root->lo.a[i] - r->o.a[i], root->hi.a[i] - r->o.a[i], slack);
	if (left)
		*h = hit_none(r);
}

/* Where the ray starts inside the root: its origin, or the point where it comes in. per_d: 1 / d, finite. False when it visits
 * nothing: it misses the root, ends before it, or leads out of it from within slack of a side. */
static inline bool root_enter(const struct box *root, const struct ray *r, struct vec per_d, double slack, struct vec *start)
{
	double t_in = 0, t_out = r->t_max + slack; /* one that ends on a side comes in */
	*start = r->o;
	for (int i = 0; i < 3; i++) {
		double below = root->lo.a[i] - r->o.a[i], above = root->hi.a[i] - r->o.a[i];
		if (side_left(r->d.a[i], below, above, slack))
			return false;
		if (below <= 0 && above >= 0)
			continue;
		if (r->d.a[i] == 0)
			return false;
		double t = (below > 0 ? below : above) * per_d.a[i];
		t_in = t > t_in ? t : t_in;
	}
	if (t_in == 0)
		return true;
	for (int i = 0; i < 3; i++) {
		double t = (per_d.a[i] > 0 ? root->hi.a[i] - r->o.a[i] : root->lo.a[i] - r->o.a[i]) * per_d.a[i];
		t_out = t < t_out ? t : t_out;
	}
	*start = vec_add(r->o, vec_scale(r->d, t_in));
	return t_in <= t_out;
}

#endif
