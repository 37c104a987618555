/* A binary tree of boxes while it is made: what builders fill, what optimisation changes, and what bvh and bvh8 are laid out from.
 *
 * Coordinates are floats in a frame of their own: relative to the root's centre, times a power of two that brings the root's
 * diagonal into (1/2, 1]. Boxes are rounded outwards. */
#ifndef ACCEL_BVH_DRAFT_H
#define ACCEL_BVH_DRAFT_H

#include "accel/accel.h"
#include "accel/quad.h"

/* frame coordinates = (scene coordinates - center) * scale; exact but for the subtraction. */
struct bvh_frame {
	struct vec center;
	double scale;
};

/* A primitive, or a part of one (spatial splits), by its box; lane 3 of lo is the primitive's id, of hi nothing. */
union bvh_ref {
	struct quad_box box;
	struct { float lo[3]; uint32_t id; float hi[3]; uint32_t unused; };
};

/* Inner: count 0, children nodes[first] and nodes[first + 1]. Leaf: refs[first .. first + count). */
struct bvh_draft_node {
	float lo[3];
	uint32_t first;
	float hi[3];
	uint32_t count;
};

struct bvh_draft {
	const struct primitives *primitives; /* borrowed */
	struct bvh_frame frame;
	struct bvh_draft_node *nodes; /* nodes[0] is the root; there may be unused ones between */
	union bvh_ref *refs;
	uint32_t ref_count;
	bool parts; /* refs may be parts: leaves are no larger than the refs, not the primitives, say */
	void *memory[2]; /* owned: nodes and refs */
};

/* What a leaf and a step cost, for builders that weigh. A leaf of n costs test * blocks of n, an inner node costs step. */
struct bvh_rules {
	float step, test;
	uint32_t block; /* primitives tested together: a power of two */
	uint32_t most;  /* primitives a leaf may list, >= 1 */
	int bins;       /* binned, spatial: planes tried an axis, plus one; at most BVH_BINS */
	int threads;
};

/* No leaf is deeper than BVH_DEPTH where a builder halves or weighs; insertion and reinsertion may go further, but no walk goes deeper
 * than BVH_DEEPEST. */
enum { BVH_BINS = 64, BVH_DEPTH = 128, BVH_DEEPEST = 512 };

enum bvh_builder { BVH_BINNED, BVH_SAH, BVH_MEDIAN, BVH_INSERTION, BVH_SPATIAL };

/* Make the tree; a is only asked for its root and primitives. optimise: rounds of reinsertion. 0, or -1 and *e (memory). Free it in
 * any case. */
int bvh_draft_make(struct bvh_draft *d, const struct accel *a, enum bvh_builder b, int optimise, const struct bvh_rules *rules,
                   struct err *e);
void bvh_draft_free(struct bvh_draft *d);

/* The builders. d: refs filled, one a primitive, in order; room for 2 ref_count nodes. 0, or -1 when memory is out.
 * binned: Wald 2007, the planes between equal bins of the centroids. sweep: every plane between two centroids. median: Smits 1999,
 * figure 1: halves by centroid, axes in turn. insertion: Goldsmith and Salmon 1987, one primitive after the other in the order
 * given by a fixed shuffle. spatial: Stich, Friedrich, Dietrich 2009: parts of primitives on both sides of a plane. */
int bvh_build_binned(struct bvh_draft *d, const struct bvh_rules *rules);
int bvh_build_sweep(struct bvh_draft *d, const struct bvh_rules *rules);
int bvh_build_median(struct bvh_draft *d, const struct bvh_rules *rules);
int bvh_build_insertion(struct bvh_draft *d, const struct bvh_rules *rules);
int bvh_build_spatial(struct bvh_draft *d, const struct bvh_rules *rules);

/* Take subtrees out and put them where they cost least (Bittner, Hapala, Havran 2013), 'rounds' times over all nodes.
 * 0, or -1 when memory is out. */
int bvh_optimise(struct bvh_draft *d, int rounds);

/* Blocks of n primitives. */
static inline uint32_t bvh_blocks(uint32_t n, uint32_t block)
{
	return (n + block - 1) / block;
}

static inline struct quad_box bvh_node_box(const struct bvh_draft_node *n)
{
	return (struct quad_box){ { n->lo[0], n->lo[1], n->lo[2], 0 }, { n->hi[0], n->hi[1], n->hi[2], 0 } };
}

static inline void bvh_node_set(struct bvh_draft_node *n, struct quad_box b, uint32_t first, uint32_t count)
{
	*n = (struct bvh_draft_node){ { b.lo[0], b.lo[1], b.lo[2] }, first, { b.hi[0], b.hi[1], b.hi[2] }, count };
}

/* Twice the centroid of a ref; lane 3 is 0, for arithmetic on an id would be slow: most are no normal floats. */
static inline quad bvh_ref_center(const union bvh_ref *r)
{
	return (quad)((quad_int)r->box.lo & (quad_int){ -1, -1, -1, 0 }) + (quad)((quad_int)r->box.hi & (quad_int){ -1, -1, -1, 0 });
}

#endif
