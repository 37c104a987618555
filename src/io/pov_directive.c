/* Directives that declare, include, report. */
#include "io/pov_reader.h"

#include <string.h>

struct pov_value *pov_variable(struct pov *p, uint32_t *name)
{
	const struct pov_token *t = pov_peek_operator(p);
	*name = 0;
	if (t->kind != TOKEN_NAME || t->name < WORD_COUNT) {
		pov_unexpected(p, t, "a name");
		return NULL;
	}
	p->source->at++;
	*name = t->name;
	struct pov_binding *b = scope_find(&p->scope, t->name);
	struct pov_value *v = b ? b->refers : NULL;
	while (v && v->type == TYPE_ARRAY && pov_peek_operator(p)->kind == '[')
		v = pov_element(p, v->array);
	return v;
}

void pov_declare(struct pov *p, uint32_t name, const struct pov_value *value)
{
	struct pov_binding *b = scope_find(&p->scope, name);
	if (!b && !p->failed) {
		b = scope_bind(&p->scope, name, 0, &p->sources[0].bindings);
		if (!b)
			pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	}
	if (b)
		*b->refers = *value;
}

void pov_declare_local(struct pov *p, uint32_t name, uint32_t frame, const struct pov_value *value)
{
	struct pov_binding *b = scope_find_in(&p->scope, name, frame);
	if (p->failed || frame > (uint32_t)(p->source - p->sources))
		return;
	if (!b) {
		b = scope_bind(&p->scope, name, frame, &p->sources[frame].bindings);
		if (!b) {
			pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
			return;
		}
	}
	*b->refers = *value;
}

static void skip_deprecated(struct pov *p)
{
	if (!pov_accept_word(p, WORD_deprecated))
		return;
	pov_accept_word(p, WORD_once);
	if (pov_peek(p)->kind == TOKEN_STRING)
		pov_take(p);
}

static void declare(struct pov *p, bool local)
{
	/* When the value is complete a macro that gives it may not be left yet, or the one at hand may be left already. */
	uint32_t frame = (uint32_t)(p->source - p->sources);
	const struct pov_token *t = pov_peek_operator(p);
	struct pov_value *element = NULL; /* what is there to assign to */
	uint32_t name;
	if (is_word(t, WORD_deprecated))
		skip_deprecated(p);
	t = pov_peek_operator(p);
	bool subscripted = t->kind == TOKEN_NAME && t + 1 < p->source->end && t[1].kind == '[';
	if (subscripted) {
		element = pov_variable(p, &name);
		if (!element && !p->failed)
			pov_refuse(p, "'%.60s' is not declared", p->names.text[name]);
	} else if (t->kind == TOKEN_NAME && t->name >= WORD_COUNT) {
		name = t->name;
		p->source->at++;
	} else {
		pov_unexpected(p, t, "a name");
		return;
	}
	if (!element) {
		struct pov_binding *b = local ? scope_find_in(&p->scope, name, frame) : scope_find(&p->scope, name);
		element = b ? b->refers : NULL;
	}
	p->relations = false;
	pov_expect(p, '=');
	struct pov_value v = pov_value_read(p);
	if (p->failed)
		return;
	bool ended = pov_accept(p, ';');
	if (p->options->strict && !ended && (v.type == TYPE_NUMBER || v.type == TYPE_STRING))
		pov_refuse(p, "';' is missing behind the value");
	if (element)
		*element = v;
	else if (local)
		pov_declare_local(p, name, frame, &v);
	else
		pov_declare(p, name, &v);
}

static void undefine(struct pov *p)
{
	const struct pov_token *t = pov_peek_operator(p);
	if (t->kind != TOKEN_NAME || t->name < WORD_COUNT) {
		pov_unexpected(p, t, "a name");
		return;
	}
	uint32_t name;
	if (t + 1 < p->source->end && t[1].kind == '[') {
		struct pov_value *v = pov_variable(p, &name);
		if (v)
			*v = (struct pov_value){ 0 };
	} else {
		p->source->at++;
		scope_remove(&p->scope, t->name);
	}
	pov_accept(p, ';');
}

