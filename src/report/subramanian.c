#include "report/subramanian.h"

#include "cost/fit.h"
#include "report/sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SCENES = 5, HEIGHTS_MOST = 64 };

/* Table 1, rays in thousands. */
static const struct {
	const char *family, *name;
	double visual, shadow, hits;
} scenes[SCENES] = {
	{ "tetra", "Tetra", 262, 37, 44 },     { "dna", "DNA", 323, 122, 75 },     { "arches", "Arches", 317, 120, 73 },
	{ "balls", "Balls", 722, 1097, 873 },  { "geo58", "Geo58", 392, 455, 278 },
};

static const struct {
	const char *place, *name, *height;
} methods[SWEEP_METHODS] = {
	{ "Table 2", "BSP tree", "planes above a leaf" }, { "Table 3", "octree", "levels" }, { "Table 4", "ARTS", "cells a side" },
	{ "Table 5", "k-d tree", "planes above a leaf" }, { "Table 6", "automatic bounding volume hierarchy", "levels" },
};

/* Tables 2 to 6, in the order of the scenes above: flops a ray, and the heights as printed. */
static const struct {
	double theory, experiment;
	const char *predicted, *best;
} paper[SWEEP_METHODS][SCENES] = {
	{ { 455.37, 184.98, "13", "9-12" }, { 249.37, 202.99, "13", "9-12" }, { 1260.54, 520.31, "15", "15" },
	  { 432.45, 408.99, "23", "20-23" }, { 389.3, 463.30, "16", "16-19" } },
	{ { 480.37, 215.02, "4", "4" }, { 251.43, 216.79, "4", "3" }, { 1243.51, 544.97, "5", "5" }, { 448.66, 459.39, "8", "8" },
	  { 437.65, 582.69, "5", "6-7" } },
	{ { 269.40, 215.63, "32", "16" }, { 93.72, 156.75, "32", "16" }, { 435.39, 471.85, "32", "32-64" },
	  { 404.89, 1125.35, "32", "64" }, { 138.41, 1158.01, "16", "32-64" } },
	{ { 141.11, 142.20, "10", "10" }, { 155.74, 192.06, "12", "12" }, { 288.36, 376.44, "16", "16" }, { 183.57, 206.08, "16", "16" },
	  { 149.22, 163.89, "11", "11" } },
	{ { 358.6, 376.86, "10", "10" }, { 881.95, 1013.63, "8", "8" }, { 1397.33, 1543.14, "10", "10" },
	  { 726.95, 1014.72, "10", "10" }, { 424.47, 533.85, "6", "6" } },
};

/* Tables 7 and 8. */
static const struct {
	int scene;
	enum sweep_method method;
	struct exponential scene_theory, scene_experiment, traversal_theory, traversal_experiment;
} fits[] = {
	{ 0, SWEEP_BSP, { 9928.28, -0.30 }, { 5473.92, -0.35 }, { 17.34, 0.19 }, { 27.92, 0.13 } },
	{ 3, SWEEP_BSP, { 111311.80, -0.29 }, { 338605.37, -0.34 }, { 19.98, 0.11 }, { 70.41, 0.06 } },
	{ 2, SWEEP_ARTS, { 22755.86, -0.31 }, { 17947.19, -0.27 }, { 127.24, 0.0142 }, { 100.62, 0.0144 } },
};

static void open_table(struct text *out, const char *title, const char *said, const char *const *heads)
{
	text_print(out, "<h3>%s</h3>\n<p>%s</p>\n<div class=\"wide\"><table><thead><tr>", title, said);
	for (; *heads; heads++)
		text_print(out, "<th>%s</th>", *heads);
	text_print(out, "</tr></thead><tbody>\n");
}

static void close_table(struct text *out)
{
	text_print(out, "</tbody></table></div>\n");
}

/* A field with a number, empty where there is none. */
static void add_number(struct text *out, const char *format, double x)
{
	char field[64];
	snprintf(field, sizeof field, format, x);
	text_print(out, "<td class=\"n\">%s</td>", isfinite(x) ? field : "");
}

static bool has_sweep(const struct sweep *s)
{
	return sweep_least(s, "flops_actual").row < s->table->rows || sweep_least(s, "model_cost").row < s->table->rows;
}

/* The first image of a scene's sweeps. */
static size_t find_image(const struct table *t, int scene)
{
	for (size_t i = 0; i < t->rows; i++)
		for (int m = 0; m < SWEEP_METHODS; m++)
			if (sweep_holds(&(struct sweep){ t, (enum sweep_method)m, scenes[scene].family, false, false }, i))
				return i;
	return t->rows;
}

