/* box, plane, disc, polygon, bicubic_patch. */
#include "geom/clip.h"
#include "io/pov_outline.h"
#include "io/pov_place.h"
#include "io/pov_shape.h"

static const double pi = 3.14159265358979323846;

static int seal_box(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)why;
	(void)e;
	struct box b = box_empty();
	box_extend(&b, s->shape.box.corner[0]);
	box_extend(&b, s->shape.box.corner[1]);
	s->shape.box = (struct pov_box){ { b.lo, b.hi } };
	return 0;
}

static struct box box_bounds(const struct pov_solid *s)
{
	return (struct box){ s->shape.box.corner[0], s->shape.box.corner[1] };
}

static double box_field(const struct pov_solid *s, struct vec p)
{
	const struct vec *c = s->shape.box.corner;
	double f = -INFINITY;
	for (int i = 0; i < 3; i++)
		f = fmax(f, fmax(c[0].a[i] - p.a[i], p.a[i] - c[1].a[i]));
	return f;
}

/* Part (i, j) of a face. */
static void draw_face(const struct vec *c, const struct pov_drawing *d, int axis, int side, int u, int v, const int *rows, int i, int j)
{
	struct vec p[4];
	for (int k = 0; k < 4; k++) {
		int at[2] = { i + (k == 1 || k == 2), j + (k >= 2) }, along[2] = { u, v };
		p[k].a[axis] = c[side].a[axis];
		for (int b = 0; b < 2; b++) {
			double lo = c[0].a[along[b]], hi = c[1].a[along[b]];
			p[k].a[along[b]] = at[b] == rows[along[b]] ? hi : lo + (hi - lo) * at[b] / rows[along[b]];
		}
	}
	pov_draw_quad(d, p[0], p[1], p[2], p[3]);
}

static void mesh_box(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct vec *c = s->shape.box.corner;
	struct vec size = vec_sub(c[1], c[0]);
	int rows[3];
	for (int axis = 0; axis < 3; axis++)
		rows[axis] = pov_draw_rows(d, size.a[axis], fmin(size.x, fmin(size.y, size.z)));
	for (int axis = 0; axis < 3; axis++)
		for (int side = 0; side < 2; side++) {
			int u = (axis + (side ? 1 : 2)) % 3, v = (axis + (side ? 2 : 1)) % 3;
			for (int i = 0; i < rows[u]; i++)
				for (int j = 0; j < rows[v]; j++)
					draw_face(c, d, axis, side, u, v, rows, i, j);
		}
}

const struct pov_shape pov_shape_box = {
	.name = "box", .seal = seal_box, .bounds = box_bounds, .field = box_field, .slope = 1, .mesh = mesh_box,
};

static int seal_plane(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	s->shape.plane.normal = vec_unit(s->shape.plane.normal);
	*why = "plane without a normal";
	return vec_length(s->shape.plane.normal) > 0 ? 0 : 1;
}

static struct box plane_bounds(const struct pov_solid *s)
{
	const struct pov_plane *q = &s->shape.plane;
	struct box b = box_infinite();
	for (int i = 0; i < 3; i++)
		if (fabs(q->normal.a[i]) == 1) {
			if (q->normal.a[i] > 0)
				b.hi.a[i] = q->distance;
			else
				b.lo.a[i] = -q->distance;
		}
	return b;
}

static double plane_field(const struct pov_solid *s, struct vec p)
{
	return vec_dot(s->shape.plane.normal, p) - s->shape.plane.distance;
}

