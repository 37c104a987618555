/* Built-in functions of strings. '(' was taken, ')' is left. Positions and lengths count characters, not bytes. */
#include "io/pov_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <stdarg.h>
#include <string.h>

enum { STRING_MOST = 1 << 24 };

static struct pov_value value_string(struct pov *p, const char *bytes, size_t n)
{
	if (n > STRING_MOST)
		pov_stop(p, STATUS_INPUT, "a string of more than %d bytes", STRING_MOST);
	const struct pov_string *s = p->failed ? NULL : pov_string_new(&p->mem, bytes, n);
	if (!s) {
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
		return value_number(0);
	}
	return (struct pov_value){ .type = TYPE_STRING, .string = s };
}

const struct pov_string *pov_format(struct pov *p, const char *fmt, ...)
{
	char text[1024];
	va_list args;
	va_start(args, fmt);
	int n = vsnprintf(text, sizeof text, fmt, args);
	va_end(args);
	const struct pov_string *s = pov_string_new(&p->mem, text, n < 0 ? 0 : (size_t)n < sizeof text ? (size_t)n : sizeof text - 1);
	if (!s)
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	return s;
}

static size_t count_characters(const struct pov_string *s)
{
	size_t n = 0;
	for (size_t i = 0; i < s->size; i++)
		n += ((unsigned char)s->bytes[i] & 0xc0) != 0x80;
	return n;
}

/* Where the character number 'index' starts. */
static size_t byte_of(const struct pov_string *s, size_t index)
{
	size_t i = 0;
	while (i < s->size && (((unsigned char)s->bytes[i] & 0xc0) == 0x80 || index-- > 0))
		i++;
	return i;
}

static double first_character(const struct pov_string *s)
{
	const unsigned char *b = (const unsigned char *)s->bytes;
	if (s->size >= 3 && b[0] >= 0xe0)
		return (b[0] & 15) << 12 | (b[1] & 63) << 6 | (b[2] & 63);
	if (s->size >= 2 && b[0] >= 0xc0)
		return (b[0] & 31) << 6 | (b[1] & 63);
	return s->size ? b[0] : 0;
}

static struct pov_value make_character(struct pov *p, double code)
{
	unsigned c = code >= 1 && code < 65536 ? (unsigned)code : '?';
	char out[4];
	size_t n = 0;
	if (c >= 0x800)
		out[n++] = (char)(0xe0 | c >> 12);
	if (c >= 0x80)
		out[n++] = (char)(c >= 0x800 ? 0x80 | (c >> 6 & 0x3f) : 0xc0 | c >> 6);
	out[n++] = (char)(c >= 0x80 ? 0x80 | (c & 0x3f) : c);
	return value_string(p, out, n);
}

/* str's form: at least |width| characters, zeros before it where width is negative; 'places' decimals, 6 where negative. */
static void print_number(struct text *t, double x, double width, double places)
{
	int w = fabs(width) < 200 ? (int)fabs(width) : 200, d = places < 0 ? 6 : places < 200 ? (int)places : 200;
	if (width < 0)
		text_print(t, "%0*.*f", w, d, x);
	else
		text_print(t, "%*.*f", w, d, x);
}

static struct pov_value finish_text(struct pov *p, struct text *t)
{
	struct pov_value v = value_string(p, t->bytes ? t->bytes : "", t->size);
	text_free(t);
	return v;
}

static double next_float(struct pov *p)
{
	pov_accept(p, ',');
	return pov_float(p);
}

static struct pov_value call_str(struct pov *p)
{
	struct text t = { 0 };
	double x = pov_float(p), width = next_float(p), places = next_float(p);
	print_number(&t, x, width, places);
	return finish_text(p, &t);
}

