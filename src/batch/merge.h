/* Bringing the shards of a job together. */
#ifndef BATCH_MERGE_H
#define BATCH_MERGE_H

#include "io/text.h"

#include <stddef.h>

struct merge_result {
	size_t shards, rows, failed, missing;
};

/* Make FOLDER/counts.csv of the rows in FOLDER/shards/K-of-N, and in FOLDER itself, in plan order: the bytes of an unsharded run. Their
 * times go to times.csv; scenes, images and drawings move to where an unsharded run keeps them. Rows that are equal fold; of a row
 * that failed and one that did not the latter counts. missing: receives the keys that nobody has, a line each. 0, or -1 and *e: no
 * shards; shards of different jobs; two rows of one key that differ (both are named); STATUS_BUSY; disk. */
int merge_shards(const char *folder, struct merge_result *result, struct text *missing, struct err *e);

#endif
