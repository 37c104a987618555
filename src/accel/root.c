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
		double hi = fmax(root.lo.a[i] + side, bounds->hi.a[i]);
		while (root.lo.a[i] + (hi - root.lo.a[i]) != hi)
			hi = nextafter(hi, INFINITY);
		root.hi.a[i] = hi;
	}
	return root;
}
