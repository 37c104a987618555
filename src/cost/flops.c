#include "cost/flops.h"

struct flops flops_of(const struct accel *a, double tests, double leaves, double inner, double boxes)
{
	if (a->volumes)
		return (struct flops){ FLOPS_TEST * tests, FLOPS_TEST * (boxes - leaves) };
	double traversal = FLOPS_PLANE * (inner - boxes) + FLOPS_TEST * boxes;
	if (a->travel == TRAVEL_LINKS)
		traversal = a->nodes == 1 ? 0 : a->nodes == a->leaves ? FLOPS_VOXEL * leaves : NAN;
	return (struct flops){ FLOPS_TEST * tests, traversal };
}
