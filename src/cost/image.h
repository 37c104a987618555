/* Predicted cost of the rays of an image from their flux: cells in, a number out. No ray is looked at. */
#ifndef COST_IMAGE_H
#define COST_IMAGE_H

#include "accel/accel.h"
#include "accel/flux.h"

/* The cost a ray, over those that visit a cell of structure a, whose leaves are boxes and whose root is that of f (sealed): alpha a
 * leaf, beta a primitive in its list. NAN where no ray visits the root. Exact for the segments counted in f where every leaf is
 * made of voxels; inside a voxel ends on surfaces are shared in proportion to the surface in the leaves. 0, or -1 and *e (memory). */
int image_predict(double *cost, const struct flux *f, const struct accel *a, double alpha, double beta, struct err *e);

#endif
