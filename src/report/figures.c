#include "report/figures.h"

#include "report/chances.h"
#include "report/rows.h"
#include "report/scatter.h"
#include "report/sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What a scatter plot shows: which rows, what along the axes, and how its series are called. */
struct view {
	bool (*shows)(const struct table *t, size_t row);
	const char *x, *y;
	void (*name)(const struct table *t, size_t row, char *out, size_t size);
};

static void add_rows(struct scatter *s, const struct table *t, const struct view *v)
{
	char name[100];
	for (size_t i = 0; i < t->rows; i++)
		if (v->shows(t, i)) {
			v->name(t, i, name, sizeof name);
			scatter_add(s, name, table_number(t, i, v->x), table_number(t, i, v->y));
		}
}

static bool finish(struct scatter *s, struct plot *p)
{
	bool any = scatter_finish(s, p);
	scatter_free(s);
	return any;
}

static bool fill_random_by_cost(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "predicted / actual", .log_x = true };
	scatter_band(&s, 0.8, 1.7, "paper: 0.8 .. 1.7");
	add_rows(&s, t, &(struct view){ rows_is_random_rays, "actual", "ratio", rows_name_family });
	return finish(&s, p);
}

static bool fill_random_by_triangles(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "triangles in the scene", .y_label = "predicted / actual", .log_x = true };
	scatter_band(&s, 0.8, 1.7, "paper: 0.8 .. 1.7");
	add_rows(&s, t, &(struct view){ rows_is_random_rays, "triangles", "ratio", rows_name_family });
	return finish(&s, p);
}

static bool fill_random_exact(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "exact prediction / actual", .log_x = true };
	add_rows(&s, t, &(struct view){ rows_is_random_rays, "actual", "ratio_exact", rows_name_family });
	return finish(&s, p);
}

static bool fill_convergence(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "random rays", .y_label = "predicted / actual", .log_x = true, .lines = true };
	add_rows(&s, t, &(struct view){ rows_is_convergence, "rays", "ratio", rows_name_scene });
	return finish(&s, p);
}

static bool fill_rendering(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "predicted / actual", .log_x = true };
	scatter_band(&s, 3.8, 6.0, "paper, walls: 3.8 .. 6.0");
	scatter_band(&s, 0.8, 2.7, "paper, others: 0.8 .. 2.7");
	add_rows(&s, t, &(struct view){ rows_is_image, "actual", "ratio", rows_name_surface });
	return finish(&s, p);
}

static bool is_image_but_wall(const struct table *t, size_t row)
{
	return rows_is_image(t, row) && !rows_is_wall_outside(t, row);
}

static bool fill_rendering_without_wall(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "predicted / actual" };
	scatter_band(&s, 0.8, 2.7, "paper: 0.8 .. 2.7");
	add_rows(&s, t, &(struct view){ is_image_but_wall, "actual", "ratio", rows_name_surface });
	return finish(&s, p);
}

static void name_balance(const struct table *t, size_t row, char *out, size_t size)
{
	snprintf(out, size, "%s", table_is(t, row, "balanced", "true") ? "balanced" : "not balanced");
}

static bool fill_overhead(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "nodes of the octree", .y_label = "nodes visited / leaves visited", .log_x = true };
	scatter_band(&s, 1, 1.5, "paper: 1 .. 1.5");
	add_rows(&s, t, &(struct view){ rows_is_image, "nodes", "overhead_actual", name_balance });
	return finish(&s, p);
}

static bool fill_chance(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "predicted / actual", .log_x = true };
	scatter_band(&s, 0.91, 1.55, "paper: 0.91 .. 1.55");
	scatter_band(&s, 0.645, 0.655, "paper, one point: 0.65");
	add_rows(&s, t, &(struct view){ rows_is_image_by_chance, "actual", "ratio", rows_name_surface });
	return finish(&s, p);
}

