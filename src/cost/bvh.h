/* Predicted cost of bounding volume hierarchies. */
#ifndef COST_BVH_H
#define COST_BVH_H

#include "cost/cost.h"

/* As cost_predict, for a structure with volumes. An inner node costs alpha, a leaf beta for each of its primitives. Known are: volumes
 * and its parts, leaves, tests and inner_step of the nodes that meet the ray up to its first hit. These are the least that finds the hit, and
 * the cost exactly where a traversal visits no others (accel.to_hit); also of lines, which nothing stops. ONE_SIDED, EXT and INTERIOR: no
 * formula. */
int bvh_predict(struct prediction *p, const struct accel *a, enum law law, double alpha, double beta, struct err *e);

#endif
