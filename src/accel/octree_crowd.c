/* Many rays on their way through an octree at once. This file is compiled for any processor, for those with AVX2, and for those with
 * AVX-512. */
#include "accel/octree_walk.h"

/* Enough to cover a miss to memory by the others' work, few enough to stay in the nearest cache. */
enum { OCTREE_WALKERS = 24 };

/* A walker among others. */
struct member {
	struct walker walker;
	const struct screen *screens[SCREEN_LANES]; /* of the first in its leaf's list */
};

/* Walkers that take the same step one after the other: their work overlaps, and so do their waits for memory, since what a walker
 * will read in its next step is asked for in this one. The lists say who takes which step in this turn. */
struct crowd {
	struct member all[OCTREE_WALKERS];
	struct member *idle[OCTREE_WALKERS];
	struct member *visit[OCTREE_WALKERS];  /* at a node */
	struct member *gather[OCTREE_WALKERS]; /* with a list to test */
	struct member *screen[OCTREE_WALKERS]; /* with its screens at hand */
	struct member *leave[OCTREE_WALKERS];  /* done with their leaf but for the candidates */
	size_t idles, visits, gathers, screens, leaves, candidates;
	struct candidate {
		struct walker *walker;
		uint32_t id;
	} candidate[OCTREE_WALKERS * SCREEN_LANES];
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
		struct member *m = c->idle[c->idles - 1];
		if (walk_start(&m->walker, a, &v->r[v->next++])) {
			c->visit[c->visits++] = m;
			c->idles--;
		} else {
			end_walk(&m->walker, v);
		}
	}
}

/* Those at an inner node go one down; those at a leaf find their way out of it and ask for its list. */
INLINED void visit_nodes(struct crowd *c, const struct octree *o)
{
	struct member *leaf[OCTREE_WALKERS];
	size_t inner = 0, leaves = 0;
	for (size_t i = 0; i < c->visits; i++) {
		struct member *m = c->visit[i];
		bool is_inner = m->walker.node->inner;
		leaf[leaves] = m;
		leaves += !is_inner;
		c->visit[inner] = m;
		inner += is_inner;
	}
	c->visits = inner;
	for (size_t i = 0; i < inner; i++) {
		descend(&c->visit[i]->walker, o);
		__builtin_prefetch(c->visit[i]->walker.node);
	}
	for (size_t i = 0; i < leaves; i++) {
		struct member *m = leaf[i];
		struct walker *w = &m->walker;
		bool tests = w->node->count && !w->ray->through;
		count_leaf(w, true);
		find_exit(w, o);
		__builtin_prefetch(w->next);
		__builtin_prefetch(octree_list(o, w->node));
		c->gather[c->gathers] = m;
		c->gathers += tests;
		c->leave[c->leaves] = m;
		c->leaves += !tests;
	}
}

INLINED void gather_screens(struct crowd *c, const struct octree *o)
{
	for (size_t i = 0; i < c->gathers; i++) {
		struct member *m = c->gather[i];
		const struct octree_node *n = m->walker.node;
		screen_gather(m->screens, o->screens, octree_list(o, n), n->count);
		for (int k = 0; k < SCREEN_LANES; k++)
			__builtin_prefetch(m->screens[k]);
		c->screen[c->screens++] = m;
	}
	c->gathers = 0;
}

/* The rest of a list that is longer than the lanes. */
INLINED void test_rest(struct walker *w, const struct accel *a, const struct octree *o)
{
	const uint32_t *ids = octree_list(o, w->node);
	if (w->node->count > SCREEN_LANES)
		screen_test(o->screens, a->primitives->all, ids + SCREEN_LANES, w->node->count - SCREEN_LANES, w->ray, &w->screened,
		            w->exit + a->slack, &w->hit);
}

/* Find the few primitives that need the exact test, and ask for them. */
INLINED void screen_lists(struct crowd *c, const struct accel *a, const struct octree *o)
{
	for (size_t i = 0; i < c->screens; i++) {
		struct member *m = c->screen[i];
		struct walker *w = &m->walker;
		uint32_t ids[SCREEN_LANES + 1];
		uint32_t found = screen_candidates(m->screens, octree_list(o, w->node), w->node->count, w->ray, &w->screened,
		                                   w->exit + a->slack, ids);
		for (uint32_t k = 0; k < found; k++) {
			const struct primitive *p = &a->primitives->all[ids[k]];
			c->candidate[c->candidates++] = (struct candidate){ w, ids[k] };
			__builtin_prefetch(p);
			__builtin_prefetch((const char *)(p + 1) - 1);
		}
		test_rest(w, a, o);
		c->leave[c->leaves++] = m;
	}
	c->screens = 0;
}

/* Those done with a leaf end or go on to the next node. */
INLINED void leave_leaves(struct crowd *c, const struct volley *v, const struct accel *a)
{
	for (size_t i = 0; i < c->candidates; i++) {
		struct walker *w = c->candidate[i].walker;
		primitive_hit(&a->primitives->all[c->candidate[i].id], c->candidate[i].id, w->ray, &w->hit);
	}
	for (size_t i = 0; i < c->leaves; i++) {
		struct member *m = c->leave[i];
		struct walker *w = &m->walker;
		if (!w->next || w->hit.t <= w->exit + a->slack) {
			w->tally.hits = w->hit.id != NO_PRIMITIVE;
			end_walk(w, v);
			c->idle[c->idles++] = m;
			continue;
		}
		w->from = w->node;
		w->node = w->next;
		c->visit[c->visits++] = m;
	}
	c->candidates = c->leaves = 0;
}

void OCTREE_CROWD(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	const struct octree *o = a->impl;
	struct volley v = { r, h, n, count, 0 };
	struct crowd c;
	c.visits = c.gathers = c.screens = c.leaves = c.candidates = 0;
	for (c.idles = 0; c.idles < OCTREE_WALKERS; c.idles++)
		c.idle[c.idles] = &c.all[c.idles];
	for (;;) {
		/* The last step first, so that nobody takes two in one turn. */
		leave_leaves(&c, &v, a);
		screen_lists(&c, a, o);
		gather_screens(&c, o);
		visit_nodes(&c, o);
		refill(&c, &v, a);
		if (c.idles == OCTREE_WALKERS)
			return;
	}
}