static double sum_classes(const struct table *t, size_t row, const char *what, const char *const *classes)
{
	double sum = 0;
	for (; *classes; classes++) {
		char column[64];
		snprintf(column, sizeof column, "%s_%s", *classes, what);
		sum += table_number(t, row, column);
	}
	return sum / 1000;
}

static void print_scenes(struct text *out, const struct table *t)
{
	static const char *const heads[] = { "scene", "primitives", "visual rays", "paper", "shadow rays", "paper", "hits", "paper", NULL };
	static const char *const visual[] = { "primary", "reflected", "refracted", NULL }, *const shadow[] = { "shadow", NULL };
	open_table(out, "Table 1: the scenes",
	           "Rays in thousands: here those of the job's image, in the paper those of 512 x 512 pixels. A hit sends a shadow ray to every light "
	           "here.", heads);
	for (int i = 0; i < SCENES; i++) {
		size_t row = find_image(t, i);
		if (row == t->rows)
			continue;
		text_print(out, "<tr><td>%s</td>", scenes[i].name);
		add_number(out, "%.0f", table_number(t, row, "triangles") + table_number(t, row, "spheres"));
		add_number(out, "%.0f", sum_classes(t, row, "rays", visual));
		add_number(out, "%.0f", scenes[i].visual);
		add_number(out, "%.0f", sum_classes(t, row, "rays", shadow));
		add_number(out, "%.0f", scenes[i].shadow);
		add_number(out, "%.0f", sum_classes(t, row, "hits", visual));
		add_number(out, "%.0f", scenes[i].hits);
		text_print(out, "</tr>\n");
	}
	close_table(out);
}

/* How much more than the least, in percent, the height costs that has the least of another column. */
static double loss(const struct sweep *s, const char *chosen_by)
{
	struct sweep_best choice = sweep_least(s, chosen_by);
	return 100 * (sweep_at(s, choice.height, "flops_actual") / sweep_least(s, "flops_actual").value - 1);
}

/* Heights nearly as good; hierarchies have none. */
static void add_heights(struct text *out, struct sweep_best best)
{
	if (best.low <= best.high)
		text_print(out, "<td>%.0f-%.0f</td>", best.low, best.high);
	else
		text_print(out, "<td></td>");
}

static void print_method_row(struct text *out, const struct sweep *image, const struct table *times, int scene)
{
	const struct sweep random = { image->table, image->method, image->family, true, false };
	struct sweep_best model = sweep_least(image, "model_cost"), exact = sweep_least(image, "flops_exact");
	struct sweep_best best = sweep_least(image, "flops_actual"), fastest = sweep_fastest(image, times);
	text_print(out, "<tr><td>%s</td><td>%s</td>", scenes[scene].name, paper[image->method][scene].predicted);
	add_number(out, "%.0f", model.height);
	text_print(out, "<td>%s</td>", paper[image->method][scene].best);
	add_number(out, "%.0f", best.height);
	add_heights(out, best);
	add_heights(out, fastest);
	add_number(out, "%.1f", paper[image->method][scene].theory);
	add_number(out, "%.1f", model.value);
	add_number(out, "%.1f", paper[image->method][scene].experiment);
	add_number(out, "%.1f", best.value);
	add_number(out, "%.2f", paper[image->method][scene].theory / paper[image->method][scene].experiment);
	add_number(out, "%.2f", model.value / best.value);
	add_number(out, "%.1f", loss(image, "model_cost"));
	add_number(out, "%.0f", exact.height);
	add_number(out, "%.1f", exact.value);
	add_number(out, "%.2f", exact.value / best.value);
	add_number(out, "%.1f", loss(image, "flops_exact"));
	add_number(out, "%.0f", sweep_least(image, "flops_replay").height);
	add_number(out, "%.1f", loss(image, "flops_replay"));
	add_number(out, "%.0f", sweep_least(&random, "flops_actual").height);
	add_number(out, "%.1f", loss(&random, "model_cost"));
	add_number(out, "%.1f", loss(&random, "flops_exact"));
	text_print(out, "</tr>\n");
}

/* How good a height some prediction chooses, over all scenes of a method. */
struct verdict {
	size_t sweeps, near, near_fastest; /* at most one level from the heights within 2 % of the best, or within 10 % of the least time */
	double worst;                      /* percent more than the best */
};

static bool is_near(enum sweep_method m, double height, struct sweep_best best)
{
	if (m == SWEEP_ARTS)
		return height >= best.low / 2 && height <= best.high * 2;
	return height >= best.low - 1 && height <= best.high + 1;
}

