#include "io/pov_lex.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NESTING_MOST = 1000 };

struct lexer {
	struct pov_file *file;
	struct pov_names *names;
	const char *at, *end;
	uint32_t line;
	size_t room;
	bool latin, spaced, lost;
	uint32_t open[NESTING_MOST]; /* openers, or the branches that follow them, whose end is still to come */
	int nesting;
};

const struct pov_string *pov_string_new(struct arena *a, const char *bytes, size_t n)
{
	struct pov_string *s = arena_alloc(a, 1, sizeof *s + n + 1);
	if (!s)
		return NULL;
	char *copy = (char *)(s + 1);
	if (n)
		memcpy(copy, bytes, n);
	*s = (struct pov_string){ n, copy };
	return s;
}

static bool is_utf8(const char *text, size_t n)
{
	const unsigned char *p = (const unsigned char *)text, *end = p + n;
	while (p < end) {
		int more = *p < 0x80 ? 0 : *p >= 0xc2 && *p < 0xe0 ? 1 : (*p & 0xf0) == 0xe0 ? 2 : *p >= 0xf0 && *p < 0xf5 ? 3 : -1;
		if (more < 0 || end - p <= more)
			return false;
		for (int i = 1; i <= more; i++)
			if ((p[i] & 0xc0) != 0x80)
				return false;
		p += more + 1;
	}
	return true;
}

static struct pov_token *add_token(struct lexer *l, int kind)
{
	struct pov_file *f = l->file;
	if (f->count + 2 > l->room) {
		size_t room = l->room + l->room / 2 + 256;
		struct pov_token *grown = room < UINT32_MAX ? realloc(f->tokens, room * sizeof *grown) : NULL;
		if (!grown) {
			l->lost = true;
			return NULL;
		}
		f->tokens = grown;
		l->room = room;
	}
	struct pov_token *t = &f->tokens[f->count++];
	*t = (struct pov_token){ .line = l->line, .kind = (uint16_t)kind, .spaced = l->spaced };
	l->spaced = false;
	return t;
}

static void add_bad(struct lexer *l, const char *why)
{
	struct pov_token *t = add_token(l, TOKEN_BAD);
	if (t && !(t->string = pov_string_new(l->names->mem, why, strlen(why))))
		l->lost = true;
}

