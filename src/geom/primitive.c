#include "geom/primitive.h"

#include "geom/sphere.h"
#include "geom/triangle.h"

struct box primitive_bounds(const struct primitive *p)
{
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_bounds(&p->triangle) : sphere_bounds(&p->sphere);
}

double primitive_area(const struct primitive *p)
{
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_area(&p->triangle) : sphere_area(&p->sphere);
}

bool primitive_touches(const struct primitive *p, const struct box *b)
{
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_touches(&p->triangle, b) : sphere_touches(&p->sphere, b);
}

double primitive_area_inside(const struct primitive *p, const struct box *b)
{
	return p->kind == PRIMITIVE_TRIANGLE ? triangle_area_inside(&p->triangle, b) : sphere_area_inside(&p->sphere, b);
}
