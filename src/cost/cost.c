/* Expected counts per ray from one pass over the cells.
 *
 * The measure of the rays (divided by pi) that visit a convex cell X is A(X) + 2 a(X): those that enter through its surface and
 * those that start inside; all rays together measure Z = A(root) + 2 a. Everything here is a sum of such terms:
 *   leaves       sum of (A + 2 a) / Z over the leaves, tests the same weighted by the lists' lengths
 *   inner_step   what a crossing of each face costs times the face's uncovered area, over Z
 *   inner_start  depth times the measure of the starts in each leaf, over Z
 * A recursion visits every inner cell that the ray meets, once: inner_top_down is the sum of (A + 2 a) / Z over them. Who starts from
 * the root for every leaf visits as many as it is deep.
 * Triangles lying in a face between two cells count for neither: the rays they stop there would have entered, and the rays they
 * send out take their place. Those that overlap there stop a ray once but send out one each. In a face of the root only the inner
 * side sends rays into the structure.
 *
 * Where rays start on the front sides of closed solids only (LAW_EXT), A becomes the area of the cell's surface outside the solids,
 * 2 a becomes a, and Z = A(root) + a. For rays from anywhere inside (LAW_INTERIOR) the measures are probabilities, that of a visit by
 * geom/interior.h and that of a start the share of the volume, and Z = 1. */
#include "cost/cost.h"

#include "cost/bvh.h"
#include "cost/mailbox.h"
#include "cost/solid.h"
#include "cost/surface.h"
#include "geom/interior.h"

#include <stdlib.h>

/* A cell and what is known of its inside so far. */
struct frame {
	struct box bounds;
	struct surface surface;
	double outside[6]; /* of every face, LAW_EXT only */
	bool leaf, box;
};

struct sums {
	const struct accel *accel;
	struct err *err;
	struct frame *open; /* cells from the root down to the last one seen */
	int depth;          /* of that one; -1 before the root */
	enum law law;
	const struct solid *solid; /* LAW_EXT only */
	double alpha, beta;
	double weight, weight_one, weight_exact; /* sum of c A, of c (A + a), and of c times the measure of the visits */
	double leaves, tests, top_down, restart, step, start, boxes;
	bool has_boxes;
	double area_inside, area_leaves;
};

static bool is_outer(const struct sums *s, const struct box *b, int f)
{
	return face_plane(b, f) == face_plane(&s->accel->root, f);
}

/* Twice the surface inside a cell, as far as it adds to the rays that visit it. */
static double surface_twice(const struct sums *s, const struct frame *c)
{
	double twice = 2 * c->surface.open;
	for (int f = 0; f < 6; f++)
		twice += c->surface.in_face[f] - (is_outer(s, &c->bounds, f) ? 0 : c->surface.covered[f]);
	return twice;
}

/* Measure of the rays that visit a cell. */
static double measure_visits(const struct sums *s, const struct frame *c)
{
	double sum = c->surface.open;
	if (s->law == LAW_INTERIOR)
		return interior_exact(&s->accel->root, &c->bounds);
	if (s->law != LAW_EXT)
		return box_area(&c->bounds) + (s->law == LAW_LINES ? 0 : surface_twice(s, c));
	for (int f = 0; f < 6; f++)
		sum += c->outside[f];
	return sum;
}

/* Measure of the rays that start in a cell. */
static double measure_starts(const struct sums *s, const struct frame *c)
{
	if (s->law == LAW_INTERIOR)
		return box_volume(&c->bounds) / box_volume(&s->accel->root);
	double sum = s->law == LAW_LINES ? 0 : s->law == LAW_EXT ? c->surface.open : 2 * c->surface.open;
	for (int f = 0; f < 6; f++) {
		sum += s->law == LAW_LINES ? 0 : s->law == LAW_EXT ? c->surface.facing[f] : c->surface.in_face[f];
		sum += is_outer(s, &c->bounds, f) ? face_area(&c->bounds, f) : 0;
	}
	return sum;
}

/* Measure of the rays that cross face f of a cell in one direction. */
static double measure_crossings(const struct sums *s, const struct frame *c, int f)
{
	if (s->law == LAW_INTERIOR)
		return NAN;
	if (s->law == LAW_EXT)
		return c->outside[f] - c->surface.facing[f];
	return face_area(&c->bounds, f) - (s->law == LAW_LINES ? 0 : c->surface.covered[f]);
}

