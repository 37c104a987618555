/* Expected counts per ray from one pass over the cells.
 *
 * The measure of the rays (divided by pi) that visit a convex cell X is A(X) + 2 a(X): those that enter through its surface and
 * those that start inside; all rays together measure Z = A(root) + 2 a. Everything here is a sum of such terms:
 *   leaves       sum of (A + 2 a) / Z over the leaves, tests the same weighted by the lists' lengths
 *   inner_step   what a crossing of each face costs times the face's uncovered area, over Z
 *   inner_start  depth times the measure of the starts in each leaf, over Z
 * Triangles lying in a face between two cells count for neither: the rays they stop there would have entered, and the rays they
 * send out take their place. Those that overlap there stop a ray once but send out one each. In a face of the root only the inner
 * side sends rays into the structure. */
#include "cost/cost.h"

#include "cost/surface.h"

#include <stdlib.h>

/* A cell and what is known of its inside so far. */
struct frame {
	struct box bounds;
	struct surface surface;
	bool leaf;
};

struct sums {
	const struct accel *accel;
	struct err *err;
	struct frame *open; /* cells from the root down to the last one seen */
	int depth;          /* of that one; -1 before the root */
	bool lines;
	double alpha, beta;
	double weight, weight_exact;   /* sum of c A and of c (A + 2 a) */
	double leaves, tests, top_down, restart, step, start;
	double area_inside, area_leaves;
};

static bool is_outer(const struct sums *s, const struct box *b, int f)
{
	return face_plane(b, f) == face_plane(&s->accel->root, f);
}

/* Measure of the rays that visit a cell. */
static double measure_visits(const struct sums *s, const struct frame *c)
{
	double twice = 2 * c->surface.open;
	for (int f = 0; f < 6; f++)
		twice += c->surface.in_face[f] - (is_outer(s, &c->bounds, f) ? 0 : c->surface.covered[f]);
	return box_area(&c->bounds) + (s->lines ? 0 : twice);
}

/* Measure of the rays that start in a cell. */
static double measure_starts(const struct sums *s, const struct frame *c)
{
	double sum = s->lines ? 0 : 2 * c->surface.open;
	for (int f = 0; f < 6; f++) {
		sum += s->lines ? 0 : c->surface.in_face[f];
		sum += is_outer(s, &c->bounds, f) ? face_area(&c->bounds, f) : 0;
	}
	return sum;
}

static void add_leaf(struct sums *s, const struct cell *c, const struct frame *frame)
{
	double visits = measure_visits(s, frame), cost = s->alpha + s->beta * c->count;
	s->weight += cost * c->area;
	s->weight_exact += cost * visits;
	s->leaves += visits;
	s->tests += c->count * visits;
	s->restart += c->depth * visits;
	s->start += c->depth * measure_starts(s, frame);
	s->area_leaves += c->area;
	s->area_inside += frame->surface.open;
	for (int f = 0; f < 6; f++) {
		double covered = s->lines ? 0 : frame->surface.covered[f];
		s->step += c->steps[f] > 0 ? c->steps[f] * (face_area(&c->bounds, f) - covered) : 0;
		s->area_inside += frame->surface.in_face[f] * (is_outer(s, &c->bounds, f) ? 1 : 0.5);
	}
}

/* Add what is known of a finished cell to the one around it: surface in a face they share stays surface in a face, what lies in
 * a face between two of its parts is inside, and counted from below. */
static void close_frame(struct sums *s, int depth)
{
	const struct frame *c = &s->open[depth];
	if (!c->leaf)
		s->top_down += measure_visits(s, c);
	if (depth == 0)
		return;
	struct frame *around = &s->open[depth - 1];
	around->surface.open += c->surface.open;
	for (int f = 0; f < 6; f++) {
		if (face_plane(&c->bounds, f) == face_plane(&around->bounds, f)) {
			around->surface.in_face[f] += c->surface.in_face[f];
			around->surface.covered[f] += c->surface.covered[f];
		} else if (f % 2) {
			around->surface.open += c->surface.in_face[f];
		}
	}
}

static int visit(void *ctx, const struct cell *c)
{
	struct sums *s = ctx;
	for (; s->depth >= c->depth; s->depth--)
		close_frame(s, s->depth);
	s->depth = c->depth;
	struct frame *frame = &s->open[c->depth];
	*frame = (struct frame){ .bounds = c->bounds, .leaf = c->leaf };
	if (!c->leaf)
		return 0;
	if (surface_measure(&frame->surface, s->accel, c, s->err) != 0)
		return -1;
	add_leaf(s, c, frame);
	return 0;
}

int cost_predict(struct prediction *p, const struct accel *a, enum law law, double alpha, double beta, struct err *e)
{
	struct sums s = { .accel = a, .err = e, .depth = -1, .lines = law == LAW_LINES, .alpha = alpha, .beta = beta };
	s.open = malloc(((size_t)a->depth + 1) * sizeof *s.open);
	if (!s.open)
		return err_memory(e, "prediction");
	int status = a->ops->cells(a, visit, &s);
	for (; s.depth >= 0; s.depth--)
		close_frame(&s, s.depth);
	free(s.open);
	double area = s.lines ? 0 : a->primitives->area, all = box_area(&a->root) + 2 * area;
	*p = (struct prediction){
		.predicted = s.weight / (box_area(&a->root) + area),
		.predicted_two_sided = s.weight / all,
		.predicted_exact = s.weight_exact / all,
		.leaves = s.leaves / all,
		.tests = s.tests / all,
		.inner_step = s.step / all,
		.inner_start = s.start / all,
		.inner_top_down = s.top_down / all,
		.inner_restart = s.restart / all,
		.area_inside = s.area_inside,
		.area_leaves = s.area_leaves,
	};
	return status;
}
