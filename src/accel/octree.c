/* Octree (Aronov, Bronnimann, Chang, Chiang: Cost prediction for ray shooting, 2002): a root cube or tight box, cut through its centre
 * into eight while a cell lists more than max_objects primitives. Rays walk from leaf to leaf over links to the same-or-larger
 * node across each face and descend from there. This file: options and
 * walk. */
#include "accel/octree.h"
#include "accel/walk.h"

#include <string.h>

/* Enough to cover a miss to memory by the others' work, few enough to stay in the nearest cache. */
enum { OCTREE_WALKERS = 16 };

/* Blocks a list may have for its candidates to be put off. */
enum { SHORT_LIST = 4 };

static const char *const root_words[] = { "cube", "box", NULL };
static const char *const overlap_words[] = { "exact", "bbox", NULL };
static const char *const criterion_words[] = { "objects", "features", "random", NULL };
static const struct key keys[] = {
	{ "balanced", KEY_BOOL, offsetof(struct octree_options, balanced), 0, 1, 0, NULL,
	  "leaves that share a vertex differ by at most one level" },
	{ "max_objects", KEY_INT, offsetof(struct octree_options, max_objects), 1, 1e9, 5, NULL,
	  "a cell that lists more primitives is split" },
	{ "root", KEY_WORD, offsetof(struct octree_options, root), 0, 0, ROOT_BOX, root_words,
	  "the region: bounding cube or tight bounding box" },
	{ "max_depth", KEY_INT, offsetof(struct octree_options, max_depth), 0, OCTREE_LEVELS, 8, NULL,
	  "cells of this depth are not split; the root has depth 0" },
	{ "overlap", KEY_WORD, offsetof(struct octree_options, overlap), 0, 0, OVERLAP_EXACT, overlap_words,
	  "what puts a primitive into a cell's list: its surface, or its bounding box, meets the cell" },
	{ "criterion", KEY_WORD, offsetof(struct octree_options, criterion), 0, 0, CRITERION_OBJECTS, criterion_words,
	  "what cells are split for: more than max_objects primitives, edges and corners, or chance" },
	{ "cutoff", KEY_REAL, offsetof(struct octree_options, cutoff), 0, 1, 0, NULL,
	  "features: cells of at most this share of the root's longest side are not split" },
	{ "root_level", KEY_INT, offsetof(struct octree_options, root_level), 0, 1, 0, NULL,
	  "random: level of the root; a cell of level l is split by the chance 2 / l, from level 8 on never" },
	{ "run", KEY_INT, offsetof(struct octree_options, run), 1, 1e6, 1, NULL, "random: which of the trees" },
	{ "runs", KEY_INT, offsetof(struct octree_options, runs), 0, 1e6, 0, NULL, "random: runs: 5 is run: [1, 2, 3, 4, 5]" },
	{ "seed", KEY_INT, offsetof(struct octree_options, seed), 0, 9e15, 0, NULL,
	  "random: of the chances; in a job the job's seed if not given" },
	{ 0 }
};

/* Grid cell of p on one axis: one that is within slack of a plane belongs to the cell ahead. */
static inline int32_t locate(const struct accel *a, const struct octree *o, int axis, double p, double d)
{
	double x = (p - a->root.lo.a[axis]) * o->per_step.a[axis];
	x = x < 0 ? 0 : x > OCTREE_CELLS ? OCTREE_CELLS : x;
	int32_t plane = (int32_t)(x + 0.5);
	int32_t cell = fabs(p - octree_plane(&a->root, o, axis, plane)) <= a->slack ? plane - (d < 0) : (int32_t)x;
	return cell < 0 ? 0 : cell >= OCTREE_CELLS ? OCTREE_CELLS - 1 : cell;
}

/* A ray on its way through the tree. */
struct walker {
	const struct ray *ray;
	const struct octree_node *node, *from; /* where it is; the leaf it came from, NULL at first */
	struct hit hit;
	struct vec o, per_d;      /* origin; 1 / d, where a zero counts as positive */
	double exit;              /* t where it leaves the leaf */
	int32_t upper[3];         /* all ones where it leaves cells through the upper side */
	int32_t at[3];            /* the grid cell it is heading for below 'node' */
	int axis;                 /* of the face through which it leaves */
	struct block_ray packed;
	struct tally tally;
};

/* False when the ray misses the root. */
static inline bool walk_start(struct walker *w, const struct accel *a, const struct ray *r)
{
	const struct octree *o = a->impl;
	w->hit = hit_none(r);
	w->tally = (struct tally){ 0 };
	w->ray = r;
	w->o = r->o;
	w->from = NULL;
	for (int i = 0; i < 3; i++) {
		w->per_d.a[i] = 1 / nonzero(r->d.a[i]);
		w->upper[i] = -(w->per_d.a[i] > 0);
	}
	struct vec start;
	if (!root_enter(&a->root, r, w->per_d, a->slack, &start))
		return false;
	w->packed = block_ray(r, o->center, o->diagonal);
	for (int i = 0; i < 3; i++)
		w->at[i] = locate(a, o, i, start.a[i], r->d.a[i]);
	int shift = OCTREE_LEVELS - o->start_depth;
	w->node = &o->nodes[o->start[(w->at[0] >> shift) | (w->at[1] >> shift) << o->start_depth |
	                             (w->at[2] >> shift) << 2 * o->start_depth]];
	__builtin_prefetch(w->node);
	return true;
}

