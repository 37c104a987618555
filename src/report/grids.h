/* What a report says of uniform grids. */
#ifndef REPORT_GRIDS_H
#define REPORT_GRIDS_H

#include "io/text.h"
#include "report/table.h"

/* Append a table of every grid in the terms of the literature as HTML; nothing where there is none. */
void grids_print(struct text *out, const struct table *t);

#endif
