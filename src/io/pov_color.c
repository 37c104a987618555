/* Colours and the short ways to read numbers, vectors and strings. */
#include "io/pov_reader.h"

#include <string.h>

bool pov_is_color_word(uint32_t word)
{
	return word >= WORD_color && word <= WORD_alpha;
}

static bool is_component_word(uint32_t word)
{
	return word >= WORD_red && word <= WORD_alpha;
}

/* The sRGB curve. */
static double linear_of_srgb(double c)
{
	return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

/* rgb, rgbf, ... and what follows: a float fills the components the word has. */
static struct pov_value read_model(struct pov *p, uint32_t word)
{
	struct pov_value v = pov_operand(p), c = { .type = TYPE_NUMBER, .count = 5, .color = true };
	bool filter = word == WORD_rgbf || word == WORD_srgbf, transmit = word == WORD_rgbt || word == WORD_srgbt;
	bool both = word == WORD_rgbft || word == WORD_srgbft;
	if (v.type != TYPE_NUMBER)
		pov_refuse(p, "%s as a colour", value_type_name(v.type));
	for (int i = 0; i < 3; i++)
		c.a[i] = value_component(&v, i);
	if (word >= WORD_srgb && word <= WORD_srgbft)
		for (int i = 0; i < 3; i++)
			c.a[i] = linear_of_srgb(c.a[i]);
	if (filter || both)
		c.a[3] = value_component(&v, 3);
	if (transmit)
		c.a[4] = value_component(&v, 3);
	if (both)
		c.a[4] = value_component(&v, 4);
	if (v.color)
		memcpy(&c.a[3], &v.a[3], 2 * sizeof *v.a);
	return c;
}

static void read_component(struct pov *p, uint32_t word, struct pov_value *c)
{
	struct pov_value v = pov_operand(p);
	int i = word == WORD_alpha ? 3 : (int)(word - WORD_red);
	c->a[i] = v.type == TYPE_NUMBER ? v.a[0] : 0;
}

struct pov_value pov_color(struct pov *p)
{
	struct pov_value c = { .type = TYPE_NUMBER, .count = 5, .color = true };
	const struct pov_token *t = pov_peek(p);
	if (is_word(t, WORD_color) || is_word(t, WORD_colour)) {
		pov_take(p);
		t = pov_peek(p);
	}
	if (t->kind == TOKEN_NAME && t->name >= WORD_rgb && t->name <= WORD_srgbft) {
		pov_take(p);
		c = read_model(p, t->name);
	} else if (t->kind != TOKEN_NAME || !is_component_word(t->name)) {
		struct pov_value v = pov_operand(p);
		if (v.type != TYPE_NUMBER)
			pov_refuse(p, "%s as a colour", value_type_name(v.type));
		for (int i = 0; i < 5; i++)
			c.a[i] = v.count == 1 && i > 2 ? 0 : value_component(&v, i);
	}
	while (!pov_stopped(p) && (t = pov_peek_operator(p))->kind == TOKEN_NAME && is_component_word(t->name)) {
		pov_take(p);
		read_component(p, t->name, &c);
	}
	return c;
}

double pov_float(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	if (v.type != TYPE_NUMBER) {
		pov_refuse(p, "%s where a number should be", value_type_name(v.type));
		return 0;
	}
	if (v.count != 1 && p->options->strict)
		pov_refuse(p, "a vector where a number should be");
	return v.a[0];
}

/* The usual way vectors of three are written, straight from the tokens: <a, b, c> of plain numbers and nothing but a separator or
 * the next operand behind it. */
static bool read_plain_vector(struct pov *p, struct vec *v)
{
	struct pov_source *s = p->source;
	const struct pov_token *t = s->at;
	if (p->pending.type != TYPE_NONE || s->end - t < 12 || t->kind != '<')
		return false;
	t++;
	for (int i = 0; i < 3; i++) {
		bool minus = t->kind == '-';
		t += minus;
		if (t->kind != TOKEN_NUMBER)
			return false;
		v->a[i] = minus ? -t->number : t->number;
		if ((++t)->kind != (i < 2 ? ',' : '>'))
			return false;
		t++;
	}
	if (t->kind != ',' && t->kind != '<' && t->kind != '}' && t->kind != TOKEN_NUMBER)
		return false;
	p->tokens_taken += (size_t)(t - s->at);
	s->at = t;
	return true;
}

struct vec pov_vector(struct pov *p)
{
	struct vec plain;
	if (read_plain_vector(p, &plain))
		return plain;
	struct pov_value v = pov_expression(p);
	if (v.type != TYPE_NUMBER) {
		pov_refuse(p, "%s where a vector should be", value_type_name(v.type));
		return vec(0, 0, 0);
	}
	return value_vec(&v);
}

void pov_vector2(struct pov *p, double *u, double *v)
{
	struct pov_value w = pov_expression(p);
	if (w.type != TYPE_NUMBER)
		pov_refuse(p, "%s where a vector should be", value_type_name(w.type));
	*u = value_component(&w, 0);
	*v = value_component(&w, 1);
}

long pov_integer(struct pov *p, const char *what, double low, double high)
{
	double x = pov_float(p);
	if (pov_stopped(p))
		return (long)low;
	if (!(x >= low && x <= high)) {
		pov_refuse(p, "%s of %g, not from %.0f to %.0f", what, x, low, high);
		return (long)low;
	}
	return (long)x;
}

size_t pov_count(struct pov *p, const char *what)
{
	return (size_t)pov_integer(p, what, 0, 1e9);
}

const struct pov_string *pov_text(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	if (v.type == TYPE_STRING)
		return v.string;
	pov_refuse(p, "%s where a string should be", value_type_name(v.type));
	return NULL;
}

const struct pov_string *pov_file_name(struct pov *p)
{
	const struct pov_token *t = pov_peek(p);
	const struct pov_string *s;
	if (t->kind == TOKEN_STRING) {
		s = t->string;
		pov_take(p);
	} else {
		s = pov_text(p);
	}
	if (!s || !memchr(s->bytes, '\\', s->size))
		return s;
	char *path = pov_alloc(p, s->size + 1, 1);
	for (size_t i = 0; path && i < s->size; i++)
		path[i] = s->bytes[i] == '\\' ? '/' : s->bytes[i];
	return path ? pov_string_new(&p->mem, path, s->size) : NULL;
}

double pov_condition(struct pov *p)
{
	bool relations = p->relations;
	p->relations = true;
	bool parenthesis = pov_peek(p)->kind == '(';
	if (parenthesis)
		pov_take(p);
	double x = pov_float(p);
	if (parenthesis)
		pov_expect(p, ')');
	p->relations = relations;
	return x;
}

bool pov_flag(struct pov *p)
{
	const struct pov_token *t = pov_peek_operator(p);
	bool follows = t->kind == TOKEN_NUMBER || t->kind == '(' ||
	               (t->kind == TOKEN_NAME && t->name >= WORD_true && t->name <= WORD_clock_on);
	return !follows || value_true(pov_float(p));
}
