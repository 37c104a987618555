/* Surfaces of fields: where a value passes zero on a line, and in a box. */
#ifndef IO_POV_MARCH_H
#define IO_POV_MARCH_H

#include "io/pov_shape.h"

/* A point where the field rises above zero between one inside (inner <= 0) and one outside (outer >= 0): regula falsi with Illinois' halving
 * (Dowell and Jarratt 1971), at most 12 steps. The result depends on which end is which only, so that neighbours that share the edge get
 * the same point. A field that is no number counts as outside. */
struct vec pov_root(double (*field)(const void *context, struct vec p), const void *context, struct vec in, double inner, struct vec out,
                    double outer);

/* Draw the zero surface of the shape's field within the box: marching tetrahedra on a grid of cells as near cubes of side 'step' as the box
 * allows, six around the diagonal of each cell (Kuhn's), which meet face to face. Blocks of cells that 'reach' proves empty are passed
 * over. The surface is closed but where it leaves the box. Returns a box about the cells that the surface passes; empty if none does. */
struct box pov_march(const struct pov_solid *s, const struct box *box, double step, const struct pov_drawing *d);

/* That box alone. *blocks: of eight cells a side, were not proved empty. */
struct box pov_march_extent(const struct pov_solid *s, const struct box *box, double step, size_t *blocks);

#endif
