#include "scene/triangulate.h"

#include <stdbool.h>

/* The polygon in the plane where its area is largest, counter-clockwise; corners not yet cut off form a ring. */
struct ring {
	double (*at)[2];
	uint32_t *before, *after;
};

/* Twice the signed area of a triangle. */
static double cross(const struct ring *r, uint32_t a, uint32_t b, uint32_t c)
{
	const double *p = r->at[a], *q = r->at[b], *s = r->at[c];
	return (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
}

static bool same_place(const struct ring *r, uint32_t a, uint32_t b)
{
	return r->at[a][0] == r->at[b][0] && r->at[a][1] == r->at[b][1];
}

/* Whether corner b may be cut off: it is convex and no reflex corner lies in its triangle. */
static bool is_ear(const struct ring *r, uint32_t b)
{
	uint32_t a = r->before[b], c = r->after[b];
	double turn = cross(r, a, b, c);
	if (turn < 0)
		return false;
	for (uint32_t i = r->after[c]; i != a; i = r->after[i]) {
		if (cross(r, r->before[i], i, r->after[i]) > 0 || same_place(r, i, a) || same_place(r, i, b) || same_place(r, i, c))
			continue;
		if (cross(r, a, b, i) >= 0 && cross(r, b, c, i) >= 0 && cross(r, c, a, i) >= 0)
			return false;
	}
	return true;
}

/* Newell's normal: twice the area vector, also of concave and slightly bent polygons. */
static struct vec find_normal(const struct vec *p, size_t n)
{
	struct vec normal = vec(0, 0, 0);
	for (size_t i = 1; i + 1 < n; i++)
		normal = vec_add(normal, vec_cross(vec_sub(p[i], p[0]), vec_sub(p[i + 1], p[0])));
	return normal;
}

static void project(const struct vec *p, size_t n, struct ring *r)
{
	struct vec normal = find_normal(p, n);
	int axis = fabs(normal.x) > fabs(normal.y) ? 0 : 1;
	axis = fabs(normal.z) >= fabs(normal.a[axis]) ? 2 : axis;
	int u = (axis + 1) % 3, v = (axis + 2) % 3;
	if (normal.a[axis] < 0) {
		int swap = u;
		u = v;
		v = swap;
	}
	for (size_t i = 0; i < n; i++) {
		r->at[i][0] = p[i].a[u];
		r->at[i][1] = p[i].a[v];
		r->before[i] = (uint32_t)(i ? i - 1 : n - 1);
		r->after[i] = (uint32_t)(i + 1 < n ? i + 1 : 0);
	}
}

/* The next ear from 'from' on; where there is none, as in a polygon that crosses itself, the most convex corner. */
static uint32_t find_ear(const struct ring *r, uint32_t from, size_t left)
{
	uint32_t best = from, i = from;
	for (size_t k = 0; k < left; k++, i = r->after[i])
		if (is_ear(r, i))
			return i;
	for (size_t k = 0; k < left; k++, i = r->after[i])
		if (cross(r, r->before[i], i, r->after[i]) > cross(r, r->before[best], best, r->after[best]))
			best = i;
	return best;
}

int triangulate_polygon(const struct vec *corners, size_t n, uint32_t *triples, struct arena *scratch)
{
	struct ring r = { arena_alloc(scratch, n, sizeof *r.at), NEW(scratch, uint32_t, n), NEW(scratch, uint32_t, n) };
	if (!r.at || !r.before || !r.after)
		return -1;
	project(corners, n, &r);
	uint32_t at = 0;
	for (size_t left = n; left >= 3; left--) {
		uint32_t ear = left == 3 ? at : find_ear(&r, at, left);
		uint32_t before = r.before[ear], after = r.after[ear];
		*triples++ = before;
		*triples++ = ear;
		*triples++ = after;
		r.after[before] = after;
		r.before[after] = before;
		at = after;
	}
	return 0;
}