/* Of the sweeps that are like one, whatever their family. */
static struct verdict judge(const struct sweep *like, const struct table *times, const char *chosen_by)
{
	struct verdict v = { 0 };
	for (int i = 0; i < SCENES; i++) {
		struct sweep s = *like;
		s.family = scenes[i].family;
		struct sweep_best choice = sweep_least(&s, chosen_by), best = sweep_least(&s, "flops_actual");
		if (choice.row == s.table->rows || best.row == s.table->rows)
			continue;
		v.sweeps++;
		v.near += is_near(s.method, choice.height, best);
		v.near_fastest += is_near(s.method, choice.height, sweep_fastest(&s, times));
		v.worst = fmax(v.worst, loss(&s, chosen_by));
	}
	return v;
}

static void print_verdict(struct text *out, const struct sweep *like, const struct table *times)
{
	static const struct { const char *column, *name; } choosers[] = {
		{ "model_cost", "model" }, { "model_cost_truncated", "model, truncated mean" }, { "flops_exact", "exact" }, { "flops_replay", "pilot" } };
	for (size_t k = 0; k < sizeof choosers / sizeof *choosers; k++) {
		struct verdict v = judge(like, times, choosers[k].column);
		if (v.sweeps)
			text_print(out, "<tr><td>%s%s</td><td>%s</td><td>%s</td><td class=\"n\">%zu</td><td class=\"n\">%zu</td>"
			           "<td class=\"n\">%zu</td><td class=\"n\">%.1f</td></tr>\n",
			           methods[like->method].name, like->restart ? ", each leaf from the root" : "", like->random ? "random" : "image",
			           choosers[k].name, v.sweeps, v.near, v.near_fastest, v.worst);
	}
}

static void print_verdicts(struct text *out, const struct table *t, const struct table *times)
{
	static const char *const heads[] = { "method", "rays", "who chooses", "sweeps", "within one level", "and of the fastest",
		                             "costs more than the best, at most, %", NULL };
	open_table(out, "Who ends subdivision best",
	           "A level is a plane above a leaf, a level of the octree, a doubling of the grid; it counts from the heights within 2 % of the best, "
	           "or within 10 % of the least time. (The paper's own fits put the least flops of its "
	           "BSP trees at h = 13.1 for Tetra and 25.5 for Balls, where it gives 9-12 and 20-23 as best: its best heights must be those of "
	           "the clock.) The model takes every leaf to be reached from the root on, past all planes above it; a recursive walk passes "
	           "fewer of them, so that deeper trees cost it less than the model expects.",
	           heads);
	for (int m = 0; m < SWEEP_METHODS; m++)
		for (int random = 0; random < 2; random++)
			for (int restart = 0; restart <= (m == SWEEP_BSP || m == SWEEP_OCTREE); restart++)
				print_verdict(out, &(struct sweep){ t, (enum sweep_method)m, NULL, random, restart }, times);
	close_table(out);
}

static void print_methods(struct text *out, const struct table *t, const struct table *times)
{
	static const char *const heads[] = {
		"scene", "paper: h predicted", "model: h", "paper: h best", "image: h best", "within 2 %", "by time, within 10 %", "paper: C theory",
		"model: C", "paper: C measured", "image: C best", "paper: ratio", "model / image", "model's h costs more, %", "exact: h",
		"exact: C", "exact / image", "exact's h costs more, %", "pilot's h", "pilot's h costs more, %", "random rays: h best", "model's h costs more, %",
		"exact's h costs more, %", NULL };
	for (int m = 0; m < SWEEP_METHODS; m++) {
		char title[100], said[400];
		bool any = false;
		for (int i = 0; i < SCENES; i++) {
			const struct sweep s = { t, (enum sweep_method)m, scenes[i].family, false, false };
			if (!has_sweep(&s))
				continue;
			snprintf(title, sizeof title, "%s: %s", methods[m].place, methods[m].name);
			snprintf(said, sizeof said, "C: flops a ray; h: %s. The model's C is that of the height it predicts, the image's that of the "
			         "best height; 'exact' is the expectation under random rays, with a mailbox of one leaf; "
			         "'pilot' what the rays of a small image would cost.", methods[m].height);
			if (!any)
				open_table(out, title, said, heads);
			any = true;
			print_method_row(out, &s, times, i);
		}
		if (any)
			close_table(out);
	}
}

