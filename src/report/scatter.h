/* Scatter plots with one colour and mark a series, and bands where a paper saw its points. */
#ifndef REPORT_SCATTER_H
#define REPORT_SCATTER_H

#include "report/plot.h"
#include "report/table.h"

enum { SCATTER_SERIES = 24 };

struct scatter {
	const char *x_label, *y_label;
	bool log_x, log_y, lines; /* lines: points of a series are joined; log_y: y is no ratio, 1 means nothing */
	int group; /* so many series in a row share a colour, and the nth of each a mark and a dash; 0: none do */
	struct {
		double low, high;
		const char *text;
	} bands[3];
	int band_count;
	struct {
		char name[100];
		struct text points;
	} series[SCATTER_SERIES];
	int series_count;
	size_t left_out; /* points of series beyond the most */
};

/* Numbers that are not finite are left out. Series stand in the legend in the order in which they came. */
void scatter_add(struct scatter *s, const char *series, double x, double y);

/* A stretch of y to be shaded. */
void scatter_band(struct scatter *s, double low, double high, const char *text);

/* The script and data of plot 'p' from what was added. False when there is no point. */
bool scatter_finish(struct scatter *s, struct plot *p);

void scatter_free(struct scatter *s);

#endif
