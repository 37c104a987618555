/* The inside of an outline as triangles. Loops that keep apart are joined to one polygon, each hole by a bridge to a corner that
 * sees it (Eberly, "Triangulation by ear clipping", section 3), and cut by ears. Where loops cross or touch, the plane is cut into strips
 * between all heights of corners and crossings, in which the even-odd inside is a row of trapezoids. */
#include "io/pov_outline.h"

#include "scene/triangulate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct filler {
	const struct pov_outline *o;
	struct arena *scratch;
	pov_fill_fn *triangle;
	void *context;
	size_t *loop_of;         /* of each point */
	struct vec *ring;        /* the polygon being joined */
	size_t ring_count;
	size_t *depth, *parent;  /* of each loop */
};

static double turn(const double *a, const double *b, const double *c)
{
	return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool same(const double *a, const double *b)
{
	return a[0] == b[0] && a[1] == b[1];
}

/* Whether the closed segments have a point in common that is no shared end. */
static bool crosses(const double *a, const double *b, const double *c, const double *d)
{
	if (fmax(a[0], b[0]) < fmin(c[0], d[0]) || fmin(a[0], b[0]) > fmax(c[0], d[0]) || fmax(a[1], b[1]) < fmin(c[1], d[1]) ||
	    fmin(a[1], b[1]) > fmax(c[1], d[1]))
		return false;
	double s = turn(a, b, c), t = turn(a, b, d), u = turn(c, d, a), v = turn(c, d, b);
	if (same(a, c) || same(a, d) || same(b, c) || same(b, d))
		return false;
	return !((s > 0 && t > 0) || (s < 0 && t < 0) || (u > 0 && v > 0) || (u < 0 && v < 0));
}

/* Neighbouring edges share their end; any other meeting makes the outline one that touches itself. */
static bool keeps_apart(const struct filler *f)
{
	const struct pov_outline *o = f->o;
	for (size_t i = 0; i < o->count; i++) {
		size_t ni = pov_outline_next(o, f->loop_of[i], i);
		for (size_t j = i + 1; j < o->count; j++) {
			size_t nj = pov_outline_next(o, f->loop_of[j], j);
			if (j == ni || nj == i)
				continue;
			if (crosses(o->at[i], o->at[ni], o->at[j], o->at[nj]) || same(o->at[i], o->at[j]))
				return false;
		}
	}
	return true;
}

static double loop_area(const struct pov_outline *o, size_t l)
{
	double sum = 0;
	for (size_t i = o->first[l]; i < o->first[l + 1]; i++)
		sum += turn(o->at[o->first[l]], o->at[i], o->at[pov_outline_next(o, l, i)]);
	return sum / 2;
}

static bool loop_holds(const struct pov_outline *o, size_t l, const double *p)
{
	struct pov_outline one = { .at = o->at, .first = o->first + l, .loops = 1 };
	return pov_outline_inside(&one, p[0], p[1]);
}

/* Loops at even depth bound inside; a hole belongs to the deepest of those about it. */
static void nest(struct filler *f)
{
	const struct pov_outline *o = f->o;
	for (size_t l = 0; l < o->loops; l++)
		for (size_t m = 0; m < o->loops; m++)
			f->depth[l] += m != l && loop_holds(o, m, o->at[o->first[l]]);
	for (size_t l = 0; l < o->loops; l++)
		for (size_t m = 0; m < o->loops; m++)
			if (m != l && f->depth[m] + 1 == f->depth[l] && loop_holds(o, m, o->at[o->first[l]]))
				f->parent[l] = m;
}

/* Append a loop to the ring, starting at its point 'from', counter-clockwise or not. */
static void append_loop(struct filler *f, size_t l, size_t from, bool forward)
{
	const struct pov_outline *o = f->o;
	size_t first = o->first[l], n = o->first[l + 1] - first;
	for (size_t k = 0; k < n; k++) {
		size_t i = first + (from - first + (forward ? k : n - k)) % n;
		f->ring[f->ring_count++] = vec(o->at[i][0], o->at[i][1], 0);
	}
}

/* Whether the direction from ring corner i to p goes into the ring's inside. */
static bool looks_inward(const struct filler *f, size_t i, const double *p)
{
	const double *a = f->ring[i ? i - 1 : f->ring_count - 1].a, *b = f->ring[i].a, *c = f->ring[i + 1 < f->ring_count ? i + 1 : 0].a;
	bool left_in = turn(a, b, p) > 0, left_out = turn(b, c, p) > 0;
	return turn(a, b, c) > 0 ? left_in && left_out : left_in || left_out;
}

static bool sees(const struct filler *f, size_t i, size_t outer, const double *p)
{
	const struct pov_outline *o = f->o;
	if (!looks_inward(f, i, p))
		return false;
	for (size_t k = 0; k < f->ring_count; k++)
		if (crosses(f->ring[i].a, p, f->ring[k].a, f->ring[k + 1 < f->ring_count ? k + 1 : 0].a))
			return false;
	for (size_t l = 0; l < o->loops; l++) {
		if (f->depth[l] % 2 == 0 || f->parent[l] != outer)
			continue;
		for (size_t k = o->first[l]; k < o->first[l + 1]; k++)
			if (crosses(f->ring[i].a, p, o->at[k], o->at[pov_outline_next(o, l, k)]))
				return false;
	}
	return true;
}

/* Join hole l by a bridge between its rightmost point and the nearest ring corner that sees it. */
static bool join_hole(struct filler *f, size_t outer, size_t l)
{
	const struct pov_outline *o = f->o;
	size_t right = o->first[l], best = SIZE_MAX;
	for (size_t i = right; i < o->first[l + 1]; i++)
		if (o->at[i][0] > o->at[right][0])
			right = i;
	double nearest = INFINITY;
	for (size_t i = 0; i < f->ring_count; i++) {
		double far = hypot(f->ring[i].x - o->at[right][0], f->ring[i].y - o->at[right][1]);
		if (far < nearest && sees(f, i, outer, o->at[right])) {
			nearest = far;
			best = i;
		}
	}
	if (best == SIZE_MAX)
		return false;
	size_t n = o->first[l + 1] - o->first[l], behind = f->ring_count - best;
	memmove(f->ring + best + n + 2, f->ring + best, behind * sizeof *f->ring);
	size_t whole = f->ring_count + n + 2;
	f->ring_count = best + 1;
	append_loop(f, l, right, loop_area(o, l) < 0);
	f->ring[f->ring_count++] = vec(o->at[right][0], o->at[right][1], 0);
	f->ring_count = whole;
	return true;
}

/* The next hole of the loop, the rightmost first; SIZE_MAX after the last. */
static size_t next_hole(const struct filler *f, size_t outer, bool *done)
{
	const struct pov_outline *o = f->o;
	size_t best = SIZE_MAX;
	double right = -INFINITY;
	for (size_t l = 0; l < o->loops; l++) {
		if (done[l] || f->depth[l] % 2 == 0 || f->parent[l] != outer)
			continue;
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++)
			if (o->at[i][0] > right) {
				right = o->at[i][0];
				best = l;
			}
	}
	return best;
}

