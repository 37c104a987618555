/* Tables 1 and 2 of Fabianowski, Fowler and Dingliana 2009: kd trees by what they take for the chance that a ray meets a cell, beside the
 * paper's. */
#ifndef REPORT_INTERIORS_H
#define REPORT_INTERIORS_H

#include "io/text.h"
#include "report/table.h"

/* Append them to an HTML page if the record holds kd trees by several of the metrics. times: of times.csv. */
void interiors_print(struct text *page, const struct table *t, const struct table *times);

/* Whether the record holds such trees. */
bool interiors_hold(const struct table *t);

#endif
