/* Rays in trees of planes.
 *
 * All decisions are made along the ray: a plane is met at t = (plane - o) / d, and a cell is a stretch of t. Where the ray meets the
 * plane before the stretch begins, or starts within slack of it, the half ahead is all there is; else the half behind comes first, and
 * ends at t at the latest. Stretches are cut by the same numbers whichever way they are found, so that the recursion (Fussell and
 * Subramanian 1988) and the restart from the root (Kaplan 1985, here without points: t is where the last leaf was left) visit the
 * same leaves. */
#include "accel/mailbox.h"
#include "accel/planes.h"

/* A ray on its way: the node it is at, and the stretch of it in question. */
struct walker {
	struct vec o, per_d; /* origin; 1 / d, where a zero counts as positive */
	double slack, in, out;
	uint32_t at;
	int waiting; /* halves ahead, on the stack */
	struct { double in, out; uint32_t node; } stack[PLANES_LEVELS];
};

/* The stretch inside the root. A ray that ends within slack of a plane ends before it. */
static inline void find_stretch(struct walker *w, const struct box *root, const struct ray *r)
{
	w->in = 0;
	w->out = r->t_max + w->slack;
	for (int i = 0; i < 3; i++) {
		if (r->d.a[i] == 0)
			continue; /* it may run in a side */
		bool up = w->per_d.a[i] > 0;
		double in = ((up ? root->lo.a[i] : root->hi.a[i]) - w->o.a[i]) * w->per_d.a[i];
		double out = ((up ? root->hi.a[i] : root->lo.a[i]) - w->o.a[i]) * w->per_d.a[i];
		w->in = in > w->in ? in : w->in;
		w->out = out < w->out ? out : w->out;
	}
}

/* One down from a plane. */
static inline void pass_plane(struct walker *w, const struct plane_node *n, bool restart)
{
	bool up = w->per_d.a[n->kind] > 0;
	double gap = n->plane - w->o.a[n->kind], t = gap * w->per_d.a[n->kind];
	if (!(up ? gap > w->slack : gap < -w->slack) || t <= w->in) {
		w->at = n->child + up;
		return;
	}
	w->at = n->child + !up;
	if (t >= w->out)
		return;
	if (!restart) {
		w->stack[w->waiting].in = t;
		w->stack[w->waiting].out = w->out;
		w->stack[w->waiting++].node = n->child + up;
	}
	w->out = t;
}

/* Into a box: false where the stretch misses it. */
static inline bool pass_box(struct walker *w, const struct plane_node *n, const struct box *b)
{
	for (int i = 0; i < 3; i++) {
		bool up = w->per_d.a[i] > 0;
		double in = ((up ? b->lo.a[i] : b->hi.a[i]) - w->o.a[i]) * w->per_d.a[i];
		double out = ((up ? b->hi.a[i] : b->lo.a[i]) - w->o.a[i]) * w->per_d.a[i];
		w->in = in > w->in ? in : w->in;
		w->out = out < w->out ? out : w->out;
	}
	w->at = n->child;
	return w->in < w->out;
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct mailbox *m, struct tally *tally, const bool count)
{
	const struct planes *p = a->impl;
	const bool restart = a->travel == TRAVEL_RESTART;
	struct walker w;
	struct vec start;
	bool at_first = true;
	*h = hit_none(r);
	w.o = r->o;
	w.slack = a->slack;
	w.at = 0;
	w.waiting = 0;
	for (int i = 0; i < 3; i++)
		w.per_d.a[i] = 1 / nonzero(r->d.a[i]);
	if (!root_enter(&a->root, r, w.per_d, a->slack, &start))
		return false;
	mailbox_next(m);
	find_stretch(&w, &a->root, r);
	const double end = w.out;
	for (;;) {
		const struct plane_node *n = &p->nodes[w.at];
		bool met = true;
		for (; n->kind != NODE_LEAF && met; n = &p->nodes[w.at]) {
			COUNT(inner_start, at_first);
			COUNT(inner_step, !at_first);
			COUNT(boxes, n->kind == NODE_BOX);
			if (n->kind == NODE_BOX)
				met = pass_box(&w, n, &p->boxes[n->first]);
			else
				pass_plane(&w, n, restart);
		}
		if (met) {
			visit_leaf(a, p->refs + n->first, n->count, r, h, m, tally, count);
			at_first = false;
			if (h->t <= w.out + a->slack)
				break;
		}
		if (restart) {
			if (w.out >= end)
				break;
			w.in = w.out;
			w.out = end;
			w.at = 0;
		} else {
			if (w.waiting == 0)
				break;
			w.waiting--;
			w.in = w.stack[w.waiting].in;
			w.out = w.stack[w.waiting].out;
			w.at = w.stack[w.waiting].node;
		}
	}
	if (r->through)
		*h = hit_none(r);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}
WALK_WITH_MAILBOX(walk)

bool planes_shoot(const struct accel *a, const struct ray *r, struct hit *h)
{
	return shoot(a, r, h);
}

bool planes_shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n)
{
	return shoot_counted(a, r, h, n);
}

void planes_shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	shoot_many(a, r, count, h, n);
}
