/* sphere, cylinder, cone, torus, superellipsoid. */
#include "io/pov_place.h"
#include "io/pov_shape.h"

static const double pi = 3.14159265358979323846;

/* Cosine and sine of i/n of a full turn; exact zeros and ones at quarters, so that rings close and poles meet. */
static void turn(int i, int n, double *c, double *s)
{
	static const double quarter[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
	i %= n;
	if (4 * i % n == 0) {
		*c = quarter[4 * i / n][0];
		*s = quarter[4 * i / n][1];
		return;
	}
	*c = cos(2 * pi * i / n);
	*s = sin(2 * pi * i / n);
}

/* Points of row i of 'rows' from pole to pole and column j of n. */
static struct vec sphere_point(const struct pov_sphere *s, int i, int rows, int j, int n)
{
	double c, h, a, b;
	turn(i, 2 * rows, &h, &c); /* from +y down */
	turn(j, n, &a, &b);
	return vec_add(s->center, vec_scale(vec(c * a, h, c * -b), s->radius));
}

static int seal_sphere(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	s->shape.sphere.radius = fabs(s->shape.sphere.radius);
	*why = "sphere of radius 0";
	return s->shape.sphere.radius > 0 ? 0 : 1;
}

static struct box sphere_box(const struct pov_solid *s)
{
	struct box b = { s->shape.sphere.center, s->shape.sphere.center };
	return box_enlarge(&b, s->shape.sphere.radius);
}

static double sphere_field(const struct pov_solid *s, struct vec p)
{
	return vec_length(vec_sub(p, s->shape.sphere.center)) - s->shape.sphere.radius;
}

static void mesh_sphere(const struct pov_solid *s, const struct pov_drawing *d)
{
	int n = d->n, rows = (n + 1) / 2;
	for (int i = 0; i < rows; i++)
		for (int j = 0; j < n; j++)
			pov_draw_quad(d, sphere_point(&s->shape.sphere, i, rows, j, n), sphere_point(&s->shape.sphere, i + 1, rows, j, n),
			              sphere_point(&s->shape.sphere, i + 1, rows, j + 1, n), sphere_point(&s->shape.sphere, i, rows, j + 1, n));
}

static void cross_sphere(const struct pov_solid *s, const struct pov_line *line)
{
	struct pov_line within = *line;
	within.least = -INFINITY;
	within.most = INFINITY;
	if (!pov_line_clip_sphere(&within, &s->shape.sphere))
		return;
	if (within.least > line->least && within.least < line->most && line->meet(line->context, within.least))
		return;
	if (within.most > line->least && within.most < line->most)
		line->meet(line->context, within.most);
}

const struct pov_shape pov_shape_sphere = {
	.name = "sphere", .seal = seal_sphere, .bounds = sphere_box, .field = sphere_field, .slope = 1, .mesh = mesh_sphere,
	.cross = cross_sphere,
};

static int seal_cone(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	struct pov_cone *c = &s->shape.cone;
	c->radius[0] = fabs(c->radius[0]);
	c->radius[1] = fabs(c->radius[1]);
	*why = "cone or cylinder without length or width";
	return vec_length(vec_sub(c->end[1], c->end[0])) > 0 && c->radius[0] + c->radius[1] > 0 ? 0 : 1;
}

/* Of a disc: along each axis by the sine of the angle to it. */
static struct box cone_box(const struct pov_solid *s)
{
	const struct pov_cone *c = &s->shape.cone;
	struct vec axis = vec_unit(vec_sub(c->end[1], c->end[0]));
	struct box b = box_empty();
	for (int k = 0; k < 2; k++) {
		struct vec side;
		for (int i = 0; i < 3; i++)
			side.a[i] = c->radius[k] * sqrt(fmax(0, 1 - axis.a[i] * axis.a[i]));
		box_extend(&b, vec_sub(c->end[k], side));
		box_extend(&b, vec_add(c->end[k], side));
	}
	return b;
}

static double cone_field(const struct pov_solid *s, struct vec p)
{
	const struct pov_cone *c = &s->shape.cone;
	struct vec along = vec_sub(c->end[1], c->end[0]), w = vec_sub(p, c->end[0]);
	double length = vec_length(along), h = vec_dot(w, along) / length;
	double away = vec_length(vec_sub(w, vec_scale(along, h / length)));
	double grow = (c->radius[1] - c->radius[0]) / length;
	return fmax((away - c->radius[0] - grow * h) / sqrt(1 + grow * grow), fmax(-h, h - length));
}

static double cone_feature(const struct pov_solid *s)
{
	return 2 * fmax(s->shape.cone.radius[0], s->shape.cone.radius[1]);
}

static struct vec between(const struct vec *p, int i, int n)
{
	return i == 0 ? p[0] : i == n ? p[1] : vec_add(p[0], vec_scale(vec_sub(p[1], p[0]), (double)i / n));
}

/* Between two lines from the one end to the other. */
static void draw_side(const struct pov_drawing *d, const struct vec *p, const struct vec *q, int rows)
{
	for (int i = 0; i < rows; i++)
		pov_draw_quad(d, between(p, i, rows), between(q, i, rows), between(q, i + 1, rows), between(p, i + 1, rows));
}

static void mesh_cone(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_cone *c = &s->shape.cone;
	struct vec u, v, before[2] = { c->end[0], c->end[1] };
	double width = 2 * pi / d->n * fmax(c->radius[0], c->radius[1]);
	int rows = pov_draw_rows(d, vec_length(vec_sub(c->end[1], c->end[0])), width);
	pov_place_frame(vec_unit(vec_sub(c->end[1], c->end[0])), &u, &v);
	for (int j = 0; j <= d->n; j++) {
		double a, b;
		turn(j, d->n, &a, &b);
		struct vec out = vec_add(vec_scale(u, a), vec_scale(v, b)), here[2];
		for (int k = 0; k < 2; k++)
			here[k] = vec_add(c->end[k], vec_scale(out, c->radius[k]));
		if (j > 0) {
			draw_side(d, before, here, rows);
			if (!s->open) {
				pov_draw(d, c->end[0], here[0], before[0]);
				pov_draw(d, c->end[1], before[1], here[1]);
			}
		}
		before[0] = here[0];
		before[1] = here[1];
	}
}

const struct pov_shape pov_shape_cylinder = {
	.name = "cylinder", .seal = seal_cone, .bounds = cone_box, .field = cone_field, .slope = 1, .feature = cone_feature,
	.mesh = mesh_cone,
};
const struct pov_shape pov_shape_cone = {
	.name = "cone", .seal = seal_cone, .bounds = cone_box, .field = cone_field, .slope = 1, .feature = cone_feature,
	.mesh = mesh_cone,
};

static int seal_torus(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	s->shape.torus.major = fabs(s->shape.torus.major);
	s->shape.torus.minor = fabs(s->shape.torus.minor);
	*why = "torus without thickness";
	return s->shape.torus.minor > 0 ? 0 : 1;
}

static struct box torus_box(const struct pov_solid *s)
{
	double r = s->shape.torus.minor, wide = s->shape.torus.major + r;
	return (struct box){ vec(-wide, -r, -wide), vec(wide, r, wide) };
}

static double torus_field(const struct pov_solid *s, struct vec p)
{
	return hypot(hypot(p.x, p.z) - s->shape.torus.major, p.y) - s->shape.torus.minor;
}

static double torus_feature(const struct pov_solid *s)
{
	return 2 * s->shape.torus.minor;
}

static struct vec torus_point(const struct pov_torus *t, int i, int j, int n)
{
	double a, b, c, h;
	turn(i, n, &c, &h);
	turn(j, n, &a, &b);
	double away = t->major + t->minor * c;
	return vec(away * a, t->minor * h, -away * b);
}

static void mesh_torus(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_torus *t = &s->shape.torus;
	for (int i = 0; i < d->n; i++)
		for (int j = 0; j < d->n; j++)
			pov_draw_quad(d, torus_point(t, i, j, d->n), torus_point(t, i, j + 1, d->n), torus_point(t, i + 1, j + 1, d->n),
			              torus_point(t, i + 1, j, d->n));
}

const struct pov_shape pov_shape_torus = {
	.name = "torus", .seal = seal_torus, .bounds = torus_box, .field = torus_field, .slope = 1, .feature = torus_feature,
	.mesh = mesh_torus,
};

static int seal_superellipsoid(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	struct pov_superellipsoid *q = &s->shape.superellipsoid;
	*why = "superellipsoid with an exponent below 0.001";
	return q->east >= 1e-3 && q->north >= 1e-3 ? 0 : 1;
}

static struct box superellipsoid_box(const struct pov_solid *s)
{
	(void)s;
	return (struct box){ vec(-1, -1, -1), vec(1, 1, 1) };
}

/* (|a|^p + |b|^p)^(1/p), by the larger one against overflow. */
static double power_sum(double a, double b, double p)
{
	double most = fmax(fabs(a), fabs(b)), least = fmin(fabs(a), fabs(b));
	return most > 0 ? most * pow(1 + pow(least / most, p), 1 / p) : 0;
}

static double superellipsoid_field(const struct pov_solid *s, struct vec p)
{
	const struct pov_superellipsoid *q = &s->shape.superellipsoid;
	return power_sum(power_sum(p.x, p.y, 2 / q->east), p.z, 2 / q->north) - 1;
}

/* Convex ones are norms, at most |x| + |y| + |z|. */
static double superellipsoid_reach(const struct pov_solid *s, struct vec p, double r)
{
	const struct pov_superellipsoid *q = &s->shape.superellipsoid;
	(void)p;
	return q->east <= 2 && q->north <= 2 ? sqrt(3.0) * r : INFINITY;
}

/* |w|^m with the sign of w; what rounding left of a zero would be far from zero under a small m. */
static double signed_power(double w, double m)
{
	return fabs(w) < 1e-12 ? 0 : copysign(pow(fabs(w), m), w);
}

static struct vec superellipsoid_point(const struct pov_superellipsoid *q, int i, int j, int n)
{
	double a, b, c, h;
	turn(i, 2 * n, &h, &c);
	turn(j, 2 * n, &a, &b);
	double away = signed_power(c, q->north);
	return vec(away * signed_power(a, q->east), away * signed_power(b, q->east), signed_power(h, q->north));
}

static void mesh_superellipsoid(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_superellipsoid *q = &s->shape.superellipsoid;
	for (int i = 0; i < d->n; i++)
		for (int j = 0; j < 2 * d->n; j++)
			pov_draw_quad(d, superellipsoid_point(q, i, j, d->n), superellipsoid_point(q, i + 1, j, d->n),
			              superellipsoid_point(q, i + 1, j + 1, d->n), superellipsoid_point(q, i, j + 1, d->n));
}

const struct pov_shape pov_shape_superellipsoid = {
	.name = "superellipsoid", .seal = seal_superellipsoid, .bounds = superellipsoid_box, .field = superellipsoid_field,
	.reach = superellipsoid_reach, .mesh = mesh_superellipsoid,
};
