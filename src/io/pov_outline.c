#include "io/pov_outline.h"

#include <math.h>

void pov_outline_add(struct pov_outline *o, double x, double y)
{
	size_t start = o->first ? o->first[o->loops] : 0;
	if (o->count > start && o->at[o->count - 1][0] == x && o->at[o->count - 1][1] == y)
		return;
	if (o->count == o->room) {
		size_t room = o->room ? 2 * o->room : 64;
		double (*grown)[2] = arena_grow(o->mem, o->at, o->count, room, sizeof *grown);
		o->lost = o->lost || !grown;
		if (o->lost)
			return;
		o->at = grown;
		o->room = room;
	}
	o->at[o->count][0] = x;
	o->at[o->count++][1] = y;
}

void pov_outline_close(struct pov_outline *o)
{
	if (o->loops + 2 > o->loop_room) {
		size_t room = o->loop_room ? 2 * o->loop_room : 8;
		size_t *grown = arena_grow(o->mem, o->first, o->first ? o->loops + 1 : 0, room, sizeof *grown);
		o->lost = o->lost || !grown;
		if (o->lost)
			return;
		o->first = grown;
		o->loop_room = room;
	}
	size_t start = o->first[o->loops];
	if (o->count > start + 1 && o->at[o->count - 1][0] == o->at[start][0] && o->at[o->count - 1][1] == o->at[start][1])
		o->count--;
	if (o->count < start + 3)
		o->count = start;
	else
		o->first[++o->loops] = o->count;
}

void pov_outline_index(struct pov_outline *o)
{
	struct arena scratch = { 0 };
	struct box *boxes = NEW(&scratch, struct box, o->count);
	size_t *after = NEW(o->mem, size_t, o->count);
	for (size_t l = 0; boxes && after && l < o->loops; l++)
		for (size_t i = o->first[l]; i < o->first[l + 1]; i++) {
			after[i] = pov_outline_next(o, l, i);
			boxes[i] = box_empty();
			box_extend(&boxes[i], vec(o->at[i][0], o->at[i][1], 0));
			box_extend(&boxes[i], vec(o->at[after[i]][0], o->at[after[i]][1], 0));
		}
	if (!boxes || !after || pov_tree_build(&o->tree, o->mem, boxes, (uint32_t)o->count) != 0)
		o->lost = true;
	o->after = after;
	arena_free(&scratch);
}

/* A question about a point: whether a ray toward +x passes an odd number of edges; the square of the distance to the nearest. */
struct query {
	const struct pov_outline *o;
	double x, y, nearest;
	bool inside;
};

