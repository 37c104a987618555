/* Parameters of the shapes that are a few numbers. Commas between them are optional. */
#include "io/pov_reader.h"

static struct vec next_vector(struct pov *p)
{
	struct vec v = pov_vector(p);
	pov_accept(p, ',');
	return v;
}

static double next_float(struct pov *p)
{
	double x = pov_float(p);
	pov_accept(p, ',');
	return x;
}

void pov_read_sphere(struct pov *p, struct pov_solid *s)
{
	s->shape.sphere.center = next_vector(p);
	s->shape.sphere.radius = next_float(p);
}

void pov_read_box(struct pov *p, struct pov_solid *s)
{
	for (int i = 0; i < 2; i++)
		s->shape.box.corner[i] = next_vector(p);
}

void pov_read_cylinder(struct pov *p, struct pov_solid *s)
{
	for (int i = 0; i < 2; i++)
		s->shape.cone.end[i] = next_vector(p);
	s->shape.cone.radius[0] = s->shape.cone.radius[1] = next_float(p);
}

void pov_read_cone(struct pov *p, struct pov_solid *s)
{
	for (int i = 0; i < 2; i++) {
		s->shape.cone.end[i] = next_vector(p);
		s->shape.cone.radius[i] = next_float(p);
	}
}

void pov_read_torus(struct pov *p, struct pov_solid *s)
{
	s->shape.torus.major = next_float(p);
	s->shape.torus.minor = next_float(p);
}

void pov_read_plane(struct pov *p, struct pov_solid *s)
{
	s->shape.plane.normal = next_vector(p);
	s->shape.plane.distance = next_float(p);
}

/* Whether a number goes on the list, with or without a comma. */
static bool another_number(struct pov *p)
{
	return pov_accept(p, ',') || pov_peek_operator(p)->kind == TOKEN_NUMBER;
}

void pov_read_disc(struct pov *p, struct pov_solid *s)
{
	s->shape.disc.center = next_vector(p);
	s->shape.disc.normal = next_vector(p);
	s->shape.disc.radius = pov_float(p);
	if (another_number(p))
		s->shape.disc.hole = pov_float(p);
}

void pov_read_superellipsoid(struct pov *p, struct pov_solid *s)
{
	pov_vector2(p, &s->shape.superellipsoid.east, &s->shape.superellipsoid.north);
}

void pov_read_quadric(struct pov *p, struct pov_solid *s)
{
	double *c = s->shape.quadric.coefficient;
	for (int i = 0; i < 3; i++) {
		struct vec v = next_vector(p);
		for (int k = 0; k < 3; k++)
			c[3 * i + k] = v.a[k];
	}
	c[9] = next_float(p);
}

static void read_coefficients(struct pov *p, struct pov_solid *s, int order)
{
	size_t count = (size_t)(order + 1) * (size_t)(order + 2) * (size_t)(order + 3) / 6;
	double *c = pov_alloc(p, count, sizeof *c);
	if (!c)
		return;
	pov_expect(p, '<');
	for (size_t i = 0; i < count && !pov_stopped(p); i++)
		c[i] = next_float(p);
	pov_expect(p, '>');
	s->shape.poly.order = order;
	s->shape.poly.coefficients = c;
}

void pov_read_poly(struct pov *p, struct pov_solid *s)
{
	int order = (int)pov_integer(p, "the order of a poly", 2, 35);
	pov_accept(p, ',');
	read_coefficients(p, s, order);
}

void pov_read_cubic(struct pov *p, struct pov_solid *s)
{
	read_coefficients(p, s, 3);
}

void pov_read_quartic(struct pov *p, struct pov_solid *s)
{
	read_coefficients(p, s, 4);
}

void pov_read_bicubic(struct pov *p, struct pov_solid *s)
{
	struct pov_bicubic *b = &s->shape.bicubic;
	b->u_steps = b->v_steps = 3;
	if (pov_peek(p)->kind == TOKEN_NUMBER) {
		/* POV-Ray 1: type, flatness, steps without words. */
		next_float(p);
		next_float(p);
		b->u_steps = (int)pov_integer(p, "u_steps", 0, 1e6);
		pov_accept(p, ',');
		b->v_steps = (int)pov_integer(p, "v_steps", 0, 1e6);
	}
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (word != WORD_type && word != WORD_flatness && word != WORD_u_steps && word != WORD_v_steps && word != WORD_uv_vectors)
			break;
		pov_take(p);
		if (word == WORD_u_steps)
			b->u_steps = (int)pov_integer(p, "u_steps", 0, 1e6);
		else if (word == WORD_v_steps)
			b->v_steps = (int)pov_integer(p, "v_steps", 0, 1e6);
		else if (word == WORD_uv_vectors)
			for (int i = 0; i < 4; i++)
				next_vector(p);
		else
			pov_float(p);
	}
	for (int i = 0; i < 16; i++)
		b->points[i] = next_vector(p);
}

/* Numbers and words before the first modifier, whatever they mean. */
static void skip_parameters(struct pov *p)
{
	for (;;) {
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (t->kind == '}' || t->kind == TOKEN_END || pov_is_transform(p, t) || pov_is_look(word) ||
		    (word >= WORD_no_shadow && word <= WORD_uv_mapping) || word == WORD_inverse)
			return;
		pov_take(p);
	}
}

void pov_read_julia(struct pov *p, struct pov_solid *s)
{
	skip_parameters(p);
	pov_make_unknown(s, "julia_fractal");
}

void pov_read_ovus(struct pov *p, struct pov_solid *s)
{
	skip_parameters(p);
	pov_make_unknown(s, "ovus");
}
