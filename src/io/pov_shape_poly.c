/* quadric, and poly of orders up to 35 (cubic, quartic): the zeros of polynomials. */
#include "io/pov_march.h"
#include "io/pov_poly.h"

enum { ORDER_MOST = 35, TIGHTENINGS = 4, SEARCHES = 4, FINER = 4, SEEN_CELLS = 30, BLOCKS_A_SEGMENT = 256 };

/* Cells across the box: along its longest side at least and at most, along its shortest at least. */
enum { QUADRIC_CELLS = 32, POLY_CELLS = 60, ACROSS = 12, CELLS_MOST = 240 };

struct term {
	double c;
	int power[3];
};

struct sealed {
	struct term *terms;
	size_t count;
	int order;
};

/* Powers of x fall from the order to 0, for each of them those of y, for each of them those of z. */
static int seal_terms(struct arena *a, struct pov_solid *s, int order, const double *c, struct err *e)
{
	size_t most = (size_t)(order + 1) * (size_t)(order + 2) * (size_t)(order + 3) / 6;
	struct sealed *q = NEW(a, struct sealed, 1);
	if (!q || !(q->terms = NEW(a, struct term, most)))
		return err_memory(e, "poly");
	q->order = order;
	for (int i = order; i >= 0; i--)
		for (int j = order - i; j >= 0; j--)
			for (int k = order - i - j; k >= 0; k--, c++)
				if (*c != 0)
					q->terms[q->count++] = (struct term){ *c, { i, j, k } };
	s->sealed = q;
	return 0;
}

static int seal_poly(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_poly *p = &s->shape.poly;
	*why = "poly of an order other than 2 to 35";
	return p->order < 2 || p->order > ORDER_MOST ? 1 : seal_terms(a, s, p->order, p->coefficients, e);
}

static int seal_quadric(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const double *c = s->shape.quadric.coefficient;
	double terms[10] = { c[0], c[3], c[4], c[6], c[1], c[5], c[7], c[2], c[8], c[9] };
	(void)why;
	return seal_terms(a, s, 2, terms, e);
}

static void fill_powers(double (*power)[ORDER_MOST + 1], int order, struct vec p)
{
	for (int a = 0; a < 3; a++) {
		power[a][0] = 1;
		for (int i = 1; i <= order; i++)
			power[a][i] = power[a][i - 1] * p.a[a];
	}
}

static double poly_field(const struct pov_solid *s, struct vec p)
{
	const struct sealed *q = s->sealed;
	double power[3][ORDER_MOST + 1], sum = 0;
	fill_powers(power, q->order, p);
	for (size_t i = 0; i < q->count; i++) {
		const struct term *t = &q->terms[i];
		sum += t->c * power[0][t->power[0]] * power[1][t->power[1]] * power[2][t->power[2]];
	}
	return sum;
}

/* |product of (x + dx) - product of x| is at most the product of (|x| + r) less that of |x|. */
static double poly_reach(const struct pov_solid *s, struct vec p, double r)
{
	const struct sealed *q = s->sealed;
	double near[3][ORDER_MOST + 1], far[3][ORDER_MOST + 1], sum = 0;
	struct vec size = vec(fabs(p.x), fabs(p.y), fabs(p.z));
	fill_powers(near, q->order, size);
	fill_powers(far, q->order, vec_add(size, vec(r, r, r)));
	for (size_t i = 0; i < q->count; i++) {
		const int *k = q->terms[i].power;
		sum += fabs(q->terms[i].c) * (far[0][k[0]] * far[1][k[1]] * far[2][k[2]] - near[0][k[0]] * near[1][k[1]] * near[2][k[2]]);
	}
	return sum;
}

static struct box poly_bounds(const struct pov_solid *s)
{
	(void)s;
	return box_infinite();
}

static struct box quadric_bounds(const struct pov_solid *s)
{
	struct box all = box_infinite();
	return pov_quadric_tighten(s, false, &all);
}

/* The least of a x^2 + b x on an interval, perhaps -INFINITY. */
static double least_value(double a, double b, double lo, double hi)
{
	double least = INFINITY, vertex = a != 0 ? -b / (2 * a) : 0;
	for (int k = 0; k < 2; k++) {
		double x = k ? hi : lo;
		double f = isfinite(x) ? x * (a * x + b) : a != 0 ? copysign(INFINITY, a) : b != 0 ? b * x : 0;
		least = fmin(least, f);
	}
	if (a > 0 && vertex > lo && vertex < hi)
		least = fmin(least, vertex * (a * vertex + b));
	return least;
}

