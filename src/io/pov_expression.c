/* Expressions. From the loosest to the tightest: ?:, & and | (of equal rank), relations, + and -, * and /, signs, subscripts and
 * components. Where relations are not allowed '<' starts a vector and '>' ends one. */
#include "io/pov_reader.h"

#include <string.h>

static struct pov_value read_sum(struct pov *p);

/* Whether a vector ends without a comma: its components are parted by blanks, as in POV-Ray 1. '<' was taken. */
static bool is_blank_separated(const struct pov *p)
{
	int depth = 0;
	for (const struct pov_token *t = p->source->at; t < p->source->end && t - p->source->at < 200; t++) {
		if (t->kind == '>' && depth-- == 0)
			return true;
		if (t->kind == ',' && depth == 0)
			return false;
		depth += t->kind == '<' || t->kind == '(' || t->kind == '[';
		depth -= t->kind == ')' || t->kind == ']';
	}
	return false;
}

static struct pov_value read_vector(struct pov *p)
{
	struct pov_value v = { .type = TYPE_NUMBER };
	bool relations = p->relations, blanks = p->blanks;
	bool separated = is_blank_separated(p);
	p->relations = false;
	p->blanks = separated;
	do {
		struct pov_value c = pov_expression(p);
		if (c.type != TYPE_NUMBER)
			pov_refuse(p, "%s as a component of a vector", value_type_name(c.type));
		if (c.count != 1 && p->options->strict)
			pov_refuse(p, "a vector as a component of a vector");
		if (v.count == 5) {
			pov_refuse(p, "a vector of more than five components");
			break;
		}
		v.a[v.count++] = c.a[0];
		pov_accept(p, ',');
	} while (!pov_stopped(p) && pov_peek(p)->kind != '>');
	pov_expect(p, '>');
	p->relations = relations;
	p->blanks = blanks;
	p->blank_vector = separated && v.count > 1;
	return v;
}

/* Escapes of a string as written. */
static const struct pov_string *decode(struct pov *p, const struct pov_string *s)
{
	if (!memchr(s->bytes, '\\', s->size))
		return s;
	char *out = pov_alloc(p, s->size + 1, 1);
	size_t n = 0;
	for (size_t i = 0; out && i < s->size; i++) {
		char c = s->bytes[i];
		if (c == '\\' && i + 1 < s->size) {
			c = s->bytes[++i];
			unsigned code = 0;
			size_t digits = 0;
			for (; c == 'u' && digits < 4 && i + 1 + digits < s->size; digits++) {
				const char *hex = "0123456789abcdef", d = s->bytes[i + 1 + digits], *at;
				if (!d || (at = strchr(hex, d >= 'A' && d <= 'F' ? d + 32 : d)) == NULL)
					break;
				code = code * 16 + (unsigned)(at - hex);
			}
			if (digits == 4) {
				i += 4;
				if (code >= 0x800)
					out[n++] = (char)(0xe0 | code >> 12);
				if (code >= 0x80)
					out[n++] = (char)(code >= 0x800 ? 0x80 | (code >> 6 & 0x3f) : 0xc0 | code >> 6);
				c = (char)(code >= 0x80 ? 0x80 | (code & 0x3f) : code);
			} else {
				c = (char)(c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c == 'a' ? '\a' : c == 'b' ? '\b' : c);
			}
		}
		out[n++] = c;
	}
	return out ? pov_string_new(&p->mem, out, n) : s;
}

static bool read_constant(const struct pov *p, uint32_t word, struct pov_value *v)
{
	const struct pov_options *o = p->options;
	double x;
	switch (word) {
	case WORD_x: *v = value_vector(vec(1, 0, 0)); return true;
	case WORD_y: *v = value_vector(vec(0, 1, 0)); return true;
	case WORD_z: *v = value_vector(vec(0, 0, 1)); return true;
	case WORD_u: *v = (struct pov_value){ .type = TYPE_NUMBER, .count = 2, .a = { 1, 0 } }; return true;
	case WORD_v: *v = (struct pov_value){ .type = TYPE_NUMBER, .count = 2, .a = { 0, 1 } }; return true;
	case WORD_t: *v = (struct pov_value){ .type = TYPE_NUMBER, .count = 4, .a = { 0, 0, 0, 1 } }; return true;
	case WORD_pi: x = 3.14159265358979323846; break;
	case WORD_true: case WORD_on: case WORD_yes: x = 1; break;
	case WORD_false: case WORD_off: case WORD_no: case WORD_now: x = 0; break;
	/* One picture, not one of an animation. */
	case WORD_clock_delta: case WORD_frame_number: case WORD_initial_frame: case WORD_final_frame: case WORD_initial_clock:
	case WORD_final_clock: case WORD_clock_on: x = 0; break;
	case WORD_clock: x = o->clock; break;
	case WORD_image_width: x = o->width; break;
	case WORD_image_height: x = o->height; break;
	case WORD_version: x = p->version; break;
	default: return false;
	}
	*v = value_number(x);
	return true;
}