static bool fill_replay(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "replay / actual", .log_x = true };
	scatter_band(&s, 0.97, 1.03, "aim: 0.97 .. 1.03");
	add_rows(&s, t, &(struct view){ rows_is_image_of_any_tree, "actual", "ratio_replay", rows_name_surface });
	return finish(&s, p);
}

static bool fill_calibrated(struct plot *p, const struct table *t, const char *folder)
{
	(void)folder;
	struct scatter s = { .x_label = "actual cost a ray", .y_label = "calibrated / actual", .log_x = true };
	scatter_band(&s, 0.9, 1.1, "aim: 0.9 .. 1.1");
	add_rows(&s, t, &(struct view){ rows_is_image_of_any_tree, "actual", "ratio_calibrated", rows_name_surface });
	return finish(&s, p);
}

/* Cost over height of one method: what the model predicts, what is expected of random rays, and what the image costs. */
static bool fill_sweep(struct plot *p, const struct table *t, enum sweep_method method)
{
	static const char *const families[] = { "tetra", "dna", "arches", "balls", "geo58" };
	static const struct { const char *column, *name; } curves[] = { { "flops_actual", "image" }, { "flops_exact", "exact" }, { "model_cost", "model" } };
	struct scatter s = { .x_label = method == SWEEP_ARTS ? "cells a side" : method == SWEEP_OCTREE ? "levels" : "planes above a leaf, at most",
		             .y_label = "flops a ray", .log_x = method == SWEEP_ARTS, .log_y = true, .lines = true, .group = 3 };
	for (size_t f = 0; f < sizeof families / sizeof *families; f++) {
		const struct sweep sweep = { t, method, families[f], false, false };
		for (size_t k = 0; k < sizeof curves / sizeof *curves; k++)
			for (size_t i = 0; i < t->rows; i++) {
				char name[100];
				snprintf(name, sizeof name, "%s, %s", families[f], curves[k].name);
				if (sweep_holds(&sweep, i))
					scatter_add(&s, name, sweep_height(&sweep, i), table_number(t, i, curves[k].column));
			}
	}
	return finish(&s, p);
}

#define FILL_SWEEP(fill, method) \
	static bool fill(struct plot *p, const struct table *t, const char *folder) \
	{ \
		(void)folder; \
		return fill_sweep(p, t, method); \
	}
FILL_SWEEP(fill_bsp, SWEEP_BSP)
FILL_SWEEP(fill_octree, SWEEP_OCTREE)
FILL_SWEEP(fill_arts, SWEEP_ARTS)
FILL_SWEEP(fill_kd, SWEEP_KD)

/* Part of a drawing: which of its blocks, and gnuplot's words for how. */
struct layer {
	int block;
	const char *style;
};

/* What the run has drawn of the first scene of a family that it has drawn. */
static bool fill_drawing(struct plot *p, const struct table *t, const char *folder, const char *family, const struct layer *layers)
{
	char path[4200];
	struct err e = { 0 };
	size_t row = 0;
	for (; row < t->rows; row++) {
		snprintf(path, sizeof path, "%s/drawings/%s.dat", folder, table_text(t, row, "scene"));
		if (table_is(t, row, "family", family) && access(path, R_OK) == 0)
			break;
	}
	if (row == t->rows || text_read_file(&p->data, path, (size_t)1 << 26, &e) != 0)
		return false;
	text_print(&p->script, "unset border\nunset tics\nunset key\nset view 66, 28, 1.7\nset view equal xyz\nset margins 0, 0, 0, 0\nsplot ");
	for (const struct layer *l = layers; l->style; l++)
		text_print(&p->script, "%s'%s.dat' index %d with lines %s", l == layers ? "" : ", \\\n  ", p->name, l->block, l->style);
	text_print(&p->script, "\n");
	return true;
}

static const char faint[] = "linecolor '#b0b8c0' linewidth 0.5", red[] = "linecolor '#D55E00' linewidth 1.2",
                  blue[] = "linecolor '#0072B2' linewidth 0.8";

