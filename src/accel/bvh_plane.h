/* Primitives' boxes in bins along every axis, and the cheapest plane between them by the surface area heuristic (Wald 2007). */
#ifndef ACCEL_BVH_PLANE_H
#define ACCEL_BVH_PLANE_H

#include "accel/bvh_draft.h"

/* By axis and bin: what encloses the boxes whose centroids are in it, and how many they are. */
struct bvh_bins {
	struct quad_box box[3][BVH_BINS];
	uint32_t count[3][BVH_BINS];
};

/* A plane: references whose bin on 'axis' is below 'bin' go left. base, scale: from centroids to bins. */
struct bvh_plane {
	quad base, scale;
	int axis, bin;
	float cost; /* without the step; INFINITY: none */
	uint32_t left;
	struct quad_box box[2];
};

/* The cheapest plane between 'bins' bins an axis, of equal ones that on the first axis, the lowest. p->base and p->scale are set; an axis
 * whose scale is 0 is left out. */
void bvh_find_plane(struct bvh_plane *p, const struct bvh_bins *b, int bins, const struct bvh_rules *rules);

#endif