/* Cut [*lo, *hi] to where a x^2 + b x + c <= 0 may be. */
static void tighten_axis(double a, double b, double c, double *lo, double *hi)
{
	if (!isfinite(c))
		return;
	if (a == 0) {
		if (b > 0)
			*hi = fmin(*hi, -c / b);
		else if (b < 0)
			*lo = fmax(*lo, -c / b);
		else if (c > 0)
			*hi = -INFINITY;
		return;
	}
	double square = b * b - 4 * a * c;
	if (square < 0) {
		if (a > 0)
			*hi = -INFINITY;
		return;
	}
	double root = sqrt(square), r = (-b - root) / (2 * a), t = (-b + root) / (2 * a);
	if (a > 0) {
		*lo = fmax(*lo, r);
		*hi = fmin(*hi, t);
	} else if (*lo > t) { /* between the roots, t first, it is outside */
		*lo = fmax(*lo, r);
	} else if (*hi < r) {
		*hi = fmin(*hi, t);
	}
}

struct box pov_quadric_tighten(const struct pov_solid *s, bool inverse, const struct box *within)
{
	struct box b = *within;
	const double *c = s->shape.quadric.coefficient;
	double sign = inverse ? -1 : 1;
	if (c[3] != 0 || c[4] != 0 || c[5] != 0)
		return b;
	for (int round = 0; round < TIGHTENINGS; round++)
		for (int a = 0; a < 3; a++) {
			double rest = sign * c[9];
			for (int k = 1; k < 3; k++) {
				int o = (a + k) % 3;
				rest += least_value(sign * c[o], sign * c[6 + o], b.lo.a[o], b.hi.a[o]);
			}
			tighten_axis(sign * c[a], sign * c[6 + a], rest, &b.lo.a[a], &b.hi.a[a]);
			if (box_is_empty(&b))
				return box_empty();
		}
	return b;
}

static double find_step(const struct pov_solid *s, const struct box *b, int n)
{
	struct vec side = vec_sub(b->hi, b->lo);
	double least = fmin(side.x, fmin(side.y, side.z)), most = box_longest(b);
	double step = fmin(least / ACROSS, most / (s->kind == POV_QUADRIC ? QUADRIC_CELLS : POLY_CELLS));
	return fmax(step * 32 / n, most / CELLS_MOST);
}

/* Where the surface is; one that is small in the box is looked for with finer grids, until it is many cells wide, or so many blocks are
 * in doubt, for the resolution n, that they are no small part of the box. */
static struct box find_surface(const struct pov_solid *s, const struct box *b, int n, double *step)
{
	struct box found = box_empty();
	size_t blocks = 0, most = (size_t)n * BLOCKS_A_SEGMENT;
	for (int i = 0; i < SEARCHES && blocks <= most && (box_is_empty(&found) || box_longest(&found) < SEEN_CELLS * *step); i++) {
		*step /= i ? FINER : 1;
		struct box seen = box_enlarge(b, *step);
		found = pov_march_extent(s, &seen, *step, &blocks);
	}
	return found;
}

/* Look where the surface is, closer and closer, then make it there. */
static void mesh_poly(const struct pov_solid *s, const struct pov_drawing *d)
{
	struct box own = pov_shape_of(s)->bounds(s), box = box_common(&own, &d->region);
	for (int i = 0; i < TIGHTENINGS && !box_is_empty(&box); i++) {
		double step = find_step(s, &box, d->n);
		struct box found = find_surface(s, &box, d->n, &step), wide = box_enlarge(&found, step), seen = box_enlarge(&box, step);
		if (box_is_empty(&found))
			return;
		found = box_common(&wide, &seen);
		bool enough = box_longest(&found) > 0.7 * box_longest(&box);
		box = found;
		if (enough)
			break;
	}
	if (!box_is_empty(&box))
		pov_march(s, &box, find_step(s, &box, d->n), d);
}

const struct pov_shape pov_shape_quadric = {
	.name = "quadric", .seal = seal_quadric, .bounds = quadric_bounds, .field = poly_field, .reach = poly_reach, .mesh = mesh_poly,
};
const struct pov_shape pov_shape_poly = {
	.name = "poly", .seal = seal_poly, .bounds = poly_bounds, .field = poly_field, .reach = poly_reach, .mesh = mesh_poly,
};