static bool is_letter(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

/* Comments nest. */
static void skip_comment(struct lexer *l)
{
	int depth = 0;
	uint32_t line = l->line;
	do {
		bool opens = l->end - l->at >= 2 && l->at[0] == '/' && l->at[1] == '*';
		bool closes = l->end - l->at >= 2 && l->at[0] == '*' && l->at[1] == '/';
		depth += opens - closes;
		l->line += *l->at == '\n';
		l->at += opens || closes ? 2 : 1;
	} while (depth > 0 && l->at < l->end);
	if (depth > 0) {
		l->line = line;
		add_bad(l, "a comment without end");
	}
}

static bool skip_space(struct lexer *l)
{
	for (; l->at < l->end; l->spaced = true) {
		char c = *l->at;
		if (c == '/' && l->end - l->at >= 2 && l->at[1] == '/') {
			while (l->at < l->end && *l->at != '\n')
				l->at++;
		} else if (c == '/' && l->end - l->at >= 2 && l->at[1] == '*') {
			skip_comment(l);
		} else if (c == ' ' || (c >= '\t' && c <= '\r') || c == '\0' || c == 0x1a) {
			l->line += c == '\n';
			l->at++;
		} else {
			return true;
		}
	}
	return false;
}

/* Digits into the mantissa while they fit; the rest only move the point. */
static void read_digits(struct lexer *l, uint64_t *mantissa, int *kept, int *dropped)
{
	for (; l->at < l->end && is_digit(*l->at); l->at++) {
		if (*mantissa < UINT64_C(1000000000000000000)) {
			*mantissa = *mantissa * 10 + (uint64_t)(*l->at - '0');
			++*kept;
		} else {
			++*dropped;
		}
	}
}

/* Where mantissa and power of ten are exact doubles one operation rounds correctly; the rest is strtod's. */
static double make_number(uint64_t mantissa, int exponent)
{
	static const double power[] = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
		                        1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
	if (mantissa <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22)
		return exponent < 0 ? (double)mantissa / power[-exponent] : (double)mantissa * power[exponent];
	char text[48];
	snprintf(text, sizeof text, "%llue%d", (unsigned long long)mantissa, exponent);
	double x = strtod(text, NULL);
	return x <= 1e300 ? x : 1e300;
}

static void read_number(struct lexer *l)
{
	uint64_t mantissa = 0;
	int whole = 0, part = 0, dropped = 0, ignored = 0, exponent = 0;
	read_digits(l, &mantissa, &whole, &dropped);
	if (l->at < l->end && *l->at == '.') {
		l->at++;
		read_digits(l, &mantissa, &part, &ignored);
		if (dropped)
			part = 0;
	}
	const char *e = l->at;
	if (e < l->end && (*e == 'e' || *e == 'E')) {
		const char *p = e + 1;
		bool negative = p < l->end && *p == '-';
		p += p < l->end && (*p == '-' || *p == '+');
		if (p < l->end && is_digit(*p)) {
			for (; p < l->end && is_digit(*p); p++)
				exponent = exponent < 10000 ? exponent * 10 + (*p - '0') : exponent;
			exponent = negative ? -exponent : exponent;
			l->at = p;
		}
	}
	struct pov_token *t = add_token(l, TOKEN_NUMBER);
	if (t)
		t->number = make_number(mantissa, exponent + dropped - part);
}

/* The text of a string as UTF-8. */
static const struct pov_string *make_string(struct lexer *l, const char *text, size_t n)
{
	if (!l->latin)
		return pov_string_new(l->names->mem, text, n);
	char *wide = malloc(2 * n + 1), *out = wide;
	if (!wide)
		return NULL;
	for (size_t i = 0; i < n; i++) {
		unsigned char c = (unsigned char)text[i];
		if (c >= 0x80)
			*out++ = (char)(0xc0 | c >> 6);
		*out++ = (char)(c >= 0x80 ? 0x80 | (c & 0x3f) : c);
	}
	const struct pov_string *s = pov_string_new(l->names->mem, wide, (size_t)(out - wide));
	free(wide);
	return s;
}

static void read_string(struct lexer *l)
{
	const char *start = ++l->at;
	uint32_t line = l->line;
	for (; l->at < l->end && *l->at != '"'; l->at++) {
		l->line += *l->at == '\n';
		if (*l->at == '\\' && l->end - l->at >= 2 && l->at[1] != '\n')
			l->at++;
	}
	if (l->at >= l->end) {
		l->at = l->end;
		add_bad(l, "a string without end");
		if (!l->lost)
			l->file->tokens[l->file->count - 1].line = line;
		return;
	}
	struct pov_token *t = add_token(l, TOKEN_STRING);
	if (t) {
		t->line = line;
		t->string = make_string(l, start, (size_t)(l->at - start));
		l->lost = !t->string;
	}
	l->at++;
}

static bool is_directive(uint32_t word)
{
	return word >= WORD_include && word <= WORD_write;
}

/* Tie branches together: every one knows where it ends. */
static void link_branches(struct lexer *l, uint32_t word)
{
	uint32_t here = (uint32_t)l->file->count - 1;
	struct pov_token *tokens = l->file->tokens;
	bool opens = word == WORD_if || word == WORD_ifdef || word == WORD_ifndef || word == WORD_while || word == WORD_for ||
	             word == WORD_switch || word == WORD_macro;
	bool goes_on = word == WORD_else || word == WORD_elseif || word == WORD_case || word == WORD_range;
	if (!opens && !goes_on && word != WORD_end)
		return;
	if (opens) {
		if (l->nesting == NESTING_MOST) {
			l->file->count--;
			add_bad(l, "directives nested more than 1000 deep");
			return;
		}
		l->open[l->nesting++] = here;
	} else if (l->nesting > 0) {
		tokens[l->open[l->nesting - 1]].jump = here;
		if (goes_on)
			l->open[l->nesting - 1] = here;
		else
			l->nesting--;
	}
}

static uint32_t read_word(struct lexer *l)
{
	const char *start = l->at;
	while (l->at < l->end && (is_letter(*l->at) || is_digit(*l->at)))
		l->at++;
	uint32_t name = pov_name(l->names, start, (size_t)(l->at - start));
	l->lost |= name == 0;
	return name;
}

static void add_word(struct lexer *l, int kind, uint32_t name)
{
	struct pov_token *t = add_token(l, kind);
	if (!t)
		return;
	t->name = name;
	if (kind == TOKEN_DIRECTIVE)
		link_branches(l, name);
}

/* '#' before what is no directive means nothing. */
static void read_directive(struct lexer *l)
{
	const char *p = l->at + 1;
	while (p < l->end && (*p == ' ' || *p == '\t'))
		p++;
	if (p == l->end || !is_letter(*p)) {
		l->at++;
		return;
	}
	l->at = p;
	uint32_t name = read_word(l);
	if (!l->lost)
		add_word(l, is_directive(name) ? TOKEN_DIRECTIVE : TOKEN_NAME, name);
}

static void read_punctuation(struct lexer *l)
{
	char c = *l->at, next = l->end - l->at >= 2 ? l->at[1] : '\0';
	int kind = next != '=' ? 0 : c == '<' ? TOKEN_LE : c == '>' ? TOKEN_GE : c == '!' ? TOKEN_NE : 0;
	if (kind) {
		add_token(l, kind);
		l->at += 2;
	} else if (strchr("{}()[]<>,;:.=+-*/&|!?", c)) {
		add_token(l, c);
		l->at++;
	} else {
		char why[64];
		snprintf(why, sizeof why, c > 0x20 && c < 0x7f ? "an unexpected character '%c'" : "binary data (byte 0x%02x)",
		         (unsigned char)c);
		add_bad(l, why);
		l->at++;
	}
}

int pov_lex(struct pov_file *f, const char *text, size_t n, struct pov_names *names)
{
	struct lexer l = { .file = f, .names = names, .at = text, .end = text + n, .line = 1, .spaced = true };
	if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
		l.at += 3;
	l.latin = !is_utf8(l.at, (size_t)(l.end - l.at));
	while (!l.lost && skip_space(&l)) {
		char c = *l.at;
		if (is_digit(c) || (c == '.' && l.end - l.at >= 2 && is_digit(l.at[1]))) {
			read_number(&l);
		} else if (is_letter(c)) {
			uint32_t name = read_word(&l);
			if (!l.lost)
				add_word(&l, name == WORD_declare || name == WORD_include ? TOKEN_DIRECTIVE : TOKEN_NAME, name);
		} else if (c == '"') {
			read_string(&l);
		} else if (c == '#') {
			read_directive(&l);
		} else {
			read_punctuation(&l);
		}
	}
	if (!l.lost && add_token(&l, TOKEN_END))
		f->count--;
	return l.lost ? -1 : 0;
}
