/* What transforms do to points, boxes and lengths. */
#ifndef IO_POV_PLACE_H
#define IO_POV_PLACE_H

#include "geom/box.h"
#include "geom/matrix.h"

#include <stdbool.h>

/* false: m is singular (or so nearly that the inverse is not finite); *inverse is then the identity. */
bool pov_place_invert(const struct matrix *m, struct matrix *inverse);

/* Of the linear part. */
double pov_place_determinant(const struct matrix *m);

/* The least and the most a unit vector is stretched: the singular values of the linear part. */
void pov_place_stretch(const struct matrix *m, double *least, double *most);

/* A box about the image of a box; infinite sides stay infinite where they reach. An empty box stays empty. */
struct box pov_place_box(const struct box *b, const struct matrix *m);

/* Two unit vectors that make a right-handed frame (u, v, axis) with a unit axis. */
void pov_place_frame(struct vec axis, struct vec *u, struct vec *v);

#endif
