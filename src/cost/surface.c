#include "cost/surface.h"

#include "geom/clip.h"

#include <stdlib.h>

/* Convex polygons lying in one face, seen along its axis. */
struct cover {
	int axis;
	struct polygon *polygon;
	double *turn; /* +1: counter-clockwise about the axis, -1: clockwise */
	size_t count;
	double least; /* pieces smaller than this are rounding */
};

/* Outward normal of edge k of polygon j, in the plane. */
static struct vec edge_normal(const struct cover *c, size_t j, int k)
{
	const struct polygon *p = &c->polygon[j];
	struct vec along = vec(0, 0, 0);
	along.a[c->axis] = c->turn[j];
	return vec_cross(vec_sub(p->corner[(k + 1) % p->count], p->corner[k]), along);
}

/* Whether an edge of polygon j has all of p on its outer side. */
static bool apart(const struct cover *c, size_t j, const struct polygon *p)
{
	for (int k = 0; k < c->polygon[j].count; k++) {
		struct vec n = edge_normal(c, j, k);
		double offset = vec_dot(n, c->polygon[j].corner[k]);
		int i = 0;
		while (i < p->count && vec_dot(n, p->corner[i]) >= offset)
			i++;
		if (i == p->count)
			return true;
	}
	return false;
}

/* Area of the part of p that none of the polygons j .. end-1 covers. */
static double area_uncovered(const struct cover *c, const struct polygon *p, size_t j, size_t end)
{
	double area = p->count < 3 ? 0 : fabs(polygon_area_vector(p).a[c->axis]);
	if (area <= c->least)
		return 0;
	while (j < end && apart(c, j, p))
		j++;
	if (j == end)
		return area;
	struct polygon rest = *p;
	double sum = 0;
	for (int k = 0; k < c->polygon[j].count && rest.count >= 3; k++) {
		struct vec n = edge_normal(c, j, k);
		double offset = vec_dot(n, c->polygon[j].corner[k]);
		struct polygon outside = rest;
		polygon_cut(&outside, vec_scale(n, -1), -offset);
		polygon_cut(&rest, n, offset);
		sum += area_uncovered(c, &outside, j + 1, end);
	}
	return sum;
}

static double area_covered(const struct cover *c)
{
	double sum = 0;
	for (size_t i = 0; i < c->count; i++)
		sum += area_uncovered(c, &c->polygon[i], 0, i);
	return sum;
}

/* The face of the cell in which the primitive lies, or -1. */
static int lies_in_face(const struct primitive *p, const struct box *b, double slack)
{
	if (p->kind != PRIMITIVE_TRIANGLE)
		return -1;
	for (int f = 0; f < 6; f++) {
		double plane = face_plane(b, f);
		int corner = 0;
		while (corner < 3 && fabs(p->triangle.v[corner].a[f / 2] - plane) <= slack)
			corner++;
		if (corner == 3)
			return f;
	}
	return -1;
}

/* The part of a triangle in face f's plane that lies within the face. */
static struct polygon cut_to_face(const struct triangle *t, const struct box *b, int f)
{
	struct polygon p = { 3, { t->v[0], t->v[1], t->v[2] } };
	struct box wide = *b;
	wide.lo.a[f / 2] = -INFINITY;
	wide.hi.a[f / 2] = INFINITY;
	for (int i = 0; i < 3; i++)
		p.corner[i].a[f / 2] = face_plane(b, f);
	polygon_cut_box(&p, &wide);
	return p;
}

/* Sum up the triangles lying in face f, and what they cover together. */
static int measure_face(struct surface *s, const struct accel *a, const struct cell *c, int f, struct err *e)
{
	const struct primitive *all = a->primitives->all;
	struct cover cover = { .axis = f / 2, .least = 1e-14 * face_area(&c->bounds, f) };
	cover.polygon = malloc((c->count + 1) * sizeof *cover.polygon);
	cover.turn = malloc((c->count + 1) * sizeof *cover.turn);
	for (uint32_t i = 0; cover.polygon && cover.turn && i < c->count; i++) {
		if (lies_in_face(&all[c->ids[i]], &c->bounds, a->slack) != f)
			continue;
		struct polygon p = cut_to_face(&all[c->ids[i]].triangle, &c->bounds, f);
		double area = polygon_area_vector(&p).a[f / 2];
		if (fabs(area) <= cover.least)
			continue;
		s->in_face[f] += fabs(area);
		s->facing[f] += (area > 0) == (f % 2 == 0) ? fabs(area) : 0;
		cover.turn[cover.count] = area > 0 ? 1 : -1;
		cover.polygon[cover.count++] = p;
	}
	int status = cover.polygon && cover.turn ? 0 : err_memory(e, "surface in a face");
	bool outer = face_plane(&c->bounds, f) == face_plane(&a->root, f);
	if (status == 0)
		s->covered[f] = outer || cover.count < 2 ? s->in_face[f] : area_covered(&cover);
	free(cover.polygon);
	free(cover.turn);
	return status;
}

int surface_measure(struct surface *s, const struct accel *a, const struct cell *c, struct err *e)
{
	bool lies_in[6] = { false };
	*s = (struct surface){ 0 };
	for (uint32_t i = 0; i < c->count; i++) {
		const struct primitive *p = &a->primitives->all[c->ids[i]];
		int f = lies_in_face(p, &c->bounds, a->slack);
		if (f < 0)
			s->open += primitive_area_inside(p, &c->bounds);
		else
			lies_in[f] = true;
	}
	for (int f = 0; f < 6; f++)
		if (lies_in[f] && measure_face(s, a, c, f, e) != 0)
			return -1;
	return 0;
}
