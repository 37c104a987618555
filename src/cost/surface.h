/* How much surface lies in a cell, with what lies exactly in its faces kept apart. */
#ifndef COST_SURFACE_H
#define COST_SURFACE_H

#include "accel/accel.h"

/* One-sided areas. Faces are numbered 2 axis + upper. */
struct surface {
	double open;       /* inside the open cell */
	double in_face[6]; /* of triangles lying in face f, within it; overlapping ones add up */
	double facing[6];  /* those of in_face whose front looks into the cell */
	double covered[6]; /* of the part of face f they cover; for faces of the root not needed and equal to in_face */
};

/* Measure the surface in a leaf of 'a'. A triangle lies in a face when all its corners are within the structure's slack of
 * the face's plane. 0, or -1 and *e (memory). */
int surface_measure(struct surface *s, const struct accel *a, const struct cell *c, struct err *e);

/* Position of face f of a box. */
static inline double face_plane(const struct box *b, int f)
{
	return f % 2 ? b->hi.a[f / 2] : b->lo.a[f / 2];
}

/* Area of face f of a box. */
static inline double face_area(const struct box *b, int f)
{
	int i = (f / 2 + 1) % 3, j = (f / 2 + 2) % 3;
	return (b->hi.a[i] - b->lo.a[i]) * (b->hi.a[j] - b->lo.a[j]);
}

#endif
