/* POV-Ray 3.7 scenes out. */
#ifndef IO_POV_WRITE_H
#define IO_POV_WRITE_H

#include "io/format.h"

/* As a format's 'write': view, background, lights and materials; spheres and open cones as such, neighbouring polygons or patches of one
 * material as a mesh2. Coordinates stay right-handed: the camera's 'right' says so. A light without colour has 1 / (2 sqrt(lights)),
 * as NFF suggests. */
int pov_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);

#endif
