/* From a binary draft to eight children a node: the largest child is opened until there are eight (Wald, Benthin, Boulos 2008). */
#include "accel/bvh8.h"
#include "base/par.h"

#include <stdlib.h>

_Static_assert(sizeof(struct bvh8_node) == 256, "four cache lines");
_Static_assert(sizeof(struct bvh8_block) == 192, "three cache lines");

enum { NODE_UNITS = sizeof(struct bvh8_node) / BVH8_UNIT, BLOCK_UNITS = sizeof(struct bvh8_block) / BVH8_UNIT, CHUNK = 1024, AHEAD = 4 };

/* A leaf whose blocks are to be filled. */
struct leaf {
	uint32_t unit, first, count;
};

/* What a node gathers below it. */
struct wide {
	uint32_t child[BVH8_WIDE], count;
};

struct layout {
	struct accel *accel;
	struct bvh8 *bvh;
	const struct bvh_draft *draft;
	struct wide *wide; /* nodes in the order in which they are placed */
	struct leaf *leaves;
	uint32_t units;
	size_t wide_count, leaf_count;
};

static bool is_leaf(const struct bvh_draft_node *n)
{
	return n->count > 0;
}

/* The up to eight nodes below 'node' that become its children. */
static void gather(const struct bvh_draft *d, uint32_t node, struct wide *w)
{
	float area[BVH8_WIDE];
	uint32_t *child = w->child, count = 0;
	for (uint32_t open = node; count < BVH8_WIDE;) {
		const struct bvh_draft_node *n = &d->nodes[open];
		for (uint32_t i = n->first; i < n->first + 2; i++) {
			child[count] = i;
			area[count++] = is_leaf(&d->nodes[i]) ? -1 : quad_box_half_area(bvh_node_box(&d->nodes[i]));
		}
		uint32_t widest = 0;
		for (uint32_t i = 1; i < count; i++)
			widest = area[i] > area[widest] ? i : widest;
		if (area[widest] < 0 || count == BVH8_WIDE)
			break;
		open = child[widest];
		child[widest] = child[--count];
		area[widest] = area[count];
	}
	w->count = count;
}

static void set_child(struct bvh8_node *n, uint32_t i, const struct bvh_draft_node *from)
{
	for (int axis = 0; axis < 3; axis++) {
		n->planes[2 * axis][i] = from->lo[axis] - BVH8_GROWTH;
		n->planes[2 * axis + 1][i] = from->hi[axis] + BVH8_GROWTH;
	}
}

static uint32_t place_leaf(struct layout *l, const struct bvh_draft_node *n)
{
	uint32_t blocks = bvh_blocks(n->count, BVH8_LANES), unit = l->units;
	l->leaves[l->leaf_count++] = (struct leaf){ unit, n->first, n->count };
	l->units += blocks * BLOCK_UNITS;
	return unit << 4 | blocks;
}

/* Place a node, then its leaves, then what is below its other children. */
static uint32_t place(struct layout *l, uint32_t node, int depth)
{
	const struct bvh_draft *d = l->draft;
	uint32_t unit = l->units;
	struct bvh8_node *n = (void *)(l->bvh->units + (size_t)unit * BVH8_UNIT);
	l->accel->depth = depth > l->accel->depth ? depth : l->accel->depth;
	l->accel->nodes++;
	if (is_leaf(&d->nodes[node]))
		return place_leaf(l, &d->nodes[node]);
	const struct wide *w = &l->wide[l->wide_count++];
	l->units += NODE_UNITS;
	n->children = w->count;
	for (uint32_t i = w->count; i < BVH8_WIDE; i++)
		for (int plane = 0; plane < 6; plane++)
			n->planes[plane][i] = plane % 2 ? -INFINITY : INFINITY;
	for (int inner = 0; inner < 2; inner++)
		for (uint32_t i = 0; i < w->count; i++) {
			if (is_leaf(&d->nodes[w->child[i]]) == inner)
				continue;
			set_child(n, i, &d->nodes[w->child[i]]);
			n->child[i] = place(l, w->child[i], depth + 1);
		}
	return unit << 4;
}

static double fill_lane(struct bvh8_block *b, int lane, const struct primitive *p, const struct bvh_frame *f)
{
	if (p->kind != PRIMITIVE_TRIANGLE)
		return INFINITY;
	const struct vec *v = p->triangle.v;
	struct vec corner = vec_scale(vec_sub(v[0], f->center), f->scale), e1 = vec_scale(vec_sub(v[1], v[0]), f->scale),
	           e2 = vec_scale(vec_sub(v[2], v[0]), f->scale);
	for (int axis = 0; axis < 3; axis++) {
		b->corner[axis][lane] = (float)corner.a[axis];
		b->edge1[axis][lane] = (float)e1.a[axis];
		b->edge2[axis][lane] = (float)e2.a[axis];
	}
	double a = vec_dot(e1, e1), c = vec_dot(e2, e2);
	struct vec e3 = vec_sub(e2, e1);
	return fmax(fmax(a, c), vec_dot(e3, e3));
}

