#include "scene/duplicates.h"

#include <stdlib.h>

/* What makes a primitive the same: its corners in rising order, or its centre and radius. */
struct shape {
	double x[9];
};

static int compare_numbers(const double *p, const double *q, int n)
{
	for (int i = 0; i < n; i++)
		if (p[i] != q[i])
			return p[i] < q[i] ? -1 : 1;
	return 0;
}

static int compare_shapes(const void *p, const void *q)
{
	return compare_numbers(((const struct shape *)p)->x, ((const struct shape *)q)->x, 9);
}

static int compare_points(const void *p, const void *q)
{
	return compare_numbers(((const struct vec *)p)->a, ((const struct vec *)q)->a, 3);
}

static struct shape shape_of(const struct primitive *p)
{
	struct shape s = { { 0 } };
	if (p->kind == PRIMITIVE_SPHERE) {
		const double x[4] = { p->sphere.center.x, p->sphere.center.y, p->sphere.center.z, p->sphere.radius };
		/* No triangle has a corner at infinity. */
		for (int i = 0; i < 9; i++)
			s.x[i] = i < 4 ? x[i] : INFINITY;
		return s;
	}
	struct vec v[3] = { p->triangle.v[0], p->triangle.v[1], p->triangle.v[2] };
	qsort(v, 3, sizeof *v, compare_points);
	for (int i = 0; i < 9; i++)
		s.x[i] = v[i / 3].a[i % 3];
	return s;
}

size_t primitives_duplicates(const struct primitives *p)
{
	size_t count = 0;
	struct shape *all = malloc((p->count + 1) * sizeof *all);
	if (!all)
		return SIZE_MAX;
	for (uint32_t i = 0; i < p->count; i++)
		all[i] = shape_of(&p->all[i]);
	qsort(all, p->count, sizeof *all, compare_shapes);
	for (uint32_t i = 1; i < p->count; i++)
		count += compare_shapes(&all[i - 1], &all[i]) == 0;
	free(all);
	return count;
}
