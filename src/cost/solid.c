#include "cost/solid.h"

#include "base/rng.h"
#include "cost/surface.h"

#include <string.h>

/* A face looked at from inside its cell: axes k (across), u and v (within). */
struct slice {
	int k, u, v;
	double plane, slack;
	bool upper;
};

static struct slice make_slice(const struct solid *s, const struct box *b, int f)
{
	int k = f / 2;
	return (struct slice){ k, (k + 1) % 3, (k + 2) % 3, face_plane(b, f), s->accel->slack, f % 2 };
}

/* A crossing of a triangle with the face's plane, from p to q, as (u, v). */
struct crossing {
	double p[2], q[2];
};

/* Height above the plane; what is within slack lies in it, and the plane itself a little inside the cell. */
static double height(const struct slice *w, struct vec p)
{
	double d = p.a[w->k] - w->plane;
	return fabs(d) <= w->slack ? 0 : d;
}

static bool is_above(const struct slice *w, double height)
{
	return w->upper ? height >= 0 : height > 0;
}

/* False when the triangle does not cross the plane. Walking along its corners, counter-clockwise about the outward normal, the plane is
 * crossed upwards at p and downwards at q: who goes from p to q has the solid to the left, u pointing right and v up. */
static bool cross_plane(struct crossing *c, const struct slice *w, const struct triangle *t)
{
	double h[3];
	int above = 0;
	for (int i = 0; i < 3; i++) {
		h[i] = height(w, t->v[i]);
		above += is_above(w, h[i]);
	}
	if (above == 0 || above == 3)
		return false;
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3;
		bool from = is_above(w, h[i]), to = is_above(w, h[j]);
		if (from == to)
			continue;
		/* The same point whichever way the edge is walked. */
		int a = from ? i : j, b = from ? j : i;
		double at = h[a] == h[b] ? 0 : h[a] / (h[a] - h[b]), *out = from ? c->q : c->p;
		out[0] = t->v[a].a[w->u] + at * (t->v[b].a[w->u] - t->v[a].a[w->u]);
		out[1] = t->v[a].a[w->v] + at * (t->v[b].a[w->v] - t->v[a].a[w->v]);
	}
	return true;
}

/* Where the crossing meets the line u = line (a little beyond it), as v; *sign: +1 where the line enters the solid with growing v, -1
 * where it leaves it. False if it does not. */
static bool cross_line(const struct crossing *c, double line, double *v, double *sign)
{
	bool from = c->p[0] > line, to = c->q[0] > line;
	if (from == to)
		return false;
	*v = c->p[1] + (line - c->p[0]) / (c->q[0] - c->p[0]) * (c->q[1] - c->p[1]);
	*sign = to ? -1 : 1;
	return true;
}

static uint32_t grid_column(const struct solid *s, const struct column_grid *g, int axis, double x)
{
	const struct box *root = &s->accel->root;
	double at = (x - root->lo.a[axis]) / (root->hi.a[axis] - root->lo.a[axis]) * g->side;
	return at < 0 ? 0 : at >= g->side ? (uint32_t)g->side - 1 : (uint32_t)at;
}

/* How many solids hold the point (plane, u, v), each coordinate a little beyond. */
static double wind(const struct solid *s, const struct slice *w, double u, double v)
{
	const struct column_grid *g = &s->grids[w->k];
	uint32_t i = grid_column(s, g, w->u, u) * (uint32_t)g->side + grid_column(s, g, w->k, w->plane);
	double sum = 0, at, sign;
	struct crossing c;
	for (uint32_t k = g->first[i]; k < g->first[i + 1]; k++)
		if (cross_plane(&c, w, &s->accel->primitives->all[g->ids[k]].triangle) && cross_line(&c, u, &at, &sign) && at <= v)
			sum += sign;
	return sum;
}

/* The part of the crossing with low <= [i] <= high; false if none is left. */
static bool clip(struct crossing *c, int i, double low, double high)
{
	int j = 1 - i;
	double *least = c->p[i] < c->q[i] ? c->p : c->q, *most = c->p[i] < c->q[i] ? c->q : c->p;
	if (most[i] <= low || least[i] >= high)
		return false;
	double slope = most[i] > least[i] ? (most[j] - least[j]) / (most[i] - least[i]) : 0;
	if (most[i] > high) {
		most[j] += (high - most[i]) * slope;
		most[i] = high;
	}
	if (least[i] < low) {
		least[j] += (low - least[i]) * slope;
		least[i] = low;
	}
	return true;
}

