/* Bounding volume hierarchy of eight children a node, for speed: boxes and triangles as floats, tested side by side.
 *
 * Hits are those of the list, bit for bit: floats only throw out what the ray certainly misses. Boxes are grown by more than what
 * rounding can move a ray (BVH8_GROWTH); of triangles, those that are certainly hit shorten the ray to where the hit lies at most, and
 * the few that remain at its end take the exact test of geom/hit.h.
 *
 * All in the frame of bvh_draft.h, where the root's diagonal is at most 1. Nodes and blocks lie in one array of units of 64 bytes,
 * depth first. A reference is a unit's number times 16, plus the number of blocks where it is a leaf. */
#ifndef ACCEL_BVH8_H
#define ACCEL_BVH8_H

#include "accel/accel.h"
#include "accel/bvh_draft.h"

enum { BVH8_WIDE = 8, BVH8_LANES = 4, BVH8_UNIT = 64, BVH8_MOST_BLOCKS = 15 };

/* Many rays are sorted before they are shot through a structure of more bytes than a cache holds. */
enum { BVH8_SORTED_BYTES = 16 << 20 };

/* Where a coordinate of the ray's origin may lie; rays from farther out are moved along to the root first. A ray's float coordinates
 * are then off by less than 12 roundings of 2^-24 wherever it may meet a box. */
#define BVH8_NEAR 1.0
#define BVH8_GROWTH 0x1p-20f

/* With S the ray's reach, which bounds |origin - corner|, and E a block's longest edge: rounding the inputs and every operation puts
 * the products u, v and det of the Moeller-Trumbore test off by less than 17 roundings of S E, its t by less than 17 of S E^2. The
 * test allows 32. */
#define BVH8_MARGIN 0x1p-19f

/* planes[2 axis + upper]; a child that is not there is a box no ray meets. */
struct bvh8_node {
	_Alignas(BVH8_UNIT) float planes[6][BVH8_WIDE];
	uint32_t child[BVH8_WIDE];
	uint32_t children, unused[7];
};

/* Triangles: a corner and the two edges from it. margin: how far off the products of the float test may be, per unit of reach;
 * margin_t: the same of its t, and of that by which its t is divided; both INFINITY where there are spheres. Lanes from 'count' on
 * repeat the last. area: half the surface of the primitives, a triangle having two sides. */
struct bvh8_block {
	_Alignas(BVH8_UNIT) float corner[3][BVH8_LANES];
	float edge1[3][BVH8_LANES], edge2[3][BVH8_LANES];
	uint32_t id[BVH8_LANES];
	float margin, margin_t;
	uint32_t count;
	float area;
};

/* The walks of one instruction set. */
struct bvh8_kernel {
	const char *name;
	bool (*shoot)(const struct accel *a, const struct ray *r, struct hit *h);
	bool (*shoot_counted)(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n);
	/* Rays as they are or in the order given: the latter for rays that would wait for memory. n: NULL where nothing is to be counted. */
	void (*shoot_all)(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
	void (*shoot_in_order)(const struct accel *a, const struct ray *r, const uint32_t *order, size_t count, struct hit *h, struct tally *n);
};
extern const struct bvh8_kernel bvh8_portable, bvh8_avx2, bvh8_avx512;

struct bvh8 {
	const struct bvh8_kernel *kernel;
	char *units;
	uint32_t root; /* reference */
	struct bvh_frame frame;
	quad half;     /* of the root's sides, in the frame, rounded upwards; lane 3 unused */
	double slack;  /* in the frame */
	bool spheres;  /* there are some */
};

struct bvh8_options {
	int builder, kernel;
	int64_t optimise;
};

enum bvh8_kernel_kind { BVH8_BEST, BVH8_AVX512, BVH8_AVX2, BVH8_PORTABLE };

/* Collapse the draft into b. 0, or -1 and *e: memory, too large. */
int bvh8_lay_out(struct accel *a, struct bvh8 *b, const struct bvh_draft *d, const struct bvh_rules *rules, struct err *e);

/* Put the children of every node into the order in which a ray that any hit ends visits them best. */
void bvh8_order_children(struct bvh8 *b);

/* An order of rays in which neighbours meet much the same, as ray numbers; free() it. NULL: as they are. */
uint32_t *bvh8_order(const struct accel *a, const struct ray *r, size_t count);

/* Where a reference leads; of a leaf's, somewhere in its first 64 bytes. */
static inline char *bvh8_at(const struct bvh8 *b, uint32_t ref)
{
	return b->units + (size_t)ref * (BVH8_UNIT / 16);
}

static inline const struct bvh8_node *bvh8_node(const struct bvh8 *b, uint32_t ref)
{
	return (const void *)bvh8_at(b, ref);
}

static inline const struct bvh8_block *bvh8_leaf(const struct bvh8 *b, uint32_t ref)
{
	return (const void *)bvh8_at(b, ref & ~15u);
}

#endif