/* Half the surface a ray may meet, in the frame. */
static float half_surface(const struct primitive *p, const struct bvh_frame *f)
{
	return (float)(primitive_area(p) * f->scale * f->scale * (p->kind == PRIMITIVE_TRIANGLE ? 1 : 0.5));
}

static void fill_block(const struct layout *l, struct bvh8_block *b, const union bvh_ref *refs, uint32_t count)
{
	double longest = 0;
	b->count = count < BVH8_LANES ? count : BVH8_LANES;
	b->area = 0;
	for (uint32_t i = 0; i < BVH8_LANES; i++) {
		uint32_t id = refs[i < b->count ? i : b->count - 1].id;
		const struct primitive *p = &l->draft->primitives->all[id];
		b->id[i] = id;
		longest = fmax(longest, fill_lane(b, (int)i, p, &l->draft->frame));
		b->area += i < b->count ? half_surface(p, &l->draft->frame) : 0;
	}
	float edge = (float)sqrt(longest) * (1 + 0x1p-20f);
	b->margin = edge * BVH8_MARGIN;
	b->margin_t = b->margin * edge;
}

/* Ask for the primitives of a leaf that is to be filled soon: they lie anywhere. */
static void prefetch_leaf(const struct layout *l, const struct leaf *leaf)
{
	for (uint32_t i = 0; i < leaf->count; i++) {
		const char *p = (const char *)&l->draft->primitives->all[l->draft->refs[leaf->first + i].id];
		__builtin_prefetch(p);
		__builtin_prefetch(p + sizeof(struct primitive) - 1);
	}
}

static void fill_leaves(void *ctx, size_t chunk)
{
	const struct layout *l = ctx;
	size_t end = (chunk + 1) * CHUNK < l->leaf_count ? (chunk + 1) * CHUNK : l->leaf_count;
	for (size_t i = chunk * CHUNK; i < end; i++) {
		const struct leaf *leaf = &l->leaves[i];
		struct bvh8_block *b = (void *)(l->bvh->units + (size_t)leaf->unit * BVH8_UNIT);
		if (i + AHEAD < end)
			prefetch_leaf(l, leaf + AHEAD);
		for (uint32_t k = 0; k < leaf->count; k += BVH8_LANES)
			fill_block(l, b++, &l->draft->refs[leaf->first + k], leaf->count - k);
	}
}

/* Gather the nodes of what will be laid out; counts them, its leaves and units. */
static void gather_below(struct layout *l, uint32_t node, size_t *units)
{
	const struct bvh_draft *d = l->draft;
	if (is_leaf(&d->nodes[node])) {
		l->leaf_count++;
		*units += bvh_blocks(d->nodes[node].count, BVH8_LANES) * (size_t)BLOCK_UNITS;
		return;
	}
	const struct wide *w = &l->wide[l->wide_count];
	gather(d, node, &l->wide[l->wide_count++]);
	*units += NODE_UNITS;
	for (uint32_t i = 0; i < w->count; i++)
		gather_below(l, w->child[i], units);
}

/* Fill b, l's draft having been gathered. 0, or -1 and *e: memory, too deep. */
static int lay_out(struct layout *l, size_t units, const struct bvh_rules *rules, struct err *e)
{
	struct accel *a = l->accel;
	size_t leaves = l->leaf_count;
	l->wide_count = l->leaf_count = 0;
	l->bvh->units = NEW(&a->mem, char, units * BVH8_UNIT);
	l->leaves = malloc(leaves * sizeof *l->leaves);
	if (!l->bvh->units || !l->leaves)
		return err_memory(e, "bvh8");
	l->bvh->root = place(l, 0, 0);
	if (a->depth > BVH_DEPTH)
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh8: the tree is deeper than %d; another builder makes a shallower one", (int)BVH_DEPTH);
	par_for(rules->threads, (leaves + CHUNK - 1) / CHUNK, fill_leaves, l);
	bvh8_order_children(l->bvh);
	a->leaves = leaves;
	a->references = l->draft->ref_count;
	return 0;
}

int bvh8_lay_out(struct accel *a, struct bvh8 *b, const struct bvh_draft *d, const struct bvh_rules *rules, struct err *e)
{
	struct layout l = { .accel = a, .bvh = b, .draft = d, .wide = arena_pages((size_t)d->ref_count * sizeof *l.wide) };
	size_t units = 0;
	int status = l.wide ? 0 : err_memory(e, "bvh8");
	if (status == 0)
		gather_below(&l, 0, &units);
	if (status == 0 && units >= (size_t)1 << 28)
		status = err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh8: more than 16 GiB");
	if (status == 0)
		status = lay_out(&l, units, rules, e);
	free(l.wide);
	free(l.leaves);
	return status;
}
