/* Parameters of the shapes made of curves, and of blobs. */
#include "io/pov_reader.h"

#include <string.h>

static bool read_spline_word(uint32_t word, enum pov_spline *spline)
{
	switch (word) {
	case WORD_linear_spline: *spline = POV_LINEAR; return true;
	case WORD_quadratic_spline: *spline = POV_QUADRATIC; return true;
	case WORD_cubic_spline: *spline = POV_CUBIC; return true;
	case WORD_bezier_spline: *spline = POV_BEZIER; return true;
	case WORD_b_spline: *spline = POV_B_SPLINE; return true;
	default: return false;
	}
}

/* Words before the numbers: kinds of spline and of sweep, switches. */
static void read_words(struct pov *p, enum pov_spline *spline, bool *conic)
{
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		bool sweep = conic && (word == WORD_linear_sweep || word == WORD_conic_sweep);
		if (sweep)
			*conic = word == WORD_conic_sweep;
		else if (!read_spline_word(word, spline) && word != WORD_sturm)
			return;
		pov_take(p);
	}
}

static void read_points(struct pov *p, struct pov_profile *f)
{
	f->count = pov_count(p, "the points of a curve");
	pov_accept(p, ',');
	f->points = pov_points(p, f->count, 2);
}

void pov_read_prism(struct pov *p, struct pov_solid *s)
{
	struct pov_profile *f = &s->shape.profile;
	read_words(p, &f->spline, &f->conic);
	f->low = pov_float(p);
	pov_accept(p, ',');
	f->high = pov_float(p);
	pov_accept(p, ',');
	read_points(p, f);
}

void pov_read_lathe(struct pov *p, struct pov_solid *s)
{
	read_words(p, &s->shape.profile.spline, NULL);
	read_points(p, &s->shape.profile);
}

void pov_read_sor(struct pov *p, struct pov_solid *s)
{
	read_points(p, &s->shape.profile);
}

void pov_read_sphere_sweep(struct pov *p, struct pov_solid *s)
{
	struct pov_sphere *all = NULL;
	size_t room = 0;
	read_words(p, &s->shape.sweep.spline, NULL);
	size_t count = pov_count(p, "the spheres of a sweep");
	pov_accept(p, ',');
	for (size_t i = 0; i < count && !pov_stopped(p); i++) {
		if ((all = pov_grow(p, all, i, &room, sizeof *all)) == NULL)
			return;
		all[i].center = pov_vector(p);
		pov_accept(p, ',');
		all[i].radius = pov_float(p);
		pov_accept(p, ',');
		if (i + 1 < count)
			pov_skip_separators(p);
	}
	s->shape.sweep.spheres = all;
	s->shape.sweep.count = count;
	if (pov_accept_word(p, WORD_tolerance))
		pov_float(p);
}

/* Modifiers of a component of a blob, to its closing brace. */
static void read_component_body(struct pov *p, struct pov_component *c)
{
	struct pov_look ignored = { .material = NO_MATERIAL };
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (t->kind == '}' || pov_stopped(p))
			break;
		if (pov_is_transform(p, t)) {
			struct matrix m = pov_transform(p);
			c->place = matrix_multiply(&c->place, &m);
		} else if (word) {
			pov_take(p);
			if (pov_is_look(word))
				pov_look_read(p, word, &ignored);
		} else {
			pov_unexpected(p, t, "a modifier");
		}
	}
	pov_expect(p, '}');
}

static void read_component(struct pov *p, struct pov_component *c, uint32_t word)
{
	*c = (struct pov_component){ .place = matrix_identity() };
	if (word == WORD_component) {
		c->strength = pov_float(p);
		pov_accept(p, ',');
		c->radius = pov_float(p);
		pov_accept(p, ',');
		c->end[0] = c->end[1] = pov_vector(p);
		return;
	}
	pov_expect(p, '{');
	c->end[0] = c->end[1] = pov_vector(p);
	pov_accept(p, ',');
	if (word == WORD_cylinder) {
		c->end[1] = pov_vector(p);
		pov_accept(p, ',');
	}
	c->radius = pov_float(p);
	pov_accept(p, ',');
	pov_accept_word(p, WORD_strength);
	c->strength = pov_float(p);
	read_component_body(p, c);
}

void pov_read_blob(struct pov *p, struct pov_solid *s)
{
	struct pov_component *all = NULL;
	size_t n = 0, room = 0;
	s->shape.blob.threshold = 1;
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (pov_stopped(p) || (word != WORD_threshold && word != WORD_sphere && word != WORD_cylinder && word != WORD_component &&
		                       word != WORD_sturm && word != WORD_hierarchy))
			break;
		pov_take(p);
		if (word == WORD_threshold) {
			s->shape.blob.threshold = pov_float(p);
		} else if (word == WORD_sturm || word == WORD_hierarchy) {
			pov_flag(p);
		} else {
			if ((all = pov_grow(p, all, n, &room, sizeof *all)) == NULL)
				return;
			read_component(p, &all[n++], word);
		}
	}
	s->shape.blob.components = all;
	s->shape.blob.count = n;
}
