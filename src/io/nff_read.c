/* Reading NFF.
 *
 * A file is a row of records; each starts with a keyword, then its numbers, all separated by any white space; '#' starts a
 * comment that ends with the line.
 *
 *   v                        the view: from, at, up (x y z), angle, hither, resolution (w h), in any order, some may be missing
 *   b r g b                  background
 *   l x y z [r g b]          light
 *   f r g b kd ks shine t ior [more, ignored]   material of what follows
 *   s x y z r                sphere
 *   c x y z r x y z r        cone: base, apex
 *   p n, then n x y z        polygon
 *   pp n, then n x y z nx ny nz   patch
 *
 * viewpoint, background, light, surface, sphere, cone, polygon and patch are the same keywords spelled out. Of several views or
 * backgrounds the last one counts. Numbers are decimal; nan, infinity and hexadecimal are none. Where the reader is not strict it
 * skips, and counts, unknown keywords with the rest of their line, polygons of fewer than three corners and spheres of no size. */
#include "io/nff.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TOKEN_MOST = 64 };

struct reader {
	struct scene *scene;
	const char *name, *at, *end;
	long line, record; /* where it is; where the record at hand starts */
	char token[TOKEN_MOST]; /* the one last read, NUL-terminated; empty at the end of the file */
	const char *token_at;   /* where it starts */
	bool strict;
	struct nff_skipped *skipped;
	struct err *err;
};

__attribute__((format(printf, 3, 4)))
static int refuse(struct reader *r, long line, const char *fmt, ...)
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

static void skip_line(struct reader *r)
{
	while (r->at < r->end && *r->at != '\n')
		r->at++;
}

static void skip_space(struct reader *r)
{
	for (; r->at < r->end; r->at++) {
		if (*r->at == '#') {
			skip_line(r);
			if (r->at == r->end)
				return;
		}
		if (!is_space(*r->at))
			return;
		r->line += *r->at == '\n';
	}
}

/* The next token into r->token; 0 also at the end of the file, where it is empty. */
static int next_token(struct reader *r)
{
	size_t n = 0;
	skip_space(r);
	r->token_at = r->at;
	for (; r->at < r->end && !is_space(*r->at) && *r->at != '#'; r->at++) {
		unsigned char c = (unsigned char)*r->at;
		if (c < 0x20 || c >= 0x7f)
			return refuse(r, r->line, "binary data (byte 0x%02x), not NFF", c);
		if (n + 1 == sizeof r->token)
			return refuse(r, r->line, "a word of more than %d characters", TOKEN_MOST - 1);
		r->token[n++] = *r->at;
	}
	r->token[n] = '\0';
	return 0;
}

static void put_back(struct reader *r)
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
static bool parse_number(const char *token, double *x)
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

/* n numbers; 'what' names the record in messages. */
static int read_numbers(struct reader *r, const char *what, double *x, int n)
{
	for (int i = 0; i < n; i++) {
		if (next_token(r) != 0)
			return -1;
		if (!*r->token)
			return refuse(r, r->line, "the file ends within %s", what);
		if (!parse_number(r->token, &x[i]))
			return refuse(r, r->line, "%s: '%s' is not a number", what, r->token);
	}
	return 0;
}

static int read_vec(struct reader *r, const char *what, struct vec *v)
{
	return read_numbers(r, what, v->a, 3);
}

/* Whether a number follows; reads up to 'most' of them into x. Returns how many, or -1. */
static int read_more(struct reader *r, double *x, int most)
{
	int n = 0;
	while (n < most) {
		double value;
		if (next_token(r) != 0)
			return -1;
		if (!*r->token || !parse_number(r->token, &value)) {
			put_back(r);
			return n;
		}
		x[n++] = value;
	}
	return n;
}

static void note_skipped(struct reader *r)
{
	if (r->skipped->records++ == 0)
		r->skipped->first_line = (uint32_t)r->record;
}

static int read_view(struct reader *r)
{
	static const char *const words[] = { "from", "at", "up", "angle", "hither", "resolution" };
	static const int counts[] = { 3, 3, 3, 1, 1, 2 };
	double x[6][3] = { { 0, 0, 1 }, { 0, 0, 0 }, { 0, 1, 0 }, { 45 }, { 0 }, { 512, 512 } };
	for (;;) {
		int k = 0;
		if (next_token(r) != 0)
			return -1;
		while (k < 6 && strcmp(r->token, words[k]) != 0)
			k++;
		if (k == 6)
			break;
		if (read_numbers(r, words[k], x[k], counts[k]) != 0)
			return -1;
	}
	put_back(r);
	for (int i = 0; i < 2; i++)
		if (!(x[5][i] >= 1 && x[5][i] <= 1e6 && x[5][i] == floor(x[5][i])))
			return refuse(r, r->record, "resolution: %g is not a whole number from 1 to 1000000", x[5][i]);
	scene_set_view(r->scene, vec(x[0][0], x[0][1], x[0][2]), vec(x[1][0], x[1][1], x[1][2]), vec(x[2][0], x[2][1], x[2][2]),
	               x[3][0], x[4][0], (int)x[5][0], (int)x[5][1]);
	return 0;
}

static int read_background(struct reader *r)
{
	double x[3];
	if (read_numbers(r, "a background", x, 3) != 0)
		return -1;
	scene_set_background(r->scene, x[0], x[1], x[2]);
	return 0;
}

