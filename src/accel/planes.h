/* Trees of axis-parallel planes: what kd trees and BSP trees have in common. They differ in how a plane is chosen, which is a function
 * (plane_rule) that a structure hands to the builder; node layout, lists, cells and walks are the same.
 *
 *   planes.h         nodes, and what a rule is told
 *   planes_build.c   from a rule to a tree
 *   planes_cells.c   its cells
 *   planes_walk.c    rays, recursively or restarting from the root
 *   kd.c             the kd tree's options
 *   kd_split.c, kd_cost.c how it chooses planes: to balance the halves; of least expected cost
 *   bsp.c            the BSP tree's */
#ifndef ACCEL_PLANES_H
#define ACCEL_PLANES_H

#include "accel/accel.h"
#include "accel/root.h"

/* Most planes above a leaf; nodes above it: every plane, and a box below each of them and at the root. */
enum { PLANES_LEVELS = 60, PLANES_DEPTH = 2 * PLANES_LEVELS + 1 };

/* Options that every tree of planes has. 'boxes': 0 none, else a cell whose primitives' bounding box has less than that share of its
 * surface area holds that box. */
struct plane_options {
	int64_t max_objects, max_depth;
	int root, travel, mailbox, stop;
	double boxes;
};

/* 'traversal' is an index into plane_travel_words, which start at TRAVEL_RECURSIVE. */
extern const char *const plane_root_words[], *const plane_travel_words[], *const plane_mailbox_words[], *const plane_stop_words[];

#define PLANE_MAX_OBJECTS(type, field) \
	{ "max_objects", KEY_INT, offsetof(type, field.max_objects), 1, 1e9, 5, NULL, "a cell that lists more primitives is split" }
#define PLANE_KEYS(type, field, depth) \
	{ "root", KEY_WORD, offsetof(type, field.root), 0, 0, ROOT_BOX, plane_root_words, \
	  "the region: bounding cube or tight bounding box" }, \
	{ "max_depth", KEY_INT, offsetof(type, field.max_depth), 0, PLANES_LEVELS, depth, NULL, \
	  "cells below so many planes are not split" }, \
	{ "traversal", KEY_WORD, offsetof(type, field.travel), 0, 0, 0, plane_travel_words, \
	  "recursive: nearer half first; restart: every leaf is found from the root" }, \
	{ "mailbox", KEY_WORD, offsetof(type, field.mailbox), 0, 0, MAILBOX_NONE, plane_mailbox_words, \
	  "tests spared: none, of what the last leaf listed too, of all the ray has been tested against" }, \
	{ "stop", KEY_WORD, offsetof(type, field.stop), 0, 0, STOP_NONE, plane_stop_words, \
	  "what ends subdivision before max_depth: nothing, or the least cost that the model, or the exact expectation, predicts" }

/* What stands in plane_node.kind: the axis of a plane, or one of these. */
enum { NODE_BOX = 3, NODE_LEAF = 4 };

struct plane_node {
	double plane;          /* a plane's position */
	uint32_t child;        /* of a plane: the lower half, the upper one follows; of a box: what is inside */
	uint32_t first, count; /* leaf: its ids are refs[first .. first + count), ascending; box: number 'first' of the boxes */
	uint8_t kind, depth;   /* depth: nodes above it */
};

struct planes {
	struct plane_node *nodes; /* root at 0, a node's halves together, depth first */
	struct box *boxes;        /* sides that lie in a side of the cell are infinite: they are not tested */
	uint32_t *refs;
	uint32_t node_count, box_count, ref_count;
	struct plane_options options;
};

/* A cell that may be split. */
struct plane_cell {
	struct box bounds;
	const uint32_t *ids; /* what it lists, ascending */
	uint32_t count;
	int level;           /* planes above it */
};

struct plane_builder;

/* Choose where to split a cell of fewer than max_depth planes: *axis and *plane, at least builder->margin inside the cell. False: it
 * stays a leaf. */
typedef bool plane_rule(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane);

struct plane_parts;

/* A tree being built, or a part of one: arrays that grow, from malloc. */
struct plane_builder {
	const struct accel *accel;
	const void *options;       /* of the structure, for its rule */
	plane_rule *rule;
	double slack, margin;      /* margin: 2^-24 of the root's longest side; cells are never thinner, boxes stand off by it */
	struct box *bounds;        /* of every primitive; parts share it */
	double *low[3], *high[3];  /* [primitives listed at the top] room for a rule to work in, an array an axis */
	double *spare;             /* and one more */
	uint32_t *ids;             /* lists of the cells on the way down */
	size_t id_count, id_room, node_room, box_room, ref_room;
	struct planes tree;
	struct plane_parts *parts; /* where small cells wait for their turn; NULL: they are built at once */
};

/* Build the tree of a->primitives into a->impl, with inner lists where *a asks for them already. options: of the structure, for its rule;
 * common: those of them that all trees have. Parts of it are built on up to a->threads threads; the tree does not depend on how many.
 * 0, or -1 and *e: memory, more than 2^32 nodes or references. */
int planes_build(struct accel *a, const void *options, const struct plane_options *common, plane_rule *rule, struct err *e);

/* The rest of what the door asks for. */
int planes_cells(const struct accel *a, cell_fn *fn, void *ctx);
bool planes_shoot(const struct accel *a, const struct ray *r, struct hit *h);
bool planes_shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n);
void planes_shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n);

#endif
