/* What a ray costs in floating point operations, as Subramanian and Fussell 1990 count them (section 5). */
#ifndef COST_FLOPS_H
#define COST_FLOPS_H

#include "accel/accel.h"

/* C_pr: a primitive or a bounding box tested; C_r: a plane passed on the way to a leaf; the same from one voxel of a grid to the next. */
#define FLOPS_TEST 15.5
#define FLOPS_PLANE 4.5
#define FLOPS_VOXEL 6.5

/* Two kinds of cost a ray: of examining primitives, C_sc, and of getting to them, C_tr. */
struct flops {
	double scene, traversal;
};

/* Counts a ray, expected or measured, as flops: tests that are made, leaves, inner nodes, boxes tested. Of a hierarchy of bounding volumes a
 * leaf's box is the primitive's, whose test it is. NAN for structures whose rays travel over links, since the paper has none. */
struct flops flops_of(const struct accel *a, double tests, double leaves, double inner, double boxes);

#endif
