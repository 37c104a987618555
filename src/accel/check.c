#include "accel/check.h"

struct checking {
	const struct accel *accel;
	struct err *err;
	uint64_t leaves, nodes;
};

/* Whether a cell must list a primitive. */
static bool belongs(const struct accel *a, const struct primitive *p, const struct box *cell)
{
	struct box inner = *cell, own = primitive_bounds(p);
	for (int i = 0; i < 3; i++)
		if (accel_wants_inside(a, &own, i)) {
			inner.lo.a[i] += 2 * a->slack;
			inner.hi.a[i] -= 2 * a->slack;
		}
	return primitive_touches(p, &inner);
}

static int check_list(struct checking *k, const struct cell *c, const struct box *wide)
{
	const struct primitives *p = k->accel->primitives;
	uint32_t found = 0;
	for (uint32_t id = 0; id < p->count; id++) {
		bool listed = found < c->count && c->ids[found] == id;
		if (listed ? !primitive_touches(&p->all[id], wide) : belongs(k->accel, &p->all[id], &c->bounds))
			return err_at(k->err, STATUS_ENVIRONMENT, NULL, 0, "primitive %u is %s", id, listed ? "listed in vain" : "missing in a list");
		found += listed;
	}
	return found == c->count ? 0 : err_at(k->err, STATUS_ENVIRONMENT, NULL, 0, "a list is not in order");
}

static int check_cell(void *ctx, const struct cell *c)
{
	struct checking *k = ctx;
	struct box wide = c->bounds;
	k->nodes++;
	k->leaves += c->leaf;
	for (int i = 0; i < 3; i++) {
		if (!(c->bounds.lo.a[i] < c->bounds.hi.a[i]))
			return err_at(k->err, STATUS_ENVIRONMENT, NULL, 0, "a cell has no volume");
		wide.lo.a[i] -= 2 * k->accel->slack; /* 2: widened twice, and rounding */
		wide.hi.a[i] += 2 * k->accel->slack;
	}
	return c->leaf ? check_list(k, c, &wide) : 0;
}

int check_lists(const struct accel *a, struct err *e)
{
	struct checking k = { .accel = a, .err = e };
	if (a->ops->cells(a, check_cell, &k) != 0)
		return -1;
	return k.leaves == a->leaves && k.nodes == a->nodes ? 0 : err_at(e, STATUS_ENVIRONMENT, NULL, 0, "cells are missing");
}