/* Area of the face inside solids. */
static double area_inside(const struct solid *s, const struct cell *c, const struct slice *w)
{
	double u0 = c->bounds.lo.a[w->u], u1 = c->bounds.hi.a[w->u], v0 = c->bounds.lo.a[w->v], v1 = c->bounds.hi.a[w->v];
	double edge = wind(s, w, u0, v0) * (v1 - v0), area = 0, at, sign;
	struct crossing x;
	for (uint32_t i = 0; i < c->count; i++) {
		if (!cross_plane(&x, w, &s->accel->primitives->all[c->ids[i]].triangle))
			continue;
		if (cross_line(&x, u0, &at, &sign) && at > v0 && at < v1)
			edge += sign * (v1 - at);
		if (clip(&x, 1, v0, v1) && clip(&x, 0, u0, u1))
			area += (x.q[1] - x.p[1]) * (u1 - (x.p[0] + x.q[0]) / 2);
	}
	return edge * (u1 - u0) + area;
}

void solid_measure(const struct solid *s, const struct cell *c, double outside[6])
{
	for (int f = 0; f < 6; f++) {
		struct slice w = make_slice(s, &c->bounds, f);
		double area = face_area(&c->bounds, f);
		if (w.plane == face_plane(&s->accel->root, f))
			outside[f] = area; /* where a solid's face covers it, rays start all the same, and end at once */
		else
			outside[f] = area - area_inside(s, c, &w);
	}
}

/* Antisymmetric in its ends: the sum over all edges vanishes when each is there once in each direction. */
static uint64_t hash_edge(struct vec p, struct vec q)
{
	uint64_t hash[2] = { 0, 0 };
	for (int end = 0; end < 2; end++)
		for (int i = 0; i < 3; i++) {
			double x = (end ? q : p).a[i] + 0.0;
			uint64_t bits;
			memcpy(&bits, &x, sizeof bits);
			hash[end] = rng_mix(hash[end] ^ bits);
		}
	return rng_mix(hash[0] ^ rng_mix(hash[1])) - rng_mix(hash[1] ^ rng_mix(hash[0]));
}

static bool bounds_solids(const struct primitives *p)
{
	uint64_t open = 0;
	double volume = 0;
	for (uint32_t i = 0; i < p->count; i++) {
		const struct vec *v = p->all[i].triangle.v;
		if (p->all[i].kind != PRIMITIVE_TRIANGLE)
			return false;
		for (int k = 0; k < 3; k++)
			open += hash_edge(v[k], v[(k + 1) % 3]);
		volume += vec_dot(v[0], vec_cross(v[1], v[2]));
	}
	return open == 0 && volume > 0;
}

/* Count what falls into each column, or list it: 'first' then holds where each column's list goes on. */
static void spread(const struct solid *s, struct column_grid *g, int k, bool list)
{
	const struct primitives *p = s->accel->primitives;
	int u = (k + 1) % 3;
	for (uint32_t i = 0; i < p->count; i++) {
		struct box b = primitive_bounds(&p->all[i]);
		uint32_t low = grid_column(s, g, k, b.lo.a[k] - s->accel->slack), high = grid_column(s, g, k, b.hi.a[k] + s->accel->slack);
		for (uint32_t y = grid_column(s, g, u, b.lo.a[u]); y <= grid_column(s, g, u, b.hi.a[u]); y++)
			for (uint32_t x = low; x <= high; x++) {
				uint32_t *n = &g->first[y * (uint32_t)g->side + x];
				if (list)
					g->ids[*n] = i;
				++*n;
			}
	}
}

static int make_grid(struct solid *s, int k, struct err *e)
{
	struct column_grid *g = &s->grids[k];
	g->side = 1;
	while (g->side < 1024 && (uint32_t)(g->side * g->side) < s->accel->primitives->count)
		g->side *= 2;
	uint32_t cells = (uint32_t)(g->side * g->side), sum = 0;
	g->first = NEW(&s->mem, uint32_t, cells + 1);
	if (!g->first)
		return err_memory(e, "solids");
	spread(s, g, k, false);
	for (uint32_t i = 0; i <= cells; i++) {
		uint32_t count = g->first[i];
		g->first[i] = sum;
		sum += count;
	}
	g->ids = NEW(&s->mem, uint32_t, sum);
	if (!g->ids)
		return err_memory(e, "solids");
	spread(s, g, k, true);
	memmove(g->first + 1, g->first, cells * sizeof *g->first);
	g->first[0] = 0;
	return 0;
}

int solid_open(struct solid *s, const struct accel *a, struct err *e)
{
	*s = (struct solid){ .accel = a };
	if (!bounds_solids(a->primitives))
		return err_at(e, STATUS_INPUT, NULL, 0, "sides: ext needs triangles that bound solids; this scene has spheres or open surfaces");
	for (int k = 0; k < 3; k++)
		if (make_grid(s, k, e) != 0)
			return -1;
	return 0;
}

void solid_close(struct solid *s)
{
	arena_free(&s->mem);
}