/* Without the standard colours their names must still mean something. */
static void declare_colors(struct pov *p)
{
	static const struct { const char *name; double r, g, b; } colors[] = {
		{ "White", 1, 1, 1 }, { "Black", 0, 0, 0 }, { "Red", 1, 0, 0 }, { "Green", 0, 1, 0 }, { "Blue", 0, 0, 1 },
		{ "Yellow", 1, 1, 0 }, { "Cyan", 0, 1, 1 }, { "Magenta", 1, 0, 1 }, { "Gray", 0.75, 0.75, 0.75 },
		{ "Grey", 0.75, 0.75, 0.75 }, { "Orange", 1, 0.5, 0 }, { "Brown", 0.65, 0.16, 0.16 }, { "Gold", 0.8, 0.5, 0.2 },
		{ "Silver", 0.9, 0.91, 0.98 },
	};
	for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) {
		uint32_t name = pov_name(&p->names, colors[i].name, strlen(colors[i].name));
		struct pov_value v = { .type = TYPE_NUMBER, .count = 5, .color = true, .a = { colors[i].r, colors[i].g, colors[i].b, 0, 0 } };
		if (name && !scope_find(&p->scope, name))
			pov_declare(p, name, &v);
	}
}

static void include(struct pov *p)
{
	const struct pov_string *name = pov_file_name(p);
	if (!name)
		return;
	const struct pov_file *f = pov_open(p, name->bytes);
	if (f) {
		pov_push(p, f, 0, f->count, 0);
		return;
	}
	if (p->options->strict)
		pov_refuse(p, "cannot find '%.200s'", name->bytes);
	p->summary->missing++;
	pov_note(p, "cannot find '%.100s'", name->bytes);
	if (strstr(name->bytes, "olors.inc"))
		declare_colors(p);
}

/* #version 3.7; also: unofficial NAME 1.2 */
static void set_version(struct pov *p)
{
	const struct pov_token *t = pov_peek(p);
	if (t->kind == TOKEN_NAME && t->name >= WORD_COUNT && !scope_find(&p->scope, t->name)) {
		for (int i = 0; i < 2 && pov_peek(p)->kind == TOKEN_NAME; i++)
			pov_take(p);
		pov_float(p);
	} else {
		p->version = pov_float(p);
		if (p->options->strict && p->version > 3.7)
			pov_refuse(p, "version %g is later than 3.7", p->version);
	}
	pov_accept(p, ';');
}

void pov_set_default(struct pov *p)
{
	pov_expect(p, '{');
	for (;;) {
		const struct pov_token *t = pov_take(p);
		if (t->kind == '}' || t->kind == TOKEN_END)
			return;
		if (t->kind != TOKEN_NAME)
			continue;
		struct pov_look look = { .material = NO_MATERIAL };
		if (pov_is_look(t->name)) {
			pov_look_read(p, t->name, &look);
			pov_look_add(&look, &p->look);
			p->look = look;
		} else if (pov_peek_operator(p)->kind == '{') {
			pov_skip_block(p);
		}
	}
}

static void report(struct pov *p, uint32_t word)
{
	const struct pov_string *s = pov_text(p);
	if (word == WORD_error && s && !p->failed) {
		size_t n = 0;
		while (n < s->size && n < 500 && (unsigned char)s->bytes[n] >= 0x20)
			n++;
		pov_stop(p, STATUS_INPUT, "the scene says: %.*s", (int)n, s->bytes);
	}
}

void pov_directive(struct pov *p, const struct pov_token *t)
{
	int quiet = p->quiet;
	bool doubt = p->doubt, relations = p->relations, blanks = p->blanks, blank_vector = p->blank_vector;
	struct pov_value pending = p->pending;
	if (!pov_enter(p))
		return;
	p->quiet = 0;
	p->doubt = p->relations = p->blanks = false;
	p->pending = (struct pov_value){ 0 };
	switch (t->name) {
	case WORD_declare: declare(p, false); break;
	case WORD_local: declare(p, true); break;
	case WORD_undef: undefine(p); break;
	case WORD_include: include(p); break;
	case WORD_version: set_version(p); break;
	case WORD_default: pov_set_default(p); break;
	case WORD_macro: pov_macro_define(p, t); break;
	case WORD_debug: case WORD_warning: case WORD_error: case WORD_render: case WORD_statistics: report(p, t->name); break;
	case WORD_fopen: case WORD_fclose: case WORD_read: case WORD_write: pov_stream_directive(p, t->name); break;
	default: pov_branch(p, t);
	}
	p->quiet = quiet;
	p->doubt = doubt;
	p->relations = relations;
	p->blanks = blanks;
	p->blank_vector = blank_vector;
	p->pending = pending;
	p->nested--;
}
