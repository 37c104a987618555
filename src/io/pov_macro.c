/* Macros: a call pushes the tokens of the body, so that they flow into whatever is being read. */
#include "io/pov_reader.h"

enum { PARAMETERS_MOST = 256 };

void pov_macro_define(struct pov *p, const struct pov_token *t)
{
	uint32_t names[PARAMETERS_MOST];
	size_t count = 0;
	const struct pov_token *name = pov_peek_operator(p);
	if (!t->jump) {
		pov_refuse(p, "'#macro' without '#end'");
		return;
	}
	if (name->kind != TOKEN_NAME || name->name < WORD_COUNT) {
		pov_unexpected(p, name, "the name of a macro");
		return;
	}
	p->source->at++;
	pov_expect(p, '(');
	while (!p->failed && !pov_accept(p, ')')) {
		const struct pov_token *parameter = pov_peek_operator(p);
		if (parameter->kind != TOKEN_NAME || count == PARAMETERS_MOST) {
			pov_unexpected(p, parameter, "the name of a parameter");
			return;
		}
		p->source->at++;
		names[count++] = parameter->name;
		pov_accept(p, ',');
	}
	struct pov_macro *m = pov_alloc(p, 1, sizeof *m);
	uint32_t *parameters = pov_alloc(p, count, sizeof *parameters);
	if (p->failed)
		return;
	for (size_t i = 0; i < count; i++)
		parameters[i] = names[i];
	const struct pov_file *f = p->source->file;
	*m = (struct pov_macro){ f, (size_t)(p->source->at - f->tokens), t->jump, name->name, parameters, count };
	p->source->at = &f->tokens[t->jump] + 1;
	struct pov_value v = { .type = TYPE_MACRO, .macro = m };
	struct pov_binding *b = scope_find(&p->scope, name->name);
	if (b && b->refers->type == TYPE_MACRO)
		*b->refers = v;
	else
		pov_declare(p, name->name, &v);
}

/* What a parameter is to stand for. */
struct argument {
	struct pov_value value;
	struct pov_value *refers; /* the caller's variable, or NULL */
};

static bool ends_argument(const struct pov_token *t)
{
	return t->kind == ',' || t->kind == ')';
}

/* One argument: a lone variable goes by reference, nothing or an unknown name as undefined, the rest by value. */
static struct argument read_argument(struct pov *p)
{
	struct argument a = { 0 };
	const struct pov_token *t = pov_peek(p);
	if (ends_argument(t))
		return a;
	if (t->kind != TOKEN_NAME || t->name < WORD_COUNT) {
		a.value = pov_value_read(p);
		return a;
	}
	const struct pov_token *next = t + 1;
	const struct pov_binding *b = scope_find(&p->scope, t->name);
	bool alone = next < p->source->end && ends_argument(next);
	if (alone && !b) {
		if (p->options->strict)
			pov_refuse(p, "'%.60s' is not declared", p->names.text[t->name]);
		pov_take(p);
		return a;
	}
	if (!alone && !(b && b->refers->type == TYPE_ARRAY && next < p->source->end && next->kind == '[')) {
		a.value = pov_value_read(p);
		return a;
	}
	uint32_t name;
	struct pov_value *v = pov_variable(p, &name);
	if (!v)
		return a;
	if (ends_argument(pov_peek_operator(p))) {
		a.refers = v;
		return a;
	}
	/* An expression that starts with an element of an array. */
	if (v->type == TYPE_NUMBER || v->type == TYPE_STRING) {
		p->pending = *v;
		a.value = pov_expression(p);
	} else if (v->type == TYPE_FUNCTION) {
		p->pending = pov_function_call(p, v->program);
		a.value = pov_expression(p);
	} else {
		pov_unexpected(p, pov_peek(p), "',' or ')'");
	}
	return a;
}

static void skip_arguments(struct pov *p)
{
	for (int depth = 1; depth > 0;) {
		const struct pov_token *t = pov_take(p);
		if (t->kind == TOKEN_END)
			return;
		depth += (t->kind == '(') - (t->kind == ')');
	}
}

void pov_macro_call(struct pov *p, const struct pov_macro *m)
{
	struct argument few[8], *all = m->count <= 8 ? few : pov_alloc(p, m->count, sizeof *all);
	bool relations = p->relations, blanks = p->blanks, blank_vector = p->blank_vector, doubt = p->doubt;
	struct pov_value pending = p->pending;
	size_t n = 0;
	if (!all || !pov_enter(p) || !pov_expect(p, '('))
		return;
	p->relations = true;
	p->blanks = p->doubt = false;
	p->pending = (struct pov_value){ 0 };
	for (; n < m->count && !pov_stopped(p); n++) {
		all[n] = read_argument(p);
		if (!pov_accept(p, ',') && pov_peek_operator(p)->kind == ')') {
			n++;
			break;
		}
	}
	if (p->doubt)
		skip_arguments(p);
	else
		pov_expect(p, ')');
	if (n < m->count && p->options->strict)
		pov_refuse(p, "macro %.60s needs %zu arguments", p->names.text[m->name], m->count);
	p->relations = relations;
	p->blanks = blanks;
	p->blank_vector = blank_vector;
	p->doubt = doubt;
	p->pending = pending;
	p->nested--;
	pov_push(p, m->file, m->first, m->end, m->name);
	for (size_t i = 0; i < m->count && !p->failed; i++) {
		struct pov_binding *b = scope_bind(&p->scope, m->parameters[i], (uint32_t)(p->source - p->sources), &p->source->bindings);
		if (!b) {
			pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
			return;
		}
		if (i < n && all[i].refers)
			b->refers = all[i].refers;
		else if (i < n)
			b->value = all[i].value;
	}
}
