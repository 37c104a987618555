/* height_field, isosurface, parametric: surfaces of a function or of a grid of values. */
#include "geom/clip.h"
#include "io/pov_march.h"

/* A height field over the unit square; each cell is split from the corner (x0, z1) to (x1, z0). */

struct hills {
	double low, high, slope;
};

static double height(const struct pov_height_field *h, int i, int j)
{
	return h->heights[(size_t)j * (size_t)h->width + (size_t)i];
}

static int seal_height_field(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_height_field *h = &s->shape.height_field;
	struct hills *q = NEW(a, struct hills, 1);
	*why = "height_field without heights";
	if (!q)
		return err_memory(e, "height_field");
	if (!h->heights || h->width < 2 || h->height < 2)
		return 1;
	*q = (struct hills){ INFINITY, -INFINITY, 0 };
	for (int j = 0; j < h->height; j++)
		for (int i = 0; i < h->width; i++) {
			double y = height(h, i, j), dx = i ? y - height(h, i - 1, j) : 0, dz = j ? y - height(h, i, j - 1) : 0;
			q->low = fmin(q->low, y);
			q->high = fmax(q->high, y);
			q->slope = fmax(q->slope, fmax(fabs(dx) * (h->width - 1), fabs(dz) * (h->height - 1)));
		}
	s->sealed = q;
	*why = "height_field whose heights are no numbers";
	return isfinite(q->low) && isfinite(q->high) && q->high >= h->level ? 0 : 1;
}

static struct box height_field_bounds(const struct pov_solid *s)
{
	const struct hills *q = s->sealed;
	return (struct box){ vec(0, fmax(q->low, s->shape.height_field.level), 0), vec(1, q->high, 1) };
}

/* The surface at x, z within the square. */
static double hill_height(const struct pov_height_field *h, double x, double z)
{
	double u = x * (h->width - 1), v = z * (h->height - 1);
	int i = (int)fmin(floor(u), h->width - 2), j = (int)fmin(floor(v), h->height - 2);
	u -= i;
	v -= j;
	double a = height(h, i, j), b = height(h, i + 1, j), c = height(h, i, j + 1), d = height(h, i + 1, j + 1);
	return u + v <= 1 ? a + u * (b - a) + v * (c - a) : d + (1 - u) * (c - d) + (1 - v) * (b - d);
}

/* All that lies under the surface, however deep. */
static struct box height_field_filled(const struct pov_solid *s)
{
	struct box b = height_field_bounds(s);
	b.lo.y = -INFINITY;
	return b;
}

static double height_field_field(const struct pov_solid *s, struct vec p)
{
	double x = fmin(1, fmax(0, p.x)), z = fmin(1, fmax(0, p.z));
	double aside = fmax(fmax(-p.x, p.x - 1), fmax(-p.z, p.z - 1));
	return fmax(p.y - hill_height(&s->shape.height_field, x, z), aside);
}

static double height_field_reach(const struct pov_solid *s, struct vec p, double r)
{
	const struct hills *q = s->sealed;
	(void)p;
	return r * (1 + sqrt(2.0) * q->slope);
}

static double height_field_feature(const struct pov_solid *s)
{
	(void)s;
	return 1;
}

static void draw_above(const struct pov_drawing *d, double level, struct vec a, struct vec b, struct vec c)
{
	struct polygon p = { 3, { a, b, c } };
	polygon_cut_axis(&p, 1, -1, level);
	for (int i = 2; i < p.count; i++)
		pov_draw(d, p.corner[0], p.corner[i - 1], p.corner[i]);
}

static struct vec hill_point(const struct pov_height_field *h, int i, int j)
{
	return vec((double)i / (h->width - 1), height(h, i, j), (double)j / (h->height - 1));
}

