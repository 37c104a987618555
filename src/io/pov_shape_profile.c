/* Shapes of a plane outline: prism and text along an axis, lathe and sor about one. */
#include "io/pov_font.h"
#include "io/pov_outline.h"
#include "io/pov_shape.h"

static const double pi = 3.14159265358979323846;

enum { FIELD_PIECES = 16 /* of a curved segment, for fields */, WALL_STEPS = 256 };

/* What is sealed: the outlines of the field. A prism has one, a text one a letter; turned shapes have one with its mirror image. */
struct sealed {
	struct pov_outline *outlines;
	size_t count;
	struct box box;
	double thickness;
};

static int mesh_pieces(const struct pov_drawing *d)
{
	return d->n / 4 < 2 ? 2 : d->n / 4;
}

/* Four times area over length: the diameter of a disc, twice the width of a strip. */
static double outline_thickness(const struct pov_outline *o)
{
	double area = 0, length = 0;
	for (size_t l = 0; l < o->loops; l++)
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++) {
			const double *a = o->at[i], *b = o->at[pov_outline_next(o, l, i)];
			area += a[0] * b[1] - a[1] * b[0];
			length += hypot(b[0] - a[0], b[1] - a[1]);
		}
	return length > 0 ? 2 * fabs(area) / length : 0;
}

/* Extent of all outlines in the plane, and the thinnest of them. */
static void measure(struct sealed *q, struct box *plane)
{
	*plane = box_empty();
	q->thickness = INFINITY;
	for (size_t k = 0; k < q->count; k++) {
		for (size_t i = 0; i < q->outlines[k].count; i++)
			box_extend(plane, vec(q->outlines[k].at[i][0], q->outlines[k].at[i][1], 0));
		q->thickness = fmin(q->thickness, outline_thickness(&q->outlines[k]));
	}
}

static struct sealed *new_sealed(struct arena *a, size_t count)
{
	struct sealed *q = NEW(a, struct sealed, 1);
	if (!q || !(q->outlines = NEW(a, struct pov_outline, count)))
		return NULL;
	q->count = count;
	for (size_t i = 0; i < count; i++)
		q->outlines[i].mem = a;
	return q;
}

static struct box sealed_box(const struct pov_solid *s)
{
	return ((const struct sealed *)s->sealed)->box;
}

static double sealed_feature(const struct pov_solid *s)
{
	return ((const struct sealed *)s->sealed)->thickness;
}

/* Along an axis. */

/* A wall's point: of a prism, at height h along y; of letters, along z. */
static struct vec wall_point(const struct pov_solid *s, const double *p, double h)
{
	if (s->kind == POV_TEXT)
		return vec(p[0], p[1], h);
	double scale = s->shape.profile.conic ? h : 1;
	return vec(p[0] * scale, h, p[1] * scale);
}

struct cap {
	const struct pov_solid *solid;
	const struct pov_drawing *d;
	double low, high;
};

static void draw_caps(void *context, const double a[2], const double b[2], const double c[2])
{
	const struct cap *k = context;
	pov_draw(k->d, wall_point(k->solid, a, k->low), wall_point(k->solid, b, k->low), wall_point(k->solid, c, k->low));
	pov_draw(k->d, wall_point(k->solid, a, k->high), wall_point(k->solid, c, k->high), wall_point(k->solid, b, k->high));
}

static void draw_walls(const struct pov_solid *s, const struct pov_drawing *d, const struct pov_outline *o, double low, double high)
{
	int rows = pov_draw_rows(d, high - low, outline_thickness(o) / 2);
	for (size_t l = 0; l < o->loops; l++)
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++) {
			size_t next = pov_outline_next(o, l, i);
			bool left = pov_outline_inside_left(o, i, next);
			const double *a = o->at[left ? next : i], *b = o->at[left ? i : next];
			for (int k = 0; k < rows; k++) {
				double from = low + (high - low) * k / rows, to = k + 1 < rows ? low + (high - low) * (k + 1) / rows : high;
				pov_draw_quad(d, wall_point(s, a, from), wall_point(s, b, from), wall_point(s, b, to), wall_point(s, a, to));
			}
		}
}