static struct pov_value call_spline(struct pov *p, const struct pov_spline_curve *s)
{
	bool relations = p->relations;
	uint32_t kind = 0;
	pov_expect(p, '(');
	p->relations = true;
	double t = pov_float(p);
	if (pov_accept(p, ',')) {
		const struct pov_token *word = pov_take(p);
		if (word->kind == TOKEN_NAME && pov_is_spline_kind(word->name))
			kind = word->name;
		else
			pov_unexpected(p, word, "a kind of spline");
	}
	p->relations = relations;
	pov_expect(p, ')');
	return pov_spline_value(s, t, kind);
}

/* The value of a name with its subscripts and calls. The token was taken. */
static struct pov_value read_identifier(struct pov *p, uint32_t name)
{
	const struct pov_binding *b = scope_find(&p->scope, name);
	struct pov_value nothing = value_number(0);
	if (!b && !p->options->strict && strcmp(p->names.text[name], "nan") == 0) {
		/* Printed by programs for the angle of what has none. */
		pov_note(p, "'nan' is taken as 0");
		p->summary->ignored++;
		return nothing;
	}
	if (!b) {
		pov_refuse(p, "'%.60s' is not declared", p->names.text[name]);
		return nothing;
	}
	const struct pov_value *v = b->refers;
	while (v->type == TYPE_ARRAY && pov_peek_operator(p)->kind == '[')
		if ((v = pov_element(p, v->array)) == NULL)
			return nothing;
	struct pov_value copy = *v;
	if (v->type == TYPE_FUNCTION && pov_peek_operator(p)->kind == '(')
		return pov_function_call(p, v->program);
	if (v->type == TYPE_SPLINE && pov_peek_operator(p)->kind == '(')
		return call_spline(p, v->spline);
	if (v->type == TYPE_NONE)
		pov_refuse(p, "'%.60s' has no value yet", p->names.text[name]);
	if (v->type == TYPE_ARRAY && !value_copy(&p->mem, v, &copy))
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	return copy;
}

static struct pov_value read_parenthesis(struct pov *p)
{
	bool relations = p->relations, blanks = p->blanks;
	p->relations = true;
	p->blanks = false;
	struct pov_value v = pov_expression(p);
	pov_expect(p, ')');
	p->relations = relations;
	p->blanks = blanks;
	return v;
}

static struct pov_value read_primary(struct pov *p)
{
	struct pov_value v = value_number(0);
	p->blank_vector = false;
	if (p->pending.type != TYPE_NONE) {
		v = p->pending;
		p->pending = (struct pov_value){ 0 };
		return v;
	}
	const struct pov_token *t = pov_peek(p);
	if (t->kind == TOKEN_NUMBER) {
		v.a[0] = t->number;
		pov_take(p);
	} else if (t->kind == TOKEN_STRING) {
		pov_take(p);
		v = (struct pov_value){ .type = TYPE_STRING, .string = decode(p, t->string) };
	} else if (t->kind == '(') {
		pov_take(p);
		v = read_parenthesis(p);
		p->blank_vector = false;
	} else if (t->kind == '<') {
		pov_take(p);
		v = read_vector(p);
	} else if (t->kind == TOKEN_NAME && t->name >= WORD_COUNT) {
		pov_take(p);
		v = read_identifier(p, t->name);
	} else if (t->kind == TOKEN_NAME && pov_is_color_word(t->name)) {
		v = pov_color(p);
	} else if (t->kind == TOKEN_NAME && pov_is_call(t->name)) {
		pov_take(p);
		v = pov_call(p, t->name);
	} else if (t->kind == TOKEN_NAME && read_constant(p, t->name, &v)) {
		pov_take(p);
	} else {
		pov_unexpected(p, t, "a value");
	}
	return v;
}

/* Which component a word behind '.' means, -1: none; -2: grey. */
static int component_of(const struct pov_token *t)
{
	if (t->kind != TOKEN_NAME)
		return -1;
	switch (t->name) {
	case WORD_x: case WORD_u: case WORD_red: return 0;
	case WORD_y: case WORD_v: case WORD_green: return 1;
	case WORD_z: case WORD_blue: return 2;
	case WORD_t: case WORD_filter: case WORD_alpha: return 3;
	case WORD_transmit: return 4;
	case WORD_gray: case WORD_grey: return -2;
	default: return -1;
	}
}