static inline void find_exit(struct walker *w, const struct accel *a, const struct octree *o)
{
	double t[3];
	const struct octree_node *n = w->node;
	int32_t side = octree_side(n->depth);
	for (int i = 0; i < 3; i++)
		t[i] = (octree_plane(&a->root, o, i, n->cell[i] + (side & w->upper[i])) - w->o.a[i]) * w->per_d.a[i];
	w->axis = t[1] < t[0];
	w->exit = t[1] < t[0] ? t[1] : t[0];
	w->axis = t[2] < w->exit ? 2 : w->axis;
	w->exit = t[2] < w->exit ? t[2] : w->exit;
}

/* Grid cell behind the face through which the ray left its last leaf: exact on the face's axis, within the face on the others. */
static inline void find_crossing(struct walker *w, const struct accel *a, const struct octree *o)
{
	const struct octree_node *from = w->from;
	int32_t side = octree_side(from->depth);
	for (int i = 0; i < 3; i++) {
		double x = (w->o.a[i] + w->exit * w->ray->d.a[i] - a->root.lo.a[i]) * o->per_step.a[i];
		int32_t low = from->cell[i], high = low + side - 1, cell = (int32_t)x;
		cell = cell > high ? high : cell;
		w->at[i] = cell < low ? low : cell;
	}
	w->at[w->axis] = w->upper[w->axis] ? from->cell[w->axis] + side : from->cell[w->axis] - 1;
}

/* From an inner node one down. */
static inline void descend(struct walker *w, const struct accel *a, const struct octree *o)
{
	/* A node as large as the last leaf is the first below its link: the crossing is not known yet. */
	if (w->from && w->node->depth == w->from->depth)
		find_crossing(w, a, o);
	w->node = &o->nodes[octree_child_toward(w->node, w->at)];
}

/* The node across the face through which the ray leaves, or NULL outside. */
static inline const struct octree_node *find_next(const struct walker *w, const struct octree *o)
{
	uint32_t link = w->node->link[2 * w->axis - w->upper[w->axis]];
	return link == NO_NODE ? NULL : &o->nodes[link];
}

/* Count a leaf, with the inner nodes passed on the way: the path from the root, or from the link, which is as deep as the last
 * leaf or a leaf itself. */
static inline __attribute__((always_inline)) void count_leaf(struct walker *w, const bool count)
{
	struct tally *tally = &w->tally;
	const struct octree_node *n = w->node;
	COUNT(leaves, 1);
	COUNT(tests, n->count);
	if (!w->from)
		COUNT(inner_start, n->depth);
	else
		COUNT(inner_step, n->depth > w->from->depth ? (uint64_t)(n->depth - w->from->depth) : 0);
}

static inline void test_leaf(struct walker *w, const struct accel *a, const struct octree *o)
{
	const struct octree_node *n = w->node;
	block_test(&o->blocks[n->block], n->edge, a->primitives->all, n->count, w->ray, &w->packed, w->exit + a->slack, &w->hit);
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	const struct octree *o = a->impl;
	struct walker w;
	bool going = walk_start(&w, a, r);
	while (going) {
		while (w.node->child)
			descend(&w, a, o);
		count_leaf(&w, count);
		find_exit(&w, a, o);
		const struct octree_node *next = find_next(&w, o);
		__builtin_prefetch(next);
		if (w.node->count && !r->through)
			test_leaf(&w, a, o);
		going = next && !(w.hit.t <= w.exit + a->slack);
		w.from = w.node;
		w.node = next;
	}
	COUNT(leaves, w.tally.leaves);
	COUNT(tests, w.tally.tests);
	COUNT(inner_step, w.tally.inner_step);
	COUNT(inner_start, w.tally.inner_start);
	*h = w.hit;
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}
WALK_TWICE(walk)

/* Walkers that take the same step one after the other: their work overlaps, and so do their waits for memory, since what a walker
 * will read in its next step is asked for in this one. Lists of walker numbers say who takes which step in this turn. */
struct crowd {
	struct walker walker[OCTREE_WALKERS];
	size_t ray[OCTREE_WALKERS];
	uint8_t visit[OCTREE_WALKERS], test[OCTREE_WALKERS], leave[OCTREE_WALKERS], idle[OCTREE_WALKERS];
	int visits, tests, leaves, idles;
	struct candidate { uint32_t id; uint8_t walker; } candidate[OCTREE_WALKERS * SHORT_LIST * LANES];
	int candidates;
};

/* Give idle walkers the rays that are left; returns the number of the next one. */
static size_t refill(struct crowd *c, const struct accel *a, const struct ray *r, size_t next, size_t count, struct hit *h,
                     struct tally *n)
{
	while (c->idles > 0 && next < count) {
		uint8_t k = c->idle[c->idles - 1];
		if (walk_start(&c->walker[k], a, &r[next])) {
			c->ray[k] = next;
			c->visit[c->visits++] = k;
			c->idles--;
		} else {
			h[next] = c->walker[k].hit;
			n[next] = c->walker[k].tally;
		}
		next++;
	}
	return next;
}

