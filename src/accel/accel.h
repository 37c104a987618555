/* Spatial structures behind one door: build one over primitives, list its cells, shoot rays through it.
 *
 * What is counted, the same for every structure, per ray:
 *   leaves       leaf cells visited over a piece of positive length, the one of the start included
 *   tests        ray-primitive tests: every primitive listed in a visited leaf, the ray's own start primitive too; there is no
 *                mailbox and no early out
 *   tests_made   of these the ones a mailbox does not spare; 0 where the structure has none
 *   barycentric  of the tests made of triangles those whose plane is met before the nearest hit so far, where a test that begins with the
 *                plane (Wald 2004) goes on; only where 'plane_tests' says so, and 0 for rays that nothing stops
 *   inner_step   inner nodes visited while stepping from one leaf to the next
 *   inner_start  inner nodes visited on the way to the first leaf, root included
 *   boxes        ray-box tests: inner nodes of both that hold a bounding box, or what a bounding volume hierarchy tests
 *   hits         1 if a primitive ends the ray, else 0
 *
 * The cells of a bounding volume hierarchy are boxes that may overlap and leave gaps. A node is visited when its box, closed, is met
 * within slack by what is left of the ray at that moment: up to the nearest hit so far. leaves and inner_step count the nodes
 * visited (inner_start stays 0), tests the primitives listed in visited leaves; a ray that leads out of the root visits what it
 * touches and hits nothing. A node of k children costs k box tests, which are shared by all children: the cost of such a structure is
 * alpha * inner_step + beta * tests (Aila, Karras, Laine 2013 weigh them 1.2 : 1).
 *
 * Rules that make the closed forms of cost/ exact:
 *   1 a hit is accepted in the leaf where t <= t_exit + slack; one further out is ignored there and found again later
 *   2 the start leaf is found by point and direction: a start within slack of a cell plane belongs to the cell ahead; one that
 *     leads out of the root visits nothing
 *   3 lists hold every primitive within slack of the closed cell ('inner_lists': those that reach into it)
 *   4 a hit at |t| <= slack counts only for an id higher than the start primitive's (geom/ray.h) */
#ifndef ACCEL_ACCEL_H
#define ACCEL_ACCEL_H

#include "base/arena.h"
#include "base/err.h"
#include "base/key.h"
#include "scene/primitives.h"

#include <stdbool.h>
#include <stdint.h>

#define TALLY_COUNTS(X) X(leaves) X(tests) X(tests_made) X(barycentric) X(inner_step) X(inner_start) X(boxes) X(hits)

struct tally {
#define COUNT_OF(field) uint64_t field;
	TALLY_COUNTS(COUNT_OF)
#undef COUNT_OF
};

static inline void tally_add(struct tally *to, const struct tally *n)
{
#define ADD(field) to->field += n->field;
	TALLY_COUNTS(ADD)
#undef ADD
}

/* How rays get from one leaf to the next: over links between neighbours, which cells list as 'steps'; by a recursion that visits
 * every inner node around a visited leaf once; from the root anew for every leaf. */
enum travel { TRAVEL_LINKS, TRAVEL_RECURSIVE, TRAVEL_RESTART };

/* Which tests are spared: none, those of primitives that the last leaf listed too, all that the ray has had before. */
enum mailbox_kind { MAILBOX_NONE, MAILBOX_ONE, MAILBOX_FULL };

/* What ends subdivision before the structure's own limits do, where it has such an option: nothing, or the least predicted cost
 * (cost/stop.h; to accel_build they are all the same). */
enum stop { STOP_NONE, STOP_MODEL, STOP_EXACT };

/* One cell as a predictor sees it; inner cells are listed too. A leaf is convex and the leaves partition the root, but for what
 * boxes cut away: no surface is there; those of a bounding volume hierarchy do not. A structure without inner cells lists leaves of depth 0 only. */
