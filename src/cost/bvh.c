/* Expected cost of the nodes of a bounding volume hierarchy that a ray meets up to its first hit.
 *
 * A node's closed box X is a convex cell, so the measure of the rays that meet it (divided by pi) is A(X) + 2 a(X), with a(X) all the
 * surface inside, whoever's it is; all rays together measure Z = A(root) + 2 a. Surface in a box's sides counts: its rays touch the
 * box where they start or end. With C the cost of a node and Q the surface of its own primitives,
 *   volumes = sum C (A + 2 a) / Z = (1 - share) SAH + share (EPO + DQ),   share = 2 a(all) / Z
 *   SAH = sum C A / A(root)              Goldsmith and Salmon 1987, MacDonald and Booth 1990
 *   EPO = sum C a(others inside) / a(all)   Aila, Karras, Laine 2013: end-point overlap
 *   DQ  = sum C a(Q inside) / a(all)     what a path from the root to the leaf of a surface point costs */
#include "cost/bvh.h"

#include <stdlib.h>

/* A box of the tree in depth-first order, and the surface found inside: its own, and that of others. */
struct volume {
	struct box bounds;
	uint32_t skip, parent, stamp;
	uint32_t count; /* of primitives; inner nodes: 0 */
	bool leaf;
	double own, others;
};

/* Where a primitive is listed. */
struct place {
	uint32_t leaf, next; /* next: place number + 1, or 0 */
};

struct volumes {
	const struct accel *accel;
	struct volume *all;
	uint32_t count, *open; /* open: the last node seen at every depth */
	int depth;
	struct place *places;
	uint32_t place_count, *first; /* first: of every primitive, place number + 1, or 0 */
};

static int visit(void *ctx, const struct cell *c)
{
	struct volumes *v = ctx;
	uint32_t number = v->count++;
	for (; v->depth >= c->depth; v->depth--)
		v->all[v->open[v->depth]].skip = number;
	v->depth = c->depth;
	v->open[c->depth] = number;
	v->all[number] = (struct volume){ .bounds = c->bounds, .parent = c->depth ? v->open[c->depth - 1] : 0, .stamp = NO_PRIMITIVE,
		                          .count = c->count, .leaf = c->leaf };
	for (uint32_t i = 0; c->leaf && i < c->count; i++) {
		v->places[v->place_count] = (struct place){ number, v->first[c->ids[i]] };
		v->first[c->ids[i]] = ++v->place_count;
	}
	return 0;
}

static int open_volumes(struct volumes *v, const struct accel *a, struct err *e)
{
	*v = (struct volumes){ .accel = a, .depth = -1 };
	v->all = malloc(a->nodes * sizeof *v->all);
	v->open = malloc(((size_t)a->depth + 1) * sizeof *v->open);
	v->places = malloc(a->references * sizeof *v->places);
	v->first = calloc(a->primitives->count, sizeof *v->first);
	if (!v->all || !v->open || !v->places || !v->first)
		return err_memory(e, "prediction");
	a->ops->cells(a, visit, v);
	for (; v->depth >= 0; v->depth--)
		v->all[v->open[v->depth]].skip = v->count;
	return 0;
}

static void close_volumes(struct volumes *v)
{
	free(v->all);
	free(v->open);
	free(v->places);
	free(v->first);
}

/* Mark the leaves that list primitive id, and all above them. */
static void stamp_paths(struct volumes *v, uint32_t id)
{
	for (uint32_t place = v->first[id]; place; place = v->places[place - 1].next)
		for (uint32_t n = v->places[place - 1].leaf; v->all[n].stamp != id; n = v->all[n].parent)
			v->all[n].stamp = id;
}

/* The area of a primitive inside the box. */
static double area_inside(const struct primitive *p, const struct box *bounds, double area, const struct box *b)
{
	bool whole = true;
	for (int i = 0; i < 3; i++) {
		if (bounds->lo.a[i] > b->hi.a[i] || bounds->hi.a[i] < b->lo.a[i])
			return 0;
		whole &= bounds->lo.a[i] >= b->lo.a[i] && bounds->hi.a[i] <= b->hi.a[i];
	}
	return whole ? area : primitive_area_inside(p, b);
}

static void add_primitive(struct volumes *v, uint32_t id)
{
	const struct primitive *p = &v->accel->primitives->all[id];
	struct box bounds = primitive_bounds(p);
	double area = primitive_area(p);
	for (uint32_t n = 0; n < v->count;) {
		struct volume *b = &v->all[n];
		double inside = area_inside(p, &bounds, area, &b->bounds);
		if (b->stamp == id)
			b->own += inside;
		else
			b->others += inside;
		n = inside > 0 ? n + 1 : b->skip;
	}
}

static void sum_up(struct prediction *p, const struct volumes *v, bool lines, double alpha, double beta)
{
	double surface = lines ? 0 : v->accel->primitives->area, root = box_area(&v->accel->root), all = root + 2 * surface;
	double sah = 0, epo = 0, dq = 0, cost = 0;
	p->leaves = p->tests = p->inner_step = p->inner_start = 0;
	for (uint32_t n = 0; n < v->count; n++) {
		const struct volume *b = &v->all[n];
		double c = b->leaf ? beta * b->count : alpha, area = box_area(&b->bounds), visits = area + 2 * (b->own + b->others);
		sah += c * area;
		epo += c * b->others;
		dq += c * b->own;
		cost += c * visits;
		p->leaves += b->leaf ? visits / all : 0;
		p->tests += b->count * visits / all;
		p->inner_step += b->leaf ? 0 : visits / all;
	}
	p->volumes = cost / all;
	p->sah = sah / root;
	p->epo = lines ? NAN : epo / surface;
	p->dq = lines ? NAN : dq / surface;
	p->surface_share = 2 * surface / all;
	p->predicted_exact = lines || v->accel->to_hit ? p->volumes : NAN;
}

int bvh_predict(struct prediction *p, const struct accel *a, enum law law, double alpha, double beta, struct err *e)
{
	struct volumes v;
	*p = prediction_unknown();
	if (law == LAW_ONE_SIDED || law == LAW_EXT || law == LAW_INTERIOR)
		return 0;
	int status = open_volumes(&v, a, e);
	for (uint32_t i = 0; status == 0 && law == LAW_RAYS && i < a->primitives->count; i++) {
		stamp_paths(&v, i);
		add_primitive(&v, i);
	}
	if (status == 0)
		sum_up(p, &v, law == LAW_LINES, alpha, beta);
	close_volumes(&v);
	return status;
}