/* Those at an inner node go one down; those at a leaf find their way out of it and ask for its blocks. */
static void visit_nodes(struct crowd *c, const struct accel *a, const struct octree *o)
{
	uint8_t leaf[OCTREE_WALKERS];
	int leaves = 0, inner = 0;
	for (int i = 0; i < c->visits; i++) {
		uint8_t k = c->visit[i];
		bool at_leaf = c->walker[k].node->child == 0;
		leaf[leaves] = k;
		leaves += at_leaf;
		c->visit[inner] = k;
		inner += !at_leaf;
	}
	c->visits = inner;
	for (int i = 0; i < inner; i++) {
		struct walker *w = &c->walker[c->visit[i]];
		descend(w, a, o);
		__builtin_prefetch(w->node);
	}
	c->tests = c->leaves = 0;
	for (int i = 0; i < leaves; i++) {
		struct walker *w = &c->walker[leaf[i]];
		const struct octree_node *n = w->node;
		count_leaf(w, true);
		find_exit(w, a, o);
		__builtin_prefetch(find_next(w, o));
		const char *line = (const char *)&o->blocks[n->block], *end = line + block_count(n->count) * sizeof *o->blocks;
		for (; line < end; line += 64)
			__builtin_prefetch(line);
		c->leave[c->leaves++] = leaf[i];
		c->test[c->tests] = leaf[i];
		c->tests += n->count && !w->ray->through;
	}
}

/* Blocks first, for everybody; the few primitives that remain are asked for meanwhile and tested after. */
static void test_leaves(struct crowd *c, const struct accel *a, const struct octree *o)
{
	c->candidates = 0;
	for (int i = 0; i < c->tests; i++) {
		struct walker *w = &c->walker[c->test[i]];
		const struct octree_node *n = w->node;
		uint32_t ids[SHORT_LIST * LANES], blocks = block_count(n->count);
		if (blocks > SHORT_LIST) {
			test_leaf(w, a, o);
			continue;
		}
		uint32_t found = block_candidates(&o->blocks[n->block], blocks, n->edge, w->ray, &w->packed, w->exit + a->slack, ids);
		for (uint32_t k = 0; k < found; k++) {
			c->candidate[c->candidates++] = (struct candidate){ ids[k], c->test[i] };
			__builtin_prefetch(&a->primitives->all[ids[k]]);
			__builtin_prefetch((const char *)(&a->primitives->all[ids[k]] + 1) - 1);
		}
	}
	for (int i = 0; i < c->candidates; i++) {
		struct walker *w = &c->walker[c->candidate[i].walker];
		primitive_hit(&a->primitives->all[c->candidate[i].id], c->candidate[i].id, w->ray, &w->hit);
	}
}

/* Those done with a leaf end or go on to the next node. */
static void leave_leaves(struct crowd *c, const struct accel *a, const struct octree *o, struct hit *h, struct tally *n)
{
	for (int i = 0; i < c->leaves; i++) {
		uint8_t k = c->leave[i];
		struct walker *w = &c->walker[k];
		const struct octree_node *next = find_next(w, o);
		if (!next || w->hit.t <= w->exit + a->slack) {
			w->tally.hits = w->hit.id != NO_PRIMITIVE;
			h[c->ray[k]] = w->hit;
			n[c->ray[k]] = w->tally;
			c->idle[c->idles++] = k;
			continue;
		}
		w->from = w->node;
		w->node = next;
		c->visit[c->visits++] = k;
	}
}

static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	const struct octree *o = a->impl;
	struct crowd c;
	c.visits = c.tests = c.leaves = 0;
	for (c.idles = 0; c.idles < OCTREE_WALKERS; c.idles++)
		c.idle[c.idles] = (uint8_t)c.idles;
	for (size_t next = 0;;) {
		next = refill(&c, a, r, next, count, h, n);
		if (c.idles == OCTREE_WALKERS)
			return;
		visit_nodes(&c, a, o);
		test_leaves(&c, a, o);
		leave_leaves(&c, a, o, h, n);
	}
}

static bool applies(const void *opt, const char *key)
{
	static const struct { const char *key; int criterion; } only[] = {
		{ "max_objects", CRITERION_OBJECTS }, { "cutoff", CRITERION_FEATURES }, { "root_level", CRITERION_RANDOM },
		{ "run", CRITERION_RANDOM }, { "seed", CRITERION_RANDOM }
	};
	const struct octree_options *o = opt;
	for (size_t i = 0; i < sizeof only / sizeof *only; i++)
		if (strcmp(only[i].key, key) == 0)
			return o->criterion == only[i].criterion;
	return strcmp(key, "runs") != 0;
}

const struct accel_ops accel_octree = {
	"octree", "cells cut into eight through the centre, leaves linked over their faces", keys, sizeof(struct octree_options), applies,
	octree_build, octree_cells, shoot, shoot_counted, shoot_many, octree_check
};