struct cell {
	struct box bounds;
	double area;               /* surface area, scene units^2 */
	const uint32_t *ids;       /* leaf: the listed primitives; inner: NULL */
	uint32_t count;            /* of ids */
	uint16_t depth;            /* root 0 */
	bool leaf;
	bool box;                  /* inner: a bounding box, that of the one cell inside, is tested here */
	/* Leaf: inner nodes visited by a ray that crosses face f (2 axis + upper side), both directions together; 0 where the
	 * outside or smaller cells lie across: a face is charged to its smaller cell. */
	double steps[6];
};
/* Return 0 to go on, anything else to stop. */
typedef int cell_fn(void *ctx, const struct cell *c);

struct accel;

/* What a structure is. Options live in a struct of opt_size <= ACCEL_OPT_MOST bytes described by keys. */
struct accel_ops {
	const char *name, *text;      /* key in job files; one line for the docs */
	const struct key *keys;       /* its options; ends with a NULL name */
	size_t opt_size;
	/* Whether the option called 'key' means anything beside the others of opt; NULL: all do. */
	bool (*applies)(const void *opt, const char *key);
	int (*build)(struct accel *a, const void *opt, struct err *e);
	/* Every cell in a fixed preorder; returns what fn stopped with, or 0. */
	int (*cells)(const struct accel *a, cell_fn *fn, void *ctx);
	/* Fill *h with the first hit (hit_better order) and return whether there is one. The counted form adds to *n. What shoot finds is
	 * the same, but t may be off by 5e-4 of the root's diagonal (mostly by less than 1e-6) where a structure is built
	 * for speed. */
	bool (*shoot)(const struct accel *a, const struct ray *r, struct hit *h);
	bool (*shoot_counted)(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n);
	/* The counted form for an array of rays; fills h[count] and n[count]. Same results as one by one, sooner. */
	void (*shoot_many)(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);
	int (*check)(const struct accel *a, struct err *e); /* invariants, for tests */
	/* As shoot, for an array of rays; fills h[count]. NULL: nothing faster than one by one (accel_hit_many). */
	void (*hit_many)(const struct accel *a, const struct ray *r, size_t count, struct hit *h);
};

enum { ACCEL_OPT_MOST = 128 };

/* Read-only once built: threads share it freely. */
struct accel {
	const struct accel_ops *ops;
	const struct primitives *primitives; /* borrowed; must outlive the structure */
	struct box root;                     /* the region that is partitioned: holds every primitive */
	double slack;                        /* 1e-9 of the root's diagonal */
	bool volumes;                        /* a bounding volume hierarchy */
	bool to_hit;                         /* rays visit the nodes of volumes that meet them up to their nearest hit, and no others */
	bool plane_tests;                    /* 'barycentric' is counted */
	bool inner_lists;                    /* what only touches a cell is not listed (accel_wants_inside) */
	int threads;                         /* that build may use; the structure does not depend on it */
	void *impl;                          /* the structure's own nodes, inside mem */
	struct arena mem;                    /* owned */
	uint64_t nodes, leaves, empty_leaves, references;
	int depth;                           /* of the deepest leaf */
	enum travel travel;
	enum mailbox_kind mailbox;
};

extern const struct accel_ops *const accel_all[]; /* NULL-terminated */

/* The structure called 'name', or NULL. */
const struct accel_ops *accel_find(const char *name);

/* Build into *a (zeroed here). opt: the structure's own options, filled from its keys. 0, or -1 and *e; then nothing is held. */
int accel_build(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, struct err *e);

/* The same on up to 'threads' threads. */
int accel_build_on(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, int threads,
                   struct err *e);

void accel_free(struct accel *a);

/* The hits of many rays, uncounted: those of shoot, sooner where the structure can. */
void accel_hit_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h);

/* Whether a primitive of these bounds is listed only where it reaches into a cell along the axis: inner lists want that of all but what is
 * flat across the axis, which may lie in a side of the cell. */
static inline bool accel_wants_inside(const struct accel *a, const struct box *own, int axis)
{
	return a->inner_lists && own->lo.a[axis] < own->hi.a[axis];
}

/* What alpha weighs in the cost of a ray. */
static inline uint64_t accel_steps(const struct accel *a, const struct tally *n)
{
	return a->volumes ? n->inner_step : n->leaves;
}

/* Whether the structure has an option 'key' that means something beside its others. */
bool accel_applies(const struct accel_ops *ops, const void *opt, const char *key);

#endif
