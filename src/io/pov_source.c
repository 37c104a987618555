/* The stack of sources and the tokens that come from it. */
#include "io/pov_reader.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct pov_token no_token = { .kind = TOKEN_END };

/* "file:line: message, in macro M called from file:line, included from file:line ...", from the innermost out. */
static void report(struct pov *p, int code, const char *message)
{
	char text[2048];
	size_t n = (size_t)snprintf(text, sizeof text, "%s", message);
	const struct pov_file *at = p->seen_file;
	for (const struct pov_source *s = p->source; s > p->sources && n < sizeof text - 600; s--) {
		const struct pov_source *caller = s - 1;
		const struct pov_token *from = caller->at > caller->file->tokens ? caller->at - 1 : caller->at;
		if (s->macro)
			n += (size_t)snprintf(text + n, sizeof text - n, ", in macro %.60s from %.200s:%u", p->names.text[s->macro],
			                      caller->file->name, (unsigned)from->line);
		else
			n += (size_t)snprintf(text + n, sizeof text - n, ", included from %.200s:%u", caller->file->name,
			                      (unsigned)from->line);
		if (p->source - s == 3)
			break;
	}
	err_flatten(text);
	err_at(p->err, code, at ? at->name : NULL, p->seen ? (long)p->seen->line : 0, "%s", text);
	p->failed = true;
	p->source = p->sources;
	p->source->at = p->source->end;
	p->branch_count = 0;
}

void pov_refuse(struct pov *p, const char *fmt, ...)
{
	if (p->quiet) {
		p->doubt = true;
		return;
	}
	if (p->failed)
		return;
	char message[1024];
	va_list args;
	va_start(args, fmt);
	vsnprintf(message, sizeof message, fmt, args);
	va_end(args);
	report(p, STATUS_INPUT, message);
}

void pov_stop(struct pov *p, int code, const char *fmt, ...)
{
	if (p->failed)
		return;
	char message[1024];
	va_list args;
	va_start(args, fmt);
	vsnprintf(message, sizeof message, fmt, args);
	va_end(args);
	report(p, code, message);
}

void pov_note(struct pov *p, const char *fmt, ...)
{
	char *reason = p->summary->reason;
	size_t size = sizeof p->summary->reason;
	if (*reason)
		return;
	int n = snprintf(reason, size, "%.120s:%u: ", p->seen_file ? p->seen_file->name : "", p->seen ? (unsigned)p->seen->line : 0);
	va_list args;
	va_start(args, fmt);
	vsnprintf(reason + n, size - (size_t)n, fmt, args);
	va_end(args);
	err_flatten(reason);
}

const char *pov_token_text(const struct pov *p, const struct pov_token *t, char *out, size_t size)
{
	switch (t->kind) {
	case TOKEN_END: snprintf(out, size, "the end of the file"); break;
	case TOKEN_NUMBER: snprintf(out, size, "the number %g", t->number); break;
	case TOKEN_STRING: snprintf(out, size, "the string \"%.40s\"", t->string->bytes); break;
	case TOKEN_NAME: snprintf(out, size, "'%.40s'", p->names.text[t->name]); break;
	case TOKEN_DIRECTIVE: snprintf(out, size, "'#%.40s'", p->names.text[t->name]); break;
	case TOKEN_LE: snprintf(out, size, "'<='"); break;
	case TOKEN_GE: snprintf(out, size, "'>='"); break;
	case TOKEN_NE: snprintf(out, size, "'!='"); break;
	case TOKEN_BAD: snprintf(out, size, "%s", t->string->bytes); break;
	default: snprintf(out, size, "'%c'", t->kind);
	}
	return out;
}

void pov_unexpected(struct pov *p, const struct pov_token *t, const char *wanted)
{
	char text[128];
	pov_token_text(p, t, text, sizeof text);
	if (t->kind == TOKEN_BAD)
		pov_refuse(p, "%s", text);
	else
		pov_refuse(p, "%s where %s should be", text, wanted);
}

bool pov_enter(struct pov *p)
{
	p->nested++;
	if (p->nested > NESTED_MOST)
		pov_stop(p, STATUS_INPUT, "nested more than %d deep", NESTED_MOST);
	return !p->failed;
}

void *pov_alloc(struct pov *p, size_t count, size_t size)
{
	size_t budget = p->options->budget.bytes;
	if (p->failed)
		return NULL;
	if ((double)count * (double)size + (double)p->mem.held > (double)budget) {
		pov_stop(p, STATUS_INPUT, "more memory than the budget of %zu bytes", budget);
		return NULL;
	}
	void *memory = arena_alloc(&p->mem, count, size);
	if (!memory)
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	return memory;
}

