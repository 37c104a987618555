/* Which cells of an octree are split. */
#include "accel/octree.h"
#include "base/rng.h"

/* From this level on random octrees end. */
enum { RANDOM_LEVELS = 8 };

/* Whether the segment from p to q meets the closed box. */
static bool segment_touches(struct vec p, struct vec q, const struct box *b)
{
	double low = 0, high = 1;
	for (int i = 0; i < 3; i++) {
		double d = q.a[i] - p.a[i];
		if (d == 0) {
			if (p.a[i] < b->lo.a[i] || p.a[i] > b->hi.a[i])
				return false;
			continue;
		}
		double t = (b->lo.a[i] - p.a[i]) / d, u = (b->hi.a[i] - p.a[i]) / d;
		low = fmax(low, fmin(t, u));
		high = fmin(high, fmax(t, u));
	}
	return low <= high;
}

static bool meets_feature(const struct primitives *p, const struct box *cell, const uint32_t *ids, uint32_t count)
{
	for (uint32_t i = 0; i < count; i++) {
		const struct primitive *q = &p->all[ids[i]];
		for (int k = 0; q->kind == PRIMITIVE_TRIANGLE && k < 3; k++)
			if (segment_touches(q->triangle.v[k], q->triangle.v[(k + 1) % 3], cell))
				return true;
	}
	return false;
}

/* The cell's own random number: it does not depend on the order in which cells are split. */
static double draw(const struct primitives *p, const struct octree *o, const struct octree_node *n)
{
	uint64_t cell = n->depth;
	for (int i = 0; i < 3; i++)
		cell = rng_mix(cell ^ (uint64_t)n->cell[i]);
	return rng_uniform(rng_key((uint64_t)o->options.seed ^ p->hash, (uint64_t)o->options.run, cell), 0);
}

static bool wins_chance(const struct primitives *p, const struct octree *o, const struct octree_node *n)
{
	int64_t level = n->depth + o->options.root_level;
	return level < RANDOM_LEVELS && draw(p, o, n) * (double)level < 2;
}

bool octree_wants_split(const struct primitives *p, const struct box *root, const struct octree *o, const struct octree_node *n,
                        const uint32_t *ids)
{
	const struct octree_options *opt = &o->options;
	struct box cell;
	if (n->depth >= opt->max_depth)
		return false;
	switch ((enum octree_criterion)opt->criterion) {
	case CRITERION_OBJECTS:
		return n->count > opt->max_objects;
	case CRITERION_FEATURES:
		cell = octree_bounds(root, o, n);
		return octree_side(n->depth) > opt->cutoff * OCTREE_CELLS && meets_feature(p, &cell, ids, n->count);
	case CRITERION_RANDOM:
		return wins_chance(p, o, n);
	}
	return false;
}
