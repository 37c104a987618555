#include "report/scatter.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Told apart by people of any colour vision (Okabe and Ito 2008). */
static const char *const colors[] = { "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8B6914" };
static const int marks[] = { 7, 5, 9, 11, 13, 6, 4, 8 };

void scatter_add(struct scatter *s, const char *series, double x, double y)
{
	int i = 0;
	if (!isfinite(x) || !isfinite(y))
		return;
	while (i < s->series_count && strcmp(s->series[i].name, series) != 0)
		i++;
	if (i == SCATTER_SERIES) {
		s->left_out++;
		return;
	}
	if (i == s->series_count)
		snprintf(s->series[s->series_count++].name, sizeof s->series[i].name, "%s", series);
	text_print(&s->series[i].points, "%.9g %.9g\n", x, y);
}

void scatter_band(struct scatter *s, double low, double high, const char *text)
{
	s->bands[s->band_count].low = low;
	s->bands[s->band_count].high = high;
	s->bands[s->band_count++].text = text;
}

/* The bands, and an axis long enough for them. */
static void print_bands(const struct scatter *s, struct text *script)
{
	double low = 1, high = 1;
	for (int i = 0; i < s->band_count; i++) {
		low = fmin(low, s->bands[i].low);
		high = fmax(high, s->bands[i].high);
	}
	text_print(script, "set yrange [*<%g:%g<*]\n", low - (high - low) / 20, high + (high - low) / 20);
	for (int i = 0; i < s->band_count; i++) {
		text_print(script, "set object %d rectangle from graph 0, first %g to graph 1, first %g behind fillcolor '#%s' fillstyle solid "
		           "noborder\n", i + 1, s->bands[i].low, s->bands[i].high, i % 2 ? "eef3e2" : "dfe9f5");
		text_print(script, "set label %d '%s' at graph 0.01, first %g offset 0,%g font ',11' textcolor '#555555'\n", i + 1,
		           s->bands[i].text, s->bands[i].high, -0.6);
	}
}

bool scatter_finish(struct scatter *s, struct plot *p)
{
	if (s->series_count == 0)
		return false;
	text_print(&p->script, "set xlabel '%s'\nset ylabel '%s'\nset key outside right top samplen 1\nset grid linecolor '#dddddd'\n",
	           s->x_label, s->y_label);
	text_print(&p->script, "set format x '%%g'\nset format y '%%g'\n%s", s->log_x ? "set logscale x\n" : "");
	if (s->log_y) {
		text_print(&p->script, "set logscale y\n");
	} else {
		text_print(&p->script, "set arrow from graph 0, first 1 to graph 1, first 1 nohead linecolor '#888888' dashtype 2\n");
		print_bands(s, &p->script);
	}
	text_print(&p->script, "plot");
	for (int i = 0; i < s->series_count; i++) {
		int color = s->group ? i / s->group : i, mark = s->group ? i % s->group : i + i / 8;
		text_print(&p->script, "%s '%s.dat' index %d %stitle '%s' with %s pointtype %d pointsize 0.6 linecolor '%s'", i ? ", \\\n " : "",
		           p->name, i, s->lines ? "smooth unique " : "", s->series[i].name, s->lines ? "linespoints" : "points",
		           marks[mark % 8], colors[color % 8]);
		if (s->group)
			text_print(&p->script, " dashtype %d", mark + 1);
		text_print(&p->data, "# %s\n", s->series[i].name);
		text_add(&p->data, s->series[i].points.bytes, s->series[i].points.size);
		text_print(&p->data, "\n\n");
		p->data.lost |= s->series[i].points.lost;
	}
	text_print(&p->script, "\n");
	return true;
}

void scatter_free(struct scatter *s)
{
	for (int i = 0; i < s->series_count; i++)
		text_free(&s->series[i].points);
}
