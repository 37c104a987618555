/* BSP tree (Kaplan 1985; Subramanian and Fussell 1990, section 5.1.1): every cell is cut through its middle, first across x, then y,
 * then z. Three planes make one step of an octree. A step that has begun is finished where there are primitives; halves without any
 * are kept whole, or cut as well, and the tree is then an octree stored in two's (section 5.1.2). */
#include "accel/check.h"
#include "accel/planes.h"

enum { HALVES_KEEP, HALVES_CUT };
enum { TOUCHING_KEEP, TOUCHING_DROP };

struct bsp_options {
	struct plane_options common;
	int empty, touching;
};

static const char *const empty_words[] = { "keep", "cut", NULL }, *const touching_words[] = { "keep", "drop", NULL };
static const struct key keys[] = {
	PLANE_MAX_OBJECTS(struct bsp_options, common),
	PLANE_KEYS(struct bsp_options, common, 24),
	{ "empty_halves", KEY_WORD, offsetof(struct bsp_options, empty), 0, 0, HALVES_KEEP, empty_words,
	  "what the remaining planes of a step do to a half that lists nothing: keep: an octree's step may end early" },
	{ "touching", KEY_WORD, offsetof(struct bsp_options, touching), 0, 0, TOUCHING_KEEP, touching_words,
	  "primitives that touch a cell and do not reach into it: keep: listed; drop: not, and a ray along the edge of a cell may miss them" },
	{ 0 }
};

/* The axis whose turn it is, or the next one across which the cell is not too thin; -1: none. */
static int find_axis(const struct plane_builder *b, const struct plane_cell *c)
{
	for (int i = 0; i < 3; i++) {
		int axis = (c->level + i) % 3;
		if (c->bounds.hi.a[axis] - c->bounds.lo.a[axis] >= 2 * b->margin)
			return axis;
	}
	return -1;
}

static bool choose(struct plane_builder *b, const struct plane_cell *c, int *axis, double *plane)
{
	const struct bsp_options *o = b->options;
	*axis = find_axis(b, c);
	if (*axis < 0)
		return false;
	*plane = c->bounds.lo.a[*axis] + (c->bounds.hi.a[*axis] - c->bounds.lo.a[*axis]) / 2;
	if (c->level % 3 == 0)
		return c->count > (uint32_t)o->common.max_objects;
	return c->count > 0 || o->empty == HALVES_CUT;
}

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct bsp_options *o = opt;
	struct plane_options common = o->common;
	common.boxes = 0; /* no option here */
	a->inner_lists = o->touching == TOUCHING_DROP;
	return planes_build(a, o, &common, choose, e);
}

const struct accel_ops accel_bsp = {
	"bsp", "cells halved across x, y and z in turn", keys, sizeof(struct bsp_options), NULL,
	build, planes_cells, planes_shoot, planes_shoot_counted, planes_shoot_many, check_lists, NULL
};
