/* Predicted cost of the rays of an image from their flux: cells in, a number out. No ray is looked at. */
#ifndef COST_IMAGE_H
#define COST_IMAGE_H

#include "accel/accel.h"
#include "accel/flux.h"
#include "base/estimate.h"

/* The cost a ray, over those that visit a cell of structure a, whose root is that of f: alpha a leaf, beta a primitive in its list.
 * NAN where no ray visits the root, or a leaf is no box. Exact for the segments counted in f if every leaf is made of voxels; inside
 * a voxel, ends of segments on surfaces are shared in proportion to the surface in its leaves.
 * The interval takes f's groups as samples of more segments of their kind (ratio of means, Student's t); what is lost where leaves
 * are smaller than voxels is not in it. 0, or -1 and *e (memory). */
int cost_predict_image(struct estimate *out, const struct flux *f, const struct accel *a, double alpha, double beta, struct err *e);

#endif
