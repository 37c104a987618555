/* The eight-wide hierarchy. This file: options, the choice of instructions, rays by the many, cells and invariants. */
#include "accel/bvh8.h"
#include "accel/root.h"

#include <stdlib.h>
#include <string.h>

/* Sorting pays where rays wait for memory: many rays, SORTED_MOST at a time, through a structure of some size (BVH8_SORTED_BYTES), in which the first ones
 * (PILOTS) make SORTED_STEPS steps or more. */
enum { PILOTS = 256, SORTED_LEAST = 4096, SORTED_MOST = 1 << 20, SORTED_STEPS = 4 };

static const char *const builder_words[] = { "binned", "sah", "median", "insertion", "spatial", NULL };
static const char *const kernel_words[] = { "best", "avx512", "avx2", "portable", NULL };

#define AT(field) offsetof(struct bvh8_options, field)
static const struct key keys[] = {
	{ "builder", KEY_WORD, AT(builder), 0, 0, BVH_BINNED, builder_words, "as for bvh" },
	{ "optimise", KEY_INT, AT(optimise), 0, 100, 0, NULL, "rounds of reinsertion after building" },
	{ "kernel", KEY_WORD, AT(kernel), 0, 0, BVH8_BEST, kernel_words, "instructions: the best the machine has, or at most these" },
	{ 0 }
};
#undef AT

static const struct bvh8_kernel *choose_kernel(int wanted)
{
#ifdef __x86_64__
	__builtin_cpu_init();
	bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
	bool avx512 = avx2 && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq");
	if (avx512 && wanted <= BVH8_AVX512)
		return &bvh8_avx512;
	if (avx2 && wanted <= BVH8_AVX2)
		return &bvh8_avx2;
#endif
	(void)wanted;
	return &bvh8_portable;
}

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct bvh8_options *o = opt;
	const struct bvh_rules rules = { 1, 1.5f, BVH8_LANES, BVH8_LANES, 16, a->threads };
	struct bvh8 *b = NEW(&a->mem, struct bvh8, 1);
	struct bvh_draft draft;
	a->root = root_box(&a->primitives->bounds, ROOT_BOX);
	a->slack = 1e-9 * box_diagonal(&a->root);
	a->volumes = true;
	a->impl = b;
	if (!b)
		return err_memory(e, "bvh8");
	b->spheres = a->primitives->spheres > 0;
	b->kernel = choose_kernel(o->kernel);
	int status = bvh_draft_make(&draft, a, (enum bvh_builder)o->builder, (int)o->optimise, &rules, e);
	b->frame = draft.frame;
	for (int i = 0; i < 3; i++)
		b->half[i] = nextafterf((float)((a->root.hi.a[i] - a->root.lo.a[i]) * b->frame.scale / 2), 1);
	b->slack = a->slack * b->frame.scale;
	if (status == 0)
		status = bvh8_lay_out(a, b, &draft, &rules, e);
	bvh_draft_free(&draft);
	return status;
}

static bool shoot(const struct accel *a, const struct ray *r, struct hit *h)
{
	const struct bvh8 *b = a->impl;
	return b->kernel->shoot(a, r, h);
}

static bool shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n)
{
	const struct bvh8 *b = a->impl;
	return b->kernel->shoot_counted(a, r, h, n);
}

/* n: NULL where nothing is to be counted. */
static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	const struct bvh8 *b = a->impl;
	struct tally pilot[PILOTS];
	size_t pilots = count < PILOTS ? count : PILOTS;
	uint64_t steps = 0;
	b->kernel->shoot_all(a, r, pilots, h, pilot);
	for (size_t i = 0; i < pilots; i++)
		steps += pilot[i].inner_step + pilot[i].leaves;
	if (n)
		memcpy(n, pilot, pilots * sizeof *n);
	bool sorted = a->mem.held > BVH8_SORTED_BYTES && steps >= SORTED_STEPS * pilots;
	for (size_t done = pilots, piece; done < count; done += piece) {
		piece = count - done < SORTED_MOST ? count - done : SORTED_MOST;
		uint32_t *order = sorted && piece >= SORTED_LEAST ? bvh8_order(a, r + done, piece) : NULL;
		if (order)
			b->kernel->shoot_in_order(a, r + done, order, piece, h + done, n ? n + done : NULL);
		else
			b->kernel->shoot_all(a, r + done, piece, h + done, n ? n + done : NULL);
		free(order);
	}
}

static void hit_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h)
{
	shoot_many(a, r, count, h, NULL);
}

/* A leaf's ids, gathered from its blocks. */
static uint32_t list_leaf(const struct bvh8 *b, uint32_t ref, uint32_t ids[BVH8_MOST_BLOCKS * BVH8_LANES])
{
	const struct bvh8_block *block = bvh8_leaf(b, ref);
	uint32_t n = 0;
	for (uint32_t i = 0; i < (ref & 15); i++)
		for (uint32_t k = 0; k < block[i].count; k++)
			ids[n++] = block[i].id[k];
	return n;
}

static struct box child_box(const struct bvh8 *b, const struct bvh8_node *n, uint32_t i)
{
	struct box box;
	for (int axis = 0; axis < 3; axis++) {
		box.lo.a[axis] = n->planes[2 * axis][i] / b->frame.scale + b->frame.center.a[axis];
		box.hi.a[axis] = n->planes[2 * axis + 1][i] / b->frame.scale + b->frame.center.a[axis];
	}
	return box;
}

static int cells_from(const struct accel *a, uint32_t ref, const struct box *bounds, uint16_t depth, cell_fn *fn, void *ctx)
{
	const struct bvh8 *b = a->impl;
	uint32_t ids[BVH8_MOST_BLOCKS * BVH8_LANES];
	struct cell c = { .bounds = *bounds, .area = box_area(bounds), .depth = depth, .leaf = (ref & 15) != 0 };
	if (c.leaf) {
		c.count = list_leaf(b, ref, ids);
		c.ids = ids;
		return fn(ctx, &c);
	}
	const struct bvh8_node *n = bvh8_node(b, ref);
	int stop = fn(ctx, &c);
	for (uint32_t i = 0; stop == 0 && i < n->children; i++) {
		struct box box = child_box(b, n, i);
		stop = cells_from(a, n->child[i], &box, depth + 1, fn, ctx);
	}
	return stop;
}

static int cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	const struct bvh8 *b = a->impl;
	return cells_from(a, b->root, &a->root, 0, fn, ctx);
}

static int see_cell(void *ctx, const struct cell *c)
{
	unsigned char *seen = ctx;
	for (uint32_t i = 0; i < c->count; i++)
		seen[c->ids[i]] = 1;
	return 0;
}

static int check(const struct accel *a, struct err *e)
{
	struct arena mem = { 0 };
	uint32_t n = a->primitives->count;
	unsigned char *seen = NEW(&mem, unsigned char, n);
	int status = seen ? cells(a, see_cell, seen) : err_memory(e, "bvh8");
	for (uint32_t i = 0; status == 0 && i < n; i++)
		if (!seen[i])
			status = err_at(e, STATUS_ENVIRONMENT, NULL, 0, "bvh8: primitive %u is in no leaf", i);
	arena_free(&mem);
	return status;
}

const struct accel_ops accel_bvh8 = {
	"bvh8", "a tree of boxes, eight children a node, tested side by side", keys, sizeof(struct bvh8_options), NULL, build, cells, shoot,
	shoot_counted, shoot_many, check, hit_many
};
