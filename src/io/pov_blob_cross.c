/* Where a line passes through a blob: the square of the distance to a component is a quadratic of t in each of at most three parts (about
 * either end of a cylinder, and between), so that the field is a quartic between the places where parts begin and end. Its roots are
 * parted by the signs of its Bernstein coefficients (Lane and Riesenfeld 1981). */
#include "io/pov_blob.h"

#include <stdlib.h>

enum { PART_NUMBERS = 6, PARTS = 3, DEGREE = 4, HALVINGS = 40, STEPS = 100 };

/* strength (1 - s)^2 from t = low to high, s = base + bend (t - origin)^2. */
struct part {
	double low, high, origin, strength, base, bend;
};

_Static_assert(sizeof(struct part) == PART_NUMBERS * sizeof(double), "parts lie in an array of numbers");

struct walk {
	const struct pov_sealed_blob *blob;
	const struct pov_line *line;
	struct part *parts;
	size_t count;
	bool inside, begun; /* whether the field was below zero last; whether that is known */
};

size_t pov_blob_room(const struct pov_solid *s)
{
	/* and both ends of each */
	return (size_t)((const struct pov_sealed_blob *)s->sealed)->count * PARTS * (PART_NUMBERS + 2);
}

/* The square of the distance of p + t d to the origin, over that of the radius, within low to high. */
static void add_part(struct walk *w, const struct pov_component *c, struct vec p, struct vec d, double low, double high)
{
	double square = vec_dot(d, d);
	if (square == 0 || !(low < high))
		return;
	double origin = -vec_dot(p, d) / square;
	struct vec near = vec_add(p, vec_scale(d, origin));
	double scale = 1 / (c->radius * c->radius), base = vec_dot(near, near) * scale;
	if (base >= 1)
		return;
	double half = sqrt((1 - base) / (square * scale));
	low = fmax(low, origin - half);
	high = fmin(high, origin + half);
	if (low < high)
		w->parts[w->count++] = (struct part){ low, high, origin, c->strength, base, square * scale };
}

/* Along a cylinder the distance does not change. */
static void add_constant(struct walk *w, const struct pov_component *c, struct vec p, double low, double high)
{
	double s = vec_dot(p, p) / (c->radius * c->radius);
	if (s < 1 && low < high)
		w->parts[w->count++] = (struct part){ low, high, low, c->strength, s, 0 };
}

static void add_component(void *context, uint32_t i)
{
	struct walk *w = context;
	const struct pov_sealed_component *c = &w->blob->all[i];
	const struct pov_component *g = &c->given;
	struct vec p = vec_sub(matrix_point(w->line->from, &c->back), g->end[0]), d = matrix_direction(w->line->toward, &c->back);
	struct vec way = vec_sub(g->end[1], g->end[0]);
	double low = w->line->least, high = w->line->most, square = vec_dot(way, way);
	if (square == 0) {
		add_part(w, g, p, d, low, high);
		return;
	}
	/* Between the planes of the ends, and beyond either. */
	double at = vec_dot(p, way) / square, speed = vec_dot(d, way) / square;
	struct vec aside = vec_sub(p, vec_scale(way, at)), drift = vec_sub(d, vec_scale(way, speed)), beyond = vec_sub(p, way);
	double t = speed == 0 ? (at < 0 ? high : low) : -at / speed, u = speed == 0 ? (at > 1 ? low : high) : (1 - at) / speed;
	bool back = speed < 0;
	double enter = fmax(low, back ? u : t), leave = fmin(high, back ? t : u);
	add_part(w, g, back ? beyond : p, d, low, fmin(high, enter));
	if (vec_dot(drift, drift) <= 1e-28 * vec_dot(d, d))
		add_constant(w, g, aside, enter, leave);
	else
		add_part(w, g, aside, drift, enter, leave);
	add_part(w, g, back ? p : beyond, d, fmax(low, leave), high);
}

static bool enter_box(void *context, const struct box *b)
{
	struct pov_line line = *((const struct walk *)context)->line;
	return pov_line_clip_box(&line, b);
}

