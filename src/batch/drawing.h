/* Lines in space to be looked at: a scene's edges, random rays in it, and the leaves that one ray visits. */
#ifndef BATCH_DRAWING_H
#define BATCH_DRAWING_H

#include "accel/accel.h"
#include "io/text.h"

/* Primitives a scene may have to be drawn: more are a blot. */
enum { DRAWING_PRIMITIVES_MOST = 5000 };

/* Append blocks of "x y z" lines as gnuplot reads them; an empty line ends a stroke, two end a block:
 *   0 the edges of all triangles       3 twenty rays from one triangle
 *   1 fifty random rays                4 the leaves that a ray visits, as boxes
 *   2 the triangle of block 3          5 that ray
 * Rays follow the invariant law from 'seed' and end where they hit or leave the root. 0, or -1 and *e (memory). */
int drawing_print(struct text *out, const struct accel *a, uint64_t seed, struct err *e);

#endif
