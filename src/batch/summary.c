#include "batch/summary.h"

#include "batch/csv.h"
#include "batch/row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct range {
	double low, high;
};

/* One scene's rows so far. */
struct digest {
	size_t rows, failed;
	char triangles[24], best[160];
	double cost; /* of the best */
	struct range ratio, exact, overhead;
	double worst; /* |z| over all exact comparisons */
};

static double number(const char *row, const char *column)
{
	char field[64];
	if (!csv_field(row, row_column(column), field, sizeof field) || !*field)
		return NAN;
	return strtod(field, NULL);
}

static void widen(struct range *r, double x)
{
	r->low = x < r->low ? x : r->low;
	r->high = x > r->high ? x : r->high;
}

/* The options of the row's structure that a job can vary, "balanced=true ...". */
static void name_variant(const char *row, char *out, size_t size)
{
	char field[64];
	csv_field(row, row_column("structure"), field, sizeof field);
	size_t n = (size_t)snprintf(out, size, "%s", field);
	for (const struct column *c = row_columns; c->name && n < size; c++)
		if (c->type == COLUMN_OPTION && strcmp(c->name, "overlap") != 0 && csv_field(row, row_column(c->name), field, sizeof field) &&
		    *field)
			n += (size_t)snprintf(out + n, size - n, " %s=%s", c->name, field);
}

static void digest_row(struct digest *d, const char *row)
{
	static const char *const deviations[] = { "z_exact", "z_leaves", "z_tests", "z_tests_made", "z_inner_step", "z_inner_start",
		"z_inner", "z_boxes" };
	char status[16];
	d->rows++;
	csv_field(row, row_column("triangles"), d->triangles, sizeof d->triangles);
	csv_field(row, row_column("status"), status, sizeof status);
	if (strcmp(status, "ok") != 0) {
		d->failed++;
		return;
	}
	double cost = number(row, "actual");
	if (cost < d->cost) {
		d->cost = cost;
		name_variant(row, d->best, sizeof d->best);
	}
	widen(&d->ratio, number(row, "ratio"));
	widen(&d->exact, number(row, "ratio_exact"));
	widen(&d->overhead, number(row, "overhead_actual"));
	for (size_t i = 0; i < sizeof deviations / sizeof *deviations; i++)
		d->worst = fmax(d->worst, fabs(number(row, deviations[i])));
}

static void print_range(struct text *out, struct range r)
{
	if (r.low <= r.high)
		text_print(out, "  %6.4f..%-6.4f", r.low, r.high);
	else
		text_print(out, "  %-14s", "");
}

/* A scene of the job by its name; one that an earlier experiment had comes first. */
struct named_scene {
	const char *name;
	size_t number;
};

static int compare_scenes(const void *a, const void *b)
{
	const struct named_scene *x = a, *y = b;
	int order = strcmp(x->name, y->name);
	return order ? order : (x->number > y->number) - (x->number < y->number);
}

/* The number of the first scene of this name, or 'count'. */
static size_t find_scene(const struct named_scene *scenes, size_t count, const char *name)
{
	size_t low = 0, high = count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (strcmp(scenes[middle].name, name) < 0)
			low = middle + 1;
		else
			high = middle;
	}
	return low < count && strcmp(scenes[low].name, name) == 0 ? scenes[low].number : count;
}

/* A digest of every scene; those that an earlier experiment had get no rows. */
static void digest_rows(struct digest *digests, struct named_scene *scenes, const struct job *job, const char *rows)
{
	const struct range none = { INFINITY, -INFINITY };
	char field[600];
	for (size_t i = 0; i < job->scene_count; i++) {
		scenes[i] = (struct named_scene){ job->scenes[i].name, i };
		digests[i] = (struct digest){ .cost = INFINITY, .ratio = none, .exact = none, .overhead = none };
	}
	qsort(scenes, job->scene_count, sizeof *scenes, compare_scenes);
	for (const char *row = strchr(rows, '\n') + 1; *row; row = strchr(row, '\n') + 1) {
		csv_field(row, row_column("scene"), field, sizeof field);
		size_t scene = find_scene(scenes, job->scene_count, field);
		if (scene < job->scene_count)
			digest_row(&digests[scene], row);
	}
}

static void print_scene(struct text *out, const struct digest *d, const char *name, int width)
{
	text_print(out, "%-*s %9s %5zu", width, name, d->triangles, d->rows);
	if (d->failed < d->rows)
		text_print(out, "  %9.3f", d->cost);
	else
		text_print(out, "  %9s", "failed");
	print_range(out, d->ratio);
	print_range(out, d->exact);
	print_range(out, d->overhead);
	text_print(out, "  %5.2f  %s\n", d->worst, d->best);
}

int summary_print(struct text *out, const struct job *job, const char *rows, const char *folder, struct err *e)
{
	struct digest *digests = calloc(job->scene_count, sizeof *digests);
	struct named_scene *scenes = calloc(job->scene_count, sizeof *scenes);
	size_t all = 0, failed = 0;
	double worst = 0;
	int width = 5, status = digests && scenes ? 0 : err_memory(e, "summary");
	for (size_t i = 0; i < job->scene_count; i++)
		width = (int)strlen(job->scenes[i].name) > width ? (int)strlen(job->scenes[i].name) : width;
	if (status == 0) {
		digest_rows(digests, scenes, job, rows);
		text_print(out, "%-*s %9s %5s  %9s  %-14s  %-14s  %-14s  %5s  %s\n", width, "scene", "triangles", "rows", "best cost",
		           "ratio", "ratio_exact", "overhead", "|z|", "best variant");
	}
	for (size_t i = 0; status == 0 && i < job->scene_count; i++) {
		if (find_scene(scenes, job->scene_count, job->scenes[i].name) != i)
			continue;
		print_scene(out, &digests[i], job->scenes[i].name, width);
		all += digests[i].rows;
		failed += digests[i].failed;
		worst = fmax(worst, digests[i].worst);
	}
	if (status == 0)
		text_print(out, "%zu rows, %zu failed; largest deviation from an exact prediction: %.2f standard errors; see %s/counts.csv\n",
		           all, failed, worst, folder);
	free(digests);
	free(scenes);
	return status;
}