static int read_light(struct reader *r)
{
	struct vec at;
	double x[3];
	if (read_vec(r, "a light", &at) != 0)
		return -1;
	int n = read_more(r, x, 3);
	if (n < 0)
		return -1;
	if (n == 3)
		scene_add_colored_light(r->scene, at, (struct color){ x[0], x[1], x[2] });
	else if (n == 0)
		scene_add_light(r->scene, at);
	else
		return refuse(r, r->record, "a light has 3 or 6 numbers, not %d", 3 + n);
	return 0;
}

static int read_material(struct reader *r)
{
	double x[8], ignored;
	int n;
	if (read_numbers(r, "a material", x, 8) != 0)
		return -1;
	while ((n = read_more(r, &ignored, 1)) == 1)
		if (r->strict)
			return refuse(r, r->record, "a material has 8 numbers");
	scene_add_material(r->scene, (struct material){ { x[0], x[1], x[2] }, x[3], x[4], x[5], x[6], x[7] });
	return n;
}

static int read_sphere(struct reader *r)
{
	double x[4];
	if (read_numbers(r, "a sphere", x, 4) != 0)
		return -1;
	if (x[3] == 0) {
		if (r->strict)
			return refuse(r, r->record, "a sphere of radius 0");
		note_skipped(r);
		return 0;
	}
	scene_add_sphere(r->scene, vec(x[0], x[1], x[2]), x[3]);
	return 0;
}

static int read_cone(struct reader *r)
{
	double x[8];
	if (read_numbers(r, "a cone", x, 8) != 0)
		return -1;
	if (x[3] * x[7] < 0)
		return refuse(r, r->record, "a cone with radii %g and %g of different sign", x[3], x[7]);
	struct vec base = vec(x[0], x[1], x[2]), apex = vec(x[4], x[5], x[6]);
	if (vec_length(vec_sub(apex, base)) == 0)
		return refuse(r, r->record, "a cone whose base is its apex");
	if (x[3] == 0 && x[7] == 0)
		return refuse(r, r->record, "a cone with both radii 0");
	scene_add_cone(r->scene, base, x[3], apex, x[7]);
	return 0;
}

/* A polygon or patch; 'numbers' a corner. The count is believed only as far as the rest of the file can hold it. */
static int read_corners(struct reader *r, const char *what, int numbers)
{
	double count;
	if (read_numbers(r, what, &count, 1) != 0)
		return -1;
	if (!(count >= 0 && count == floor(count)))
		return refuse(r, r->record, "%s of %g corners", what, count);
	size_t fits = (size_t)(r->end - r->at) / (2 * (size_t)numbers) + 1;
	if (count > (double)fits || count > INT_MAX)
		return refuse(r, r->record, "%s of %.0f corners cannot fit in the rest of the file", what, count);
	size_t n = (size_t)count;
	struct vec few[2 * 16], *p = n <= 16 ? few : malloc(2 * n * sizeof *p);
	if (!p)
		return err_memory(r->err, r->name);
	int status = 0;
	for (size_t i = 0; status == 0 && i < n; i++) {
		status = read_vec(r, what, &p[i]);
		if (status == 0 && numbers == 6)
			status = read_vec(r, what, &p[n + i]);
	}
	if (status == 0 && n < 3) {
		if (r->strict)
			status = refuse(r, r->record, "%s of %zu corners", what, n);
		note_skipped(r);
	} else if (status == 0 && numbers == 6) {
		scene_add_patch(r->scene, p, p + n, n);
	} else if (status == 0) {
		scene_add_polygon(r->scene, p, n);
	}
	if (p != few)
		free(p);
	return status;
}

static int read_polygon(struct reader *r)
{
	return read_corners(r, "a polygon", 3);
}

static int read_patch(struct reader *r)
{
	return read_corners(r, "a patch", 6);
}

static const struct record {
	const char *word, *spelled;
	int (*read)(struct reader *r);
} records[] = {
	{ "v", "viewpoint", read_view },  { "b", "background", read_background }, { "l", "light", read_light },
	{ "f", "surface", read_material }, { "s", "sphere", read_sphere },        { "c", "cone", read_cone },
	{ "p", "polygon", read_polygon }, { "pp", "patch", read_patch },
};

static int read_record(struct reader *r)
{
	r->record = r->line;
	for (size_t i = 0; i < sizeof records / sizeof *records; i++)
		if (strcmp(r->token, records[i].word) == 0 || strcmp(r->token, records[i].spelled) == 0)
			return records[i].read(r);
	double x;
	if (parse_number(r->token, &x))
		return refuse(r, r->record, "the number '%s' where a keyword should be", r->token);
	if (r->strict)
		return refuse(r, r->record, "unknown keyword '%s'; known are v b l f s c p pp", r->token);
	note_skipped(r);
	skip_line(r);
	return 0;
}

int nff_read(struct scene *s, const char *name, const char *text, size_t n, bool strict, struct nff_skipped *skipped,
             struct err *e)
{
	struct reader r = { .scene = s, .name = name, .at = text, .end = text + n, .line = 1, .strict = strict,
		            .skipped = skipped, .err = e };
	*skipped = (struct nff_skipped){ 0 };
	if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
		r.at += 3;
	for (bool first = true;; first = false) {
		if (next_token(&r) != 0)
			return -1;
		if (!*r.token)
			return scene_complete(s, name, e);
		if (first && strcmp(r.token, "nff") == 0)
			return refuse(&r, r.line, "this is WorldToolKit (Sense8) NFF, another format of the same name");
		if (read_record(&r) != 0)
			return -1;
		if (s->lost)
			return scene_complete(s, name, e);
	}
}