/* The plane (x, z) is seen from below, that of letters (x, y) from above: they turn the other way. */
static void extrude(const struct pov_solid *s, const struct pov_drawing *d, const struct pov_outline *o, double low, double high)
{
	struct pov_drawing own = *d;
	struct cap caps = { s, &own, low, high };
	own.turn = d->turn != (s->kind == POV_TEXT);
	if (s->kind == POV_PRISM && s->shape.profile.conic && low < 0 && high > 0) {
		draw_walls(s, &own, o, low, 0);
		draw_walls(s, &own, o, 0, high);
	} else {
		draw_walls(s, &own, o, low, high);
	}
	if (!s->open && pov_outline_fill(o, d->scratch, draw_caps, &caps) != 0)
		d->out->lost = true;
}

static int seal_prism(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	struct pov_profile *p = &s->shape.profile;
	struct sealed *q = new_sealed(a, 1);
	struct box plane;
	if (!q)
		return err_memory(e, "prism");
	pov_outline_spline(q->outlines, p->spline, p->points, p->count, FIELD_PIECES, true);
	pov_outline_index(q->outlines);
	if (q->outlines->lost)
		return err_memory(e, "prism");
	if (p->low > p->high) {
		double swap = p->low;
		p->low = p->high;
		p->high = swap;
	}
	measure(q, &plane);
	double scale = p->conic ? fmax(fabs(p->low), fabs(p->high)) : 1;
	q->box = box_empty();
	for (int k = 0; k < 2; k++) {
		double h = k ? p->high : p->low, t = p->conic ? h : 1;
		box_extend(&q->box, vec(plane.lo.x * t, h, plane.lo.y * t));
		box_extend(&q->box, vec(plane.hi.x * t, h, plane.hi.y * t));
	}
	q->thickness *= scale;
	s->sealed = q;
	*why = "prism without an outline";
	return q->outlines->loops ? 0 : 1;
}

static double prism_field(const struct pov_solid *s, struct vec p)
{
	const struct sealed *q = s->sealed;
	const struct pov_profile *o = &s->shape.profile;
	double ends = fmax(o->low - p.y, p.y - o->high);
	if (!o->conic)
		return fmax(pov_outline_distance(q->outlines, p.x, p.z), ends);
	if (p.y == 0)
		return fmax(ends, hypot(p.x, p.z));
	return fmax(fabs(p.y) * pov_outline_distance(q->outlines, p.x / p.y, p.z / p.y), ends);
}

/* Where it narrows to the apex the field grows with the outline's own width. */
static double prism_reach(const struct pov_solid *s, struct vec p, double r)
{
	const struct sealed *q = s->sealed;
	if (!s->shape.profile.conic)
		return r;
	double wide = 0;
	for (size_t i = 0; i < q->outlines->count; i++)
		wide = fmax(wide, hypot(q->outlines->at[i][0], q->outlines->at[i][1]));
	(void)p;
	return r * (1 + wide);
}

static void mesh_prism(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_profile *p = &s->shape.profile;
	struct pov_outline o = { .mem = d->scratch };
	pov_outline_spline(&o, p->spline, p->points, p->count, mesh_pieces(d), true);
	if (o.lost)
		d->out->lost = true;
	else
		extrude(s, d, &o, p->low, p->high);
}

const struct pov_shape pov_shape_prism = {
	.name = "prism", .seal = seal_prism, .bounds = sealed_box, .field = prism_field, .reach = prism_reach,
	.feature = sealed_feature, .mesh = mesh_prism,
};

static int seal_text(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_text *t = &s->shape.text;
	struct sealed *q = new_sealed(a, t->count);
	struct box plane;
	if (!q)
		return err_memory(e, "text");
	int status = pov_font_outlines(t, q->outlines, why);
	if (status != 0)
		return status;
	for (size_t i = 0; i < q->count; i++) {
		pov_outline_index(&q->outlines[i]);
		if (q->outlines[i].lost)
			return err_memory(e, "text");
	}
	measure(q, &plane);
	q->box = (struct box){ vec(plane.lo.x, plane.lo.y, fmin(0, t->thickness)), vec(plane.hi.x, plane.hi.y, fmax(0, t->thickness)) };
	s->sealed = q;
	*why = "text without letters";
	return box_is_empty(&plane) ? 1 : 0;
}

