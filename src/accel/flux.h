/* The flux of a set of ray segments through a region, from which the visits to any box in it follow without a ray.
 *
 * A segment that visits a convex cell has a piece inside it, and the piece has two ends: at each the segment either crosses the
 * cell's surface or ends itself (it may have begun there). So, whatever the segments,
 *     visits of a cell = (crossings of its surface + ends of segments inside it) / 2.
 * Crossings are counted on the sides of a grid of voxels over the root, ends in the voxels. For a box made of voxels the sum is
 * exact. In others, crossings are interpolated linearly between planes, and both are shared out within a voxel by area and volume;
 * ends on surfaces are kept apart, for who knows where the surface lies can share them better.
 *
 * Segments belong to one of a few groups, each counted by itself: how much the groups differ tells the sampling error. */
#ifndef ACCEL_FLUX_H
#define ACCEL_FLUX_H

#include "base/arena.h"
#include "base/err.h"
#include "geom/box.h"

#include <stdint.h>

/* Voxels a side, and groups. */
enum { FLUX_SIDE = 64, FLUX_GROUPS = 8 };

enum flux_end { FLUX_FREE, FLUX_ON_SURFACE, FLUX_ENDS };

/* Segments that cross the lower side across each axis, either way, and ends inside. */
struct flux_voxel {
	uint32_t crossings[3][FLUX_GROUPS], ends[FLUX_ENDS][FLUX_GROUPS];
};

struct flux {
	struct arena mem; /* owned */
	struct box root;
	struct vec step;  /* sides of a voxel; plane i of an axis lies at root.lo + i step */
	struct flux_voxel *voxels; /* by flux_at; one more along every axis, for the root's upper sides */
	uint64_t segments[FLUX_GROUPS]; /* that visit the root */
};

/* Open *f over a root with nothing counted. 0, or -1 and *e (memory). Close it in any case. */
int flux_open(struct flux *f, const struct box *root, struct err *e);
void flux_close(struct flux *f);

/* Number of the voxel at[0], at[1], at[2], each 0 .. FLUX_SIDE. */
static inline size_t flux_at(const int32_t at[3])
{
	return ((size_t)at[2] * (FLUX_SIDE + 1) + (size_t)at[1]) * (FLUX_SIDE + 1) + (size_t)at[0];
}

/* A box inside the root, measured in voxels: 0 .. FLUX_SIDE. */
struct box flux_place(const struct flux *f, const struct box *b);

/* By group, crossings of the surface of a box and ends inside it. The box is given in voxels. */
void flux_crossings(const struct flux *f, const struct box *b, double sum[FLUX_GROUPS]);
void flux_ends(const struct flux *f, enum flux_end kind, const struct box *b, double sum[FLUX_GROUPS]);

#endif
