#include "report/interiors.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { METRICS = 4, FIGURES = 4, SCENES_MOST = 64 };
enum { TRAVERSALS, PLANES, TRIANGLES, SPEED };

static const char *const metrics[METRICS] = { "sah", "hq26", "fast6", "exact" };

/* Per cent more than by the SAH, in the order of the figures; NAN: not in the paper. build: by eq. (5). static_view: of table 2(a). */
static const struct printed {
	const char *family, *name;
	double more[METRICS][FIGURES], build, static_view;
} papers[] = {
	{ "room", "Scene 6", { [1] = { -24.9, -15.3, -7.3, 7.5 }, [2] = { -25.2, -14.3, -3.0, 7.0 } }, 7.4, 8.5 },
	{ "atrium", "Sponza", { [1] = { -0.5, 1.1, -12.3, 1.9 }, [2] = { -4.3, 25.5, -13.7, 0.0 } }, 5.8, -3.9 },
	{ "nave", "Sibenik", { [1] = { -5.8, -11.0, -7.2, 2.0 }, [2] = { -5.6, -10.5, -4.0, 2.1 } }, 2.3, 4.2 },
	{ "forest", "Fairy", { [1] = { 5.5, -5.7, -2.8, 1.3 }, [2] = { -1.1, -3.9, -6.5, 2.7 } }, 13.0, 0.4 },
	{ "conference", "Conference", { [1] = { -13.0, -21.4, -6.1, 5.1 }, [2] = { -18.6, -17.4, 1.4, 4.2 } }, 7.6, 5.1 },
};

/* What is told apart: rays of one kind. */
struct kind {
	const char *workload, *light, *title;
};

enum { FLIGHT, LIGHT_OUTSIDE, INTERIOR_HITS, INTERIOR, KINDS };
static const struct kind kinds[KINDS] = {
	{ "render", "", "Flights: primary rays, shadows of one light, one level of reflection (table 1)" },
	{ "render", "outside", "The same with the light outside the box, which nothing assumes" },
	{ "interior-hits", "", "Rays from anywhere inside, up to their hits" },
	{ "interior", "", "Rays from anywhere inside that nothing stops: what eq. (3) assumes" },
};

static bool is_row(const struct table *t, size_t row, const char *scene, const char *metric, const struct kind *k)
{
	return table_is(t, row, "status", "ok") && table_is(t, row, "structure", "kd") && table_is(t, row, "split", metric) &&
	       table_is(t, row, "scene", scene) && table_is(t, row, "workload", k->workload) && table_is(t, row, "light", k->light);
}

/* The first such row, or none (t->rows). */
static size_t find_row(const struct table *t, const char *scene, const char *metric, const struct kind *k)
{
	size_t i = 0;
	while (i < t->rows && !is_row(t, i, scene, metric, k))
		i++;
	return i;
}

/* Scenes that have a tree by the SAH and one by another metric; returns how many. */
static size_t list_scenes(const struct table *t, const char **scenes, const struct kind *k)
{
	size_t count = 0;
	for (size_t i = 0; i < t->rows && count < SCENES_MOST; i++) {
		const char *scene = table_text(t, i, "scene");
		bool other = false;
		if (!is_row(t, i, scene, metrics[0], k) || find_row(t, scene, metrics[0], k) != i)
			continue;
		for (int m = 1; m < METRICS; m++)
			other |= find_row(t, scene, metrics[m], k) < t->rows;
		if (other)
			scenes[count++] = scene;
	}
	return count;
}

bool interiors_hold(const struct table *t)
{
	const char *scenes[SCENES_MOST];
	bool any = false;
	for (int i = 0; i < KINDS; i++)
		any |= list_scenes(t, scenes, &kinds[i]) > 0;
	return any;
}

static const struct printed *find_printed(const struct table *t, size_t row)
{
	for (size_t i = 0; i < sizeof papers / sizeof *papers; i++)
		if (table_is(t, row, "family", papers[i].family))
			return &papers[i];
	return NULL;
}

static double find_time(const struct table *t, size_t row, const struct table *times, const char *column)
{
	for (size_t i = 0; row < t->rows && i < times->rows; i++)
		if (table_is(times, i, "key", table_text(t, row, "key")))
			return table_number(times, i, column);
	return NAN;
}

/* What a figure says of a row; planes are all tests made, of which 'actual_barycentric' go on. */
static double find_figure(const struct table *t, size_t row, const struct table *times, int figure)
{
	static const char *const columns[] = { "actual_inner", "actual_tests", "actual_barycentric" };
	if (row == t->rows)
		return NAN;
	return figure == SPEED ? find_time(t, row, times, "rays_per_second") : table_number(t, row, columns[figure]);
}

static double more_than(double x, double base)
{
	return 100 * (x / base - 1);
}

