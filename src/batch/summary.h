/* What a finished record says in a few lines. */
#ifndef BATCH_SUMMARY_H
#define BATCH_SUMMARY_H

#include "batch/job.h"
#include "io/text.h"

/* Append a table to 'out' from the lines of counts.csv (head included): a line a scene with its best variant, the spread of the
 * ratios and the worst deviation; then a line for all. folder: named in the last line. 0, or -1
 * and *e (memory). */
int summary_print(struct text *out, const struct job *job, const char *rows, const char *folder, struct err *e);

#endif
