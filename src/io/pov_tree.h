/* A hierarchy of boxes, to find the few of many things that a point or a ray may meet. */
#ifndef IO_POV_TREE_H
#define IO_POV_TREE_H

#include "base/arena.h"
#include "geom/box.h"

#include <stdbool.h>
#include <stdint.h>

/* Nodes in depth-first order: the first child follows its parent. */
struct pov_tree_node {
	struct box box;
	uint32_t skip;         /* the node after this one's whole subtree */
	uint32_t first, count; /* of 'order', at leaves; count 0 at inner nodes */
};

struct pov_tree {
	struct pov_tree_node *nodes;
	uint32_t *order, node_count;
};

/* Over n boxes, by halving at the median of the longest side; empty boxes are left out. 0, or -1 when memory is out. */
int pov_tree_build(struct pov_tree *t, struct arena *a, const struct box *boxes, uint32_t n);

/* Call 'leaf' for all things in nodes whose box 'enter' lets in. */
typedef bool pov_tree_enter_fn(void *context, const struct box *b);
typedef void pov_tree_leaf_fn(void *context, uint32_t i);
void pov_tree_visit(const struct pov_tree *t, pov_tree_enter_fn *enter, pov_tree_leaf_fn *leaf, void *context);

#endif
