/* Figures of what the approximations of the chance that a ray from inside meets a cell are worth. */
#ifndef REPORT_CHANCES_H
#define REPORT_CHANCES_H

#include "report/plot.h"
#include "report/table.h"

/* As 'fill' of struct figure: eq. (2), (4) and (5) over the exact value, by that value; and how often which ratio is. Over random nodes
 * of a cube, a hall and a corridor; only where the record holds kd trees by such a metric. */
bool chances_fill_scatter(struct plot *p, const struct table *t, const char *folder);
bool chances_fill_histogram(struct plot *p, const struct table *t, const char *folder);

#endif