static void add_leaf(struct sums *s, const struct cell *c, const struct frame *frame)
{
	double visits = measure_visits(s, frame), cost = s->alpha + s->beta * c->count;
	s->weight += cost * c->area;
	s->weight_one += cost * (c->area + surface_twice(s, frame) / 2);
	s->weight_exact += cost * visits;
	s->leaves += visits;
	s->tests += c->count * visits;
	s->restart += c->depth * visits;
	s->start += c->depth * measure_starts(s, frame);
	s->area_leaves += c->area;
	s->area_inside += frame->surface.open;
	for (int f = 0; f < 6; f++) {
		s->step += c->steps[f] > 0 ? c->steps[f] * measure_crossings(s, frame, f) : 0;
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
	if (c->box)
		s->boxes += measure_visits(s, c);
	s->has_boxes |= c->box;
	if (depth == 0)
		return;
	struct frame *around = &s->open[depth - 1];
	around->surface.open += c->surface.open;
	for (int f = 0; f < 6; f++) {
		if (face_plane(&c->bounds, f) == face_plane(&around->bounds, f)) {
			around->surface.in_face[f] += c->surface.in_face[f];
			around->surface.covered[f] += c->surface.covered[f];
			around->outside[f] += c->outside[f];
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
	*frame = (struct frame){ .bounds = c->bounds, .leaf = c->leaf, .box = c->box };
	if (!c->leaf)
		return 0;
	if (surface_measure(&frame->surface, s->accel, c, s->err) != 0)
		return -1;
	if (s->law == LAW_EXT)
		solid_measure(s->solid, c, frame->outside);
	add_leaf(s, c, frame);
	return 0;
}

/* Inner nodes of the way the structure's rays travel. */
static void choose_travel(struct prediction *p, enum travel travel, bool has_boxes)
{
	if (has_boxes)
		p->inner_restart = p->inner_start = NAN;
	if (travel == TRAVEL_LINKS) {
		p->inner = p->inner_step + p->inner_start;
		return;
	}
	p->inner = travel == TRAVEL_RECURSIVE ? p->inner_top_down : p->inner_restart;
	p->inner_step = p->inner - p->inner_start;
}

/* What of a prediction a law has no formula for. */
static void clear_unknown(struct prediction *p, enum law law, bool has_boxes)
{
	if (law == LAW_LINES)
		p->predicted_one = NAN;
	if (law == LAW_ONE_SIDED)
		p->predicted_two_sided = p->predicted_exact = p->leaves = p->tests = p->inner_step = p->inner_start =
			p->inner = p->inner_top_down = p->inner_restart = p->boxes = NAN;
	if (law == LAW_EXT)
		p->predicted_two_sided = NAN;
	if (law == LAW_EXT && has_boxes) /* what of their sides lies outside the solids is not known */
		p->inner = p->inner_top_down = p->boxes = NAN;
	if (law == LAW_INTERIOR)
		p->predicted = p->predicted_two_sided = p->predicted_one = NAN;
}

int cost_predict(struct prediction *p, const struct accel *a, enum law law, double alpha, double beta, struct err *e)
{
	if (law == LAW_NONE) {
		*p = prediction_unknown();
		return 0;
	}
	if (a->volumes)
		return bvh_predict(p, a, law, alpha, beta, e);
	struct solid solid = { 0 };
	struct sums s = { .accel = a, .err = e, .depth = -1, .law = law, .solid = &solid, .alpha = alpha, .beta = beta };
	int status = law == LAW_EXT ? solid_open(&solid, a, e) : 0;
	s.open = malloc(((size_t)a->depth + 1) * sizeof *s.open);
	if (status == 0 && !s.open)
		status = err_memory(e, "prediction");
	if (status == 0)
		status = a->ops->cells(a, visit, &s);
	bool has_mailbox = a->mailbox != MAILBOX_NONE && (law == LAW_RAYS || law == LAW_LINES);
	double spared = NAN;
	if (status == 0 && has_mailbox)
		status = mailbox_measure_spared(&spared, a, law == LAW_LINES, e);
	for (; s.depth >= 0; s.depth--)
		close_frame(&s, s.depth);
	free(s.open);
	solid_close(&solid);
	double area = law == LAW_LINES ? 0 : a->primitives->area, root = box_area(&a->root);
	double all = law == LAW_INTERIOR ? 1 : root + (law == LAW_EXT ? 1 : 2) * area;
	*p = (struct prediction){
		.predicted = s.weight / (root + area),
		.predicted_two_sided = s.weight / (root + 2 * area),
		.predicted_one = s.weight_one / (root + area),
		.predicted_exact = s.weight_exact / all,
		.leaves = s.leaves / all,
		.tests = s.tests / all,
		.tests_one = s.has_boxes ? NAN : (s.tests - spared) / all,
		.inner_step = s.step / all,
		.inner_start = s.start / all,
		.inner_top_down = s.top_down / all,
		.inner_restart = s.restart / all,
		.boxes = s.boxes / all,
		.area_inside = s.area_inside,
		.area_leaves = s.area_leaves,
		.volumes = NAN, .sah = NAN, .epo = NAN, .dq = NAN, .surface_share = NAN,
	};
	choose_travel(p, a->travel, s.has_boxes);
	clear_unknown(p, law, s.has_boxes);
	return status;
}
