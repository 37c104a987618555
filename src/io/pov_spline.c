/* Splines: curves through knots (t, value), t a number, the value a vector. */
#include "io/pov_reader.h"

#include <string.h>

enum { COMPONENTS = 5 };

bool pov_is_spline_kind(uint32_t word)
{
	return word == WORD_linear_spline || word == WORD_quadratic_spline || word == WORD_cubic_spline || word == WORD_natural_spline;
}

/* A knot in its place by t; one of equal t is replaced. */
static void insert(struct pov_spline_curve *s, struct pov_knot knot)
{
	size_t i = s->knots;
	while (i > 0 && s->knot[i - 1].t > knot.t)
		i--;
	if (i > 0 && s->knot[i - 1].t == knot.t) {
		s->knot[i - 1] = knot;
		return;
	}
	memmove(&s->knot[i + 1], &s->knot[i], (s->knots - i) * sizeof *s->knot);
	s->knot[i] = knot;
	s->knots++;
}

struct pov_value pov_spline_read(struct pov *p)
{
	struct pov_spline_curve *s = pov_alloc(p, 1, sizeof *s);
	size_t room = 0;
	if (!s || !pov_expect(p, '{'))
		return value_number(0);
	s->kind = WORD_linear_spline;
	const struct pov_token *t = pov_peek(p);
	const struct pov_binding *b = t->kind == TOKEN_NAME ? scope_find(&p->scope, t->name) : NULL;
	if (b && b->refers->type == TYPE_SPLINE) {
		pov_take(p);
		*s = *b->refers->spline;
		room = s->knots;
	}
	while (!pov_stopped(p) && (t = pov_peek(p))->kind != '}') {
		if (t->kind == TOKEN_NAME && pov_is_spline_kind(t->name)) {
			s->kind = t->name;
			pov_take(p);
			continue;
		}
		struct pov_knot knot = { .t = pov_float(p) };
		pov_accept(p, ',');
		struct pov_value v = pov_expression(p);
		pov_accept(p, ',');
		if (v.type != TYPE_NUMBER)
			pov_refuse(p, "%s where a vector should be", value_type_name(v.type));
		for (int i = 0; i < COMPONENTS; i++)
			knot.value[i] = value_component(&v, i);
		s->count = v.count > s->count ? v.count : s->count;
		struct pov_knot *grown = pov_grow(p, s->knot, s->knots, &room, sizeof knot);
		if (!grown)
			return value_number(0);
		s->knot = grown;
		insert(s, knot);
	}
	pov_expect(p, '}');
	if (s->knots == 0)
		pov_refuse(p, "a spline without points");
	return (struct pov_value){ .type = TYPE_SPLINE, .spline = s };
}

/* The parabola through three knots. */
static double lagrange(const struct pov_knot *k, int c, double t)
{
	double a = k[0].t, b = k[1].t, d = k[2].t;
	return k[0].value[c] * (t - b) * (t - d) / ((a - b) * (a - d)) + k[1].value[c] * (t - a) * (t - d) / ((b - a) * (b - d)) +
	       k[2].value[c] * (t - a) * (t - b) / ((d - a) * (d - b));
}

/* Hermite between knots i and i + 1, the slope of a knot the mean of those of its two chords. */
static double hermite(const struct pov_knot *k, int c, double t)
{
	double h = k[1].t - k[0].t, s = (t - k[0].t) / h, chord[3];
	for (int i = 0; i < 3; i++)
		chord[i] = (k[i].value[c] - k[i - 1].value[c]) / (k[i].t - k[i - 1].t);
	double m0 = (chord[0] + chord[1]) / 2 * h, m1 = (chord[1] + chord[2]) / 2 * h;
	return (2 * s * s * s - 3 * s * s + 1) * k[0].value[c] + (s * s * s - 2 * s * s + s) * m0 + (3 * s * s - 2 * s * s * s) * k[1].value[c] +
	       (s * s * s - s * s) * m1;
}

/* Natural cubic: second derivatives from the tridiagonal system, solved forwards only as far as needed and back to i (Thomas). */
static double natural(const struct pov_spline_curve *s, size_t i, int c, double t)
{
	const struct pov_knot *k = s->knot;
	double next = 0, here = 0;
	/* second[j] = r[j] - q[j] second[j + 1]; without an array: substitute from the far end for every span asked. */
	enum { MOST = 4096 };
	double q[MOST], r[MOST];
	size_t n = s->knots < MOST ? s->knots : MOST;
	q[0] = r[0] = 0;
	for (size_t j = 1; j + 1 < n; j++) {
		double h0 = k[j].t - k[j - 1].t, h1 = k[j + 1].t - k[j].t;
		double d = 6 * ((k[j + 1].value[c] - k[j].value[c]) / h1 - (k[j].value[c] - k[j - 1].value[c]) / h0);
		double pivot = 2 * (h0 + h1) - h0 * q[j - 1];
		q[j] = h1 / pivot;
		r[j] = (d - h0 * r[j - 1]) / pivot;
	}
	for (size_t j = n - 1; j-- > i;) {
		next = here;
		here = r[j] - q[j] * next;
	}
	double h = k[i + 1].t - k[i].t, a = (k[i + 1].t - t) / h, b = 1 - a;
	return a * k[i].value[c] + b * k[i + 1].value[c] + ((a * a * a - a) * here + (b * b * b - b) * next) * h * h / 6;
}

static double interpolate(const struct pov_spline_curve *s, uint32_t kind, size_t i, int c, double t)
{
	const struct pov_knot *k = &s->knot[i];
	switch (kind) {
	case WORD_quadratic_spline:
		if (s->knots >= 3)
			return lagrange(i == 0 ? k : k - 1, c, t);
		break;
	case WORD_natural_spline: return natural(s, i, c, t);
	case WORD_cubic_spline: return hermite(k, c, t);
	default: break;
	}
	return k[0].value[c] + (k[1].value[c] - k[0].value[c]) * ((t - k[0].t) / (k[1].t - k[0].t));
}

struct pov_value pov_spline_value(const struct pov_spline_curve *s, double t, uint32_t kind)
{
	struct pov_value v = { .type = TYPE_NUMBER, .count = (uint8_t)s->count };
	kind = kind ? kind : s->kind;
	bool controls = kind == WORD_cubic_spline && s->knots >= 4;
	if (kind == WORD_cubic_spline && !controls)
		kind = WORD_linear_spline;
	size_t first = controls ? 1 : 0, last = s->knots - (controls ? 2 : 1), i = first;
	t = t > s->knot[first].t ? (t < s->knot[last].t ? t : s->knot[last].t) : s->knot[first].t;
	while (i + 1 < last && s->knot[i + 1].t <= t)
		i++;
	for (int c = 0; c < v.count; c++)
		v.a[c] = first == last ? s->knot[first].value[c] : interpolate(s, kind, i, c, t);
	return v;
}
