/* The tables of Subramanian and Fussell 1990 beside what a job has measured. */
#ifndef REPORT_SUBRAMANIAN_H
#define REPORT_SUBRAMANIAN_H

#include "io/text.h"
#include "report/table.h"

/* Append the tables as HTML; nothing where the job has no rows for them. times: of times.csv, for the best height by time. */
void subramanian_print(struct text *out, const struct table *t, const struct table *times);

#endif
