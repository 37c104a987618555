#include "io/pov_march.h"

enum { ROOT_STEPS = 12, BLOCK = 8, SIDE = BLOCK + 1, CELLS_MOST = 1 << 20 };

struct vec pov_root(double (*field)(const void *context, struct vec p), const void *context, struct vec in, double inner, struct vec out,
                    double outer)
{
	if (outer == 0)
		return out;
	struct vec way = vec_sub(out, in);
	double s = 0, t = 1, at = 0, enough = 1e-14 * (fabs(inner) + fabs(outer));
	bool flat = inner == 0; /* the field is zero on a stretch, whose end is meant */
	int kept = 0; /* which end stayed last time: -1 the inner, 1 the outer */
	for (int i = 0; i < ROOT_STEPS; i++) {
		at = (s * outer - t * inner) / (outer - inner);
		if (!(at > s && at < t))
			at = (s + t) / 2;
		double f = field(context, vec_add(in, vec_scale(way, at)));
		if (!flat && fabs(f) <= enough)
			break;
		if (f <= 0) {
			s = at;
			inner = f;
			outer = kept == 1 ? outer / 2 : outer;
			kept = 1;
		} else {
			t = at;
			outer = f;
			inner = kept == -1 ? inner / 2 : inner;
			kept = -1;
		}
	}
	return vec_add(in, vec_scale(way, at));
}

/* A grid of count[axis] cells over a box, and what is done where the surface passes. */
struct grid {
	const struct pov_solid *s;
	double (*field)(const struct pov_solid *s, struct vec p);
	struct box box;
	int count[3];
	const struct pov_drawing *d; /* NULL: only the extent is wanted */
	struct box extent;
	size_t blocks; /* marched through */
};

struct corner {
	struct vec p;
	double f;
};

static struct vec grid_point(const struct grid *g, int i, int j, int k)
{
	int at[3] = { i, j, k };
	struct vec p;
	for (int a = 0; a < 3; a++)
		p.a[a] = at[a] == g->count[a] ? g->box.hi.a[a] : g->box.lo.a[a] + (g->box.hi.a[a] - g->box.lo.a[a]) * at[a] / g->count[a];
	return p;
}

static double field_of(const void *context, struct vec p)
{
	const struct grid *g = context;
	return g->field(g->s, p);
}

static struct vec crossing(const struct grid *g, const struct corner *in, const struct corner *out)
{
	return pov_root(field_of, g, in->p, in->f, out->p, out->f);
}

/* Corners of a tetrahedron that is right-handed: the triangle or two that part those inside from the others. The first 'inside'
 * corners are inside, and the order is an even permutation, so that the triangles face outward. */
static void part_tetrahedron(const struct grid *g, const struct corner *const *c, int inside)
{
	if (inside == 1) {
		pov_draw(g->d, crossing(g, c[0], c[1]), crossing(g, c[0], c[2]), crossing(g, c[0], c[3]));
	} else if (inside == 2) {
		struct vec p = crossing(g, c[0], c[2]), q = crossing(g, c[0], c[3]), r = crossing(g, c[1], c[3]), s = crossing(g, c[1], c[2]);
		pov_draw_quad(g->d, p, q, r, s);
	} else {
		pov_draw(g->d, crossing(g, c[0], c[3]), crossing(g, c[1], c[3]), crossing(g, c[2], c[3]));
	}
}

static void march_tetrahedron(const struct grid *g, const struct corner *const *c)
{
	const struct corner *order[4];
	int from[4], n = 0, inside = 0, swaps = 0;
	for (int pass = 0; pass < 2; pass++)
		for (int i = 0; i < 4; i++)
			if ((c[i]->f < 0) == (pass == 0))
				from[n++] = i;
	for (int i = 0; i < 4; i++) {
		inside += c[i]->f < 0;
		for (int j = 0; j < i; j++)
			swaps += from[j] > from[i];
	}
	if (inside == 0 || inside == 4)
		return;
	if (swaps % 2) { /* two of the same side exchanged make it even */
		int k = inside == 1 ? 2 : 0;
		int t = from[k];
		from[k] = from[k + 1];
		from[k + 1] = t;
	}
	for (int i = 0; i < 4; i++)
		order[i] = c[from[i]];
	part_tetrahedron(g, order, inside);
}

