/* What other chapters ask of quadrics. */
#ifndef IO_POV_POLY_H
#define IO_POV_POLY_H

#include "io/pov_shape.h"

/* The part of a box, infinite or not, that the inside of a quadric without mixed terms may reach (or its outside, 'inverse'); by
 * intervals, an axis after the other. Other quadrics leave the box as it is. */
struct box pov_quadric_tighten(const struct pov_solid *s, bool inverse, const struct box *within);

#endif
