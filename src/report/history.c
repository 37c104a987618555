#include "report/history.h"

#include "report/compare.h"
#include "report/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Scenes with a line of their own in the plot. */
enum { SCENES_MOST = 12 };

struct history {
	struct measured *runs;
	const char *const *names;
	size_t n;
	const char *column;
	const struct named_row **common; /* rows of the first run that all have */
	size_t common_count;
	const char *scenes[SCENES_MOST];
	size_t scene_count;
	double *values; /* room for common_count */
};

static bool read_value(const struct history *h, size_t run, const struct named_row *first, double *x)
{
	const struct measured *m = &h->runs[run];
	const struct named_row *row = measured_find(m, first);
	const char *text = row ? measured_text(m, row, h->column) : "";
	char *end;
	*x = strtod(text, &end);
	return *text && *end == '\0';
}

static void add_scene(struct history *h, const char *scene)
{
	for (size_t i = 0; i < h->scene_count; i++)
		if (strcmp(h->scenes[i], scene) == 0)
			return;
	if (h->scene_count < SCENES_MOST)
		h->scenes[h->scene_count++] = scene;
}

static int find_common(struct history *h, struct err *e)
{
	const struct measured *first = &h->runs[0];
	h->common = malloc((first->counts.rows + 1) * sizeof *h->common);
	h->values = malloc((first->counts.rows + 1) * sizeof *h->values);
	if (!h->common || !h->values)
		return err_memory(e, "history");
	for (size_t i = 0; i < first->counts.rows; i++) {
		bool everywhere = true;
		double x;
		for (size_t run = 0; everywhere && run < h->n; run++)
			everywhere = read_value(h, run, &first->rows[i], &x);
		if (!everywhere)
			continue;
		h->common[h->common_count++] = &first->rows[i];
		add_scene(h, measured_text(first, &first->rows[i], "scene"));
	}
	return h->common_count ? 0 : err_at(e, STATUS_INPUT, NULL, 0, "the runs have no row with a '%s' in common", h->column);
}

/* Over the common rows of one scene, or of all where it is NULL. */
static double median_of(const struct history *h, size_t run, const char *scene)
{
	double median, low, high;
	size_t n = 0;
	for (size_t i = 0; i < h->common_count; i++)
		if (!scene || strcmp(measured_text(&h->runs[0], h->common[i], "scene"), scene) == 0)
			n += read_value(h, run, h->common[i], &h->values[n]);
	compare_median(h->values, n, &median, &low, &high);
	return median;
}

static void print_table(struct text *out, const struct history *h)
{
	double before = NAN;
	int width = 3;
	for (size_t run = 0; run < h->n; run++)
		width = (int)strlen(h->names[run]) > width ? (int)strlen(h->names[run]) : width;
	text_print(out, "%-*s  %14s  %10s\n", width, "run", h->column, "change");
	for (size_t run = 0; run < h->n; run++) {
		double now = median_of(h, run, NULL);
		text_print(out, "%-*s  %14.9g", width, h->names[run], now);
		if (run > 0 && before != 0)
			text_print(out, "  %+9.3f%%", 100 * (now - before) / fabs(before));
		text_print(out, "\n");
		before = now;
	}
	text_print(out, "medians over the %zu rows that all %zu runs have\n", h->common_count, h->n);
}

/* A double-quoted word of gnuplot's data files and scripts. */
static void add_quoted(struct text *out, const char *word)
{
	text_add(out, "\"", 1);
	for (const char *p = word; *p; p++)
		text_add(out, *p == '"' || *p == '\\' || (unsigned char)*p < 0x20 ? "_" : p, 1);
	text_add(out, "\"", 1);
}

static void fill_plot(struct plot *p, const struct history *h)
{
	text_print(&p->script, "set ylabel \"median of %s\" noenhanced\nset xtics rotate by -30 noenhanced\n"
	           "set key outside right top samplen 1 noenhanced\nset grid linecolor '#dddddd'\n"
	           "set offsets 0.3, 0.3, graph 0.05, graph 0.05\n"
	           "plot '%s.dat' using 1:3:xtic(2) with linespoints linewidth 3 linecolor '#000000' title 'all'", h->column, p->name);
	for (size_t s = 0; s < h->scene_count; s++) {
		text_print(&p->script, ", '' using 1:%zu with linespoints title ", s + 4);
		add_quoted(&p->script, h->scenes[s]);
	}
	text_print(&p->script, "\n");
	for (size_t run = 0; run < h->n; run++) {
		text_print(&p->data, "%zu ", run + 1);
		add_quoted(&p->data, h->names[run]);
		text_print(&p->data, " %.9g", median_of(h, run, NULL));
		for (size_t s = 0; s < h->scene_count; s++)
			text_print(&p->data, " %.9g", median_of(h, run, h->scenes[s]));
		text_print(&p->data, "\n");
	}
}

int history_write(struct text *out, struct measured *runs, const char *const *names, size_t n, const char *column, const char *folder,
                  struct err *e)
{
	struct history h = { .runs = runs, .names = names, .n = n, .column = column };
	char name[128];
	struct plot plot = { .name = name };
	bool drawn = false;
	int status = find_common(&h, e);
	snprintf(name, sizeof name, "history-%s", column);
	if (status == 0) {
		print_table(out, &h);
		fill_plot(&plot, &h);
		status = plot_draw(&plot, folder, &drawn, e);
	}
	if (status == 0)
		text_print(out, drawn ? "%s/plots/%s.svg\n" : "gnuplot is missing: the script is %s/plots/%s.gp, but nothing is drawn\n", folder, name);
	plot_free(&plot);
	free(h.common);
	free(h.values);
	return status;
}
