/* The rows that lie in an output folder and in the folders of its shards. */
#ifndef BATCH_FOUND_H
#define BATCH_FOUND_H

#include "base/arena.h"
#include "batch/record.h"

/* One folder: the output folder itself, then its shards by number of shards and number. */
struct found_source {
	const char *folder;
	struct old_rows old;
};

struct found_row {
	const char *line; /* whole, in its source */
	size_t source;
	bool ok;
};

/* Zero-initialise; found_free closes. */
struct found {
	struct arena mem;
	struct found_source *sources;
	struct found_row *rows; /* by key, those of status ok first, then by source */
	size_t source_count, row_count;
};

/* Read counts.csv and counts.old.csv of FOLDER and of every FOLDER/shards/K-of-N; none of them needs to be there. 0, or -1 and *e. */
int found_read(struct found *f, const char *folder, struct err *e);
void found_free(struct found *f);

/* The first row with this key (16 digits), or NULL; found_line: only if it is of status ok. */
const struct found_row *found_row(const struct found *f, const char *key);
const char *found_line(const struct found *f, const char *key);

/* 0 when all rows of one key and status ok are the same bytes, or -1 and *e naming two that are not. */
int found_check(const struct found *f, struct err *e);

#endif
