#include "accel/root.h"

/* Steps to the next number that are tried one by one; an upper side near 0, beside a lower one far from it, may be 2^52 of them off. */
enum { STEPS_MOST = 1000 };

/* The least number from hi on, or nearly so, that lo + (hi - lo) comes back to. */
static double find_upper_side(double lo, double hi)
{
	for (int step = 0; lo + (hi - lo) != hi; step++)
		hi = step < STEPS_MOST ? nextafter(hi, INFINITY) : lo + nextafter(hi - lo, INFINITY);
	return hi;
}

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
		root.hi.a[i] = find_upper_side(root.lo.a[i], fmax(root.lo.a[i] + side, bounds->hi.a[i]));
	}
	return root;
}
