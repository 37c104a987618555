#include "report/rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Smaller runs of random rays only show convergence. */
static const double rays_ordinary = 200000;

static bool is_octree(const struct table *t, size_t row, const char *criterion)
{
	return table_is(t, row, "status", "ok") && table_is(t, row, "structure", "octree") && table_is(t, row, "criterion", criterion);
}

static bool is_random_rays(const struct table *t, size_t row)
{
	return is_octree(t, row, "objects") && table_is(t, row, "workload", "invariant");
}

int rows_prepare(struct table *t, struct err *e)
{
	double most = 0;
	for (size_t i = 0; i < t->rows; i++)
		if (is_random_rays(t, i))
			most = fmax(most, table_number(t, i, "rays"));
	t->ordinary_rays = fmin(most, rays_ordinary);
	t->few = NEW(&t->mem, size_t, t->rows);
	if (!t->few)
		return err_memory(e, "report");
	for (size_t i = 0; i < t->rows; i++)
		if (is_random_rays(t, i) && table_number(t, i, "rays") < t->ordinary_rays)
			t->few[t->few_count++] = i;
	return 0;
}

bool rows_is_random_rays(const struct table *t, size_t row)
{
	return is_random_rays(t, row) && table_number(t, row, "rays") >= t->ordinary_rays;
}

/* Whether two rows are of the same tree. */
static bool is_same_tree(const struct table *t, size_t i, size_t k)
{
	static const char *const columns[] = { "scene", "balanced", "max_objects", "root", "max_depth", "overlap" };
	for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
		if (!table_is(t, i, columns[c], table_text(t, k, columns[c])))
			return false;
	return true;
}

bool rows_is_convergence(const struct table *t, size_t row)
{
	for (size_t i = 0; t->few_count > 0 && is_random_rays(t, row) && i < t->few_count; i++)
		if (is_same_tree(t, row, t->few[i]))
			return true;
	return false;
}

bool rows_is_image(const struct table *t, size_t row)
{
	return is_octree(t, row, "objects") && table_is(t, row, "workload", "render");
}

bool rows_is_image_by_chance(const struct table *t, size_t row)
{
	return is_octree(t, row, "random") && table_is(t, row, "workload", "render");
}

bool rows_is_image_of_any_tree(const struct table *t, size_t row)
{
	return table_is(t, row, "status", "ok") && table_is(t, row, "workload", "render");
}

bool rows_is_wall_outside(const struct table *t, size_t row)
{
	return table_is(t, row, "family", "wall") && !strstr(table_text(t, row, "scene"), "interior");
}

void rows_name_family(const struct table *t, size_t row, char *out, size_t size)
{
	const char *family = table_text(t, row, "family");
	snprintf(out, size, "%s", *family ? family : table_text(t, row, "scene"));
}

void rows_name_scene(const struct table *t, size_t row, char *out, size_t size)
{
	snprintf(out, size, "%s", table_text(t, row, "scene"));
}

void rows_name_surface(const struct table *t, size_t row, char *out, size_t size)
{
	if (table_is(t, row, "family", "tetra"))
		rows_name_scene(t, row, out, size);
	else
		rows_name_family(t, row, out, size);
	if (strstr(table_text(t, row, "scene"), "interior") && strlen(out) + 10 < size)
		strcat(out, ", inside");
}
