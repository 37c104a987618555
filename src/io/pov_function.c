/* function { ... }: the same operators as expressions, on floats, compiled to a tree. Names that are no parameters mean what they mean
 * when the function is declared. */
#include "io/pov_program.h"
#include "io/pov_reader.h"

enum { PARAMETERS_MOST = 56 };
static const double weight_most = 1e8;

struct compiler {
	struct pov *p;
	uint32_t names[SLOTS_MOST]; /* of the slots; parameters first */
	int slots;
	double weight;
	bool unknown, plain; /* plain: the parameters are not named: x, y, z */
	struct pov_node spare; /* where memory is out */
};

static struct pov_node *compile(struct compiler *c);

static struct pov_node *make(struct compiler *c, enum pov_node_kind kind, uint32_t word)
{
	struct pov_node *n = pov_alloc(c->p, 1, sizeof *n);
	if (!n) {
		c->spare = (struct pov_node){ 0 };
		return &c->spare;
	}
	n->kind = kind;
	n->word = word;
	c->weight++;
	c->unknown |= kind == NODE_UNKNOWN;
	return n;
}

static struct pov_node *make_number(struct compiler *c, double x)
{
	struct pov_node *n = make(c, NODE_NUMBER, 0);
	n->number = x;
	return n;
}

static void add_operand(struct pov_node *n, struct pov_node *operand)
{
	if (n == operand)
		return; /* both are the spare one */
	struct pov_node **last = &n->first;
	while (*last)
		last = &(*last)->next;
	*last = operand;
	n->count++;
}

/* A component behind '.', or 0. */
static int read_component(struct compiler *c)
{
	if (!pov_accept(c->p, '.'))
		return 0;
	const struct pov_token *t = pov_take(c->p);
	uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
	switch (word) {
	case WORD_x: case WORD_u: case WORD_red: return 0;
	case WORD_y: case WORD_v: case WORD_green: return 1;
	case WORD_z: case WORD_blue: return 2;
	case WORD_t: case WORD_filter: return 3;
	case WORD_transmit: return 4;
	case WORD_gray: case WORD_grey: return 0;
	default: pov_unexpected(c->p, t, "a component of a vector");
	}
	return 0;
}

static void read_arguments(struct compiler *c, struct pov_node *n)
{
	pov_expect(c->p, '(');
	do {
		if (n->count == PARAMETERS_MOST) {
			pov_refuse(c->p, "more than %d arguments", PARAMETERS_MOST);
			return;
		}
		add_operand(n, compile(c));
	} while (!pov_stopped(c->p) && pov_accept(c->p, ','));
	pov_expect(c->p, ')');
}

static struct pov_node *compile_call(struct compiler *c, const struct pov_program *f)
{
	struct pov_node *n = make(c, NODE_CALL, 0);
	n->program = f;
	read_arguments(c, n);
	n->slot = read_component(c);
	c->weight += f->weight;
	c->unknown |= f->unknown;
	if (n->count != f->parameters && !f->unknown && !pov_stopped(c->p))
		pov_refuse(c->p, "a function of %d arguments with %d", f->parameters, n->count);
	if (f->unknown)
		n->kind = NODE_UNKNOWN;
	return n;
}

static struct pov_node *compile_spline(struct compiler *c, const struct pov_spline_curve *s)
{
	struct pov_node *n = make(c, NODE_SPLINE, 0);
	n->spline = s;
	pov_expect(c->p, '(');
	add_operand(n, compile(c));
	if (pov_accept(c->p, ',')) {
		const struct pov_token *t = pov_take(c->p);
		if (t->kind == TOKEN_NAME && pov_is_spline_kind(t->name))
			n->word = t->name;
	}
	pov_expect(c->p, ')');
	n->slot = read_component(c);
	return n;
}

/* sum(i, from, to, term) and prod. */
static struct pov_node *compile_sum(struct compiler *c, uint32_t word)
{
	struct pov_node *n = make(c, word == WORD_sum ? NODE_SUM : NODE_PRODUCT, 0);
	pov_expect(c->p, '(');
	const struct pov_token *t = pov_peek_operator(c->p);
	if (t->kind != TOKEN_NAME || c->slots == SLOTS_MOST) {
		pov_unexpected(c->p, t, "the name of a variable");
		return n;
	}
	c->p->source->at++;
	pov_expect(c->p, ',');
	add_operand(n, compile(c));
	pov_expect(c->p, ',');
	add_operand(n, compile(c));
	pov_expect(c->p, ',');
	n->slot = c->slots;
	c->names[c->slots++] = t->name;
	double before = c->weight;
	add_operand(n, compile(c));
	c->weight = before + 1000 * (c->weight - before);
	c->slots--;
	pov_expect(c->p, ')');
	return n;
}

