#include "report/ladder.h"

#include <math.h>
#include <stdio.h>

enum { EXPERIMENTS = 8 };

static const char *const traversals[EXPERIMENTS] = { "point", "slabs", "sibling", "skip", "array", "any", "cache", "cache" };

/* Seconds for a million rays on an SGI O2, 180 MHz R5000. */
static const struct {
	const char *scene, *name;
	int seconds[EXPERIMENTS];
} printed[] = {
	{ "theater", "theater", { 64, 36, 30, 21, 22, 11, 10, 6 } },
	{ "lab", "lab", { 79, 41, 32, 22, 20, 12, 12, 7 } },
	{ "soup", "10,000 small", { 415, 223, 191, 142, 110, 48, 50, 27 } },
	{ "soup-cube-100", "10,000 mid", { 392, 185, 154, 103, 81, 77, 79, 65 } },
	{ "soup-cube-200", "10,000 big", { 381, 179, 152, 104, 82, 79, 77, 69 } },
	{ "soup-count-100000", "100,000 small", { 995, 620, 550, 449, 351, 62, 63, 33 } },
	{ "soup-count-100000-cube-100", "100,000 mid", { 932, 473, 424, 324, 230, 146, 148, 89 } },
	{ "soup-count-100000-cube-200", "100,000 big", { 1024, 508, 442, 332, 240, 210, 212, 156 } },
	{ "soup-count-300000-cube-100", "300,000 mid", { 1093, 597, 536, 421, 312, 120, 121, 64 } },
};
enum { SCENES = sizeof printed / sizeof *printed };

/* The row of an experiment, counted from 0, or none (t->rows). */
static size_t find_row(const struct table *t, const char *scene, int experiment)
{
	for (size_t i = 0; i < t->rows; i++)
		if (table_is(t, i, "status", "ok") && table_is(t, i, "structure", "bvh") && table_is(t, i, "scene", scene) &&
		    table_is(t, i, "traversal", traversals[experiment]) &&
		    table_is(t, i, "workload", experiment == EXPERIMENTS - 1 ? "segments-twice" : "segments"))
			return i;
	return t->rows;
}

/* Seconds a million rays took. */
static double find_seconds(const struct table *t, size_t row, const struct table *times)
{
	for (size_t i = 0; i < times->rows; i++)
		if (table_is(times, i, "key", table_text(t, row, "key")))
			return table_number(times, i, "seconds_walk") * 1e6 / table_number(t, row, "rays");
	return NAN;
}

static void add_head(struct text *page, const char *title, const char *note)
{
	text_print(page, "<h2>%s</h2>\n<p>%s</p>\n<div class=\"wide\"><table><thead><tr><th>scene</th>", title, note);
	for (int i = 1; i <= EXPERIMENTS; i++)
		text_print(page, "<th>%d</th>", i);
	text_print(page, "</tr></thead><tbody>\n");
}

static void add_times(struct text *page, const struct table *t, const struct table *times)
{
	add_head(page, "Smits 1999, table 1: time relative to experiment 1",
	         "Measured, with the paper's ratio in brackets; under 1 also the seconds a million rays take. 1 boxes by the point where a ray enters, "
	         "recursion; 2 boxes by slabs; 3 left child, right sibling, parent; 4 skip pointers; 5 an array in depth-first order; 6 any hit ends "
	         "a shadow ray; 7 the last hit is tested first; 8 the same, each ray twice.");
	for (int s = 0; s < SCENES; s++) {
		size_t first = find_row(t, printed[s].scene, 0);
		if (first == t->rows)
			continue;
		double base = find_seconds(t, first, times);
		text_print(page, "<tr><td>%s</td>", printed[s].name);
		for (int i = 0; i < EXPERIMENTS; i++) {
			size_t row = find_row(t, printed[s].scene, i);
			double ratio = row < t->rows ? find_seconds(t, row, times) / base : NAN, paper = (double)printed[s].seconds[i] / printed[s].seconds[0];
			if (i == 0)
				text_print(page, "<td class=\"n\">1 <small>%.3g s (%d s)</small></td>", base, printed[s].seconds[0]);
			else
				text_print(page, "<td class=\"n\">%.2f <small>(%.2f)</small></td>", ratio, paper);
		}
		text_print(page, "</tr>\n");
	}
	text_print(page, "</tbody></table></div>\n");
}

static void add_counts(struct text *page, const struct table *t)
{
	add_head(page, "The same in counts, which the paper lacks", "Box tests a ray, and primitive tests a ray below.");
	for (int s = 0; s < SCENES; s++) {
		if (find_row(t, printed[s].scene, 0) == t->rows)
			continue;
		text_print(page, "<tr><td>%s</td>", printed[s].name);
		for (int i = 0; i < EXPERIMENTS; i++) {
			size_t row = find_row(t, printed[s].scene, i);
			if (row < t->rows)
				text_print(page, "<td class=\"n\">%.4g<br>%.4g</td>", table_number(t, row, "actual_boxes"), table_number(t, row, "actual_tests"));
			else
				text_print(page, "<td></td>");
		}
		text_print(page, "</tr>\n");
	}
	text_print(page, "</tbody></table></div>\n");
}

int ladder_add(struct text *page, const struct table *t, const char *folder, struct err *e)
{
	char path[4200];
	struct table times = { 0 };
	bool any = false;
	for (int s = 0; s < SCENES; s++)
		any |= find_row(t, printed[s].scene, 0) < t->rows;
	if (!any)
		return 0;
	snprintf(path, sizeof path, "%s/times.csv", folder);
	if (table_read(&times, path, e) != 0)
		return -1;
	add_times(page, t, &times);
	add_counts(page, t);
	table_free(&times);
	return 0;
}