static bool fill_rays_of_triangle(struct plot *p, const struct table *t, const char *folder)
{
	return fill_drawing(p, t, folder, "tetra", (const struct layer[]){ { 2, blue }, { 3, red }, { 0, NULL } });
}

static bool fill_rays_of_scene(struct plot *p, const struct table *t, const char *folder)
{
	return fill_drawing(p, t, folder, "tetra", (const struct layer[]){ { 0, faint }, { 1, red }, { 0, NULL } });
}

static bool fill_walk(struct plot *p, const struct table *t, const char *folder)
{
	return fill_drawing(p, t, folder, "teapot", (const struct layer[]){ { 0, faint }, { 4, blue }, { 5, red }, { 0, NULL } });
}

const struct figure figures[] = {
	{ "fig1a-cost", "Random rays: predicted over actual cost, by actual cost",
	  "Figure 1(a) as its caption has it. A point is one octree of one scene; predicted is eq. (3) as printed.", fill_random_by_cost },
	{ "fig1a-triangles", "Random rays: predicted over actual cost, by size of the scene",
	  "Figure 1(a) as the text has it: the same points along the number of triangles.", fill_random_by_triangles },
	{ "fig1a-exact", "Random rays: the exact prediction over actual cost",
	  "The same octrees, predicted with the rays that start inside a cell and with both sides of every surface. What is left is the "
	  "sampling error of the measurement.", fill_random_exact },
	{ "fig1b", "The ratio as the number of random rays grows", "Figure 1(b). Every point has its rays in common with those to its right.",
	  fill_convergence },
	{ "fig2a", "Twenty random rays from one triangle", "Figure 2(a). The lengths are those to the first hit or out of the root.",
	  fill_rays_of_triangle },
	{ "fig2b", "Fifty random rays in a scene of tetrahedra", "Figure 2(b).", fill_rays_of_scene },
	{ "fig2c", "The leaves of an octree that one ray visits", "Figure 2(c). Each box is a leaf; the ray is red.", fill_walk },
	{ "fig3a", "Rendering: predicted over actual cost", "Figure 3(a): the same predictor against the rays of an image.", fill_rendering },
	{ "fig3b", "Rendering: the same without the wall seen from outside", "Figure 3(b).", fill_rendering_without_wall },
	{ "fig4", "Rendering: the overhead of vertical motion",
	  "Figure 4: inner nodes and leaves visited over leaves visited. Proven below 2 for random rays, below 1.5 in balanced trees.",
	  fill_overhead },
	{ "fig5", "Rendering with random octrees", "Figure 5: trees that know nothing of the scene, five of each scene and root.",
	  fill_chance },
	{ "replay", "Rendering: a pilot image replayed, over actual cost",
	  "The pilot's few rays walked through every tree without testing a primitive, random octrees included.", fill_replay },
	{ "calibrated", "Rendering: the predictor calibrated by the flux of a pilot image, over actual cost",
	  "The pilot's rays counted once on a grid of 64 x 64 x 64; from then on a sum over the cells of a tree, and no ray at all.",
	  fill_calibrated },
	{ "costs-bsp", "BSP trees: cost by height", "Figure 5 of Subramanian and Fussell 1990: the model's cost, the exact expectation for random rays, "
	  "and what the rays of an image cost.", fill_bsp },
	{ "costs-octree", "Octrees: cost by height", "Figure 6 of the same.", fill_octree },
	{ "costs-arts", "Grids: cost by resolution", "Figure 7 of the same.", fill_arts },
	{ "costs-kd", "k-d trees: cost by height", "Figure 9 of the same.", fill_kd },
	{ "chances", "Chances that a ray from inside meets a node, over the exact ones",
	  "Of random nodes of a cube, a hall (1 : 1 : 0.3) and a corridor (1 : 0.3 : 0.3): Fabianowski et al. 2009, eq. (2), (4), (5), over the "
	  "closed form of eq. (3).", chances_fill_scatter },
	{ "chances-histogram", "How far the approximations are off", "The same nodes by their ratio.", chances_fill_histogram },
	{ 0 }
};
