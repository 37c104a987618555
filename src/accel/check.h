/* What holds for the lists of every structure whose leaves have boxes, for tests. */
#ifndef ACCEL_CHECK_H
#define ACCEL_CHECK_H

#include "accel/accel.h"

/* Every list is ascending, holds what meets the cell (reaches into it, if lists are inner ones), and nothing that stays clear of
 * it by more than slack; every cell has a volume; a->leaves and a->nodes are what the cells add up to. 0, or -1 and *e. */
int check_lists(const struct accel *a, struct err *e);

#endif
