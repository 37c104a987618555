/* One column over several runs of a job. */
#ifndef REPORT_HISTORY_H
#define REPORT_HISTORY_H

#include "io/text.h"
#include "report/measured.h"

/* Of the rows that all runs have and did: the median of 'column' in every run, over all rows and by scene. Print a table, a line a run,
 * to 'out' and draw it as FOLDER/plots/history-COLUMN.svg (plot.h). names[n]: of the runs, borrowed. 0, or -1 and *e: no such column,
 * no rows in common, disk, memory. */
int history_write(struct text *out, struct measured *runs, const char *const *names, size_t n, const char *column, const char *folder,
                  struct err *e);

#endif
