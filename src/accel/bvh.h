/* Bounding volume hierarchy: a binary tree of boxes, in double precision, laid out in depth-first order. */
#ifndef ACCEL_BVH_H
#define ACCEL_BVH_H

#include "accel/accel.h"
#include "accel/bvh_draft.h"

/* How rays find their way. ORDERED: of all boxes known the one the ray comes into first, up to the nearest hit. The others are the steps of
 * Smits 1999, table 1, and visit the whole subtree in a fixed order: POINT tests boxes by the point where the ray enters, by
 * recursion; SLABS by intervals; SIBLING without recursion, over links to left child, right sibling and parent; SKIP over links to
 * the node after a subtree; ARRAY the same in an array in depth-first order; ANY ends at the first primitive found, where the ray
 * allows it; CACHE tests the one that ended the ray before first. */
enum bvh_traversal {
	BVH_ORDERED, BVH_POINT, BVH_SLABS, BVH_SIBLING, BVH_SKIP, BVH_ARRAY, BVH_ANY, BVH_CACHE
};

struct bvh_options {
	int builder, traversal;
	int64_t max_objects, bins, optimise;
	double step, test;
};

/* Inner: count 0; the left child is the next node. Leaf: ids[first .. first + count). */
struct bvh_node {
	struct box bounds;
	uint32_t first, count, right, skip; /* skip: the node after the last one below */
};

struct bvh {
	struct bvh_node *nodes; /* depth first, the root at 0 */
	uint32_t *ids;
	int traversal;
	struct smits_node *links; /* for the traversals that follow links, else NULL */
};

/* A ray as box tests need it. */
struct bvh_ray {
	struct vec o, per_d;
	double slack;
	int32_t lower[3]; /* 1 where the direction points down */
};

static inline struct bvh_ray bvh_ray(const struct ray *r)
{
	struct bvh_ray b = { .o = r->o, .slack = r->slack };
	for (int i = 0; i < 3; i++) {
		b.per_d.a[i] = 1 / (r->d.a[i] == 0 ? 1e-300 : r->d.a[i]);
		b.lower[i] = b.per_d.a[i] < 0;
	}
	return b;
}

/* Whether the closed box meets the ray between 0 and limit, within slack; *t: where it comes in. */
static inline bool bvh_meets(const struct box *b, const struct bvh_ray *r, double limit, double *t)
{
	double in = 0, out = limit;
	for (int i = 0; i < 3; i++) {
		double near = ((r->lower[i] ? b->hi.a[i] : b->lo.a[i]) - r->o.a[i]) * r->per_d.a[i];
		double far = ((r->lower[i] ? b->lo.a[i] : b->hi.a[i]) - r->o.a[i]) * r->per_d.a[i];
		in = near > in ? near : in;
		out = far < out ? far : out;
	}
	*t = in;
	return in <= out + r->slack;
}

/* Lay the draft out: nodes and ids into a's memory, a's counts. 0, or -1 and *e: memory, deeper than BVH_DEEPEST. */
int bvh_lay_out(struct accel *a, struct bvh *b, const struct bvh_draft *d, struct err *e);

/* Smits' traversals; one of each is compiled for counting. */
bool smits_shoot(const struct accel *a, const struct ray *r, struct hit *h);
bool smits_shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n);
/* With the cache going from ray to ray. */
void smits_shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
/* Links between nodes, in the order a recursive builder would make them. 0, or -1 when memory is out. */
int smits_link(struct accel *a, struct bvh *b);

#endif
