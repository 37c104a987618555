/* The order of a node's children where any hit will do: that first which finds one soonest. A line that meets a box of surface A meets a
 * convex body inside, of surface S, with probability S / A (Crofton); so the chance that a child is met and ends the ray, and the steps
 * it takes to find out, follow from the leaves upwards, and the best order is by chance over steps, the greatest first. (Nah and
 * Manocha 2014 order by surface alone.) */
#include "accel/bvh8.h"

/* What a block costs in steps from node to node. */
#define BLOCK_STEPS 1.4f

/* Of a child that is met: the chance of a hit in it, and the steps until it is found or known to be none. */
struct prospect {
	float chance, steps;
};

struct child {
	struct prospect prospect;
	uint32_t ref;
	float planes[6], chance; /* chance: that a ray meets it that meets its parent */
};

/* Half the surface of a box. */
static float area_of(const float planes[6])
{
	return quad_box_half_area((struct quad_box){ { planes[0], planes[2], planes[4] }, { planes[1], planes[3], planes[5] } });
}

static struct prospect look_into_leaf(const struct bvh8 *b, uint32_t ref, float area)
{
	const struct bvh8_block *k = bvh8_leaf(b, ref), *end = k + (ref & 15);
	struct prospect p = { 0, BLOCK_STEPS * (float)(ref & 15) };
	for (; k < end; k++)
		p.chance += k->area / area;
	p.chance = p.chance < 1 ? p.chance : 1;
	return p;
}

static void put_child(struct bvh8_node *n, uint32_t i, const struct child *c)
{
	n->child[i] = c->ref;
	for (int plane = 0; plane < 6; plane++)
		n->planes[plane][i] = c->planes[plane];
}

static void take_out(const struct bvh8_node *n, uint32_t i, struct child *c)
{
	c->ref = n->child[i];
	for (int plane = 0; plane < 6; plane++)
		c->planes[plane] = n->planes[plane][i];
}

/* Looks below a child, whose box has half the surface 'area', and puts every node there into order. */
static struct prospect look_into(const struct bvh8 *b, uint32_t ref, float area)
{
	struct child child[BVH8_WIDE], taken;
	struct prospect sum = { 0, 1 };
	float missed = 1;
	if (ref & 15)
		return look_into_leaf(b, ref, area);
	struct bvh8_node *n = (void *)bvh8_at(b, ref);
	for (uint32_t i = 0, k; i < n->children; i++) {
		take_out(n, i, &taken);
		float part = area_of(taken.planes);
		taken.prospect = look_into(b, taken.ref, part);
		taken.chance = part < area ? part / area : 1;
		for (k = i; k > 0 && child[k - 1].prospect.chance * taken.prospect.steps < taken.prospect.chance * child[k - 1].prospect.steps; k--)
			child[k] = child[k - 1];
		child[k] = taken;
	}
	for (uint32_t i = 0; i < n->children; i++) {
		put_child(n, i, &child[i]);
		sum.steps += missed * child[i].chance * child[i].prospect.steps;
		missed *= 1 - child[i].chance * child[i].prospect.chance;
	}
	sum.chance = 1 - missed;
	return sum;
}

void bvh8_order_children(struct bvh8 *b)
{
	look_into(b, b->root, 1);
}