/* The six paths along the edges from corner 0 to corner 7 of a cell, in right-handed order. */
static const unsigned char kuhn[6][4] = { { 0, 1, 3, 7 }, { 0, 5, 1, 7 }, { 0, 3, 2, 7 }, { 0, 2, 6, 7 }, { 0, 4, 5, 7 }, { 0, 6, 4, 7 } };

static void march_cell(struct grid *g, const struct corner *const *c)
{
	int inside = 0;
	for (int i = 0; i < 8; i++)
		inside += c[i]->f < 0;
	if (inside == 0 || inside == 8)
		return;
	box_extend(&g->extent, c[0]->p);
	box_extend(&g->extent, c[7]->p);
	for (int t = 0; g->d && t < 6; t++) {
		const struct corner *four[4];
		for (int i = 0; i < 4; i++)
			four[i] = c[kuhn[t][i]];
		march_tetrahedron(g, four);
	}
}

static void march_block(struct grid *g, const int *at)
{
	struct corner corner[SIDE][SIDE][SIDE];
	int n[3];
	g->blocks++;
	for (int a = 0; a < 3; a++)
		n[a] = g->count[a] - at[a] < BLOCK ? g->count[a] - at[a] : BLOCK;
	for (int i = 0; i <= n[0]; i++)
		for (int j = 0; j <= n[1]; j++)
			for (int k = 0; k <= n[2]; k++) {
				struct vec p = grid_point(g, at[0] + i, at[1] + j, at[2] + k);
				corner[i][j][k] = (struct corner){ p, g->field(g->s, p) };
			}
	for (int i = 0; i < n[0]; i++)
		for (int j = 0; j < n[1]; j++)
			for (int k = 0; k < n[2]; k++) {
				const struct corner *c[8];
				for (int b = 0; b < 8; b++)
					c[b] = &corner[i + (b & 1)][j + (b >> 1 & 1)][k + (b >> 2)];
				march_cell(g, c);
			}
}

/* The cells from 'at', 'size' in each direction: halved until blocks remain, what is provably empty left out. */
static void visit(struct grid *g, const int *at, int size)
{
	int end[3];
	for (int a = 0; a < 3; a++) {
		if (at[a] >= g->count[a])
			return;
		end[a] = at[a] + size < g->count[a] ? at[a] + size : g->count[a];
	}
	struct vec lo = grid_point(g, at[0], at[1], at[2]), hi = grid_point(g, end[0], end[1], end[2]);
	struct vec middle = vec_scale(vec_add(lo, hi), 0.5);
	double reach = pov_shape_reach(g->s, middle, vec_length(vec_sub(hi, lo)) / 2);
	if (isfinite(reach) && fabs(g->field(g->s, middle)) > reach)
		return;
	if (size == BLOCK) {
		march_block(g, at);
		return;
	}
	for (int b = 0; b < 8; b++) {
		int half = size / 2, from[3] = { at[0] + half * (b & 1), at[1] + half * (b >> 1 & 1), at[2] + half * (b >> 2) };
		visit(g, from, half);
	}
}

static struct grid march(const struct pov_solid *s, const struct box *box, double step, const struct pov_drawing *d)
{
	struct grid g = { .s = s, .field = pov_shape_of(s)->field, .box = *box, .d = d, .extent = box_empty() };
	int at[3] = { 0, 0, 0 }, size = BLOCK;
	if (box_is_empty(box))
		return g;
	for (int a = 0; a < 3; a++) {
		double cells = ceil((box->hi.a[a] - box->lo.a[a]) / step - 1e-9);
		g.count[a] = !(cells >= 1) ? 1 : cells > CELLS_MOST ? CELLS_MOST : (int)cells;
		while (size < g.count[a])
			size *= 2;
	}
	visit(&g, at, size);
	return g;
}

struct box pov_march(const struct pov_solid *s, const struct box *box, double step, const struct pov_drawing *d)
{
	return march(s, box, step, d).extent;
}

struct box pov_march_extent(const struct pov_solid *s, const struct box *box, double step, size_t *blocks)
{
	struct grid g = march(s, box, step, NULL);
	*blocks = g.blocks;
	return g.extent;
}