static void pass_edge(struct query *q, const double *a, const double *b)
{
	if ((a[1] > q->y) != (b[1] > q->y) && q->x < a[0] + (q->y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
		q->inside = !q->inside;
}

static void measure_edge(struct query *q, const double *a, const double *b)
{
	double u = b[0] - a[0], v = b[1] - a[1], s = ((q->x - a[0]) * u + (q->y - a[1]) * v) / (u * u + v * v);
	s = s < 0 ? 0 : s > 1 ? 1 : s;
	double dx = q->x - a[0] - s * u, dy = q->y - a[1] - s * v, square = dx * dx + dy * dy;
	q->nearest = square < q->nearest ? square : q->nearest;
}

static bool may_pass(void *context, const struct box *b)
{
	const struct query *q = context;
	return b->lo.y <= q->y && b->hi.y > q->y && b->hi.x > q->x;
}

static bool may_be_nearer(void *context, const struct box *b)
{
	const struct query *q = context;
	double dx = q->x < b->lo.x ? b->lo.x - q->x : q->x > b->hi.x ? q->x - b->hi.x : 0;
	double dy = q->y < b->lo.y ? b->lo.y - q->y : q->y > b->hi.y ? q->y - b->hi.y : 0;
	return dx * dx + dy * dy < q->nearest;
}

static void pass_leaf(void *context, uint32_t i)
{
	struct query *q = context;
	pass_edge(q, q->o->at[i], q->o->at[q->o->after[i]]);
}

static void measure_leaf(void *context, uint32_t i)
{
	struct query *q = context;
	measure_edge(q, q->o->at[i], q->o->at[q->o->after[i]]);
}

static void for_edges(struct query *q, void (*each)(struct query *q, const double *a, const double *b))
{
	for (size_t l = 0; l < q->o->loops; l++)
		for (size_t i = q->o->first[l]; i < q->o->first[l + 1]; i++)
			each(q, q->o->at[i], q->o->at[pov_outline_next(q->o, l, i)]);
}

bool pov_outline_inside(const struct pov_outline *o, double x, double y)
{
	struct query q = { .o = o, .x = x, .y = y };
	if (o->tree.nodes)
		pov_tree_visit(&o->tree, may_pass, pass_leaf, &q);
	else
		for_edges(&q, pass_edge);
	return q.inside;
}

double pov_outline_distance(const struct pov_outline *o, double x, double y)
{
	struct query q = { .o = o, .x = x, .y = y, .nearest = INFINITY };
	if (o->tree.nodes)
		pov_tree_visit(&o->tree, may_be_nearer, measure_leaf, &q);
	else
		for_edges(&q, measure_edge);
	return pov_outline_inside(o, x, y) ? -sqrt(q.nearest) : sqrt(q.nearest);
}

bool pov_outline_inside_left(const struct pov_outline *o, size_t i, size_t next)
{
	const double *a = o->at[i], *b = o->at[next];
	double aside = 1e-6, u = b[0] - a[0], v = b[1] - a[1];
	return pov_outline_inside(o, (a[0] + b[0]) / 2 - aside * v, (a[1] + b[1]) / 2 + aside * u);
}

/* c[0] + t c[1] + t^2 c[2] + t^3 c[3] of one coordinate, for the segment from points[i]. */
static void segment(enum pov_spline kind, const struct vec *p, size_t i, int axis, double *c)
{
	double b = p[i].a[axis], d = p[i + 1].a[axis];
	c[0] = b;
	c[2] = c[3] = 0;
	if (kind == POV_LINEAR) {
		c[1] = d - b;
	} else if (kind == POV_QUADRATIC) {
		double a = p[i - 1].a[axis];
		c[1] = (d - a) / 2;
		c[2] = (a - 2 * b + d) / 2;
	} else if (kind == POV_BEZIER) {
		double e = p[i + 2].a[axis], f = p[i + 3].a[axis];
		c[1] = 3 * (d - b);
		c[2] = 3 * (b - 2 * d + e);
		c[3] = f - b + 3 * (d - e);
	} else {
		double a = p[i - 1].a[axis], e = p[i + 2].a[axis];
		c[1] = (d - a) / 2;
		c[2] = a - 2.5 * b + 2 * d - e / 2;
		c[3] = (e - a) / 2 + 1.5 * (b - d);
	}
}

static void add_segment(struct pov_outline *o, enum pov_spline kind, const struct vec *p, size_t i, int pieces)
{
	double c[2][4];
	pieces = kind == POV_LINEAR ? 1 : pieces;
	for (int axis = 0; axis < 2; axis++)
		segment(kind, p, i, axis, c[axis]);
	size_t end = kind == POV_BEZIER ? i + 3 : i + 1;
	pov_outline_add(o, p[i].x, p[i].y);
	for (int k = 1; k < pieces; k++) {
		double t = (double)k / pieces;
		pov_outline_add(o, c[0][0] + t * (c[0][1] + t * (c[0][2] + t * c[0][3])),
		                c[1][0] + t * (c[1][1] + t * (c[1][2] + t * c[1][3])));
	}
	pov_outline_add(o, p[end].x, p[end].y);
}

static bool same_point(struct vec a, struct vec b)
{
	return fabs(a.x - b.x) < 1e-9 && fabs(a.y - b.y) < 1e-9;
}

void pov_outline_spline(struct pov_outline *o, enum pov_spline kind, const struct vec *points, size_t n, int pieces, bool loops)
{
	/* How many points a segment needs before and behind its two ends, and how many points further the next one starts. */
	size_t before = kind == POV_QUADRATIC || kind == POV_CUBIC ? 1 : 0, behind = kind == POV_CUBIC ? 1 : 0;
	size_t span = kind == POV_BEZIER ? 3 : 1, step = kind == POV_BEZIER ? 4 : 1;
	size_t start = before;
	for (size_t i = before; i + span + behind < n;) {
		add_segment(o, kind, points, i, pieces);
		if (loops && same_point(points[i + span], points[start])) {
			pov_outline_close(o);
			i = start = i + span + behind + 1 + before;
		} else {
			i += step;
		}
	}
	if (loops && o->count > (o->first ? o->first[o->loops] : 0))
		pov_outline_close(o);
}
