/* The flux of a set of ray segments through a region, from which the visits to any box in it follow without a ray.
 *
 * A segment that visits a convex cell has a piece inside it, and the piece has two ends: at each the segment either crosses the
 * cell's surface or ends itself (starts, where it began). So, whatever the segments,
 *     visits of a cell = (crossings of its surface + ends of segments inside it) / 2.
 * Crossings are counted on the planes of a grid of voxels over the root, ends in the voxels. For a box whose sides are planes of the
 * grid the sum is exact; for others crossings are interpolated linearly between planes, and both are shared by area and by volume
 * within a voxel: what the formula gives where voxels are filled evenly. Ends on surfaces are apart, for they can be shared better.
 *
 * All counts are kept summed up from the lower corner, so that a box of any size costs the same. */
#ifndef ACCEL_FLUX_H
#define ACCEL_FLUX_H

#include "base/arena.h"
#include "base/err.h"
#include "geom/box.h"

#include <stdint.h>

enum flux_end { FLUX_FREE, FLUX_ON_SURFACE, FLUX_ENDS };

struct flux {
	struct arena mem;     /* owned */
	struct box root;
	int32_t side;         /* voxels along every axis */
	struct vec step;      /* sides of a voxel; plane i of an axis lies at root.lo + i step */
	/* [(side + 1)^3], x fastest, by node of the grid: crossings of the node's plane across an axis, either way, that lie below the
	 * node along the other two; ends below the node along all three. */
	uint32_t *crossings[3], *ends[FLUX_ENDS];
	uint64_t segments;    /* that visit the root */
};

/* Open *f with 2^level voxels a side and nothing counted. 0, or -1 and *e (memory). Close it in any case. */
int flux_open(struct flux *f, const struct box *root, int level, struct err *e);
void flux_close(struct flux *f);

/* Count a crossing of plane at[axis] of an axis in the cell at[] of the others; an end in voxel at[]. */
void flux_add_crossing(struct flux *f, int axis, const int32_t at[3]);
void flux_add_end(struct flux *f, enum flux_end kind, const int32_t at[3]);

/* Sum up, once all is counted and before anything is asked. */
void flux_seal(struct flux *f);

/* A box inside the root in voxels: 0 .. side. */
struct box flux_place(const struct flux *f, const struct box *b);

/* Crossings of the surface of a box, and ends inside it; the box is given in voxels. */
double flux_crossings(const struct flux *f, const struct box *b);
double flux_ends(const struct flux *f, enum flux_end kind, const struct box *b);

#endif
