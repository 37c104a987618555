#include "io/pov_outline.h"

#include <math.h>

void pov_outline_add(struct pov_outline *o, double x, double y)
{
	size_t start = o->first ? o->first[o->loops] : 0;
	if (o->count > start && o->at[o->count - 1][0] == x && o->at[o->count - 1][1] == y)
		return;
	if (o->count == o->room) {
		size_t room = o->room ? 2 * o->room : 64;
		double (*grown)[2] = arena_grow(o->mem, o->at, o->count, room, sizeof *grown);
		o->lost = o->lost || !grown;
		if (o->lost)
			return;
		o->at = grown;
		o->room = room;
	}
	o->at[o->count][0] = x;
	o->at[o->count++][1] = y;
}

void pov_outline_close(struct pov_outline *o)
{
	if (o->loops + 2 > o->loop_room) {
		size_t room = o->loop_room ? 2 * o->loop_room : 8;
		size_t *grown = arena_grow(o->mem, o->first, o->first ? o->loops + 1 : 0, room, sizeof *grown);
		double (*reach)[4] = arena_grow(o->mem, o->reach, o->loops, room, sizeof *reach);
		o->lost = o->lost || !grown || !reach;
		if (o->lost)
			return;
		o->first = grown;
		o->reach = reach;
		o->loop_room = room;
	}
	size_t start = o->first[o->loops];
	if (o->count > start + 1 && o->at[o->count - 1][0] == o->at[start][0] && o->at[o->count - 1][1] == o->at[start][1])
		o->count--;
	if (o->count < start + 3) {
		o->count = start;
		return;
	}
	double *r = o->reach[o->loops];
	r[0] = r[1] = INFINITY;
	r[2] = r[3] = -INFINITY;
	for (size_t i = start; i < o->count; i++)
		for (int axis = 0; axis < 2; axis++) {
			r[axis] = fmin(r[axis], o->at[i][axis]);
			r[2 + axis] = fmax(r[2 + axis], o->at[i][axis]);
		}
	o->first[++o->loops] = o->count;
}

/* Square of the distance from what a loop reaches. */
static double away(const double *r, double x, double y)
{
	double u = fmax(0, fmax(r[0] - x, x - r[2])), v = fmax(0, fmax(r[1] - y, y - r[3]));
	return u * u + v * v;
}

bool pov_outline_inside(const struct pov_outline *o, double x, double y)
{
	bool inside = false;
	for (size_t l = 0; l < o->loops; l++) {
		if (away(o->reach[l], x, y) > 0)
			continue;
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++) {
			const double *a = o->at[i], *b = o->at[pov_outline_next(o, l, i)];
			if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
				inside = !inside;
		}
	}
	return inside;
}

double pov_outline_distance(const struct pov_outline *o, double x, double y)
{
	double least = INFINITY;
	for (size_t l = 0; l < o->loops; l++) {
		if (away(o->reach[l], x, y) >= least)
			continue;
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++) {
			const double *a = o->at[i], *b = o->at[pov_outline_next(o, l, i)];
			double u = b[0] - a[0], v = b[1] - a[1], s = ((x - a[0]) * u + (y - a[1]) * v) / (u * u + v * v);
			s = fmin(1, fmax(0, s));
			double dx = x - a[0] - s * u, dy = y - a[1] - s * v;
			least = fmin(least, dx * dx + dy * dy);
		}
	}
	return pov_outline_inside(o, x, y) ? -sqrt(least) : sqrt(least);
}

bool pov_outline_inside_left(const struct pov_outline *o, size_t i, size_t next)
{
	const double *a = o->at[i], *b = o->at[next];
	double aside = 1e-6, u = b[0] - a[0], v = b[1] - a[1];
	return pov_outline_inside(o, (a[0] + b[0]) / 2 - aside * v, (a[1] + b[1]) / 2 + aside * u);
}

/* c[0] + t c[1] + t^2 c[2] + t^3 c[3] of one coordinate, for the segment from points[i]. */
static void segment(enum pov_spline kind, const struct vec *p, size_t i, int axis, double *c)
{
	double b = p[i].a[axis], d = p[i + 1].a[axis];
	c[0] = b;
	c[2] = c[3] = 0;
	if (kind == POV_LINEAR) {
		c[1] = d - b;
	} else if (kind == POV_QUADRATIC) {
		double a = p[i - 1].a[axis];
		c[1] = (d - a) / 2;
		c[2] = (a - 2 * b + d) / 2;
	} else if (kind == POV_BEZIER) {
		double e = p[i + 2].a[axis], f = p[i + 3].a[axis];
		c[1] = 3 * (d - b);
		c[2] = 3 * (b - 2 * d + e);
		c[3] = f - b + 3 * (d - e);
	} else {
		double a = p[i - 1].a[axis], e = p[i + 2].a[axis];
		c[1] = (d - a) / 2;
		c[2] = a - 2.5 * b + 2 * d - e / 2;
		c[3] = (e - a) / 2 + 1.5 * (b - d);
	}
}

static void add_segment(struct pov_outline *o, enum pov_spline kind, const struct vec *p, size_t i, int pieces)
{
	double c[2][4];
	pieces = kind == POV_LINEAR ? 1 : pieces;
	for (int axis = 0; axis < 2; axis++)
		segment(kind, p, i, axis, c[axis]);
	size_t end = kind == POV_BEZIER ? i + 3 : i + 1;
	pov_outline_add(o, p[i].x, p[i].y);
	for (int k = 1; k < pieces; k++) {
		double t = (double)k / pieces;
		pov_outline_add(o, c[0][0] + t * (c[0][1] + t * (c[0][2] + t * c[0][3])),
		                c[1][0] + t * (c[1][1] + t * (c[1][2] + t * c[1][3])));
	}
	pov_outline_add(o, p[end].x, p[end].y);
}

static bool same_point(struct vec a, struct vec b)
{
	return fabs(a.x - b.x) < 1e-9 && fabs(a.y - b.y) < 1e-9;
}

void pov_outline_spline(struct pov_outline *o, enum pov_spline kind, const struct vec *points, size_t n, int pieces, bool loops)
{
	/* How many points a segment needs before and behind its two ends, and how many points further the next one starts. */
	size_t before = kind == POV_QUADRATIC || kind == POV_CUBIC ? 1 : 0, behind = kind == POV_CUBIC ? 1 : 0;
	size_t span = kind == POV_BEZIER ? 3 : 1, step = kind == POV_BEZIER ? 4 : 1;
	size_t start = before;
	for (size_t i = before; i + span + behind < n;) {
		add_segment(o, kind, points, i, pieces);
		if (loops && same_point(points[i + span], points[start])) {
			pov_outline_close(o);
			i = start = i + span + behind + 1 + before;
		} else {
			i += step;
		}
	}
	if (loops && o->count > (o->first ? o->first[o->loops] : 0))
		pov_outline_close(o);
}
