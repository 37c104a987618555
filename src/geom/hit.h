/* Ray against primitive: the one test every walk uses, so that all structures find the same t bit for bit. */
#ifndef GEOM_HIT_H
#define GEOM_HIT_H

#include "geom/primitive.h"

/* Moeller and Trumbore 1997, two-sided; the division waits until the ray is known to pass the triangle. */
static inline bool triangle_hit(const struct triangle *s, const struct ray *r, double *t)
{
	struct vec e1 = vec_sub(s->v[1], s->v[0]), e2 = vec_sub(s->v[2], s->v[0]);
	struct vec p = vec_cross(r->d, e2), w = vec_sub(r->o, s->v[0]), q = vec_cross(w, e1);
	double det = vec_dot(e1, p), sign = det < 0 ? -1 : 1, size = det * sign, u = vec_dot(w, p) * sign, v = vec_dot(r->d, q) * sign;
	/* One branch: which side is hit, and which edge is missed, no processor can guess. */
	if ((u < 0) | (v < 0) | (u + v > size) | (size == 0))
		return false;
	*t = vec_dot(e2, q) / det;
	return true;
}

/* Whether the ray meets the plane of a triangle between its start and t = limit. A test that divides first (Wald 2004) ends here where it
 * does not; the same products as above, which the compiler makes once. */
static inline bool triangle_plane_met(const struct triangle *s, const struct ray *r, double limit)
{
	struct vec e1 = vec_sub(s->v[1], s->v[0]), e2 = vec_sub(s->v[2], s->v[0]);
	struct vec p = vec_cross(r->d, e2), w = vec_sub(r->o, s->v[0]), q = vec_cross(w, e1);
	double det = vec_dot(e1, p), sign = det < 0 ? -1 : 1, size = det * sign, t = vec_dot(e2, q) * sign;
	return t >= 0 && size > 0 && t <= limit * size;
}

/* The nearest acceptable root. Of a sphere the ray starts on, the root nearest to t = 0 is the start itself. */
static inline bool sphere_hit(const struct sphere *s, const struct ray *r, uint32_t id, double *t)
{
	struct vec w = vec_sub(s->center, r->o);
	double along = vec_dot(w, r->d);
	struct vec across = vec_sub(w, vec_scale(r->d, along));
	double square = s->radius * s->radius - vec_dot(across, across);
	if (square < 0)
		return false;
	double half = sqrt(square), near = along - half, far = along + half;
	if (id == r->from) {
		*t = fabs(near) < fabs(far) ? far : near;
		return *t > 0;
	}
	*t = ray_accepts(r, near, id) ? near : far;
	return true;
}

/* Improve *h if the primitive is hit nearer, within r->t_max. The caller counts the test. */
static inline void primitive_hit(const struct primitive *p, uint32_t id, const struct ray *r, struct hit *h)
{
	double t;
	if (p->kind == PRIMITIVE_TRIANGLE) {
		if (!triangle_hit(&p->triangle, r, &t) || id == r->from || !ray_accepts(r, t, id))
			return;
	} else if (!sphere_hit(&p->sphere, r, id, &t) || (id != r->from && !ray_accepts(r, t, id))) {
		return;
	}
	if (hit_better(t, id, h) && t <= r->t_max)
		*h = (struct hit){ t, id };
}

#endif