static void mesh_height_field(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_height_field *h = &s->shape.height_field;
	double level = height_field_bounds(s).lo.y;
	for (int j = 0; j + 1 < h->height; j++)
		for (int i = 0; i + 1 < h->width; i++) {
			struct vec a = hill_point(h, i, j), b = hill_point(h, i + 1, j), c = hill_point(h, i, j + 1), e = hill_point(h, i + 1, j + 1);
			draw_above(d, level, a, c, b);
			draw_above(d, level, b, c, e);
		}
}

const struct pov_shape pov_shape_height_field = {
	.name = "height_field", .seal = seal_height_field, .bounds = height_field_bounds, .field = height_field_field,
	.reach = height_field_reach, .feature = height_field_feature, .mesh = mesh_height_field, .filled = height_field_filled,
};

double *pov_heights_sample(struct arena *a, struct pov_function f, int width, int height)
{
	double *h = NEW(a, double, (size_t)width * (size_t)height);
	for (int j = 0; h && j < height; j++)
		for (int i = 0; i < width; i++) {
			double arguments[3] = { (double)i / (width - 1), (double)j / (height - 1), 0 };
			h[(size_t)(height - 1 - j) * (size_t)width + (size_t)i] = f.value(f.context, arguments);
		}
	return h;
}

/* An isosurface: marched through its container, which caps it (io/pov_term.c adds the container as a solid of its own). */

/* ISO_HALVINGS: of a line, at most. */
enum { ISO_CELLS = 60, ISO_HALVINGS = 16 };

static struct box container(bool spherical, const struct pov_sphere *ball, const struct pov_box *b)
{
	struct box out = { ball->center, ball->center };
	if (spherical)
		return box_enlarge(&out, fabs(ball->radius));
	out = box_empty();
	box_extend(&out, b->corner[0]);
	box_extend(&out, b->corner[1]);
	return out;
}

static int seal_isosurface(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	*why = "isosurface of a function that cannot be computed";
	return s->shape.isosurface.function.value ? 0 : 1;
}

static struct box isosurface_bounds(const struct pov_solid *s)
{
	const struct pov_isosurface *q = &s->shape.isosurface;
	return container(q->spherical, &q->sphere, &q->box);
}

static double isosurface_field(const struct pov_solid *s, struct vec p)
{
	const struct pov_isosurface *q = &s->shape.isosurface;
	double f = q->function.value(q->function.context, p.a) - q->threshold;
	return isnan(f) ? INFINITY : f;
}

static void mesh_isosurface(const struct pov_solid *s, const struct pov_drawing *d)
{
	struct box box = isosurface_bounds(s);
	double cells = ISO_CELLS * d->n / 32.0, step = box_longest(&box) / cells;
	size_t before = d->out->count;
	struct box found = pov_march(s, &box, step, d), wide = box_enlarge(&found, step), tight = box_common(&box, &wide);
	if (box_is_empty(&found) || box_longest(&tight) >= 0.7 * box_longest(&box))
		return;
	/* Small in its container, and seen too coarsely. */
	d->out->count = before;
	pov_march(s, &tight, box_longest(&tight) / cells, d);
}

/* A stretch of a line: the field at its ends. slope: the most the field changes in a unit of t. */
struct stretch {
	const struct pov_solid *s;
	const struct pov_line *line;
	double slope, shortest;
};

static double field_at(const void *context, struct vec p)
{
	return isosurface_field(context, p);
}

static double value_at(const struct stretch *h, double t)
{
	return isosurface_field(h->s, pov_line_point(h->line, t));
}

/* Between ends of different signs, as far along the line. */
static double root_between(const struct stretch *h, double t, double f, double u, double g)
{
	struct vec p = pov_line_point(h->line, t), q = pov_line_point(h->line, u);
	struct vec at = f < 0 ? pov_root(field_at, h->s, p, f, q, g) : pov_root(field_at, h->s, q, g, p, f);
	return fmin(u, fmax(t, vec_dot(vec_sub(at, h->line->from), h->line->toward) / vec_dot(h->line->toward, h->line->toward)));
}