static struct pov_value call_vstr(struct pov *p)
{
	struct text t = { 0 };
	long n = pov_integer(p, "a number of components", 1, 5);
	pov_accept(p, ',');
	struct pov_value v = pov_expression(p);
	pov_accept(p, ',');
	const struct pov_string *between = pov_text(p);
	double width = next_float(p), places = next_float(p);
	for (int i = 0; between && v.type == TYPE_NUMBER && i < n; i++) {
		if (i > 0)
			text_add(&t, between->bytes, between->size);
		print_number(&t, value_component(&v, i), width, places);
	}
	return finish_text(p, &t);
}

static struct pov_value call_concat(struct pov *p)
{
	struct text t = { 0 };
	do {
		const struct pov_string *s = pov_text(p);
		if (!s)
			break;
		text_add(&t, s->bytes, s->size);
		pov_accept(p, ',');
	} while (!pov_stopped(p) && t.size <= STRING_MOST && pov_peek(p)->kind != ')');
	return finish_text(p, &t);
}

static struct pov_value call_substr(struct pov *p)
{
	const struct pov_string *s = pov_text(p);
	double from = next_float(p), length = next_float(p);
	if (!s || pov_stopped(p))
		return value_number(0);
	size_t n = count_characters(s);
	if (!(from >= 1 && length >= 0 && from - 1 + length <= (double)n)) {
		if (p->options->strict)
			pov_refuse(p, "substr from %g, length %g, of %zu characters", from, length, n);
		from = from >= 1 ? (from <= (double)n + 1 ? from : (double)n + 1) : 1;
		length = length >= 0 ? (from - 1 + length <= (double)n ? length : (double)n - from + 1) : 0;
	}
	size_t first = byte_of(s, (size_t)from - 1), end = byte_of(s, (size_t)from - 1 + (size_t)length);
	return value_string(p, s->bytes + first, end - first);
}

static struct pov_value call_case(struct pov *p, bool upper)
{
	const struct pov_string *s = pov_text(p);
	char *copy = s ? pov_alloc(p, s->size + 1, 1) : NULL;
	if (!copy)
		return value_number(0);
	for (size_t i = 0; i < s->size; i++) {
		char c = s->bytes[i];
		bool other = upper ? c >= 'a' && c <= 'z' : c >= 'A' && c <= 'Z';
		copy[i] = (char)(other ? c ^ 32 : c);
	}
	return value_string(p, copy, s->size);
}

static struct pov_value call_file_exists(struct pov *p)
{
	const struct pov_string *s = pov_file_name(p);
	struct text t = { 0 };
	bool exists = s && (pov_stream_find(p, s->bytes) || pov_load(p, s->bytes, &t));
	text_free(&t);
	return value_number(exists);
}

static struct pov_value call_compare(struct pov *p)
{
	const struct pov_string *a = pov_text(p);
	pov_accept(p, ',');
	const struct pov_string *b = pov_text(p);
	int order = a && b ? strcmp(a->bytes, b->bytes) : 0;
	return value_number((order > 0) - (order < 0));
}

/* Always the same moment: scenes must not depend on when they are read. */
static struct pov_value call_datetime(struct pov *p)
{
	pov_float(p);
	if (pov_accept(p, ','))
		pov_text(p);
	return value_string(p, "2000-01-01 00:00:00Z", 20);
}

struct pov_value pov_call_string(struct pov *p, uint32_t word)
{
	const struct pov_string *s;
	switch (word) {
	case WORD_strlen: s = pov_text(p); return value_number(s ? (double)count_characters(s) : 0);
	case WORD_asc: s = pov_text(p); return value_number(s ? first_character(s) : 0);
	case WORD_val: s = pov_text(p); return value_number(s ? strtod(s->bytes, NULL) : 0);
	case WORD_strcmp: return call_compare(p);
	case WORD_file_exists: return call_file_exists(p);
	case WORD_concat: return call_concat(p);
	case WORD_str: return call_str(p);
	case WORD_vstr: return call_vstr(p);
	case WORD_substr: return call_substr(p);
	case WORD_strupr: return call_case(p, true);
	case WORD_strlwr: return call_case(p, false);
	case WORD_chr: return make_character(p, pov_float(p));
	default: return call_datetime(p);
	}
}
