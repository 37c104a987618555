#include "geom/triangle.h"

#include "geom/clip.h"

struct box triangle_bounds(const struct triangle *t)
{
	struct box b = { t->v[0], t->v[0] };
	box_extend(&b, t->v[1]);
	box_extend(&b, t->v[2]);
	return b;
}

double triangle_area(const struct triangle *t)
{
	return vec_length(vec_cross(vec_sub(t->v[1], t->v[0]), vec_sub(t->v[2], t->v[0]))) / 2;
}

/* Whether an axis (cross product of the edge e with a coordinate axis, components p and q in the other two) separates the box
 * of half sides hp, hq from the triangle that has one edge corner at (ap, aq) and its opposite corner at (bp, bq). */
static inline bool edge_separates(double ep, double eq, double ap, double aq, double bp, double bq, double hp, double hq)
{
	double m = ep * aq - eq * ap, n = ep * bq - eq * bp;
	double reach = hp * fabs(eq) + hq * fabs(ep);
	double least = m < n ? m : n, most = m < n ? n : m;
	return least > reach || most < -reach;
}

bool triangle_touches_inner(const struct triangle *t, const struct box *b)
{
	struct vec c = vec_scale(vec_add(b->lo, b->hi), 0.5), h = vec_scale(vec_sub(b->hi, b->lo), 0.5);
	struct vec v[3], e[3];
	for (int i = 0; i < 3; i++)
		v[i] = vec_sub(t->v[i], c);
	for (int i = 0; i < 3; i++)
		e[i] = vec_sub(v[(i + 1) % 3], v[i]);
	struct vec n = vec_cross(e[0], e[1]);
	if (fabs(vec_dot(n, v[0])) > h.x * fabs(n.x) + h.y * fabs(n.y) + h.z * fabs(n.z))
		return false;
	for (int i = 0; i < 3; i++) {
		struct vec a = v[i], o = v[(i + 2) % 3];
		if (edge_separates(e[i].y, e[i].z, a.y, a.z, o.y, o.z, h.y, h.z) ||
		    edge_separates(e[i].z, e[i].x, a.z, a.x, o.z, o.x, h.z, h.x) ||
		    edge_separates(e[i].x, e[i].y, a.x, a.y, o.x, o.y, h.x, h.y))
			return false;
	}
	return true;
}

bool triangle_touches(const struct triangle *t, const struct box *b)
{
	struct box s = triangle_bounds(t);
	for (int i = 0; i < 3; i++)
		if (s.lo.a[i] > b->hi.a[i] || s.hi.a[i] < b->lo.a[i])
			return false;
	return triangle_touches_inner(t, b);
}

double triangle_area_inside(const struct triangle *t, const struct box *b)
{
	struct box s = triangle_bounds(t);
	bool whole = true;
	for (int i = 0; i < 3; i++) {
		if (s.lo.a[i] > b->hi.a[i] || s.hi.a[i] < b->lo.a[i])
			return 0;
		whole &= s.lo.a[i] >= b->lo.a[i] && s.hi.a[i] <= b->hi.a[i];
	}
	if (whole)
		return triangle_area(t);
	struct polygon p = { 3, { t->v[0], t->v[1], t->v[2] } };
	polygon_cut_box(&p, b);
	return vec_length(polygon_area_vector(&p));
}
