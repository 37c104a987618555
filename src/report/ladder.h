/* Table 1 of Smits 1999: what each of his eight experiments costs, beside the paper's. */
#ifndef REPORT_LADDER_H
#define REPORT_LADDER_H

#include "io/text.h"
#include "report/table.h"

/* Add it to an HTML page if the record holds rows of it. folder: of the record, for its times. 0, or -1 and *e (memory, I/O). */
int ladder_add(struct text *page, const struct table *t, const char *folder, struct err *e);

#endif
