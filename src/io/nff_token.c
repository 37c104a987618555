#include "io/nff_token.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

int nff_refuse(struct nff_reader *r, long line, const char *fmt, ...)
{
	char why[256];
	va_list args;
	va_start(args, fmt);
	vsnprintf(why, sizeof why, fmt, args);
	va_end(args);
	return err_at(r->err, STATUS_INPUT, r->name, line, "%s", why);
}

static bool is_space(char c)
{
	return c == ' ' || (c >= '\t' && c <= '\r');
}

void nff_skip_line(struct nff_reader *r)
{
	while (r->at < r->end && *r->at != '\n')
		r->at++;
}

static bool is_comment(const struct nff_reader *r, char c)
{
	return c == '#' || (c == '%' && r->percent);
}

static void skip_space(struct nff_reader *r)
{
	for (; r->at < r->end; r->at++) {
		if (is_comment(r, *r->at)) {
			nff_skip_line(r);
			if (r->at == r->end)
				return;
		}
		if (!is_space(*r->at))
			return;
		r->line += *r->at == '\n';
	}
}

int nff_next(struct nff_reader *r)
{
	size_t n = 0;
	skip_space(r);
	r->token_at = r->at;
	for (; r->at < r->end && !is_space(*r->at) && !is_comment(r, *r->at); r->at++) {
		unsigned char c = (unsigned char)*r->at;
		if (c < 0x20 || c >= 0x7f)
			return nff_refuse(r, r->line, "binary data (byte 0x%02x), not NFF", c);
		if (n + 1 == sizeof r->token)
			return nff_refuse(r, r->line, "a word of more than %d characters", NFF_TOKEN_MOST - 1);
		r->token[n++] = *r->at;
	}
	r->token[n] = '\0';
	return 0;
}

void nff_put_back(struct nff_reader *r)
{
	r->at = r->token_at;
}

/* Decimal digits into *mantissa while they fit; returns how many characters were digits. */
static int read_digits(const char **p, uint64_t *mantissa, int *kept)
{
	int digits = 0;
	for (; **p >= '0' && **p <= '9'; ++*p, digits++)
		if (*mantissa < UINT64_C(100000000000000000)) {
			*mantissa = *mantissa * 10 + (uint64_t)(**p - '0');
			++*kept;
		}
	return digits;
}

/* The value of a decimal number. Where the mantissa and the power of ten are both exact doubles, one operation rounds correctly;
 * the rest is strtod's. */
bool nff_number(const char *token, double *x)
{
	static const double power[] = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
		                        1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
	const char *p = token;
	bool negative = *p == '-';
	uint64_t mantissa = 0;
	int kept = 0;
	p += *p == '-' || *p == '+';
	int whole = read_digits(&p, &mantissa, &kept), whole_kept = kept, part = 0;
	if (*p == '.') {
		p++;
		part = read_digits(&p, &mantissa, &kept);
	}
	if (whole + part == 0)
		return false;
	bool complete = kept == whole + part;
	int exponent = -(kept - whole_kept);
	if (*p == 'e' || *p == 'E') {
		char *end;
		const char *digits = p + 1 + (p[1] == '-' || p[1] == '+');
		if (*digits < '0' || *digits > '9')
			return false;
		long e = strtol(p + 1, &end, 10);
		exponent = e < -100000 || e > 100000 ? 100000 : exponent + (int)e;
		p = end;
	}
	if (*p)
		return false;
	if (complete && mantissa <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22) {
		double m = (double)mantissa;
		*x = exponent < 0 ? m / power[-exponent] : m * power[exponent];
		*x = negative ? -*x : *x;
		return true;
	}
	*x = strtod(token, NULL);
	return isfinite(*x);
}

int nff_read_numbers(struct nff_reader *r, const char *what, double *x, int n)
{
	for (int i = 0; i < n; i++) {
		if (nff_next(r) != 0)
			return -1;
		if (!*r->token)
			return nff_refuse(r, r->line, "the file ends within %s", what);
		if (!nff_number(r->token, &x[i]))
			return nff_refuse(r, r->line, "%s: '%s' is not a number", what, r->token);
	}
	return 0;
}

int nff_read_vec(struct nff_reader *r, const char *what, struct vec *v)
{
	return nff_read_numbers(r, what, v->a, 3);
}

int nff_read_more(struct nff_reader *r, double *x, int most)
{
	int n = 0;
	while (n < most) {
		double value;
		if (nff_next(r) != 0)
			return -1;
		if (!*r->token || !nff_number(r->token, &value)) {
			nff_put_back(r);
			return n;
		}
		x[n++] = value;
	}
	return n;
}

void nff_note_skipped(struct nff_reader *r)
{
	if (r->skipped->records++ == 0)
		r->skipped->first_line = (uint32_t)r->record;
}

int nff_read_count(struct nff_reader *r, const char *what, int numbers, size_t *count)
{
	double value;
	if (nff_read_numbers(r, what, &value, 1) != 0)
		return -1;
	if (!(value >= 0 && value == floor(value)))
		return nff_refuse(r, r->record, "%s of %g corners", what, value);
	size_t fits = (size_t)(r->end - r->at) / (2 * (size_t)numbers) + 1;
	if (value > (double)fits || value > INT_MAX)
		return nff_refuse(r, r->record, "%s of %.0f corners cannot fit in the rest of the file", what, value);
	*count = (size_t)value;
	return 0;
}
