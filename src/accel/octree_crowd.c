/* Many rays on their way through an octree at once. This file is compiled twice: for any processor, and for those with AVX2. */
#include "accel/octree_walk.h"

/* Enough to cover a miss to memory by the others' work, few enough to stay in the nearest cache. */
enum { OCTREE_WALKERS = 24 };

/* Walkers that take the same step one after the other: their work overlaps, and so do their waits for memory, since what a walker
 * will read in its next step is asked for in this one. The lists say who takes which step in this turn. */
struct crowd {
	struct walker all[OCTREE_WALKERS];
	struct walker *visit[OCTREE_WALKERS], *leaf[OCTREE_WALKERS], *test[OCTREE_WALKERS], *idle[OCTREE_WALKERS];
	size_t visits, leaves, tests, idles;
	const struct screen *screens[OCTREE_WALKERS][SCREEN_LANES]; /* of the first in the lists of 'test' */
};

/* What is shot: rays r[0 .. count), where their hits and counts go, and the first one that waits. */
struct volley {
	const struct ray *r;
	struct hit *h;
	struct tally *n;
	size_t count, next;
};

INLINED void end_walk(const struct walker *w, const struct volley *v)
{
	size_t i = (size_t)(w->ray - v->r);
	v->h[i] = w->hit;
	v->n[i] = w->tally;
}

/* Give idle walkers the rays that wait. */
INLINED void refill(struct crowd *c, struct volley *v, const struct accel *a)
{
	while (c->idles > 0 && v->next < v->count) {
		struct walker *w = c->idle[c->idles - 1];
		if (walk_start(w, a, &v->r[v->next++])) {
			c->visit[c->visits++] = w;
			c->idles--;
		} else {
			end_walk(w, v);
		}
	}
}

/* Those at an inner node go one down; those at a leaf find their way out of it and ask for its list. */
INLINED void visit_nodes(struct crowd *c, const struct octree *o)
{
	size_t inner = 0;
	c->tests = c->leaves = 0;
	for (size_t i = 0; i < c->visits; i++) {
		struct walker *w = c->visit[i];
		bool is_inner = w->node->inner;
		c->leaf[c->leaves] = w;
		c->leaves += !is_inner;
		c->visit[inner] = w;
		inner += is_inner;
	}
	c->visits = inner;
	for (size_t i = 0; i < inner; i++) {
		descend(c->visit[i], o);
		__builtin_prefetch(c->visit[i]->node);
	}
	for (size_t i = 0; i < c->leaves; i++) {
		struct walker *w = c->leaf[i];
		count_leaf(w, true);
		find_exit(w, o);
		__builtin_prefetch(w->next);
		__builtin_prefetch(octree_list(o, w->node));
		c->test[c->tests] = w;
		c->tests += w->node->count && !w->ray->through;
	}
}

/* The rest of a list that is longer than the lanes. */
INLINED void test_rest(struct walker *w, const struct accel *a, const struct octree *o)
{
	const uint32_t *ids = octree_list(o, w->node);
	if (w->node->count > SCREEN_LANES)
		screen_test(o->screens, a->primitives->all, ids + SCREEN_LANES, w->node->count - SCREEN_LANES, w->ray, &w->screened,
		            w->exit + a->slack, &w->hit);
}

/* Screens first, for everybody; the few primitives that remain are asked for meanwhile and tested after. */
INLINED void test_leaves(struct crowd *c, const struct accel *a, const struct octree *o)
{
	struct candidate {
		struct walker *walker;
		uint32_t id;
	} candidate[OCTREE_WALKERS * SCREEN_LANES];
	size_t candidates = 0;
	for (size_t i = 0; i < c->tests; i++) {
		const struct octree_node *n = c->test[i]->node;
		screen_gather(c->screens[i], o->screens, octree_list(o, n), n->count);
		for (int k = 0; k < SCREEN_LANES; k++)
			__builtin_prefetch(c->screens[i][k]);
	}
	for (size_t i = 0; i < c->tests; i++) {
		struct walker *w = c->test[i];
		uint32_t ids[SCREEN_LANES + 1];
		uint32_t found = screen_candidates(c->screens[i], octree_list(o, w->node), w->node->count, w->ray, &w->screened,
		                                   w->exit + a->slack, ids);
		for (uint32_t k = 0; k < found; k++) {
			const struct primitive *p = &a->primitives->all[ids[k]];
			candidate[candidates++] = (struct candidate){ w, ids[k] };
			__builtin_prefetch(p);
			__builtin_prefetch((const char *)(p + 1) - 1);
		}
	}
	for (size_t i = 0; i < c->tests; i++)
		test_rest(c->test[i], a, o);
	for (size_t i = 0; i < candidates; i++) {
		struct walker *w = candidate[i].walker;
		primitive_hit(&a->primitives->all[candidate[i].id], candidate[i].id, w->ray, &w->hit);
	}
}

/* Those done with a leaf end or go on to the next node. */
INLINED void leave_leaves(struct crowd *c, const struct volley *v, const struct accel *a)
{
	for (size_t i = 0; i < c->leaves; i++) {
		struct walker *w = c->leaf[i];
		if (!w->next || w->hit.t <= w->exit + a->slack) {
			w->tally.hits = w->hit.id != NO_PRIMITIVE;
			end_walk(w, v);
			c->idle[c->idles++] = w;
			continue;
		}
		w->from = w->node;
		w->node = w->next;
		c->visit[c->visits++] = w;
	}
}

void OCTREE_CROWD(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	const struct octree *o = a->impl;
	struct volley v = { r, h, n, count, 0 };
	struct crowd c;
	c.visits = 0;
	for (c.idles = 0; c.idles < OCTREE_WALKERS; c.idles++)
		c.idle[c.idles] = &c.all[c.idles];
	for (;;) {
		refill(&c, &v, a);
		if (c.idles == OCTREE_WALKERS)
			return;
		visit_nodes(&c, o);
		test_leaves(&c, a, o);
		leave_leaves(&c, &v, a);
	}
}
