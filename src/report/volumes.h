/* How near predictions for bounding volume hierarchies come to what traversals cost that find the nearest hit. */
#ifndef REPORT_VOLUMES_H
#define REPORT_VOLUMES_H

#include "io/text.h"
#include "report/table.h"

/* Add it to an HTML page if the record holds rows of it. */
void volumes_add(struct text *page, const struct table *t);

#endif
