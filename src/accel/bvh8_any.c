/* The order of a node's children where any hit will do: that first which finds one soonest. A line that meets a box of surface A meets a
 * convex body inside, of surface S, with probability S / A (Crofton); so the chance that a child is met and ends the ray, and the steps
 * it takes to find out, follow from the leaves upwards, and the best order is by chance over steps, the greatest first. (Nah and
 * Manocha 2014 order by surface alone.) */
#include "accel/bvh8.h"

#include <string.h>

/* What a block costs in steps from node to node. */
#define BLOCK_STEPS 1.4f

/* Of a child that is met: the chance of a hit in it, and the steps until it is found or known to be none. */
struct prospect {
	float chance, steps;
};

struct child {
	struct prospect prospect;
	uint32_t ref;
	float planes[6], chance; /* chance: of a hit, from the parent's point of view */
};

/* Half the surface, and that of what is in a block. */
static float area_of(const float planes[6])
{
	float x = planes[1] - planes[0], y = planes[3] - planes[2], z = planes[5] - planes[4];
	return x * y + y * z + z * x;
}

static float area_of_block(const struct accel *a, const struct bvh8_block *k)
{
	const struct bvh8 *b = a->impl;
	float sum = 0;
	for (uint32_t i = 0; i < k->count; i++) {
		const struct primitive *p = &a->primitives->all[k->id[i]];
		if (k->margin == INFINITY && p->kind == PRIMITIVE_SPHERE) {
			float radius = (float)(p->sphere.radius * b->frame.scale);
			sum += 6.2831853f * radius * radius;
			continue;
		}
		float x = k->edge1[1][i] * k->edge2[2][i] - k->edge1[2][i] * k->edge2[1][i];
		float y = k->edge1[2][i] * k->edge2[0][i] - k->edge1[0][i] * k->edge2[2][i];
		float z = k->edge1[0][i] * k->edge2[1][i] - k->edge1[1][i] * k->edge2[0][i];
		sum += sqrtf(x * x + y * y + z * z) / 2;
	}
	return sum;
}

static struct prospect look_into_leaf(const struct accel *a, uint32_t ref, float area)
{
	const struct bvh8_block *k = bvh8_leaf(a->impl, ref), *end = k + (ref & 15);
	struct prospect p = { 0, BLOCK_STEPS * (float)(ref & 15) };
	for (; k < end; k++)
		p.chance += area_of_block(a, k) / area;
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

static struct prospect look_into(const struct accel *a, uint32_t ref, float area)
{
	const struct bvh8 *b = a->impl;
	struct child child[BVH8_WIDE], taken;
	struct prospect sum = { 0, 1 };
	float missed = 1;
	if (ref & 15)
		return look_into_leaf(a, ref, area);
	struct bvh8_node *n = (void *)(b->units + (size_t)ref * (BVH8_UNIT / 16));
	for (uint32_t i = 0, k; i < n->children; i++) {
		take_out(n, i, &taken);
		float part = area_of(taken.planes);
		taken.prospect = look_into(a, taken.ref, part);
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

void bvh8_order_children(struct accel *a)
{
	const struct bvh8 *b = a->impl;
	look_into(a, b->root, 1);
}