/* A variable of the scene: its value now. */
static struct pov_node *compile_identifier(struct compiler *c)
{
	struct pov *p = c->p;
	uint32_t name;
	const struct pov_value *v = pov_variable(p, &name);
	if (!v) {
		if (!p->failed)
			pov_refuse(p, "'%.60s' is not declared", p->names.text[name]);
		return make_number(c, 0);
	}
	if (v->type == TYPE_FUNCTION)
		return compile_call(c, v->program);
	if (v->type == TYPE_SPLINE)
		return compile_spline(c, v->spline);
	if (v->type != TYPE_NUMBER) {
		pov_refuse(p, "%s in a function", value_type_name(v->type));
		return make_number(c, 0);
	}
	int component = pov_peek_operator(p)->kind == '.' ? read_component(c) : 0;
	return make_number(c, value_component(v, component));
}

static struct pov_node *compile_math(struct compiler *c, uint32_t word)
{
	struct pov_node *n = make(c, NODE_MATH, word);
	read_arguments(c, n);
	int most = pov_math_arguments(word);
	if (!pov_stopped(c->p) && ((most > 0 && n->count > most) || (word == WORD_select ? n->count < 3 : n->count < most)))
		pov_refuse(c->p, "%s with %d arguments", c->p->names.text[word], n->count);
	return n;
}

static int find_slot(const struct compiler *c, const struct pov_token *t)
{
	int i = t->kind == TOKEN_NAME ? c->slots : 0;
	while (i > 0 && c->names[i - 1] != t->name)
		i--;
	/* Functions of a parametric surface call them so. */
	if (i == 0 && c->plain && t->kind == TOKEN_NAME && (t->name == WORD_u || t->name == WORD_v))
		return t->name == WORD_v;
	return i - 1;
}

static struct pov_node *compile_primary(struct compiler *c)
{
	struct pov *p = c->p;
	const struct pov_token *t = pov_peek(p);
	struct pov_node *n;
	int slot = find_slot(c, t);
	if (slot >= 0) {
		pov_take(p);
		n = make(c, NODE_SLOT, 0);
		n->slot = slot;
	} else if (t->kind == '(') {
		pov_take(p);
		n = compile(c);
		pov_expect(p, ')');
	} else if (t->kind == TOKEN_NAME && t->name >= WORD_COUNT) {
		n = compile_identifier(c);
	} else if (t->kind == TOKEN_NAME && pov_math_arguments(t->name) != -2) {
		pov_take(p);
		n = compile_math(c, t->name);
	} else if (is_word(t, WORD_sum) || is_word(t, WORD_prod)) {
		pov_take(p);
		n = compile_sum(c, t->name);
	} else if (t->kind == TOKEN_NUMBER || (t->kind == TOKEN_NAME && !pov_is_look(t->name))) {
		struct pov_value v = pov_operand(p);
		if (v.type != TYPE_NUMBER)
			pov_refuse(p, "%s in a function", value_type_name(v.type));
		n = make_number(c, v.a[0]);
	} else {
		pov_unexpected(p, t, "a value");
		n = make_number(c, 0);
	}
	return n;
}

static struct pov_node *compile_operand(struct compiler *c)
{
	const struct pov_token *t = pov_peek(c->p);
	if (t->kind != '-' && t->kind != '+' && t->kind != '!')
		return compile_primary(c);
	uint32_t sign = t->kind;
	pov_take(c->p);
	if (!pov_enter(c->p))
		return make_number(c, 0);
	struct pov_node *n = compile_operand(c);
	c->p->nested--;
	if (sign == '+')
		return n;
	struct pov_node *outer = make(c, NODE_SIGN, sign);
	add_operand(outer, n);
	return outer;
}

/* 4: '*' and '/', 3: '+' and '-', 2: relations, 1: '&' and '|', 0: none. */
static int rank_of(int kind)
{
	switch (kind) {
	case '*': case '/': return 4;
	case '+': case '-': return 3;
	case '<': case '>': case '=': case TOKEN_LE: case TOKEN_GE: case TOKEN_NE: return 2;
	case '&': case '|': return 1;
	default: return 0;
	}
}

static struct pov_node *compile_rank(struct compiler *c, int rank)
{
	struct pov_node *left = rank == 5 ? compile_operand(c) : compile_rank(c, rank + 1);
	for (int op; rank < 5 && !pov_stopped(c->p) && rank_of(op = pov_peek_operator(c->p)->kind) == rank;) {
		pov_take(c->p);
		struct pov_node *n = make(c, NODE_OPERATE, (uint32_t)op);
		add_operand(n, left);
		add_operand(n, compile_rank(c, rank + 1));
		left = n;
	}
	return left;
}

static struct pov_node *compile(struct compiler *c)
{
	if (!pov_enter(c->p))
		return make_number(c, 0);
	struct pov_node *n = compile_rank(c, 1);
	if (!pov_stopped(c->p) && pov_accept(c->p, '?')) {
		struct pov_node *choice = make(c, NODE_CHOOSE, 0);
		add_operand(choice, n);
		add_operand(choice, compile(c));
		pov_expect(c->p, ':');
		add_operand(choice, compile(c));
		n = choice;
	}
	c->p->nested--;
	return n;
}