/* What the model puts in the place of what is known exactly. */
static void print_errors(struct text *out, const struct table *t)
{
	static const char *const heads[] = { "method", "scene", "h", "regions: model", "expected", "image", "tests: model", "expected", "image",
		                             "tests with mailbox: image", NULL };
	open_table(out, "Where the model errs",
	           "At the best height. The model takes a ray to be stopped by every region with the same chance, and its lists to be as long as the "
	           "mean over all leaves; but rays meet leaves by their surface area, and long lists stand in small leaves. 'expected' is exact "
	           "for random rays, without a mailbox.", heads);
	for (int m = 0; m < SWEEP_ABV; m++)
		for (int i = 0; i < SCENES; i++) {
			const struct sweep s = { t, (enum sweep_method)m, scenes[i].family, false, false };
			struct sweep_best best = sweep_least(&s, "flops_actual");
			if (best.row == t->rows)
				continue;
			text_print(out, "<tr><td>%s</td><td>%s</td>", methods[m].name, scenes[i].name);
			add_number(out, "%.0f", best.height);
			add_number(out, "%.2f", table_number(t, best.row, "model_regions"));
			add_number(out, "%.2f", table_number(t, best.row, "predicted_leaves"));
			add_number(out, "%.2f", table_number(t, best.row, "actual_leaves"));
			add_number(out, "%.2f", table_number(t, best.row, "model_regions") * table_number(t, best.row, "model_per_leaf"));
			add_number(out, "%.2f", table_number(t, best.row, "predicted_tests"));
			add_number(out, "%.2f", table_number(t, best.row, "actual_tests"));
			add_number(out, "%.2f", table_number(t, best.row, "actual_tests_made"));
			text_print(out, "</tr>\n");
		}
	close_table(out);
}

static struct exponential fit_column(const struct sweep *s, const char *column)
{
	double x[HEIGHTS_MOST], y[HEIGHTS_MOST];
	size_t n = 0;
	for (size_t i = 0; i < s->table->rows && n < HEIGHTS_MOST; i++)
		if (sweep_holds(s, i)) {
			x[n] = sweep_height(s, i);
			y[n++] = table_number(s->table, i, column);
		}
	return fit_exponential(x, y, n);
}

static void add_fit(struct text *out, struct exponential f)
{
	text_print(out, "<td>%.5g e<sup>%.3gh</sup></td>", f.factor, f.rate);
}

static void print_fits(struct text *out, const struct table *t)
{
	static const char *const heads[] = { "scene", "method", "whose", "C_sc, theory", "C_sc, measured", "C_tr, theory", "C_tr, measured",
		                             "h of least cost, theory", "measured", NULL };
	open_table(out, "Tables 7 and 8: exponentials",
	           "Fitted by least squares in the logarithm over every height of the job, for ARTS over the cells a side; the minimum in closed form.",
	           heads);
	for (size_t i = 0; i < sizeof fits / sizeof *fits; i++) {
		const struct sweep s = { t, fits[i].method, scenes[fits[i].scene].family, false, false };
		const struct exponential theirs[4] = { fits[i].scene_theory, fits[i].scene_experiment, fits[i].traversal_theory,
			                               fits[i].traversal_experiment };
		const struct exponential ours[4] = { fit_column(&s, "model_scene"), fit_column(&s, "flops_actual_scene"),
			                             fit_column(&s, "model_traversal"), fit_column(&s, "flops_actual_traversal") };
		for (int k = 0; k < 2; k++) {
			const struct exponential *f = k ? ours : theirs;
			if (k && !has_sweep(&s))
				break;
			text_print(out, "<tr><td>%s</td><td>%s</td><td>%s</td>", scenes[fits[i].scene].name, methods[fits[i].method].name,
			           k ? "here" : "paper");
			for (int j = 0; j < 4; j++)
				add_fit(out, f[j]);
			add_number(out, "%.1f", fit_minimum(f[0], f[2]));
			add_number(out, "%.1f", fit_minimum(f[1], f[3]));
			text_print(out, "</tr>\n");
		}
	}
	close_table(out);
}

/* Whether the job has images of a scene of the paper in one of its partitions of space. */
static bool is_swept(const struct table *t)
{
	for (int i = 0; i < SCENES; i++)
		for (int m = 0; m < SWEEP_ABV; m++)
			for (int restart = 0; restart < 2; restart++) {
				const struct sweep s = { t, (enum sweep_method)m, scenes[i].family, false, restart };
				if (has_sweep(&s))
					return true;
			}
	return false;
}

void subramanian_print(struct text *out, const struct table *t, const struct table *times)
{
	if (!is_swept(t))
		return;
	text_print(out, "<h2>Subramanian and Fussell 1990, beside what was measured</h2>\n");
	print_scenes(out, t);
	print_methods(out, t, times);
	print_verdicts(out, t, times);
	print_errors(out, t);
	print_fits(out, t);
}