/* A measured number of per cent, the paper's in brackets; each empty where there is none. */
static void print_cell(struct text *page, double x, double paper)
{
	text_print(page, "<td class=\"n\">");
	if (!isnan(x))
		text_print(page, "%+.1f", x);
	if (!isnan(paper))
		text_print(page, " <small>(%+.1f)</small>", paper);
	text_print(page, "</td>");
}

/* Numbers of which mean and standard deviation are wanted. */
struct sums {
	double n, sum, square;
};

static void sums_add(struct sums *s, double x)
{
	if (isnan(x))
		return;
	s->n++;
	s->sum += x;
	s->square += x * x;
}

static double mean_of(const struct sums *s)
{
	return s->n > 0 ? s->sum / s->n : NAN;
}

static double deviation_of(const struct sums *s)
{
	return s->n > 1 ? sqrt(fmax(0, s->square - s->sum * s->sum / s->n) / (s->n - 1)) : NAN;
}

/* A column of a comparison: measured and printed numbers. */
struct column {
	struct sums measured, paper;
};

static void print_sums(struct text *page, const char *name, const struct column *columns, double (*what)(const struct sums *))
{
	text_print(page, "<tr><td>%s</td><td></td>", name);
	for (int c = 0; c < (METRICS - 1) * FIGURES; c++)
		print_cell(page, what(&columns[c].measured), what(&columns[c].paper));
	text_print(page, "</tr>\n");
}

static void print_scene(struct text *page, const struct table *t, const struct table *times, const char *scene, const struct kind *k,
                        struct column *columns)
{
	size_t base = find_row(t, scene, metrics[0], k);
	const struct printed *paper = k == &kinds[FLIGHT] ? find_printed(t, base) : NULL;
	text_print(page, "<tr><td>%s%s%s%s</td><td class=\"n\">%.2f, %.2f", scene, paper ? " <small>(" : "", paper ? paper->name : "",
	           paper ? ")</small>" : "", find_figure(t, base, times, TRAVERSALS), find_figure(t, base, times, PLANES));
	if (!isnan(find_figure(t, base, times, TRIANGLES)))
		text_print(page, ", %.2f", find_figure(t, base, times, TRIANGLES));
	text_print(page, "</td>");
	for (int m = 1; m < METRICS; m++)
		for (int f = 0; f < FIGURES; f++, columns++) {
			size_t row = find_row(t, scene, metrics[m], k);
			double x = more_than(find_figure(t, row, times, f), find_figure(t, base, times, f));
			double said = paper && m < METRICS - 1 ? paper->more[m][f] : NAN;
			print_cell(page, x, said);
			sums_add(&columns->measured, x);
			sums_add(&columns->paper, said);
		}
	text_print(page, "</tr>\n");
}

static void print_kind(struct text *page, const struct table *t, const struct table *times, const struct kind *k)
{
	const char *scenes[SCENES_MOST];
	struct column columns[(METRICS - 1) * FIGURES] = { 0 };
	size_t count = list_scenes(t, scenes, k);
	if (count == 0)
		return;
	text_print(page, "<h2>%s</h2>\n<p>Per cent more than by the SAH (eq. 2); under it inner nodes, plane tests and, where there are any, "
	           "barycentric tests a ray.", k->title);
	text_print(page, "%s</p>\n<div class=\"wide\"><table><thead><tr><th>scene</th><th>sah</th>",
	           k == &kinds[FLIGHT] ? " In brackets the paper's numbers." : "");
	for (int m = 1; m < METRICS; m++)
		text_print(page, "<th>%s: traversals</th><th>plane tests</th><th>triangle tests</th><th>rays/s</th>", metrics[m]);
	text_print(page, "</tr></thead><tbody>\n");
	for (size_t i = 0; i < count; i++)
		print_scene(page, t, times, scenes[i], k, columns);
	if (count > 1) {
		print_sums(page, "average", columns, mean_of);
		print_sums(page, "standard deviation", columns, deviation_of);
	}
	text_print(page, "</tbody></table></div>\n");
}

/* The row of a tree whatever its rays. */
static size_t find_tree(const struct table *t, const char *scene, int metric)
{
	for (int i = 0; i < KINDS; i++) {
		size_t row = find_row(t, scene, metrics[metric], &kinds[i]);
		if (row < t->rows)
			return row;
	}
	return t->rows;
}