static void mesh_plane(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_plane *q = &s->shape.plane;
	struct vec u, v, middle = vec_scale(vec_add(d->region.lo, d->region.hi), 0.5);
	struct vec foot = vec_sub(middle, vec_scale(q->normal, plane_field(s, middle)));
	double far = box_diagonal(&d->region);
	/* The region may end in the plane itself: no rounding may put it beyond. */
	for (int i = 0; i < 3; i++)
		if (fabs(q->normal.a[i]) == 1)
			foot.a[i] = q->normal.a[i] * q->distance;
	pov_place_frame(q->normal, &u, &v);
	u = vec_scale(u, far);
	v = vec_scale(v, far);
	struct polygon p = { 4, { vec_sub(vec_sub(foot, u), v), vec_sub(vec_add(foot, u), v), vec_add(vec_add(foot, u), v),
		                  vec_add(vec_sub(foot, u), v) } };
	polygon_cut_box(&p, &d->region);
	for (int i = 2; i < p.count; i++)
		pov_draw(d, p.corner[0], p.corner[i - 1], p.corner[i]);
}

const struct pov_shape pov_shape_plane = {
	.name = "plane", .seal = seal_plane, .bounds = plane_bounds, .field = plane_field, .slope = 1, .mesh = mesh_plane,
};

static int seal_disc(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	struct pov_disc *d = &s->shape.disc;
	d->normal = vec_unit(d->normal);
	*why = "disc without a normal or without width";
	return vec_length(d->normal) > 0 && d->radius > fmax(0, d->hole) ? 0 : 1;
}

static struct box disc_bounds(const struct pov_solid *s)
{
	const struct pov_disc *d = &s->shape.disc;
	struct vec side;
	for (int i = 0; i < 3; i++)
		side.a[i] = d->radius * sqrt(fmax(0, 1 - d->normal.a[i] * d->normal.a[i]));
	return (struct box){ vec_sub(d->center, side), vec_add(d->center, side) };
}

/* As a solid it is the half space behind it. */
static double disc_field(const struct pov_solid *s, struct vec p)
{
	return vec_dot(s->shape.disc.normal, vec_sub(p, s->shape.disc.center));
}

static struct box disc_filled(const struct pov_solid *s)
{
	(void)s;
	return box_infinite();
}

static void mesh_disc(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_disc *q = &s->shape.disc;
	struct vec u, v, before = q->center;
	pov_place_frame(q->normal, &u, &v);
	double hole = fmax(0, q->hole) / q->radius;
	for (int j = 0; j <= d->n; j++) {
		double angle = 2 * pi * (j % d->n) / d->n;
		struct vec out = vec_scale(vec_add(vec_scale(u, cos(angle)), vec_scale(v, sin(angle))), q->radius);
		struct vec inner[2] = { vec_add(q->center, vec_scale(before, hole)), vec_add(q->center, vec_scale(out, hole)) };
		if (j > 0)
			pov_draw_quad(d, inner[0], vec_add(q->center, before), vec_add(q->center, out), inner[1]);
		before = out;
	}
}

const struct pov_shape pov_shape_disc = {
	.name = "disc", .seal = seal_disc, .bounds = disc_bounds, .field = disc_field, .slope = 1, .mesh = mesh_disc,
	.filled = disc_filled,
};

/* A polygon's plane as a frame, and its loops there. */
struct flat {
	struct vec origin, u, v;
	struct pov_outline outline;
};

static struct vec flat_point(const struct flat *f, const double *p)
{
	return vec_add(f->origin, vec_add(vec_scale(f->u, p[0]), vec_scale(f->v, p[1])));
}

/* The normal of the first corner that turns enough, or zero; POV-Ray's plane is also that of three points. */
static struct vec polygon_normal(const struct pov_polygon *p)
{
	struct vec best = vec(0, 0, 0);
	for (size_t i = 1; i + 1 < p->count; i++) {
		struct vec n = vec_cross(vec_sub(p->points[i], p->points[0]), vec_sub(p->points[i + 1], p->points[0]));
		if (vec_length(n) > vec_length(best))
			best = n;
	}
	return vec_unit(best);
}

static bool same_place(struct vec p, struct vec q, double size)
{
	return vec_length(vec_sub(p, q)) <= 1e-9 * size;
}