/* Functions that are no expressions: of patterns and pigments, transforms, splines, and POV-Ray's own. */
static bool read_special(struct compiler *c, struct pov_program *f)
{
	struct pov *p = c->p;
	const struct pov_token *t = pov_peek(p);
	uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
	if (word == WORD_transform) {
		pov_take(p);
		struct matrix *m = pov_alloc(p, 1, sizeof *m);
		if (m)
			*m = pov_transform_block(p);
		f->matrix = m;
		f->parameters = 3;
	} else if (word == WORD_spline) {
		pov_take(p);
		struct pov_value v = pov_spline_read(p);
		f->spline = v.type == TYPE_SPLINE ? v.spline : NULL;
		f->parameters = 1;
	} else if (word == WORD_internal) {
		pov_take(p);
		pov_expect(p, '(');
		f->internal = (int)pov_integer(p, "the number of an internal function", 0, 1000);
		pov_expect(p, ')');
		f->parameters = internal_arguments(f->internal);
		f->unknown = f->parameters == 0;
	} else if (word == WORD_pattern || pov_is_look(word)) {
		pov_take(p);
		pov_skip_block(p);
		f->unknown = true;
	} else {
		return false;
	}
	return true;
}

static void read_parameters(struct compiler *c)
{
	struct pov *p = c->p;
	pov_take(p);
	while (!p->failed && !pov_accept(p, ')')) {
		const struct pov_token *t = pov_peek_operator(p);
		if (t->kind != TOKEN_NAME || c->slots == PARAMETERS_MOST) {
			pov_unexpected(p, t, "the name of a parameter");
			return;
		}
		p->source->at++;
		c->names[c->slots++] = t->name;
		pov_accept(p, ',');
	}
}

struct pov_value pov_function_read(struct pov *p)
{
	struct compiler c = { .p = p };
	struct pov_program *f = pov_alloc(p, 1, sizeof *f);
	int quiet = p->quiet;
	if (!f)
		return value_number(0);
	p->quiet = 0;
	if (pov_peek(p)->kind == '(') {
		read_parameters(&c);
	} else {
		c.names[0] = WORD_x;
		c.names[1] = WORD_y;
		c.names[2] = WORD_z;
		c.slots = 3;
		c.plain = true;
	}
	f->parameters = c.slots;
	bool relations = p->relations, blanks = p->blanks;
	p->relations = true;
	p->blanks = false;
	pov_expect(p, '{');
	if (!read_special(&c, f)) {
		f->root = compile(&c);
		f->unknown = c.unknown;
	}
	pov_expect(p, '}');
	p->relations = relations;
	p->blanks = blanks;
	p->quiet = quiet;
	f->weight = c.weight;
	if (f->weight > weight_most)
		pov_stop(p, STATUS_INPUT, "a function whose value takes more than %g steps", weight_most);
	return (struct pov_value){ .type = TYPE_FUNCTION, .program = f };
}

struct pov_value pov_function_call(struct pov *p, const struct pov_program *f)
{
	double a[SLOTS_MOST] = { 0 };
	int n = 0;
	bool relations = p->relations, blanks = p->blanks;
	pov_expect(p, '(');
	p->relations = true;
	p->blanks = false;
	do {
		if (n == PARAMETERS_MOST) {
			pov_refuse(p, "more than %d arguments", PARAMETERS_MOST);
			break;
		}
		struct pov_value v = pov_expression(p);
		bool spread = n == 0 && v.type == TYPE_NUMBER && v.count > 1 && !f->root && !f->internal;
		for (int i = 0; i < (spread ? 3 : 1); i++)
			a[n++] = v.type == TYPE_NUMBER ? value_component(&v, i) : 0;
	} while (!pov_stopped(p) && pov_accept(p, ','));
	p->relations = relations;
	p->blanks = blanks;
	pov_expect(p, ')');
	if (!pov_stopped(p) && n != f->parameters && !f->unknown && p->options->strict)
		pov_refuse(p, "a function of %d arguments with %d", f->parameters, n);
	if (f->unknown) {
		p->summary->unknown++;
		pov_note(p, "a function made of noise, a pattern or a pigment is not known here");
		return (struct pov_value){ .type = TYPE_NUMBER, .count = f->root ? 1 : 5, .a = { 0.5, 0.5, 0.5, 0, 0 } };
	}
	if (f->root || f->internal)
		return value_number(program_value(f, a, 0));
	struct pov_value v = { .type = TYPE_NUMBER, .count = 3 };
	for (int i = 0; i < 3; i++)
		v.a[i] = program_value(f, a, i);
	return v;
}

static double call_program(void *context, const double *arguments)
{
	double x = program_value(context, arguments, 0);
	return isfinite(x) ? x : x < 0 ? -1e10 : 1e10;
}

struct pov_function pov_function_of(const struct pov_program *f, bool *known)
{
	*known = !f->unknown;
	return (struct pov_function){ call_program, (void *)f };
}
