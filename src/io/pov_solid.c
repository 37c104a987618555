#include "io/pov_solid.h"

#include "io/pov_place.h"
#include "io/pov_shape.h"

static const double bound_huge = 1e10;

struct pov_solid *pov_solid_new(struct arena *a, enum pov_kind kind)
{
	struct pov_solid *s = NEW(a, struct pov_solid, 1);
	if (s) {
		s->kind = kind;
		s->material = NO_MATERIAL;
		s->place = matrix_identity();
	}
	return s;
}

int pov_solid_seal(struct arena *a, struct pov_solid *s, struct err *e)
{
	const struct pov_shape *shape = pov_shape_of(s);
	const char *why = NULL;
	int status = shape->seal ? shape->seal(a, s, &why, e) : 0;
	if (status != 1)
		return status;
	s->kind = POV_UNKNOWN;
	s->shape.unknown = why;
	return 0;
}

void pov_solid_move(struct pov_solid *s, const struct matrix *m)
{
	s->place = matrix_multiply(&s->place, m);
	s->traced = NULL;
	for (struct pov_solid *c = s->clip; c; c = c->next)
		pov_solid_move(c, m);
	for (struct pov_solid *c = s->bound; c; c = c->next)
		pov_solid_move(c, m);
}

/* *to becomes a copy of the row; false when memory is out. */
static bool copy_row(struct arena *a, const struct pov_solid *from, struct pov_solid **to)
{
	for (*to = NULL; from; from = from->next, to = &(*to)->next)
		if (!(*to = pov_solid_copy(a, from)))
			return false;
	return true;
}

struct pov_solid *pov_solid_copy(struct arena *a, const struct pov_solid *s)
{
	struct pov_solid *c = NEW(a, struct pov_solid, 1);
	if (!c)
		return NULL;
	*c = *s;
	c->next = NULL;
	c->traced = NULL;
	return copy_row(a, s->child, &c->child) && copy_row(a, s->clip, &c->clip) && copy_row(a, s->bound, &c->bound) ? c : NULL;
}

bool pov_shape_container(const struct pov_solid *s, struct pov_solid *container)
{
	bool spherical = s->kind == POV_ISOSURFACE ? s->shape.isosurface.spherical : s->shape.parametric.spherical;
	if (s->kind != POV_ISOSURFACE && !(s->kind == POV_PARAMETRIC && s->shape.parametric.contained))
		return false;
	*container = (struct pov_solid){ .kind = spherical ? POV_SPHERE : POV_BOX, .material = NO_MATERIAL, .place = matrix_identity() };
	if (spherical)
		container->shape.sphere = s->kind == POV_ISOSURFACE ? s->shape.isosurface.sphere : s->shape.parametric.sphere;
	else
		container->shape.box = s->kind == POV_ISOSURFACE ? s->shape.isosurface.box : s->shape.parametric.box;
	const char *why;
	struct err e = { 0 };
	return pov_shape_of(container)->seal(NULL, container, &why, &e) == 0;
}

static bool inside_leaf(const struct pov_solid *s, struct vec p)
{
	struct pov_solid container;
	if (!(pov_shape_of(s)->field(s, p) <= 0))
		return false;
	return !pov_shape_container(s, &container) || inside_leaf(&container, p);
}

static bool inside(const struct pov_solid *s, struct vec p, bool turned);

/* Turned inside out, by De Morgan's rules: all of the parts where it was any of them. */
static bool inside_parts(const struct pov_solid *s, struct vec p, bool turned)
{
	bool all = (s->kind == POV_INTERSECTION || s->kind == POV_DIFFERENCE) != turned;
	for (const struct pov_solid *c = s->child; c; c = c->next) {
		bool taken = s->kind == POV_DIFFERENCE && c != s->child;
		if (inside(c, p, taken != turned) != all)
			return !all;
	}
	return all;
}

/* Clips stay as they are where the solid they clip is turned inside out. Nothing is inside a shape that has no inside, turned or not; one
 * that is not known takes nothing away. */
static bool inside(const struct pov_solid *s, struct vec p, bool turned)
{
	struct matrix back;
	for (const struct pov_solid *c = s->clip; c; c = c->next)
		if (!inside(c, p, false))
			return false;
	pov_place_invert(&s->place, &back);
	struct vec local = matrix_point(p, &back);
	turned = turned != s->inverse;
	if (s->kind < POV_UNION && !pov_shape_has_inside(s))
		return s->kind == POV_UNKNOWN && turned;
	return s->kind < POV_UNION ? inside_leaf(s, local) != turned : inside_parts(s, local, turned);
}

bool pov_solid_inside(const struct pov_solid *s, struct vec p)
{
	return inside(s, p, false);
}

struct box pov_shape_placed(const struct pov_solid *s, const struct matrix *place)
{
	struct box b = pov_shape_of(s)->bounds(s);
	if (s->kind != POV_SPHERE)
		return pov_place_box(&b, place);
	struct vec c = matrix_point(s->shape.sphere.center, place);
	for (int j = 0; j < 3; j++) {
		double side = s->shape.sphere.radius * sqrt(place->m[0][j] * place->m[0][j] + place->m[1][j] * place->m[1][j] +
		                                            place->m[2][j] * place->m[2][j]);
		b.lo.a[j] = c.a[j] - side;
		b.hi.a[j] = c.a[j] + side;
	}
	return b;
}

/* Clips and 'inverse' change nothing, as in POV-Ray. */
static struct box extent(const struct pov_solid *s, const struct matrix *parent)
{
	struct matrix place = matrix_multiply(&s->place, parent);
	if (s->kind < POV_UNION)
		return pov_shape_placed(s, &place);
	struct box b = s->kind == POV_INTERSECTION ? box_infinite() : box_empty();
	for (const struct pov_solid *c = s->child; c; c = c->next) {
		struct box part = extent(c, &place);
		if (s->kind == POV_INTERSECTION)
			b = box_common(&b, &part);
		else
			box_join(&b, &part);
		if (s->kind == POV_DIFFERENCE)
			break;
	}
	return b;
}

struct box pov_solid_extent(const struct pov_solid *s)
{
	struct matrix same = matrix_identity();
	struct box b = extent(s, &same);
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = fmax(-bound_huge, fmin(bound_huge, b.lo.a[i]));
		b.hi.a[i] = fmax(-bound_huge, fmin(bound_huge, b.hi.a[i]));
	}
	return b;
}
