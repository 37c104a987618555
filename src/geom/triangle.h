/* Triangles: measures and overlap. Arguments as in geom/primitive.h. */
#ifndef GEOM_TRIANGLE_H
#define GEOM_TRIANGLE_H

#include "geom/primitive.h"

struct box triangle_bounds(const struct triangle *t);
double triangle_area(const struct triangle *t);

/* Separating axis test with all 13 axes (Akenine-Moeller 2001), closed. */
bool triangle_touches(const struct triangle *t, const struct box *b);

/* The ten axes of it that remain when the bounding boxes are known to meet: the normal, and the products of edges and axes. */
bool triangle_touches_inner(const struct triangle *t, const struct box *b);

double triangle_area_inside(const struct triangle *t, const struct box *b);

#endif
