/* out/JOB/: the rows already there, the rows to come. Every row goes to disk by one write as soon as it is there; a run that is
 * killed loses at most the row it was working on, and the finished file is the same as if it had not been. */
#ifndef BATCH_RECORD_H
#define BATCH_RECORD_H

#include "base/err.h"
#include "io/text.h"

#include <stdbool.h>
#include <stddef.h>

/* Lines sorted by their key, the first field. */
struct line_index {
	const char **lines;
	size_t count;
};

struct record {
	char folder[3000];
	int lock, counts, times;   /* open files, -1 if not */
	struct text old;           /* counts.csv as found, whole lines only, without the head */
	struct line_index good;    /* its rows of status ok */
	struct text done;          /* all rows of this run in plan order, with the head */
	size_t kept, added, failed; /* rows */
};

/* Make and lock the folder and read what is there; a torn last line is dropped, and rows with other columns are set aside as
 * counts.old.csv. fresh: what is there is removed. 0, or -1 and *e: STATUS_BUSY when another run holds the lock. Close it in
 * any case. */
int record_open(struct record *r, const char *folder, bool fresh, struct err *e);

/* The line with this key (16 digits) and status ok among the old ones, or NULL. */
const char *record_find(const struct record *r, const char *key);

/* A row of the plan, in plan order: one found, or a new one, which is written at once. line: with its newline.
 * 0, or -1 and *e (disk). */
int record_keep(struct record *r, const char *line, struct err *e);
int record_add(struct record *r, const char *line, bool failed, struct err *e);

/* A line for times.csv. */
int record_time(struct record *r, const char *line, struct err *e);

/* All rows are there: make counts.csv exactly the plan's rows in its order; rows that belong to no combination of this job go to
 * counts.old.csv. 0, or -1 and *e. */
int record_finish(struct record *r, struct err *e);

void record_close(struct record *r);

#endif
