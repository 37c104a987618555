/* Points and directions: three doubles, by name or by axis. */
#ifndef GEOM_VEC_H
#define GEOM_VEC_H

#include <math.h>
#include <stdbool.h>

struct vec {
	union {
		struct { double x, y, z; };
		double a[3]; /* by axis: 0 x, 1 y, 2 z */
	};
};

static inline struct vec vec(double x, double y, double z)
{
	return (struct vec){ { { x, y, z } } };
}

static inline struct vec vec_add(struct vec p, struct vec q)
{
	return vec(p.x + q.x, p.y + q.y, p.z + q.z);
}

static inline struct vec vec_sub(struct vec p, struct vec q)
{
	return vec(p.x - q.x, p.y - q.y, p.z - q.z);
}

static inline struct vec vec_scale(struct vec p, double s)
{
	return vec(p.x * s, p.y * s, p.z * s);
}

static inline double vec_dot(struct vec p, struct vec q)
{
	return p.x * q.x + p.y * q.y + p.z * q.z;
}

static inline struct vec vec_cross(struct vec p, struct vec q)
{
	return vec(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
}

static inline double vec_length(struct vec p)
{
	return sqrt(vec_dot(p, p));
}

static inline bool vec_is_finite(struct vec p)
{
	return isfinite(p.x) && isfinite(p.y) && isfinite(p.z);
}

/* p / |p|; a zero vector stays zero. */
static inline struct vec vec_unit(struct vec p)
{
	double d = vec_length(p);
	return d > 0 ? vec(p.x / d, p.y / d, p.z / d) : p;
}

#endif