/* One loop at even depth with its holes: 0 done, 1 it cannot be done so, -1 memory. */
static int fill_loop(struct filler *f, size_t outer, bool *done)
{
	double area = fabs(loop_area(f->o, outer)), sum = 0;
	f->ring_count = 0;
	append_loop(f, outer, f->o->first[outer], loop_area(f->o, outer) > 0);
	for (size_t l; (l = next_hole(f, outer, done)) != SIZE_MAX; done[l] = true) {
		if (!join_hole(f, outer, l))
			return 1;
		area -= fabs(loop_area(f->o, l));
	}
	uint32_t *triples = NEW(f->scratch, uint32_t, 3 * f->ring_count);
	if (!triples || triangulate_polygon(f->ring, f->ring_count, triples, f->scratch) != 0)
		return -1;
	size_t n = f->ring_count - 2;
	for (size_t k = 0; k < n; k++)
		sum += fabs(turn(f->ring[triples[3 * k]].a, f->ring[triples[3 * k + 1]].a, f->ring[triples[3 * k + 2]].a)) / 2;
	if (fabs(sum - area) > 1e-9 * area)
		return 1;
	for (size_t k = 0; k < n; k++)
		f->triangle(f->context, f->ring[triples[3 * k]].a, f->ring[triples[3 * k + 1]].a, f->ring[triples[3 * k + 2]].a);
	return 0;
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* An edge within a strip: where it is at the strip's low and high end. */
struct side {
	double middle, low, high;
};

static int compare_sides(const void *a, const void *b)
{
	return compare(&((const struct side *)a)->middle, &((const struct side *)b)->middle);
}

/* Heights of corners and crossings, sorted; *heights from malloc. SIZE_MAX when memory is out. */
static size_t find_heights(const struct filler *f, double **heights)
{
	const struct pov_outline *o = f->o;
	size_t n = 0, room = 2 * o->count;
	double *y = malloc(room * sizeof *y);
	for (size_t i = 0; y && i < o->count; i++) {
		size_t ni = pov_outline_next(o, f->loop_of[i], i);
		y[n++] = o->at[i][1];
		for (size_t j = i + 1; y && j < o->count; j++) {
			const double *a = o->at[i], *b = o->at[ni], *c = o->at[j], *d = o->at[pov_outline_next(o, f->loop_of[j], j)];
			double s = turn(c, d, a), t = turn(c, d, b);
			if (s == t || !crosses(a, b, c, d))
				continue;
			y[n++] = a[1] + s / (s - t) * (b[1] - a[1]);
			if (n + o->count - i > room) {
				room *= 2;
				double *grown = realloc(y, room * sizeof *y);
				if (!grown)
					free(y);
				y = grown;
			}
		}
	}
	if (y)
		qsort(y, n, sizeof *y, compare);
	*heights = y;
	return y ? n : SIZE_MAX;
}

static void fill_strip(const struct filler *f, double low, double high, struct side *sides)
{
	const struct pov_outline *o = f->o;
	double middle = (low + high) / 2;
	size_t n = 0;
	for (size_t i = 0; i < o->count; i++) {
		const double *a = o->at[i], *b = o->at[pov_outline_next(o, f->loop_of[i], i)];
		if ((a[1] > middle) == (b[1] > middle))
			continue;
		double slope = (b[0] - a[0]) / (b[1] - a[1]);
		sides[n++] = (struct side){ a[0] + (middle - a[1]) * slope, a[0] + (low - a[1]) * slope, a[0] + (high - a[1]) * slope };
	}
	qsort(sides, n, sizeof *sides, compare_sides);
	for (size_t i = 0; i + 1 < n; i += 2) {
		double p[4][2] = { { sides[i].low, low }, { sides[i + 1].low, low }, { sides[i + 1].high, high }, { sides[i].high, high } };
		f->triangle(f->context, p[0], p[1], p[2]);
		f->triangle(f->context, p[0], p[2], p[3]);
	}
}

static int fill_strips(const struct filler *f)
{
	double *heights;
	size_t n = find_heights(f, &heights);
	struct side *sides = malloc((f->o->count + 1) * sizeof *sides);
	for (size_t i = 0; n != SIZE_MAX && sides && i + 1 < n; i++)
		if (heights[i + 1] > heights[i])
			fill_strip(f, heights[i], heights[i + 1], sides);
	free(sides);
	free(heights);
	return n == SIZE_MAX || !sides ? -1 : 0;
}

/* Triangles are kept until all loops are done, for the strips may have to do it all again. */
struct kept {
	struct arena *mem;
	double (*corner)[2];
	size_t count, room;
	bool lost;
};

static void keep(void *context, const double a[2], const double b[2], const double c[2])
{
	struct kept *k = context;
	if (k->count + 3 > k->room) {
		size_t room = k->room ? 2 * k->room : 96;
		double (*grown)[2] = arena_grow(k->mem, k->corner, k->count, room, sizeof *grown);
		k->lost = k->lost || !grown;
		if (k->lost)
			return;
		k->corner = grown;
		k->room = room;
	}
	const double *p[3] = { a, b, c };
	for (int i = 0; i < 3; i++, k->count++)
		memcpy(k->corner[k->count], p[i], sizeof *k->corner);
}

static int fill_loops(struct filler *f)
{
	struct kept kept = { .mem = f->scratch };
	struct filler g = *f;
	bool *done = NEW(f->scratch, bool, f->o->loops);
	int status = done ? 0 : -1;
	g.triangle = keep;
	g.context = &kept;
	if (done)
		nest(&g);
	for (size_t l = 0; status == 0 && l < f->o->loops; l++)
		if (g.depth[l] % 2 == 0)
			status = fill_loop(&g, l, done);
	if (kept.lost)
		return -1;
	for (size_t i = 0; status == 0 && i < kept.count; i += 3)
		f->triangle(f->context, kept.corner[i], kept.corner[i + 1], kept.corner[i + 2]);
	return status;
}

int pov_outline_fill(const struct pov_outline *o, struct arena *scratch, pov_fill_fn *triangle, void *context)
{
	struct filler f = { .o = o, .scratch = scratch, .triangle = triangle, .context = context };
	if (o->loops == 0)
		return 0;
	f.loop_of = NEW(scratch, size_t, o->count);
	f.ring = NEW(scratch, struct vec, o->count + 2 * o->loops);
	f.depth = NEW(scratch, size_t, o->loops);
	f.parent = NEW(scratch, size_t, o->loops);
	if (!f.loop_of || !f.ring || !f.depth || !f.parent)
		return -1;
	for (size_t l = 0; l < o->loops; l++)
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++)
			f.loop_of[i] = l;
	int status = keeps_apart(&f) ? fill_loops(&f) : 1;
	return status == 1 ? fill_strips(&f) : status;
}
