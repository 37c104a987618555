/* How much of a cell's faces lies outside closed solids.
 *
 * Rays that start on the front sides of closed, disjoint solids only never run inside them, so they enter a cell through the outside
 * part of its faces only. That part is measured exactly: the cross-section of the solids with a face is bounded by the segments in
 * which triangles cross the face; its area is swept from one edge of the face to the other, that of the edge from one corner, and
 * whether the corner is inside follows from the crossings of the edge's line. Faces are looked at from just inside the cell. */
#ifndef COST_SOLID_H
#define COST_SOLID_H

#include "accel/accel.h"

/* Triangles by where they lie as seen along an axis. Read-only once made. */
struct solid {
	const struct accel *accel; /* borrowed */
	struct arena mem;          /* owned */
	struct column_grid {
		int side;          /* cells a side over the root */
		uint32_t *first;   /* [side^2 + 1] */
		uint32_t *ids;
	} grids[3];                /* number k: over axes k and k + 1 */
};

/* 0, or -1 and *e: memory, or the scene is not made of triangles that bound solids (every edge once in each direction, outward
 * normals). Close it in any case. */
int solid_open(struct solid *s, const struct accel *a, struct err *e);
void solid_close(struct solid *s);

/* Area of the part of each face of leaf c that lies outside, scene units^2. */
void solid_measure(const struct solid *s, const struct cell *c, double outside[6]);

#endif