void *pov_grow(struct pov *p, void *array, size_t count, size_t *room, size_t size)
{
	if (count < *room)
		return array;
	size_t want = *room ? 2 * *room : 16;
	void *grown = pov_alloc(p, want, size);
	if (!grown)
		return NULL;
	if (*room)
		memcpy(grown, array, *room * size);
	*room = want;
	return grown;
}

void pov_push(struct pov *p, const struct pov_file *f, size_t first, size_t end, uint32_t macro)
{
	int depth = (int)(p->source - p->sources);
	if (p->failed)
		return;
	if (depth >= p->options->budget.depth || depth + 1 >= SOURCES_MOST) {
		pov_stop(p, STATUS_INPUT, "inclusions and macros within each other more than the budget of %d deep", p->options->budget.depth);
		return;
	}
	*++p->source = (struct pov_source){ .file = f, .at = f->tokens + first, .end = f->tokens + end, .macro = macro,
		                            .branches = p->branch_count };
}

/* Go on where the macro was called or the file included; false at the end of the scene. */
static bool pop(struct pov *p)
{
	if (p->source == p->sources)
		return false;
	p->branch_count = p->source->branches;
	scope_close(&p->scope, &p->source->bindings);
	p->source--;
	return true;
}

static const struct pov_token *see(struct pov *p, const struct pov_token *t)
{
	p->seen = t;
	p->seen_file = p->source->file;
	return t;
}

const struct pov_token *pov_peek(struct pov *p)
{
	for (;;) {
		struct pov_source *s = p->source;
		if (p->failed)
			return &no_token;
		if (s->at == s->end) {
			if (!pop(p))
				return see(p, s->end);
			continue;
		}
		const struct pov_token *t = see(p, s->at);
		struct pov_binding *b;
		if (t->kind == TOKEN_DIRECTIVE) {
			s->at++;
			pov_directive(p, t);
		} else if (t->kind == TOKEN_NAME && t->name >= WORD_COUNT && (b = scope_find(&p->scope, t->name)) != NULL &&
		           b->refers->type == TYPE_MACRO) {
			s->at++;
			pov_macro_call(p, b->refers->macro);
		} else {
			return t;
		}
	}
}

const struct pov_token *pov_peek_operator(struct pov *p)
{
	for (;;) {
		struct pov_source *s = p->source;
		if (p->failed)
			return &no_token;
		if (s->at == s->end) {
			if (!pop(p))
				return see(p, s->end);
			continue;
		}
		const struct pov_token *t = see(p, s->at);
		bool closes = t->kind == TOKEN_DIRECTIVE && (t->name == WORD_else || t->name == WORD_elseif || t->name == WORD_end);
		if (!closes || p->branch_count == s->branches)
			return t;
		uint32_t word = p->branches[p->branch_count - 1].word;
		if (word != WORD_if && word != WORD_switch)
			return t;
		s->at++;
		pov_branch(p, t);
	}
}

static void step(struct pov *p, const struct pov_token *t)
{
	size_t budget = p->options->budget.tokens, bytes = p->options->budget.bytes;
	if (p->mem.held > bytes)
		pov_stop(p, STATUS_INPUT, "more memory than the budget of %zu bytes", bytes);
	if (t == p->source->at && t != p->source->end)
		p->source->at++;
	if (++p->tokens_taken > budget && p->tokens_taken - p->tokens_cut > budget && p->tokens_taken > p->tokens_cut)
		pov_stop(p, STATUS_INPUT, "more tokens than the budget of %zu", budget);
}

const struct pov_token *pov_take(struct pov *p)
{
	const struct pov_token *t = pov_peek(p);
	step(p, t);
	return t;
}

bool pov_accept(struct pov *p, int kind)
{
	const struct pov_token *t = pov_peek_operator(p);
	if (t->kind != kind)
		return false;
	step(p, t);
	return true;
}

bool pov_expect(struct pov *p, int kind)
{
	if (pov_accept(p, kind))
		return true;
	/* A directive or macro may stand before the brace that ends a block. */
	const struct pov_token *t = pov_peek(p);
	if (t->kind == kind) {
		step(p, t);
		return true;
	}
	char wanted[8] = { '\'', (char)kind, '\'' };
	pov_unexpected(p, t, wanted);
	return false;
}

bool pov_accept_word(struct pov *p, uint32_t word)
{
	const struct pov_token *t = pov_peek(p);
	if (!is_word(t, word))
		return false;
	step(p, t);
	return true;
}

void pov_skip_separators(struct pov *p)
{
	for (;;) {
		const struct pov_token *t = pov_peek(p);
		if (t->kind != ',' && t->kind != ';')
			return;
		step(p, t);
	}
}