/* In the plane; 0 inside. */
static double box_distance(const struct box *b, struct vec p)
{
	return hypot(fmax(0, fmax(b->lo.x - p.x, p.x - b->hi.x)), fmax(0, fmax(b->lo.y - p.y, p.y - b->hi.y)));
}

static double text_field(const struct pov_solid *s, struct vec p)
{
	const struct sealed *q = s->sealed;
	double f = INFINITY;
	for (size_t i = 0; i < q->count; i++)
		if (q->outlines[i].loops && box_distance(&q->outlines[i].tree.nodes->box, p) < f)
			f = fmin(f, pov_outline_distance(&q->outlines[i], p.x, p.y));
	return fmax(f, fmax(q->box.lo.z - p.z, p.z - q->box.hi.z));
}

static void mesh_text(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct sealed *q = s->sealed;
	for (size_t i = 0; i < q->count; i++)
		extrude(s, d, &q->outlines[i], q->box.lo.z, q->box.hi.z);
}

const struct pov_shape pov_shape_text = {
	.name = "text", .seal = seal_text, .bounds = sealed_box, .field = text_field, .slope = 1, .feature = sealed_feature,
	.mesh = mesh_text,
};

/* About an axis. */

/* The squared radius of sor over a span from q[0] to q[1], as a cubic of 0..1 (Hermite). */
static void sor_cubic(const struct vec *q, double *c)
{
	double a = q[0].x * q[0].x, b = q[1].x * q[1].x, slope[2];
	for (int k = 0; k < 2; k++)
		slope[k] = 2 * q[k].x * (q[k + 1].x - q[k - 1].x) / (q[k + 1].y - q[k - 1].y) * (q[1].y - q[0].y);
	c[0] = a;
	c[1] = slope[0];
	c[2] = 3 * (b - a) - 2 * slope[0] - slope[1];
	c[3] = 2 * (a - b) + slope[0] + slope[1];
}

/* The points of sor between its controls, denser where spans end, for there the radius may go to zero like a root. */
static void sor_curve(struct pov_outline *o, const struct pov_profile *p, int pieces)
{
	for (size_t i = 1; i + 2 < p->count; i++) {
		const struct vec *q = p->points + i;
		double c[4];
		sor_cubic(q, c);
		for (int k = 0; k <= pieces; k++) {
			double t = k == pieces ? 1 : (1 - cos(pi * k / pieces)) / 2;
			pov_outline_add(o, sqrt(fmax(0, c[0] + t * (c[1] + t * (c[2] + t * c[3])))), k == pieces ? q[1].y : q[0].y + t * (q[1].y - q[0].y));
		}
	}
}

/* Whether the profile is drawn at a height. POV-Ray draws no span of sor whose squared radius falls below zero within it. */
static bool has_wall(const struct pov_solid *s, double y)
{
	const struct pov_profile *p = &s->shape.profile;
	size_t i = 1;
	if (s->kind != POV_SOR)
		return true;
	while (i + 3 < p->count && y > p->points[i + 1].y)
		i++;
	double c[4], least = -1e-12 * fmax(p->points[i].x * p->points[i].x, p->points[i + 1].x * p->points[i + 1].x);
	sor_cubic(p->points + i, c);
	for (int k = 1; k < WALL_STEPS; k++) {
		double t = (double)k / WALL_STEPS;
		if (c[0] + t * (c[1] + t * (c[2] + t * c[3])) < least)
			return false;
	}
	return true;
}

/* The half profile, unclosed. */
static void turned_curve(struct pov_outline *o, const struct pov_solid *s, int pieces)
{
	const struct pov_profile *p = &s->shape.profile;
	if (s->kind == POV_SOR)
		sor_curve(o, p, pieces);
	else
		pov_outline_spline(o, p->spline, p->points, p->count, pieces, false);
}

static bool closes(const struct pov_outline *half)
{
	const double *a = half->at[0], *b = half->at[half->count - 1];
	return half->count > 2 && hypot(a[0] - b[0], a[1] - b[1]) < 1e-9;
}