/* The field from t = low to high as a quartic's Bernstein coefficients, from its coefficients about the middle. */
static void make_quartic(const struct walk *w, double low, double high, double *b)
{
	double middle = (low + high) / 2, half = (high - low) / 2, p[DEGREE + 1] = { 0 };
	for (size_t i = 0; i < w->count; i++) {
		const struct part *q = &w->parts[i];
		if (!(q->low < middle && middle < q->high))
			continue;
		double u = middle - q->origin, x = 1 - q->base - q->bend * u * u, y = -2 * q->bend * u * half, z = -q->bend * half * half;
		double square[DEGREE + 1] = { x * x, 2 * x * y, 2 * x * z + y * y, 2 * y * z, z * z };
		for (int k = 0; k <= DEGREE; k++)
			p[k] += q->strength * square[k];
	}
	/* What the powers of v, from -1 to 1, are in Bernstein's basis. */
	static const double powers[DEGREE + 1][DEGREE + 1] = {
		{ 1, 1, 1, 1, 1 }, { -1, -0.5, 0, 0.5, 1 }, { 1, 0, -1.0 / 3, 0, 1 }, { -1, 0.5, 0, -0.5, 1 }, { 1, -1, 1, -1, 1 },
	};
	for (int i = 0; i <= DEGREE; i++)
		for (int k = 0; k <= DEGREE; k++)
			b[i] -= p[k] * powers[k][i];
}

/* De Casteljau: the value at v, from 0 to 1, and the coefficients of both sides where wanted. */
static double split(const double *b, double v, double *left, double *right)
{
	double c[DEGREE + 1];
	for (int i = 0; i <= DEGREE; i++)
		c[i] = b[i];
	for (int k = 0; k <= DEGREE; k++) {
		if (left) {
			left[k] = c[0];
			right[DEGREE - k] = c[DEGREE - k];
		}
		for (int i = 0; i < DEGREE - k; i++)
			c[i] += v * (c[i + 1] - c[i]);
	}
	return c[0];
}

/* The one root of coefficients whose signs change once. */
static double find_root(const double *b, double low, double high)
{
	double s = 0, t = 1, f = b[0], g = b[DEGREE], v = 0.5;
	for (int i = 0; i < STEPS && t - s > 1e-15; i++) {
		v = i % 3 == 2 ? (s + t) / 2 : s + (t - s) * f / (f - g);
		double x = split(b, v, NULL, NULL);
		if (x == 0)
			break;
		if ((x < 0) == (b[0] < 0)) {
			f = x;
			s = v;
		} else {
			g = x;
			t = v;
		}
	}
	return low + (high - low) * v;
}

static bool meet_roots(struct walk *w, const double *b, double low, double high, int level)
{
	int changes = 0;
	for (int i = 0; i < DEGREE; i++)
		changes += (b[i] < 0) != (b[i + 1] < 0);
	if (changes == 0 || (level == HALVINGS && changes % 2 == 0))
		return false;
	if (changes == 1 || level == HALVINGS)
		return w->line->meet(w->line->context, find_root(b, low, high));
	double left[DEGREE + 1], right[DEGREE + 1], middle = (low + high) / 2;
	split(b, 0.5, left, right);
	return meet_roots(w, left, low, middle, level + 1) || meet_roots(w, right, middle, high, level + 1);
}

/* The stretch from 'low' to 'high'; rounding may leave the root at its end to neither of two. */
static bool cross_stretch(struct walk *w, double threshold, double low, double high)
{
	double b[DEGREE + 1] = { threshold, threshold, threshold, threshold, threshold };
	make_quartic(w, low, high, b);
	if (w->begun && w->inside != (b[0] < 0) && w->line->meet(w->line->context, low))
		return true;
	w->begun = true;
	w->inside = b[DEGREE] < 0;
	return meet_roots(w, b, low, high, 0);
}

static int by_value(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

void pov_blob_cross(const struct pov_solid *s, const struct pov_line *line)
{
	struct walk w = { .blob = s->sealed, .line = line, .parts = (struct part *)(void *)line->room };
	pov_tree_visit(&w.blob->tree, enter_box, add_component, &w);
	double *ends = line->room + w.count * PART_NUMBERS;
	size_t n = 0;
	for (size_t i = 0; i < w.count; i++) {
		ends[n++] = w.parts[i].low;
		ends[n++] = w.parts[i].high;
	}
	if (n == 0)
		return;
	qsort(ends, n, sizeof *ends, by_value);
	for (size_t i = 1; i < n; i++)
		if (ends[i - 1] < ends[i] && cross_stretch(&w, s->shape.blob.threshold, ends[i - 1], ends[i]))
			return;
}
