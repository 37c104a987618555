/* Values that are not expressions: blocks, and names of what has no operators. */
#include "io/pov_reader.h"

static struct pov_value make_object(struct pov_object *o)
{
	return o ? (struct pov_value){ .type = TYPE_OBJECT, .object = o } : value_number(0);
}

/* A texture may have several layers, one block after the other. */
static struct pov_value read_look(struct pov *p)
{
	struct pov_look *look = pov_alloc(p, 1, sizeof *look);
	const struct pov_token *t = pov_peek(p);
	if (!look)
		return value_number(0);
	look->material = NO_MATERIAL;
	do {
		uint32_t word = t->name;
		pov_take(p);
		pov_look_read(p, word, look);
		t = pov_peek_operator(p);
	} while (!p->failed && (is_word(t, WORD_texture) || is_word(t, WORD_interior_texture)));
	return (struct pov_value){ .type = TYPE_LOOK, .look = look };
}

static struct pov_value read_transform(struct pov *p)
{
	struct matrix *m = pov_alloc(p, 1, sizeof *m);
	const struct pov_token *t = pov_peek(p);
	if (!m)
		return value_number(0);
	if (t->name == WORD_transform) {
		pov_take(p);
		*m = pov_transform_block(p);
	} else {
		*m = pov_transform(p);
	}
	return (struct pov_value){ .type = TYPE_TRANSFORM, .matrix = m };
}

static struct pov_value read_camera(struct pov *p)
{
	struct pov_view *v = pov_alloc(p, 1, sizeof *v);
	pov_take(p);
	if (!v)
		return value_number(0);
	*v = pov_camera_read(p);
	return (struct pov_value){ .type = TYPE_CAMERA, .view = v };
}

static bool is_skipped(uint32_t word)
{
	return word == WORD_global_settings || word == WORD_background || word == WORD_atmosphere || word == WORD_photons ||
	       word == WORD_radiosity;
}

struct pov_value pov_value_read(struct pov *p)
{
	const struct pov_token *t = pov_peek(p);
	uint32_t word = t->kind == TOKEN_NAME && t->name < WORD_COUNT ? t->name : WORD_NONE;
	struct pov_value v;
	if (word == WORD_NONE)
		return pov_expression(p);
	if (!pov_enter(p))
		return value_number(0);
	if (word == WORD_array || word == WORD_spline || word == WORD_function) {
		pov_take(p);
		v = word == WORD_array ? pov_array_read(p) : word == WORD_spline ? pov_spline_read(p) : pov_function_read(p);
	} else if (word == WORD_camera) {
		v = read_camera(p);
	} else if (pov_is_object(p, t)) {
		v = make_object(pov_object(p));
	} else if (pov_is_look(word) || is_skipped(word)) {
		v = read_look(p);
	} else if (pov_is_transform(p, t)) {
		v = read_transform(p);
	} else {
		v = pov_expression(p);
	}
	p->nested--;
	return v;
}
