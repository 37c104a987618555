/* One self-contained HTML page: figures, statements, and every row of the record. */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "io/text.h"
#include "report/table.h"

/* Draw FOLDER/plots/ and write FOLDER/report.html from FOLDER/counts.csv. said: what a person should know, such as that gnuplot is
 * missing. 0, or -1 and *e. */
int report_write(const char *folder, struct text *said, struct err *e);

#endif
