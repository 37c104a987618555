/* Octree (Aronov, Bronnimann, Chang, Chiang: Cost prediction for ray shooting, 2002): a root cube or tight box, cut through its centre
 * into eight while a cell lists more than max_objects primitives. Rays walk from leaf to leaf over links to the same-or-larger
 * node across each face and descend from there. This file: options, the walk of one ray, and the table. */
#include "accel/octree_walk.h"

#include <string.h>

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

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	const struct octree *o = a->impl;
	struct walker w;
	bool going = walk_start(&w, a, r);
	while (going) {
		while (w.node->inner)
			descend(&w, o);
		count_leaf(&w, count);
		find_exit(&w, o);
		__builtin_prefetch(w.next);
		if (w.node->count && !r->through)
			test_leaf(&w, a, o);
		going = w.next && !(w.hit.t <= w.exit + a->slack);
		w.from = w.node;
		w.node = w.next;
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

static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
#ifdef __x86_64__
	if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
		octree_crowd_avx512(a, r, count, h, n);
		return;
	}
	if (__builtin_cpu_supports("avx2")) {
		octree_crowd_avx2(a, r, count, h, n);
		return;
	}
#endif
	octree_crowd(a, r, count, h, n);
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
	octree_build, octree_cells, shoot, shoot_counted, shoot_many, octree_check, NULL
};
