/* Balancing an octree by Moore's three passes over a table of leaf vertices (Moore 1995, as told by Aronov et al. 2002, section
 * 4.1): every vertex knows the depth of the deepest leaf that has it as a corner; a leaf with a corner deeper than its own depth
 * plus one is split. Left to right, right to left, and left to right again suffices. */
#include "accel/octree.h"
#include "base/rng.h"

#include <stdlib.h>

/* Open addressing; key 0 is free (a vertex key has bit 63 set). */
struct vertex {
	uint64_t key;
	uint32_t depth;
};

struct vertex_table {
	struct vertex *slots;
	size_t room, used; /* room: a power of two */
};

static uint64_t vertex_key(const struct octree_node *n, unsigned corner)
{
	uint64_t key = 1, side = (uint64_t)octree_side(n->depth);
	for (unsigned i = 0; i < 3; i++)
		key = key << 21 | ((uint64_t)n->cell[i] + (corner >> i & 1) * side);
	return key;
}

static struct vertex *find_slot(const struct vertex_table *t, uint64_t key)
{
	size_t i = rng_mix(key) & (t->room - 1);
	while (t->slots[i].key && t->slots[i].key != key)
		i = (i + 1) & (t->room - 1);
	return &t->slots[i];
}

static int grow_table(struct vertex_table *t, struct err *e)
{
	struct vertex_table wider = { .room = t->room ? t->room * 2 : 4096, .used = t->used };
	wider.slots = calloc(wider.room, sizeof *wider.slots);
	if (!wider.slots)
		return err_memory(e, "octree balance");
	for (size_t i = 0; i < t->room; i++)
		if (t->slots[i].key)
			*find_slot(&wider, t->slots[i].key) = t->slots[i];
	free(t->slots);
	*t = wider;
	return 0;
}

/* Enter the eight corners of a leaf. */
static int enter_leaf(struct vertex_table *t, const struct octree_node *n, struct err *e)
{
	if (t->used + 8 > t->room / 2 && grow_table(t, e) != 0)
		return -1;
	for (unsigned corner = 0; corner < 8; corner++) {
		uint64_t key = vertex_key(n, corner);
		struct vertex *v = find_slot(t, key);
		t->used += v->key == 0;
		v->key = key;
		v->depth = v->depth > n->depth ? v->depth : n->depth;
	}
	return 0;
}

static bool too_coarse(const struct vertex_table *t, const struct octree_node *n)
{
	for (unsigned corner = 0; corner < 8; corner++)
		if (find_slot(t, vertex_key(n, corner))->depth > n->depth + 1u)
			return true;
	return false;
}

/* Depth first below n, children in ascending or descending order; a leaf that is split is entered like an inner node. */
static int pass(struct octree_builder *b, struct vertex_table *t, uint32_t n, bool descending, struct err *e)
{
	if (!b->tree.nodes[n].inner) {
		if (!too_coarse(t, &b->tree.nodes[n]))
			return 0;
		if (octree_split(b, n, e) != 0)
			return -1;
		for (uint32_t c = 0; c < 8; c++)
			if (enter_leaf(t, &b->tree.nodes[b->tree.nodes[n].child + c], e) != 0)
				return -1;
	}
	for (uint32_t c = 0; c < 8; c++)
		if (pass(b, t, b->tree.nodes[n].child + (descending ? 7 - c : c), descending, e) != 0)
			return -1;
	return 0;
}

int octree_balance(struct octree_builder *b, struct err *e)
{
	struct vertex_table t = { 0 };
	int status = grow_table(&t, e);
	for (uint32_t n = 0; status == 0 && n < b->tree.node_count; n++)
		if (!b->tree.nodes[n].inner)
			status = enter_leaf(&t, &b->tree.nodes[n], e);
	for (int turn = 0; status == 0 && turn < 3; turn++)
		status = pass(b, &t, 0, turn == 1, e);
	free(t.slots);
	return status;
}
