/* Spheres, as surfaces: measures and overlap. Arguments as in geom/primitive.h. */
#ifndef GEOM_SPHERE_H
#define GEOM_SPHERE_H

#include "geom/primitive.h"

struct box sphere_bounds(const struct sphere *s);
double sphere_area(const struct sphere *s);

/* The surface meets the closed box: its nearest point is inside or on the sphere, its farthest corner outside or on it. */
bool sphere_touches(const struct sphere *s, const struct box *b);

/* By Archimedes, dA = r dphi dz: the integral over z of r times the angle of the circle at height z that lies inside the
 * rectangle; integrated between all heights where the circle passes a side or a corner. */
double sphere_area_inside(const struct sphere *s, const struct box *b);

#endif