static void read_component(struct pov *p, struct pov_value *v)
{
	const struct pov_token *t = pov_take(p);
	int i = component_of(t);
	if (i == -1 || v->type != TYPE_NUMBER) {
		pov_unexpected(p, t, "a component of a vector");
		return;
	}
	*v = value_number(i == -2 ? 0.297 * value_component(v, 0) + 0.589 * value_component(v, 1) + 0.114 * value_component(v, 2)
	                          : value_component(v, i));
}

struct pov_value pov_operand(struct pov *p)
{
	struct pov_value v, minus = value_number(-1);
	int kind = p->pending.type != TYPE_NONE ? 0 : pov_peek(p)->kind;
	if (kind == '-' || kind == '+' || kind == '!') {
		pov_take(p);
		if (!pov_enter(p))
			return minus;
		v = pov_operand(p);
		p->nested--;
		struct pov_value zero = value_number(0);
		if (kind != '+' && !value_operate(kind == '-' ? '*' : '=', &v, kind == '-' ? &minus : &zero, &v))
			pov_refuse(p, "a sign before %s", value_type_name(v.type));
		return v;
	}
	v = read_primary(p);
	while (pov_peek_operator(p)->kind == '.') {
		pov_take(p);
		read_component(p, &v);
		if (pov_stopped(p))
			break;
	}
	return v;
}

static void apply(struct pov *p, int op, struct pov_value *a, const struct pov_value *b)
{
	if (a->type == TYPE_NUMBER && b->type == TYPE_NUMBER && a->count == 1 && b->count == 1) {
		switch (op) {
		case '+': a->a[0] += b->a[0]; return;
		case '-': a->a[0] -= b->a[0]; return;
		case '*': a->a[0] *= b->a[0]; return;
		default: break;
		}
	}
	if (op == '/' && b->type == TYPE_NUMBER && b->count == 1 && b->a[0] == 0) {
		if (p->options->strict)
			pov_refuse(p, "division by zero");
		struct pov_value huge = value_number(1e-300);
		b = &huge;
		if (!value_operate('/', a, b, a))
			pov_refuse(p, "an operator on %s", value_type_name(a->type));
		return;
	}
	if (!value_operate(op, a, b, a))
		pov_refuse(p, "an operator between %s and %s", value_type_name(a->type), value_type_name(b->type));
}

static struct pov_value read_product(struct pov *p)
{
	struct pov_value v = pov_operand(p);
	for (int op; !pov_stopped(p) && ((op = pov_peek_operator(p)->kind) == '*' || op == '/');) {
		pov_take(p);
		struct pov_value w = pov_operand(p);
		apply(p, op, &v, &w);
	}
	return v;
}

/* Where blanks part components a sign with a blank before and none behind belongs to the next one. */
static bool starts_component(const struct pov *p, const struct pov_token *sign)
{
	return (p->blanks || p->blank_vector) && sign->spaced && !sign[1].spaced;
}

static struct pov_value read_sum(struct pov *p)
{
	struct pov_value v = read_product(p);
	for (;;) {
		if (pov_stopped(p))
			return v;
		const struct pov_token *t = pov_peek_operator(p);
		int op = t->kind;
		if ((op != '+' && op != '-') || starts_component(p, t))
			return v;
		pov_take(p);
		struct pov_value w = read_product(p);
		apply(p, op, &v, &w);
	}
}

static bool is_relation(int kind)
{
	return kind == '<' || kind == '>' || kind == '=' || kind == TOKEN_LE || kind == TOKEN_GE || kind == TOKEN_NE;
}

static struct pov_value read_relation(struct pov *p)
{
	struct pov_value v = read_sum(p);
	for (int op; !pov_stopped(p) && p->relations && is_relation(op = pov_peek_operator(p)->kind);) {
		pov_take(p);
		struct pov_value w = read_sum(p);
		apply(p, op, &v, &w);
	}
	return v;
}

struct pov_value pov_expression(struct pov *p)
{
	struct pov_value v = value_number(0);
	if (!pov_enter(p))
		return v;
	v = read_relation(p);
	for (int op; !pov_stopped(p) && ((op = pov_peek_operator(p)->kind) == '&' || op == '|');) {
		pov_take(p);
		struct pov_value w = read_relation(p);
		apply(p, op, &v, &w);
	}
	if (!pov_stopped(p) && pov_accept(p, '?')) {
		struct pov_value yes = pov_expression(p);
		pov_expect(p, ':');
		struct pov_value no = pov_expression(p);
		if (v.type != TYPE_NUMBER)
			pov_refuse(p, "%s before '?'", value_type_name(v.type));
		v = value_true(v.a[0]) ? yes : no;
	}
	p->nested--;
	return v;
}
