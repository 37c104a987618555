/* The figures of a report: each one row of a table, filled from the rows of counts.csv, left out where it has no data. */
#ifndef REPORT_FIGURES_H
#define REPORT_FIGURES_H

#include "report/plot.h"
#include "report/table.h"

/* fill puts script and data into the plot; false where the table has nothing for it. folder: of the job's output. */
struct figure {
	const char *name, *title, *caption;
	bool (*fill)(struct plot *p, const struct table *t, const char *folder);
};

/* NULL-named at the end. */
extern const struct figure figures[];

#endif
