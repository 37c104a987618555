/* Parameters of height fields, texts, isosurfaces and parametric surfaces. */
#include "io/pov_image.h"
#include "io/pov_program.h"
#include "io/pov_reader.h"

#include <stdio.h>
#include <string.h>

static bool is_image_type(uint32_t word)
{
	return word >= WORD_pot && word <= WORD_df3;
}

static void read_image(struct pov *p, struct pov_solid *s, uint32_t type)
{
	struct pov_height_field *h = &s->shape.height_field;
	const struct pov_string *name = pov_file_name(p);
	struct text bytes = { 0 };
	const char *why = "cannot be found";
	if (!name)
		return;
	if (pov_load(p, name->bytes, &bytes))
		h->heights = pov_image_heights(&p->mem, bytes.bytes, bytes.size, type ? p->names.text[type] : NULL, &h->width, &h->height, &why);
	text_free(&bytes);
	if (h->heights)
		return;
	if (p->options->strict)
		pov_refuse(p, "'%.200s' %s", name->bytes, why);
	pov_note(p, "'%.100s' %s", name->bytes, why);
	pov_make_unknown(s, "height_field");
}

/* function W, H { ... } */
static void read_sampled(struct pov *p, struct pov_solid *s)
{
	struct pov_height_field *h = &s->shape.height_field;
	bool known;
	h->width = (int)pov_integer(p, "the width of a height field", 2, 16384);
	pov_expect(p, ',');
	h->height = (int)pov_integer(p, "the height of a height field", 2, 16384);
	struct pov_value v = pov_function_read(p);
	if (pov_stopped(p) || v.type != TYPE_FUNCTION)
		return;
	struct pov_function f = pov_function_of(v.program, &known);
	if (!known)
		pov_make_unknown(s, "height_field");
	else if (!(h->heights = pov_heights_sample(&p->mem, f, h->width, h->height)))
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
}

void pov_read_height_field(struct pov *p, struct pov_solid *s)
{
	const struct pov_token *t = pov_peek(p);
	uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
	if (is_image_type(word)) {
		pov_take(p);
		read_image(p, s, word);
	} else if (word == WORD_function) {
		pov_take(p);
		read_sampled(p, s);
	} else {
		read_image(p, s, 0);
	}
	for (;;) {
		pov_skip_separators(p);
		t = pov_peek(p);
		word = t->kind == TOKEN_NAME ? t->name : 0;
		bool level = word == WORD_water_level, smooth = word == WORD_smooth;
		if ((!level && !smooth && word != WORD_hierarchy) || pov_stopped(p))
			return;
		pov_take(p);
		double x = level ? pov_float(p) : pov_flag(p);
		if (s->kind == POV_HEIGHT_FIELD && level)
			s->shape.height_field.level = x;
		else if (s->kind == POV_HEIGHT_FIELD && smooth)
			s->shape.height_field.smooth = x != 0;
	}
}

/* The code points of a text. */
static uint32_t *make_codes(struct pov *p, const struct pov_string *text, size_t *count)
{
	uint32_t *codes = pov_alloc(p, text->size + 1, sizeof *codes);
	size_t n = 0;
	for (size_t i = 0; codes && i < text->size; i++) {
		unsigned char c = (unsigned char)text->bytes[i];
		if ((c & 0xc0) != 0x80)
			codes[n++] = c < 0x80 ? c : c < 0xe0 ? c & 31 : c < 0xf0 ? c & 15 : c & 7;
		else if (n > 0)
			codes[n - 1] = codes[n - 1] << 6 | (c & 63);
	}
	*count = n;
	return codes;
}

static void load_font(struct pov *p, struct pov_solid *s, const char *name)
{
	struct text bytes = { 0 };
	for (const struct pov_font *f = p->fonts; f; f = f->next)
		if (strcmp(f->name, name) == 0) {
			s->shape.text.font = f->bytes;
			s->shape.text.font_size = f->size;
			return;
		}
	char longer[256];
	snprintf(longer, sizeof longer, "%s.ttf", name);
	if (!pov_load(p, name, &bytes) && !pov_load(p, longer, &bytes)) {
		if (p->options->strict)
			pov_refuse(p, "cannot find '%.200s'", name);
		pov_note(p, "cannot find '%.100s'", name);
		return;
	}
	struct pov_font *f = pov_alloc(p, 1, sizeof *f);
	unsigned char *copy = pov_alloc(p, bytes.size, 1);
	if (f && copy) {
		memcpy(copy, bytes.bytes, bytes.size);
		*f = (struct pov_font){ name, copy, bytes.size, p->fonts };
		p->fonts = f;
		s->shape.text.font = copy;
		s->shape.text.font_size = bytes.size;
	}
	text_free(&bytes);
}

