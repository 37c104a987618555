/* #fopen, #read, #write and #fclose. What a scene writes lives in memory only, and may be included or read again; real files may only
 * be read, and only below the folders that are searched. */
#include "io/pov_reader.h"

#include <string.h>

static struct pov_stream *make_stream(struct pov *p, const char *name, bool reads)
{
	struct pov_stream *s = pov_alloc(p, 1, sizeof *s);
	if (!s)
		return NULL;
	*s = (struct pov_stream){ .name = name, .reads = reads, .next = p->streams };
	s->file.name = name;
	s->file.folder = "";
	p->streams = s;
	return s;
}

static bool leaves_folder(const char *name)
{
	for (const char *at = name; (at = strstr(at, "..")) != NULL; at += 2)
		if ((at == name || at[-1] == '/') && (at[2] == '/' || at[2] == '\0'))
			return true;
	return *name == '/';
}

static void open_for_reading(struct pov *p, uint32_t handle, const char *name)
{
	struct text t = { 0 };
	const struct pov_stream *written = pov_stream_find(p, name);
	if (written)
		text_add(&t, written->text.bytes ? written->text.bytes : "", written->text.size);
	else if (leaves_folder(name) || !pov_load(p, name, &t)) {
		pov_refuse(p, "cannot read '%.200s'", name);
		return;
	}
	struct pov_stream *s = make_stream(p, name, true);
	if (s && pov_lex(&s->file, t.bytes ? t.bytes : "", t.size, &p->names) != 0)
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	text_free(&t);
	if (p->failed)
		return;
	p->tokens_cut += s->file.count;
	struct pov_value v = { .type = TYPE_STREAM, .stream = s };
	pov_declare(p, handle, &v);
}

static void open_stream(struct pov *p)
{
	const struct pov_token *t = pov_peek_operator(p);
	if (t->kind != TOKEN_NAME || t->name < WORD_COUNT) {
		pov_unexpected(p, t, "a name");
		return;
	}
	uint32_t handle = t->name;
	p->source->at++;
	const struct pov_string *name = pov_file_name(p);
	t = pov_take(p);
	if (!name || p->failed)
		return;
	if (is_word(t, WORD_read)) {
		open_for_reading(p, handle, name->bytes);
		return;
	}
	/* A word that is a directive too is cut as a plain name here: read, write, append. */
	if (!is_word(t, WORD_write) && !is_word(t, WORD_append)) {
		pov_unexpected(p, t, "read, write or append");
		return;
	}
	struct pov_stream *s = pov_stream_find(p, name->bytes);
	if (!s)
		s = make_stream(p, name->bytes, false);
	if (!s)
		return;
	if (is_word(t, WORD_write))
		text_free(&s->text);
	struct pov_value v = { .type = TYPE_STREAM, .stream = s };
	pov_declare(p, handle, &v);
}

/* The stream of a handle; NULL (and refused) if it is none. */
static struct pov_stream *find_handle(struct pov *p, uint32_t *name)
{
	struct pov_value *v = pov_variable(p, name);
	if (v && v->type == TYPE_STREAM)
		return v->stream;
	pov_refuse(p, "'%.60s' is no open file", p->names.text[*name]);
	return NULL;
}

/* The next token of the data, past commas. */
static const struct pov_token *next_datum(struct pov_stream *s)
{
	while (s->file.tokens[s->at].kind == ',')
		s->at++;
	return &s->file.tokens[s->at];
}

static bool read_number(struct pov_stream *s, double *x)
{
	double sign = 1;
	const struct pov_token *t = next_datum(s);
	for (; t->kind == '-' || t->kind == '+'; t = &s->file.tokens[++s->at])
		sign = t->kind == '-' ? -sign : sign;
	if (t->kind != TOKEN_NUMBER)
		return false;
	*x = sign * t->number;
	s->at++;
	return true;
}

static bool read_datum(struct pov *p, struct pov_stream *s, struct pov_value *v)
{
	const struct pov_token *t = next_datum(s);
	if (t->kind == TOKEN_STRING) {
		*v = (struct pov_value){ .type = TYPE_STRING, .string = t->string };
		s->at++;
		return true;
	}
	*v = (struct pov_value){ .type = TYPE_NUMBER };
	if (t->kind == '<') {
		for (s->at++; v->count < 5 && next_datum(s)->kind != '>'; v->count++)
			if (!read_number(s, &v->a[v->count]))
				break;
		if (next_datum(s)->kind == '>' && v->count > 0) {
			s->at++;
			return true;
		}
	} else if (read_number(s, &v->a[0])) {
		v->count = 1;
		return true;
	}
	pov_refuse(p, "'%.100s', line %u: neither a number, a vector nor a string", s->name, (unsigned)s->file.tokens[s->at].line);
	return false;
}

static void read_stream(struct pov *p)
{
	uint32_t handle, name;
	pov_expect(p, '(');
	struct pov_stream *s = find_handle(p, &handle);
	if (s && !s->reads)
		pov_refuse(p, "'%.60s' is open for writing", p->names.text[handle]);
	for (;;) {
		pov_accept(p, ',');
		if (p->failed || pov_peek(p)->kind == ')')
			break;
		struct pov_value v, *variable = pov_variable(p, &name);
		if (!s || next_datum(s)->kind == TOKEN_END || !read_datum(p, s, &v))
			continue;
		if (variable)
			*variable = v;
		else
			pov_declare(p, name, &v);
	}
	pov_expect(p, ')');
	if (s && s->reads && !p->failed && next_datum(s)->kind == TOKEN_END)
		scope_remove(&p->scope, handle);
}

static void write_stream(struct pov *p)
{
	uint32_t handle;
	pov_expect(p, '(');
	struct pov_stream *s = find_handle(p, &handle);
	for (;;) {
		pov_accept(p, ',');
		if (p->failed || pov_peek(p)->kind == ')')
			break;
		struct pov_value v = pov_expression(p);
		if (!s || s->reads || s->text.size > p->options->budget.bytes / 8) {
			pov_refuse(p, "'%.60s' cannot be written", p->names.text[handle]);
		} else if (v.type == TYPE_STRING) {
			text_add(&s->text, v.string->bytes, v.string->size);
		} else if (v.type == TYPE_NUMBER && v.count == 1) {
			text_print(&s->text, "%g", v.a[0]);
		} else if (v.type == TYPE_NUMBER) {
			for (int i = 0; i < v.count; i++)
				text_print(&s->text, "%s%g", i ? ", " : "<", v.a[i]);
			text_add(&s->text, ">", 1);
		} else {
			pov_refuse(p, "%s cannot be written", value_type_name(v.type));
		}
	}
	pov_expect(p, ')');
}

void pov_stream_directive(struct pov *p, uint32_t word)
{
	uint32_t handle;
	p->relations = true;
	if (word == WORD_fopen) {
		open_stream(p);
	} else if (word == WORD_read) {
		read_stream(p);
	} else if (word == WORD_write) {
		write_stream(p);
	} else if (pov_variable(p, &handle)) {
		scope_remove(&p->scope, handle);
	}
	pov_accept(p, ';');
}
