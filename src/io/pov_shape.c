#include "io/pov_shape.h"

enum { ROWS_MOST = 32 };

static int seal_unknown(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	(void)a;
	(void)e;
	*why = s->shape.unknown ? s->shape.unknown : "unknown shape";
	return 1;
}

static struct box no_bounds(const struct pov_solid *s)
{
	(void)s;
	return box_empty();
}

static const struct pov_shape unknown = { .name = "unknown", .seal = seal_unknown, .bounds = no_bounds };
static const struct pov_shape in_union = { .name = "union" }, in_merge = { .name = "merge" },
                              in_intersection = { .name = "intersection" }, in_difference = { .name = "difference" };

static const struct pov_shape *const shapes[POV_KINDS] = {
	[POV_SPHERE] = &pov_shape_sphere,
	[POV_BOX] = &pov_shape_box,
	[POV_CYLINDER] = &pov_shape_cylinder,
	[POV_CONE] = &pov_shape_cone,
	[POV_TORUS] = &pov_shape_torus,
	[POV_PLANE] = &pov_shape_plane,
	[POV_DISC] = &pov_shape_disc,
	[POV_POLYGON] = &pov_shape_polygon,
	[POV_MESH] = &pov_shape_mesh,
	[POV_PRISM] = &pov_shape_prism,
	[POV_LATHE] = &pov_shape_lathe,
	[POV_SOR] = &pov_shape_sor,
	[POV_SPHERE_SWEEP] = &pov_shape_sphere_sweep,
	[POV_SUPERELLIPSOID] = &pov_shape_superellipsoid,
	[POV_BLOB] = &pov_shape_blob,
	[POV_QUADRIC] = &pov_shape_quadric,
	[POV_POLY] = &pov_shape_poly,
	[POV_HEIGHT_FIELD] = &pov_shape_height_field,
	[POV_BICUBIC_PATCH] = &pov_shape_bicubic,
	[POV_TEXT] = &pov_shape_text,
	[POV_ISOSURFACE] = &pov_shape_isosurface,
	[POV_PARAMETRIC] = &pov_shape_parametric,
	[POV_UNKNOWN] = &unknown,
	[POV_UNION] = &in_union,
	[POV_MERGE] = &in_merge,
	[POV_INTERSECTION] = &in_intersection,
	[POV_DIFFERENCE] = &in_difference,
};

const struct pov_shape *pov_shape_of(const struct pov_solid *s)
{
	return shapes[s->kind];
}

const char *pov_kind_name(enum pov_kind kind)
{
	return shapes[kind]->name;
}

bool pov_shape_has_inside(const struct pov_solid *s)
{
	return pov_shape_of(s)->field && (s->kind != POV_MESH || vec_length(s->shape.mesh.inside) > 0);
}

double pov_shape_reach(const struct pov_solid *s, struct vec p, double r)
{
	const struct pov_shape *shape = pov_shape_of(s);
	return shape->reach ? shape->reach(s, p, r) : shape->slope * r;
}

void pov_draw(const struct pov_drawing *d, struct vec a, struct vec b, struct vec c)
{
	struct vec v[3] = { matrix_point(a, d->place), matrix_point(d->turn ? c : b, d->place), matrix_point(d->turn ? b : c, d->place) };
	pov_facets_add(d->out, v, d->material);
}

int pov_draw_rows(const struct pov_drawing *d, double length, double width)
{
	return d->even ? (int)fmax(1, fmin(ROWS_MOST, ceil(length / (2 * width) - 1e-9))) : 1;
}

void pov_draw_quad(const struct pov_drawing *d, struct vec a, struct vec b, struct vec c, struct vec e)
{
	pov_draw(d, a, b, c);
	pov_draw(d, a, c, e);
}

struct vec pov_line_point(const struct pov_line *line, double t)
{
	return vec_add(line->from, vec_scale(line->toward, t));
}

bool pov_line_clip_sphere(struct pov_line *line, const struct pov_sphere *s)
{
	double square = vec_dot(line->toward, line->toward), middle = vec_dot(vec_sub(s->center, line->from), line->toward) / square;
	struct vec off = vec_sub(pov_line_point(line, middle), s->center);
	double half = (s->radius * s->radius - vec_dot(off, off)) / square;
	if (!(half > 0))
		return false;
	line->least = fmax(line->least, middle - sqrt(half));
	line->most = fmin(line->most, middle + sqrt(half));
	return line->least < line->most;
}

bool pov_line_clip_box(struct pov_line *line, const struct box *b)
{
	for (int i = 0; i < 3; i++) {
		double from = line->from.a[i], way = line->toward.a[i];
		if (way == 0 && (from < b->lo.a[i] || from > b->hi.a[i]))
			return false;
		if (way == 0)
			continue;
		double s = (b->lo.a[i] - from) / way, t = (b->hi.a[i] - from) / way;
		line->least = fmax(line->least, fmin(s, t));
		line->most = fmin(line->most, fmax(s, t));
	}
	return line->least < line->most;
}