void pov_read_text(struct pov *p, struct pov_solid *s)
{
	static const char *const fonts[] = { "timrom.ttf", "cyrvetic.ttf", "crystal.ttf", "povlogo.ttf" };
	struct pov_text *t = &s->shape.text;
	const struct pov_string *font = NULL;
	long inner = 0;
	if (pov_accept_word(p, WORD_internal))
		inner = pov_integer(p, "the number of an internal font", 0, 1e6);
	else if (pov_accept_word(p, WORD_ttf) || pov_peek(p)->kind == TOKEN_STRING)
		font = pov_file_name(p);
	else
		pov_unexpected(p, pov_peek(p), "ttf");
	pov_accept(p, ',');
	const struct pov_string *text = pov_text(p);
	pov_accept(p, ',');
	t->thickness = pov_float(p);
	pov_accept(p, ',');
	t->offset = pov_vector(p);
	if (pov_stopped(p) || !text)
		return;
	if (font)
		load_font(p, s, font->bytes);
	else if (inner >= 1 && inner <= 4)
		load_font(p, s, fonts[inner - 1]);
	t->codes = make_codes(p, text, &t->count);
	if (!t->font)
		pov_make_unknown(s, "text");
}

/* contained_by { sphere { } } or { box { } }; returns whether it is a sphere. */
static bool read_container(struct pov *p, struct pov_sphere *sphere, struct pov_box *box)
{
	bool spherical = false;
	pov_expect(p, '{');
	const struct pov_token *t = pov_take(p);
	pov_expect(p, '{');
	if (is_word(t, WORD_sphere)) {
		spherical = true;
		sphere->center = pov_vector(p);
		pov_accept(p, ',');
		sphere->radius = pov_float(p);
	} else if (is_word(t, WORD_box)) {
		box->corner[0] = pov_vector(p);
		pov_accept(p, ',');
		box->corner[1] = pov_vector(p);
	} else {
		pov_unexpected(p, t, "sphere or box");
	}
	pov_expect(p, '}');
	pov_expect(p, '}');
	return spherical;
}

static bool is_accuracy_word(uint32_t word)
{
	return word == WORD_accuracy || word == WORD_max_gradient || word == WORD_max_trace || word == WORD_all_intersections ||
	       word == WORD_evaluate || word == WORD_precompute;
}

/* Words that say how exactly POV-Ray is to look, by their first number. */
static double read_accuracy(struct pov *p, uint32_t word)
{
	if (word == WORD_all_intersections)
		return 0;
	double x = pov_float(p);
	/* evaluate a, b, c; precompute n, x, y, z */
	while (pov_accept(p, ','))
		pov_float(p);
	return x;
}

/* evaluate: the gradient is found on the way. */
static void read_iso_accuracy(struct pov *p, struct pov_isosurface *f, uint32_t word)
{
	double x = read_accuracy(p, word);
	if (word == WORD_accuracy)
		f->accuracy = x;
	else if (word == WORD_max_gradient)
		f->gradient = x;
	else if (word == WORD_evaluate)
		f->gradient = 0;
}

/* A function in place or by name; false: its values are not known. */
static bool read_function(struct pov *p, struct pov_function *f, bool surface)
{
	bool known = false;
	struct pov_value v = pov_accept_word(p, WORD_function) ? pov_function_read(p) : pov_value_read(p);
	if (v.type != TYPE_FUNCTION) {
		pov_refuse(p, "%s where a function should be", value_type_name(v.type));
		return false;
	}
	if (surface && !pov_stopped(p)) {
		/* Of u and v only. */
		struct pov_program *own = pov_alloc(p, 1, sizeof *own);
		if (!own)
			return false;
		*own = *v.program;
		own->parameters = 2;
		v.program = own;
	}
	*f = pov_function_of(v.program, &known);
	return known;
}

void pov_read_isosurface(struct pov *p, struct pov_solid *s)
{
	struct pov_isosurface *f = &s->shape.isosurface;
	bool known = false;
	f->box = (struct pov_box){ { vec(-1, -1, -1), vec(1, 1, 1) } };
	f->accuracy = 0.001;
	f->gradient = 1.1;
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (pov_stopped(p))
			return;
		if (word == WORD_function) {
			known = read_function(p, &f->function, false);
		} else if (word == WORD_contained_by) {
			pov_take(p);
			f->spherical = read_container(p, &f->sphere, &f->box);
		} else if (word == WORD_threshold) {
			pov_take(p);
			f->threshold = pov_float(p);
		} else if (word == WORD_open) {
			pov_take(p);
			s->open = pov_flag(p);
		} else if (is_accuracy_word(word)) {
			pov_take(p);
			read_iso_accuracy(p, f, word);
		} else {
			break;
		}
	}
	if (!known)
		pov_make_unknown(s, "isosurface");
}

void pov_read_parametric(struct pov *p, struct pov_solid *s)
{
	struct pov_parametric *f = &s->shape.parametric;
	bool known = true;
	for (int i = 0; i < 3; i++) {
		known &= read_function(p, &f->function[i], true);
		pov_accept(p, ',');
	}
	pov_vector2(p, &f->low[0], &f->low[1]);
	pov_accept(p, ',');
	pov_vector2(p, &f->high[0], &f->high[1]);
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (pov_stopped(p) || (word != WORD_contained_by && !is_accuracy_word(word)))
			break;
		pov_take(p);
		if (word == WORD_contained_by) {
			f->contained = true;
			f->spherical = read_container(p, &f->sphere, &f->box);
		} else {
			read_accuracy(p, word);
		}
	}
	if (!known)
		pov_make_unknown(s, "parametric");
}
