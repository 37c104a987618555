#include "accel/root.h"

struct box root_box(const struct box *bounds, enum root_kind kind)
{
	struct vec size = vec_sub(bounds->hi, bounds->lo);
	double longest = fmax(size.x, fmax(size.y, size.z));
	struct box root = *bounds;
	for (int i = 0; i < 3; i++) {
		double side = kind == ROOT_CUBE ? longest : size.a[i];
		if (!(side >= 1e-6 * longest))
			side = 1e-6 * longest;
		if (side > size.a[i])
			root.lo.a[i] -= (side - size.a[i]) / 2;
		while (root.lo.a[i] + side < bounds->hi.a[i])
			side = nextafter(side, INFINITY);
		root.hi.a[i] = root.lo.a[i] + side;
	}
	return root;
}

bool root_enter(const struct box *root, const struct ray *r, struct vec per_d, double slack, struct vec *start)
{
	double t_in = 0, t_out = r->t_max;
	*start = r->o;
	for (int i = 0; i < 3; i++) {
		double below = root->lo.a[i] - r->o.a[i], above = root->hi.a[i] - r->o.a[i];
		/* Leading out, within slack of a side or beyond it. */
		if ((r->d.a[i] < 0 && below >= -slack) || (r->d.a[i] > 0 && above <= slack))
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