/* The profile with its mirror image: one loop where it is open, straight across at both ends; two where it is closed. */
static void mirror(struct pov_outline *o, const struct pov_outline *half)
{
	for (size_t i = 0; i < half->count; i++)
		pov_outline_add(o, half->at[i][0], half->at[i][1]);
	if (closes(half))
		pov_outline_close(o);
	for (size_t i = half->count; i-- > 0;)
		pov_outline_add(o, -half->at[i][0], half->at[i][1]);
	pov_outline_close(o);
}

static bool rises(const struct pov_profile *p)
{
	for (size_t i = 1; i + 1 < p->count; i++)
		if (!(p->points[i + 1].y > p->points[i - 1].y && p->points[i + 1].y >= p->points[i].y))
			return false;
	return true;
}

static int seal_turned(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	struct sealed *q = new_sealed(a, 1);
	struct pov_outline half = { .mem = a };
	struct box plane;
	if (!q)
		return err_memory(e, pov_kind_name(s->kind));
	*why = "sor whose heights do not rise";
	if (s->kind == POV_SOR && !rises(&s->shape.profile))
		return 1;
	*why = "lathe or sor without a profile";
	turned_curve(&half, s, FIELD_PIECES);
	if (!half.lost && half.count < 2)
		return 1;
	if (!half.lost)
		mirror(q->outlines, &half);
	pov_outline_index(q->outlines);
	if (half.lost || q->outlines->lost)
		return err_memory(e, pov_kind_name(s->kind));
	measure(q, &plane);
	double wide = fmax(plane.hi.x, -plane.lo.x);
	q->box = (struct box){ vec(-wide, plane.lo.y, -wide), vec(wide, plane.hi.y, wide) };
	s->sealed = q;
	return q->outlines->loops ? 0 : 1;
}

static double turned_field(const struct pov_solid *s, struct vec p)
{
	return pov_outline_distance(((const struct sealed *)s->sealed)->outlines, hypot(p.x, p.z), p.y);
}

static struct vec turned_point(const double *p, int j, int n)
{
	double angle = 2 * pi * (j % n) / n;
	return vec(p[0] * cos(angle), p[1], -p[0] * sin(angle));
}

static void mesh_turned(const struct pov_solid *s, const struct pov_drawing *d)
{
	struct pov_outline half = { .mem = d->scratch }, whole = { .mem = d->scratch };
	turned_curve(&half, s, mesh_pieces(d));
	if (!half.lost)
		mirror(&whole, &half);
	if (half.lost || whole.lost || whole.loops == 0) {
		d->out->lost = d->out->lost || half.lost || whole.lost;
		return;
	}
	for (size_t i = 0; i + 1 < half.count; i++) {
		if (!has_wall(s, (half.at[i][1] + half.at[i + 1][1]) / 2))
			continue;
		bool left = pov_outline_inside_left(&whole, i, i + 1 < whole.first[1] ? i + 1 : 0);
		const double *a = half.at[left ? i : i + 1], *b = half.at[left ? i + 1 : i];
		for (int j = 0; j < d->n; j++)
			pov_draw_quad(d, turned_point(a, j, d->n), turned_point(a, j + 1, d->n), turned_point(b, j + 1, d->n),
			              turned_point(b, j, d->n));
	}
	if (s->kind != POV_SOR || s->open)
		return;
	for (int k = 0; k < 2; k++) {
		const double *p = half.at[k ? half.count - 1 : 0];
		double middle[2] = { 0, p[1] };
		for (int j = 0; j < d->n; j++)
			pov_draw(d, turned_point(middle, 0, 1), turned_point(p, k ? j : j + 1, d->n), turned_point(p, k ? j + 1 : j, d->n));
	}
}

const struct pov_shape pov_shape_lathe = {
	.name = "lathe", .seal = seal_turned, .bounds = sealed_box, .field = turned_field, .slope = 1,
	.feature = sealed_feature, .mesh = mesh_turned,
};
const struct pov_shape pov_shape_sor = {
	.name = "sor", .seal = seal_turned, .bounds = sealed_box, .field = turned_field, .slope = 1, .feature = sealed_feature,
	.mesh = mesh_turned,
};