/* Halved while the field could pass zero by its slope, as POV-Ray looks for it; true: enough was seen. */
static bool cross_stretch(const struct stretch *h, double t, double f, double u, double g)
{
	bool passes = (f < 0) != (g < 0);
	if (!passes && fabs(f) + fabs(g) >= h->slope * (u - t))
		return false;
	if (u - t <= h->shortest)
		return passes && h->line->meet(h->line->context, root_between(h, t, f, u, g));
	double middle = (t + u) / 2, value = value_at(h, middle);
	return cross_stretch(h, t, f, middle, value) || cross_stretch(h, middle, value, u, g);
}

static void cross_isosurface(const struct pov_solid *s, const struct pov_line *line)
{
	const struct pov_isosurface *q = &s->shape.isosurface;
	struct pov_line within = *line;
	struct box box = isosurface_bounds(s);
	if (q->spherical ? !pov_line_clip_sphere(&within, &q->sphere) : !pov_line_clip_box(&within, &box))
		return;
	double unit = vec_length(line->toward), length = within.most - within.least;
	struct stretch h = { s, line, q->gradient * unit, fmax(q->accuracy / unit, ldexp(length, -ISO_HALVINGS)) };
	cross_stretch(&h, within.least, value_at(&h, within.least), within.most, value_at(&h, within.most));
}

const struct pov_shape pov_shape_isosurface = {
	.name = "isosurface", .seal = seal_isosurface, .bounds = isosurface_bounds, .field = isosurface_field,
	.slope = INFINITY, .mesh = mesh_isosurface, .cross = cross_isosurface,
};

/* A parametric surface: a grid over u, v. */

struct sheet {
	struct box box;
};

enum { SHEET_SAMPLES = 32 };

static struct vec sheet_point(const struct pov_parametric *q, double i, double j)
{
	double at[2] = { q->low[0] + i * (q->high[0] - q->low[0]), q->low[1] + j * (q->high[1] - q->low[1]) };
	struct vec p;
	for (int a = 0; a < 3; a++)
		p.a[a] = q->function[a].value(q->function[a].context, at);
	return p;
}

static int seal_parametric(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_parametric *q = &s->shape.parametric;
	struct sheet *sheet = NEW(a, struct sheet, 1);
	if (!sheet)
		return err_memory(e, "parametric");
	*why = "parametric of a function that cannot be computed";
	for (int i = 0; i < 3; i++)
		if (!q->function[i].value)
			return 1;
	sheet->box = box_empty();
	for (int i = 0; i <= SHEET_SAMPLES; i++)
		for (int j = 0; j <= SHEET_SAMPLES; j++) {
			struct vec p = sheet_point(q, (double)i / SHEET_SAMPLES, (double)j / SHEET_SAMPLES);
			if (vec_is_finite(p))
				box_extend(&sheet->box, p);
		}
	if (q->contained) {
		struct box around = container(q->spherical, &q->sphere, &q->box);
		sheet->box = box_common(&sheet->box, &around);
	}
	s->sealed = sheet;
	return box_is_empty(&sheet->box) ? 1 : 0;
}

static struct box parametric_bounds(const struct pov_solid *s)
{
	return ((const struct sheet *)s->sealed)->box;
}

static void mesh_parametric(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_parametric *q = &s->shape.parametric;
	int n = 2 * d->n;
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++) {
			double u = (double)i / n, v = (double)j / n, un = (i + 1.0) / n, vn = (j + 1.0) / n;
			struct vec a = sheet_point(q, u, v), b = sheet_point(q, un, v), c = sheet_point(q, un, vn), e = sheet_point(q, u, vn);
			if (vec_is_finite(a) && vec_is_finite(b) && vec_is_finite(c) && vec_is_finite(e))
				pov_draw_quad(d, a, b, c, e);
		}
}

const struct pov_shape pov_shape_parametric = {
	.name = "parametric", .seal = seal_parametric, .bounds = parametric_bounds, .mesh = mesh_parametric,
};