static void print_trees(struct text *page, const struct table *t, const struct table *times)
{
	text_print(page, "<h2>The trees</h2>\n<p>Build time in seconds, and per cent more than by the SAH with the paper's for eq. (5) in brackets; "
	           "z: the farthest that what rays visit which nothing stops is from the exact expectation, in standard errors.</p>\n"
	           "<div class=\"wide\"><table><thead><tr><th>scene</th><th>split</th><th>nodes</th><th>references</th><th>depth</th>"
	           "<th>seconds</th><th>%% more</th><th>z</th></tr></thead><tbody>\n");
	for (size_t i = 0; i < t->rows; i++) {
		const char *scene = table_text(t, i, "scene");
		int m = 0;
		while (m < METRICS && !table_is(t, i, "split", metrics[m]))
			m++;
		if (m == METRICS || find_tree(t, scene, m) != i)
			continue;
		const struct printed *paper = find_printed(t, i);
		double took = find_time(t, i, times, "seconds_build"), base = find_time(t, find_tree(t, scene, 0), times, "seconds_build"), worst = NAN;
		size_t free = find_row(t, scene, metrics[m], &kinds[INTERIOR]);
		static const char *const deviations[] = { "z_exact", "z_leaves", "z_tests", "z_inner" };
		for (size_t c = 0; free < t->rows && c < sizeof deviations / sizeof *deviations; c++) {
			double z = table_number(t, free, deviations[c]);
			worst = fabs(z) <= fabs(worst) ? worst : z;
		}
		text_print(page, "<tr><td>%s</td><td>%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td><td class=\"n\">%s</td><td class=\"n\">%.3f</td>",
		           scene, metrics[m], table_text(t, i, "nodes"), table_text(t, i, "references"), table_text(t, i, "depth"), took);
		print_cell(page, m ? more_than(took, base) : NAN, m == 2 && paper ? paper->build : NAN);
		if (isnan(worst))
			text_print(page, "<td></td></tr>\n");
		else
			text_print(page, "<td class=\"n\">%+.2f</td></tr>\n", worst);
	}
	text_print(page, "</tbody></table></div>\n");
}

/* One line of table 2(b): counts of one class of rays, or of all of them (NULL). */
static void print_setting(struct text *page, const struct table *t, const struct table *times, const char *name, const char *scene,
                          const struct kind *k, const char *class, double paper)
{
	static const char *const columns[2][4] = { { "primary_inner", "shadow_inner", "reflected_inner", "refracted_inner" },
		                                   { "primary_tests", "shadow_tests", "reflected_tests", "refracted_tests" } };
	size_t row[2] = { find_row(t, scene, metrics[0], k), find_row(t, scene, metrics[2], k) };
	double sums[2][2] = { { 0 } };
	if (row[0] == t->rows || row[1] == t->rows)
		return;
	for (int what = 0; what < 2; what++)
		for (int tree = 0; tree < 2; tree++)
			for (int c = 0; c < 4; c++)
				if (!class || strncmp(columns[what][c], class, strlen(class)) == 0)
					sums[what][tree] += table_number(t, row[tree], columns[what][c]);
	text_print(page, "<tr><td>%s</td>", name);
	print_cell(page, more_than(sums[0][1], sums[0][0]), NAN);
	print_cell(page, more_than(sums[1][1], sums[1][0]), NAN);
	print_cell(page, class ? NAN : more_than(find_figure(t, row[1], times, SPEED), find_figure(t, row[0], times, SPEED)), paper);
	text_print(page, "</tr>\n");
}

/* Other programs with eq. (5): of still views, and of a light that is moved inside. */
static void print_others(struct text *page, const struct table *t, const struct table *times)
{
	const char *scenes[SCENES_MOST];
	size_t count = list_scenes(t, scenes, &kinds[LIGHT_OUTSIDE]);
	if (count == 0)
		return;
	text_print(page, "<h2>Where the light stands (table 2)</h2>\n<p>By eq. (5), per cent more than by the SAH; in brackets the frames per second "
	           "of the paper's ports.</p>\n<div class=\"wide\"><table><thead><tr><th>rays</th><th>traversals</th><th>plane tests</th><th>rays/s</th></tr>"
	           "</thead><tbody>\n");
	for (size_t i = 0; i < count; i++) {
		print_setting(page, t, times, "primary rays (unshadowed)", scenes[i], &kinds[FLIGHT], "primary", 2.5);
		print_setting(page, t, times, "shadow rays, light inside", scenes[i], &kinds[FLIGHT], "shadow", NAN);
		print_setting(page, t, times, "shadow rays, light outside", scenes[i], &kinds[LIGHT_OUTSIDE], "shadow", NAN);
		print_setting(page, t, times, "all, light inside", scenes[i], &kinds[FLIGHT], NULL, 1.7);
		print_setting(page, t, times, "all, light outside", scenes[i], &kinds[LIGHT_OUTSIDE], NULL, -3.8);
	}
	for (size_t i = 0; i < sizeof papers / sizeof *papers; i++)
		text_print(page, "<tr><td>%s, still views</td><td></td><td></td><td class=\"n\"><small>(%+.1f)</small></td></tr>\n", papers[i].name,
		           papers[i].static_view);
	text_print(page, "</tbody></table></div>\n");
}

void interiors_print(struct text *page, const struct table *t, const struct table *times)
{
	if (!interiors_hold(t))
		return;
	for (int i = 0; i < KINDS; i++)
		print_kind(page, t, times, &kinds[i]);
	print_others(page, t, times);
	print_trees(page, t, times);
}
