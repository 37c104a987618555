/* Light leaving a point of a surface towards the eye, and the rays that bring it there. */
#ifndef TRACE_SHADE_H
#define TRACE_SHADE_H

#include "geom/ray.h"
#include "scene/primitives.h"

/* A point that a ray has hit. Both unit normals point to the side the ray comes from. */
struct surface_point {
	struct vec at;
	struct vec normal;  /* of the surface */
	struct vec shading; /* interpolated over a patch; else the same */
	bool inside;        /* the ray comes from the back */
	const struct material *material;
};

/* Where ray r ends in hit h (h->id is a primitive). */
struct surface_point surface_point_make(const struct scene *s, const struct primitives *p, const struct ray *r, const struct hit *h);

/* Strength of each of a scene's lights that has no colour, and of the light from everywhere: sqrt(n) / (2 n) for n lights (NFF's
 * suggestion). */
double light_strength(const struct scene *s);

/* What light number 'light' adds to the colour seen along direction 'seen' when nothing shades it (Phong 1975). toward: the unit
 * direction to the light. */
struct color shade_light(const struct scene *s, size_t light, const struct surface_point *p, struct vec seen, struct vec toward);

/* What arrives from everywhere. */
struct color shade_ambient(const struct scene *s, const struct surface_point *p);

/* The mirrored direction, never below the surface. */
struct vec reflect(const struct surface_point *p, struct vec d);

/* Snell's law into *out; false at total internal reflection. */
bool refract(const struct surface_point *p, struct vec d, struct vec *out);

static inline struct color color_scale(struct color c, double s)
{
	return (struct color){ c.r * s, c.g * s, c.b * s };
}

static inline struct color color_times(struct color c, struct color d)
{
	return (struct color){ c.r * d.r, c.g * d.g, c.b * d.b };
}

static inline void color_add(struct color *c, struct color d)
{
	c->r += d.r;
	c->g += d.g;
	c->b += d.b;
}

#endif