static int seal_polygon(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_polygon *p = &s->shape.polygon;
	struct vec normal = polygon_normal(p);
	struct box b = box_empty();
	*why = "polygon without area";
	if (p->count < 3 || vec_length(normal) == 0)
		return 1;
	for (size_t i = 0; i < p->count; i++)
		box_extend(&b, p->points[i]);
	double size = box_diagonal(&b);
	*why = "polygon that is not flat";
	for (size_t i = 0; i < p->count; i++)
		if (fabs(vec_dot(normal, vec_sub(p->points[i], p->points[0]))) > 1e-5 * size)
			return 1;
	struct flat *f = NEW(a, struct flat, 1);
	if (!f)
		return err_memory(e, "polygon");
	f->origin = p->points[0];
	f->outline.mem = a;
	pov_place_frame(normal, &f->u, &f->v);
	for (size_t i = 0, start = 0; i < p->count; i++) {
		struct vec q = vec_sub(p->points[i], f->origin);
		pov_outline_add(&f->outline, vec_dot(q, f->u), vec_dot(q, f->v));
		if ((i > start && same_place(p->points[i], p->points[start], size)) || i + 1 == p->count) {
			pov_outline_close(&f->outline);
			start = i + 1;
		}
	}
	s->sealed = f;
	return f->outline.lost ? err_memory(e, "polygon") : 0;
}

static struct box polygon_bounds(const struct pov_solid *s)
{
	struct box b = box_empty();
	for (size_t i = 0; i < s->shape.polygon.count; i++)
		box_extend(&b, s->shape.polygon.points[i]);
	return b;
}

struct fill_flat {
	const struct flat *flat;
	const struct pov_drawing *d;
};

static void draw_flat(void *context, const double a[2], const double b[2], const double c[2])
{
	const struct fill_flat *f = context;
	pov_draw(f->d, flat_point(f->flat, a), flat_point(f->flat, b), flat_point(f->flat, c));
}

static void mesh_polygon(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct flat *flat = s->sealed;
	struct fill_flat f = { flat, d };
	if (pov_outline_fill(&flat->outline, d->scratch, draw_flat, &f) != 0)
		d->out->lost = true;
}

const struct pov_shape pov_shape_polygon = {
	.name = "polygon", .seal = seal_polygon, .bounds = polygon_bounds, .mesh = mesh_polygon,
};

static struct box bicubic_bounds(const struct pov_solid *s)
{
	struct box b = box_empty();
	for (int i = 0; i < 16; i++)
		box_extend(&b, s->shape.bicubic.points[i]);
	return b;
}

static struct vec bicubic_point(const struct vec *p, double u, double v)
{
	double bu[4] = { (1 - u) * (1 - u) * (1 - u), 3 * u * (1 - u) * (1 - u), 3 * u * u * (1 - u), u * u * u };
	double bv[4] = { (1 - v) * (1 - v) * (1 - v), 3 * v * (1 - v) * (1 - v), 3 * v * v * (1 - v), v * v * v };
	struct vec sum = vec(0, 0, 0);
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
			sum = vec_add(sum, vec_scale(p[4 * i + j], bu[i] * bv[j]));
	return sum;
}

/* 2^u by 2^v pieces; steps above 4 are no longer seen. */
static void mesh_bicubic(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_bicubic *q = &s->shape.bicubic;
	int nu = 1 << (q->u_steps < 0 ? 0 : q->u_steps > 4 ? 4 : q->u_steps), nv = 1 << (q->v_steps < 0 ? 0 : q->v_steps > 4 ? 4 : q->v_steps);
	for (int i = 0; i < nu; i++)
		for (int j = 0; j < nv; j++) {
			double u = (double)i / nu, v = (double)j / nv, un = (i + 1.0) / nu, vn = (j + 1.0) / nv;
			pov_draw_quad(d, bicubic_point(q->points, u, v), bicubic_point(q->points, un, v), bicubic_point(q->points, un, vn),
			              bicubic_point(q->points, u, vn));
		}
}

const struct pov_shape pov_shape_bicubic = {
	.name = "bicubic_patch", .bounds = bicubic_bounds, .mesh = mesh_bicubic,
};
