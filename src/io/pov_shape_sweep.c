/* sphere_sweep: the union of the spheres that move along a curve, their radii with them. Between neighbours it is a cone that touches
 * both spheres; a curve is a row of many such pieces. */
#include "io/pov_place.h"
#include "io/pov_shape.h"

static const double pi = 3.14159265358979323846;

enum { FIELD_PIECES = 16 };

struct sealed {
	struct pov_sphere *at; /* spheres along the curve */
	size_t count;
	struct box box;
};

/* A sphere on the curve and how it changes there. */
struct stop {
	struct pov_sphere at, rate;
};

static double channel(const struct pov_sphere *s, int k)
{
	return k < 3 ? s->center.a[k] : s->radius;
}

static void set_channel(struct pov_sphere *s, int k, double x)
{
	if (k < 3)
		s->center.a[k] = x;
	else
		s->radius = x;
}

/* At t of the segment from p[0] to p[1] (b-spline: under p[-1] to p[2]); cubic is Catmull's and Rom's. */
static struct stop stop_at(enum pov_spline kind, const struct pov_sphere *p, double t)
{
	struct stop r = { 0 };
	for (int k = 0; k < 4; k++) {
		double b = channel(p, k), c = channel(p + 1, k), m[4] = { b, c - b, 0, 0 };
		if (kind != POV_LINEAR) {
			double a = channel(p - 1, k), d = channel(p + 2, k);
			bool spline = kind == POV_B_SPLINE;
			m[0] = spline ? (a + 4 * b + c) / 6 : b;
			m[1] = (c - a) / 2;
			m[2] = spline ? (a - 2 * b + c) / 2 : a - 2.5 * b + 2 * c - d / 2;
			m[3] = spline ? (d - a + 3 * (b - c)) / 6 : (d - a) / 2 + 1.5 * (b - c);
		}
		set_channel(&r.at, k, m[0] + t * (m[1] + t * (m[2] + t * m[3])));
		set_channel(&r.rate, k, m[1] + t * (2 * m[2] + t * 3 * m[3]));
	}
	r.at.radius = fabs(r.at.radius);
	return r;
}

/* The curve in 'pieces' a segment; NULL when memory is out. */
static struct stop *stops(const struct pov_sphere_sweep *p, struct arena *a, int pieces, size_t *count)
{
	size_t ends = p->spline == POV_LINEAR ? 0 : 1, n = 0;
	size_t segments = p->count > 2 * ends + 1 ? p->count - 2 * ends - 1 : 0;
	if (p->spline == POV_LINEAR)
		pieces = 1;
	struct stop *r = NEW(a, struct stop, segments * (size_t)pieces + 1);
	for (size_t i = 0; r && i < segments; i++)
		for (int k = 0; k <= pieces; k++)
			if (k < pieces || i + 1 == segments)
				r[n++] = stop_at(p->spline, p->spheres + ends + i, (double)k / pieces);
	*count = n;
	return r;
}

static int seal_sweep(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	struct sealed *q = NEW(a, struct sealed, 1);
	size_t count = 0;
	struct stop *along = stops(&s->shape.sweep, a, FIELD_PIECES, &count);
	if (!q || !along || !(q->at = NEW(a, struct pov_sphere, count)))
		return err_memory(e, "sphere_sweep");
	q->count = count;
	q->box = box_empty();
	for (size_t i = 0; i < q->count; i++) {
		struct box ball = { along[i].at.center, along[i].at.center };
		ball = box_enlarge(&ball, along[i].at.radius);
		box_join(&q->box, &ball);
		q->at[i] = along[i].at;
	}
	s->sealed = q;
	*why = "sphere_sweep of too few spheres";
	return q->count ? 0 : 1;
}

static struct box sweep_bounds(const struct pov_solid *s)
{
	return ((const struct sealed *)s->sealed)->box;
}

/* Distance to the spheres between a and b: the nearest is where the way to p makes the cone's angle with the axis. */
static double piece_distance(const struct pov_sphere *a, const struct pov_sphere *b, struct vec p)
{
	struct vec way = vec_sub(b->center, a->center), w = vec_sub(p, a->center);
	double length = vec_length(way), narrows = a->radius - b->radius;
	if (length <= fabs(narrows)) {
		const struct pov_sphere *larger = narrows > 0 ? a : b;
		return vec_length(vec_sub(p, larger->center)) - larger->radius;
	}
	double y = vec_dot(w, way) / length, x = vec_length(vec_sub(w, vec_scale(way, y / length))), sine = narrows / length;
	double t = fmin(1, fmax(0, (y - x * sine / sqrt(1 - sine * sine)) / length));
	return hypot(x, y - t * length) - (a->radius - t * narrows);
}

