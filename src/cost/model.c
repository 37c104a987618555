#include "cost/model.h"

#include "geom/clip.h"

#include <stdlib.h>

/* A cell on the way down. */
struct step {
	struct box bounds;
	double planes, boxes; /* above what is inside */
	bool box;
};

struct sums {
	const struct accel *accel;
	struct step *path; /* of the cells around the one at hand */
	double leaves, references, planes, boxes, area, area_of_boxes;
	double inner_children, leaf_children; /* weighted by A(parent) / A(root) */
	double depth, gaps;                   /* of the leaves; volume of inner cells less that of their children */
};

/* The bounding box of the part of a primitive inside the cell; of a sphere's bounding box. */
static void extend_by_part(struct box *b, const struct primitive *p, const struct box *cell)
{
	struct box all = primitive_bounds(p);
	if (p->kind == PRIMITIVE_TRIANGLE) {
		struct polygon part = { 3, { p->triangle.v[0], p->triangle.v[1], p->triangle.v[2] } };
		polygon_cut_box(&part, cell);
		for (int i = 0; i < part.count; i++)
			box_extend(b, part.corner[i]);
		return;
	}
	for (int i = 0; i < 3; i++) {
		all.lo.a[i] = fmax(all.lo.a[i], cell->lo.a[i]);
		all.hi.a[i] = fmin(all.hi.a[i], cell->hi.a[i]);
		if (all.lo.a[i] > all.hi.a[i])
			return;
	}
	box_join(b, &all);
}

static double area_of_parts(const struct accel *a, const struct cell *c)
{
	struct box all = box_empty();
	for (uint32_t i = 0; i < c->count; i++)
		extend_by_part(&all, &a->primitives->all[c->ids[i]], &c->bounds);
	return all.lo.x <= all.hi.x ? box_area(&all) : 0;
}

/* How many planes cut a cell out of the one around it: 1 in a binary tree, 3 in an octree. */
static int count_planes(const struct box *around, const struct box *cell)
{
	int planes = 0;
	for (int i = 0; i < 3; i++)
		planes += around->lo.a[i] != cell->lo.a[i] || around->hi.a[i] != cell->hi.a[i];
	return planes;
}

static double volume(const struct box *b)
{
	return (b->hi.x - b->lo.x) * (b->hi.y - b->lo.y) * (b->hi.z - b->lo.z);
}

static int add_cell(void *ctx, const struct cell *c)
{
	struct sums *s = ctx;
	struct step *here = &s->path[c->depth], *around = c->depth > 0 ? here - 1 : NULL;
	*here = (struct step){ .bounds = c->bounds, .box = c->box };
	s->gaps += c->leaf || c->box ? 0 : volume(&c->bounds);
	if (around) {
		s->gaps -= around->box ? 0 : volume(&c->bounds);
		here->planes = around->planes + (around->box ? 0 : count_planes(&around->bounds, &c->bounds));
		here->boxes = around->boxes + around->box;
		*(c->leaf ? &s->leaf_children : &s->inner_children) += box_area(&around->bounds) / box_area(&s->accel->root);
	}
	if (!c->leaf)
		return 0;
	s->leaves++;
	s->depth += c->depth;
	s->references += c->count;
	s->planes += here->planes;
	s->boxes += here->boxes;
	s->area += c->area;
	s->area_of_boxes += area_of_parts(s->accel, c);
	return 0;
}

static int sum_cells(struct sums *s, const struct accel *a, struct err *e)
{
	*s = (struct sums){ .accel = a };
	s->path = malloc(((size_t)a->depth + 1) * sizeof *s->path);
	if (!s->path)
		return err_memory(e, "model");
	int status = a->ops->cells(a, add_cell, s);
	free(s->path);
	return status;
}

static void count_regions(struct model *m, double k)
{
	double p = m->chance, missed = pow(1 - p, k);
	m->regions = fmax(1, (1 - missed * (1 - p) - p * (k + 1) * missed) / p);
	m->regions_truncated = (1 - missed) / p;
}

static struct flops flops_by(const struct model *m, bool grid, double regions)
{
	double way = grid ? FLOPS_VOXEL : FLOPS_PLANE * m->height;
	return (struct flops){ FLOPS_TEST * regions * m->per_leaf, way * regions + FLOPS_TEST * m->boxes };
}

static void model_partition(struct model *m, const struct sums *s)
{
	bool grid = s->accel->leaves == s->accel->nodes && s->accel->leaves > 1;
	m->chance = s->area_of_boxes / s->area;
	m->height = s->planes / s->leaves;
	m->boxes = s->boxes / s->leaves;
	m->descent = NAN;
	count_regions(m, s->leaves);
	m->flops = flops_by(m, grid, m->regions);
	struct flops truncated = flops_by(m, grid, m->regions_truncated);
	m->cost_truncated = truncated.scene + truncated.traversal;
}

static void model_hierarchy(struct model *m, const struct sums *s)
{
	m->chance = m->regions_truncated = m->cost_truncated = NAN;
	m->height = s->depth / s->leaves;
	m->descent = FLOPS_TEST * m->height;
	m->regions = 1 + s->inner_children + s->leaf_children;
	m->flops = (struct flops){ FLOPS_TEST * m->per_leaf * s->leaf_children, FLOPS_TEST * (1 + s->inner_children) };
}

int model_make(struct model *m, const struct accel *a, struct err *e)
{
	struct sums s;
	if (sum_cells(&s, a, e) != 0)
		return -1;
	*m = (struct model){ .per_leaf = s.references / s.leaves };
	if (fabs(s.gaps) > 1e-6 * volume(&a->root))
		model_hierarchy(m, &s);
	else
		model_partition(m, &s);
	m->cost = m->flops.scene + m->flops.traversal;
	return 0;
}
