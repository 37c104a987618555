/* The octree's inside, shared by the files that build it (octree_build.c) by a criterion (octree_criterion.c), balance it
 * (octree_balance.c), list and check its cells (octree_cells.c), and walk it (octree_walk.h) one ray at a time (octree.c) or many
 * (octree_crowd.c).
 *
 * Cells have integer coordinates on a grid of 2^20 cells a side over the root, whatever the tree's depth: plane i of an axis lies
 * at root.lo + i * step, the same double for every cell that has it as a side. */
#ifndef ACCEL_OCTREE_H
#define ACCEL_OCTREE_H

#include "accel/accel.h"
#include "accel/axes.h"
#include "accel/root.h"

enum { OCTREE_LEVELS = 20, OCTREE_CELLS = 1 << OCTREE_LEVELS };
#define NO_NODE UINT32_MAX

enum octree_overlap { OVERLAP_EXACT, OVERLAP_BBOX };

/* What a cell above max_depth is split for:
 *   OBJECTS   it lists more than max_objects primitives
 *   FEATURES  it is larger than the cut-off and meets an edge or a corner of a triangle (Aronov and Fortune, as told by Aronov et
 *             al. 2002, section 3.3); a sphere has neither
 *   RANDOM    by chance, 2 / level, always on the first two levels and never from level 8 on (ibid., section 4.3) */
enum octree_criterion { CRITERION_OBJECTS, CRITERION_FEATURES, CRITERION_RANDOM };

/* Of the options of one criterion the others make nothing; 'runs' is for job files, which make it a list of 'run'. */
struct octree_options {
	bool balanced;
	int64_t max_objects, max_depth;
	int root, overlap, criterion;
	double cutoff;                  /* FEATURES: in sides of the root */
	int64_t root_level, run, runs;  /* RANDOM */
	int64_t seed;                   /* RANDOM: with the scene and the run it determines the tree */
};

/* A list no longer than this lies in its leaf; longer ones lie in refs. */
enum { OCTREE_SHORT = 5 };

struct screen;

/* One cache line. Children stand together, number 4 z + 2 y + x (upper half: 1). While a tree is being built all lists lie in refs. */
struct octree_node {
	union {
		uint32_t child;             /* inner: the first of eight */
		uint32_t first;             /* leaf with a long list: its ids are refs[first .. first + count) */
		uint32_t ids[OCTREE_SHORT]; /* leaf with a short one: the ids */
	};
	uint32_t count;   /* leaf: length of its list */
	uint32_t link[6]; /* leaf: the same-or-larger node across face 2 axis + upper, NO_NODE outside */
	int32_t cell[3];  /* lower corner on the grid */
	uint8_t depth;
	bool inner;
	uint8_t unused[2];
};
_Static_assert(sizeof(struct octree_node) == 64, "a node is a cache line");

struct octree {
	struct octree_node *nodes; /* depth first, root at 0 */
	uint32_t *refs;
	const struct screen *screens; /* of all primitives */
	uint32_t *start;           /* [1 << 3 start_depth], x fastest: the node of that depth or the leaf around it */
	int start_depth;
	uint32_t node_count, ref_count;
	axes lo, hi;               /* of the root */
	axes step, per_step;       /* grid spacing and its inverse */
	struct vec center;         /* of the root */
	double diagonal;
	struct octree_options options;
};

/* Side of a node in grid cells. */
static inline int32_t octree_side(unsigned depth)
{
	return (int32_t)(OCTREE_CELLS >> depth);
}

/* Position of grid plane i. */
static inline double octree_plane(const struct box *root, const struct octree *o, int axis, int32_t i)
{
	return root->lo.a[axis] + i * o->step[axis];
}

/* The list of a leaf of a finished tree. */
static inline const uint32_t *octree_list(const struct octree *o, const struct octree_node *n)
{
	return n->count <= OCTREE_SHORT ? n->ids : o->refs + n->first;
}

/* The child of n on the way to grid cell 'at'. */
static inline uint32_t octree_child_toward(const struct octree_node *n, const int32_t *at)
{
	int shift = OCTREE_LEVELS - 1 - n->depth;
	return n->child + (uint32_t)((at[0] >> shift & 1) | (at[1] >> shift & 1) << 1 | (at[2] >> shift & 1) << 2);
}

/* Whether node n, whose list is ids[0 .. n->count), is to be split. */
bool octree_wants_split(const struct primitives *p, const struct box *root, const struct octree *o, const struct octree_node *n,
                        const uint32_t *ids);

struct box octree_bounds(const struct box *root, const struct octree *o, const struct octree_node *n);

/* A tree being built: arrays that grow, from malloc, freed on closing. Inner nodes' old lists stay in refs until the end. */
struct octree_builder {
	const struct primitives *primitives;
	const struct box *root;
	double slack;
	struct octree tree;
	struct box *bounds; /* of every primitive */
	size_t node_room, ref_room;
};

/* Fill *b with the tree split to the options over a->primitives, a->root and a->slack. Close it in any case.
 * 0, or -1 and *e: memory, too many nodes. */
int octree_builder_open(struct octree_builder *b, const struct accel *a, const struct octree_options *o, struct err *e);
void octree_builder_close(struct octree_builder *b);

/* Add eight leaf children to leaf 'n' and share its list out among them (the old list stays behind, unused).
 * 0, or -1 and *e: memory, too many nodes. */
int octree_split(struct octree_builder *b, uint32_t n, struct err *e);

/* Moore's three passes with the table of leaf vertices (Aronov et al. 2002, section 4.1): afterwards leaves that share a vertex
 * differ by at most one level. 0, or -1 and *e. */
int octree_balance(struct octree_builder *b, struct err *e);

/* The door's functions that do not walk. */
int octree_build(struct accel *a, const void *opt, struct err *e);
int octree_cells(const struct accel *a, cell_fn *fn, void *ctx);
int octree_check(const struct accel *a, struct err *e);

/* The door's walk of many rays (octree_crowd.c): for any processor, and for those with AVX2 and AVX-512. OCTREE_CROWD: the one compiled
 * for. */
void octree_crowd(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
void octree_crowd_avx2(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
void octree_crowd_avx512(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
#define OCTREE_CROWD octree_crowd_avx512
#elif defined(__AVX2__)
#define OCTREE_CROWD octree_crowd_avx2
#else
#define OCTREE_CROWD octree_crowd
#endif

#endif
