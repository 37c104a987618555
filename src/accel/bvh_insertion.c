/* One primitive after the other goes where the tree's areas grow least (Goldsmith and Salmon 1987): from the root down, into the child
 * whose growth, and that of all above, costs less than a new pair here. The order of insertion decides much; it is a fixed shuffle. */
#include "accel/bvh_draft.h"
#include "base/rng.h"

#include <stdlib.h>

struct node {
	struct quad_box box;
	uint32_t parent, child[2], ref; /* a leaf has child[0] == 0 */
};

struct tree {
	struct node *nodes;
	uint32_t count;
};

static float grown(const struct node *n, struct quad_box b)
{
	quad_box_join(&b, n->box);
	return quad_box_half_area(b);
}

/* Where ref's box costs least: it becomes the sibling of what is returned. */
static uint32_t find_sibling(const struct tree *t, struct quad_box b)
{
	uint32_t at = 0, best = 0;
	float inherited = 0, least = INFINITY; /* inherited: growth of everything above 'at' */
	for (;;) {
		const struct node *n = &t->nodes[at];
		float pair = grown(n, b), cost = inherited + pair;
		if (cost < least) {
			least = cost;
			best = at;
		}
		inherited += pair - quad_box_half_area(n->box);
		if (!n->child[0] || inherited >= least)
			return best;
		float growth[2];
		for (int i = 0; i < 2; i++) {
			const struct node *c = &t->nodes[n->child[i]];
			growth[i] = grown(c, b) - quad_box_half_area(c->box);
		}
		at = n->child[growth[1] < growth[0]];
	}
}

static void insert(struct tree *t, uint32_t ref, struct quad_box b)
{
	uint32_t leaf = t->count++;
	t->nodes[leaf] = (struct node){ .box = b, .ref = ref };
	if (leaf == 0)
		return;
	uint32_t sibling = find_sibling(t, b), moved = t->count++;
	struct node *s = &t->nodes[sibling];
	/* The sibling's place becomes the pair, so that the root stays node 0. */
	t->nodes[moved] = *s;
	t->nodes[moved].parent = t->nodes[leaf].parent = sibling;
	for (int i = 0; s->child[0] && i < 2; i++)
		t->nodes[s->child[i]].parent = moved;
	s->child[0] = moved;
	s->child[1] = leaf;
	for (uint32_t at = sibling;; at = t->nodes[at].parent) {
		quad_box_join(&t->nodes[at].box, b);
		if (at == 0)
			return;
	}
}

static void emit(const struct tree *t, struct bvh_draft *d, uint32_t from, uint32_t to, uint32_t *count)
{
	const struct node *n = &t->nodes[from];
	if (!n->child[0]) {
		bvh_node_set(&d->nodes[to], n->box, n->ref, 1);
		return;
	}
	uint32_t children = *count;
	*count += 2;
	bvh_node_set(&d->nodes[to], n->box, children, 0);
	emit(t, d, n->child[0], children, count);
	emit(t, d, n->child[1], children + 1, count);
}

/* All refs in an order that has nothing to do with where they are. */
static void shuffle(uint32_t *order, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++)
		order[i] = i;
	for (uint32_t i = n - 1; i > 0; i--) {
		uint32_t k = (uint32_t)(rng_uniform(rng_key(n, 0, i), 0) * (i + 1.0)), moved = order[i];
		order[i] = order[k];
		order[k] = moved;
	}
}

int bvh_build_insertion(struct bvh_draft *d, const struct bvh_rules *rules)
{
	uint32_t n = d->ref_count, count = 1;
	struct tree t = { .nodes = arena_pages(2 * (size_t)n * sizeof *t.nodes) };
	uint32_t *order = malloc((size_t)n * sizeof *order);
	int status = t.nodes && order ? 0 : -1;
	(void)rules;
	if (status == 0) {
		shuffle(order, n);
		for (uint32_t i = 0; i < n; i++)
			insert(&t, order[i], d->refs[order[i]].box);
		emit(&t, d, 0, 0, &count);
	}
	free(t.nodes);
	free(order);
	return status;
}