static double sweep_field(const struct pov_solid *s, struct vec p)
{
	const struct sealed *q = s->sealed;
	double f = q->count == 1 ? piece_distance(q->at, q->at, p) : INFINITY;
	for (size_t i = 0; i + 1 < q->count; i++)
		f = fmin(f, piece_distance(&q->at[i], &q->at[i + 1], p));
	return f;
}

static double sweep_feature(const struct pov_solid *s)
{
	const struct sealed *q = s->sealed;
	double most = 0;
	for (size_t i = 0; i < q->count; i++)
		most = fmax(most, q->at[i].radius);
	return 2 * most;
}

/* The circle where a sphere that moves along 'axis' and shrinks by 'sine' per length touches what it sweeps. */
struct ring {
	struct vec center, u, v;
	double radius;
};

static struct ring touch(const struct pov_sphere *s, struct vec axis, double sine, struct vec u)
{
	struct ring r;
	sine = fmin(1, fmax(-1, sine));
	u = vec_unit(vec_sub(u, vec_scale(axis, vec_dot(u, axis))));
	if (vec_length(u) < 0.5)
		pov_place_frame(axis, &u, &r.v);
	r.center = vec_add(s->center, vec_scale(axis, s->radius * sine));
	r.radius = s->radius * sqrt(1 - sine * sine);
	r.u = u;
	r.v = vec_cross(axis, u);
	return r;
}

static struct vec ring_point(const struct ring *r, int j, int n)
{
	double angle = 2 * pi * (j % n) / n;
	return vec_add(r->center, vec_add(vec_scale(r->u, r->radius * cos(angle)), vec_scale(r->v, r->radius * sin(angle))));
}

static void draw_tube(const struct pov_drawing *d, const struct ring *a, const struct ring *b)
{
	for (int j = 0; j < d->n; j++)
		pov_draw_quad(d, ring_point(a, j, d->n), ring_point(a, j + 1, d->n), ring_point(b, j + 1, d->n), ring_point(b, j, d->n));
}

static void draw_ball(const struct pov_drawing *d, const struct pov_sphere *at)
{
	struct pov_solid ball = { .kind = POV_SPHERE, .shape.sphere = *at };
	if (at->radius > 0)
		pov_shape_sphere.mesh(&ball, d);
}

static void draw_straight(const struct pov_drawing *d, const struct pov_sphere *a, const struct pov_sphere *b)
{
	struct vec way = vec_sub(b->center, a->center), u = vec(0, 0, 0);
	double length = vec_length(way), sine = (a->radius - b->radius) / length;
	if (length <= fabs(a->radius - b->radius))
		return;
	struct ring from = touch(a, vec_unit(way), sine, u), to = touch(b, vec_unit(way), sine, from.u);
	draw_tube(d, &from, &to);
}

static void draw_curve(const struct pov_drawing *d, const struct stop *along, size_t count)
{
	struct ring before = { .u = vec(0, 0, 0) };
	for (size_t i = 0; i < count; i++) {
		double speed = vec_length(along[i].rate.center);
		struct vec axis = speed > 0 ? vec_unit(along[i].rate.center)
		                            : vec_unit(vec_sub(along[i + 1 < count ? i + 1 : i].at.center, along[i ? i - 1 : 0].at.center));
		if (vec_length(axis) == 0)
			continue;
		struct ring here = touch(&along[i].at, axis, speed > 0 ? -along[i].rate.radius / speed : 0, before.u);
		if (vec_length(before.u) > 0)
			draw_tube(d, &before, &here);
		before = here;
	}
}

static void mesh_sweep(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_sphere_sweep *p = &s->shape.sweep;
	size_t count;
	struct stop *along = stops(p, d->scratch, d->n / 2 < 4 ? 4 : d->n / 2, &count);
	if (!along) {
		d->out->lost = true;
		return;
	}
	for (size_t i = 0; i < count; i++)
		if (p->spline == POV_LINEAR || i == 0 || i + 1 == count)
			draw_ball(d, &along[i].at);
	if (p->spline != POV_LINEAR)
		draw_curve(d, along, count);
	else
		for (size_t i = 0; i + 1 < count; i++)
			draw_straight(d, &along[i].at, &along[i + 1].at);
}

const struct pov_shape pov_shape_sphere_sweep = {
	.name = "sphere_sweep", .seal = seal_sweep, .bounds = sweep_bounds, .field = sweep_field, .slope = 1,
	.feature = sweep_feature, .mesh = mesh_sweep,
};
