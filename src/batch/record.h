/* out/JOB/: the rows already there, the rows to come.
 *
 * counts.csv holds, at every instant of a run, the first rows of the finished file: rows go there in plan order, each by one write, those
 * that an earlier run made as well as new ones. What was found at the start waits in counts.old.csv until its turn; what belongs to no
 * combination of the job stays there. So a run may be killed anywhere and loses at most the row it was working on. */
#ifndef BATCH_RECORD_H
#define BATCH_RECORD_H

#include "base/err.h"
#include "io/text.h"

#include <stdbool.h>
#include <stddef.h>

/* Characters of a key. */
enum { KEY_LENGTH = 16 };

/* Lines sorted by their key, the first field. */
struct line_index {
	const char **lines;
	size_t count;
};

/* Rows of a file that may have been written by several versions of the program. */
struct old_rows {
	struct text rows;    /* whole lines with today's columns, of no head */
	struct text foreign; /* all other lines, heads included */
};

struct record {
	char folder[3000];
	int lock, counts, times;   /* open files, -1 if not */
	struct old_rows old;       /* what was found; a key has one row */
	struct line_index good;    /* its rows of status ok */
	struct text keys;          /* of all rows of this run in plan order, a line each */
	size_t kept, added, failed; /* rows */
};

/* Add the rows of counts.csv or its like; torn lines and lines of another number of fields are dropped. No file: nothing is added. 0,
 * or -1 and *e. */
int old_rows_read(struct old_rows *old, const char *path, struct err *e);
void old_rows_free(struct old_rows *old);

/* The rows with a key, or only those of status ok, sorted by key; lines are borrowed, the array is the caller's. 0, or -1 and *e
 * (memory). */
int line_index_make(struct line_index *index, const struct text *rows, bool ok_only, struct err *e);

/* The line with this key (its first 16 characters), or NULL. */
const char *line_index_find(const struct line_index *index, const char *key);

/* The next line of a text, or NULL at its end. */
const char *line_next(const char *line);

/* Whether the row (a whole line) says that it could be done. */
bool line_is_ok(const char *line);

/* Make and lock the folder and read what is there. fresh: what is there is removed. 0, or -1 and *e: STATUS_BUSY when another run holds
 * the lock. Close it in any case. */
int record_open(struct record *r, const char *folder, bool fresh, struct err *e);

/* The line with this key (16 digits) and status ok among the old ones, or NULL. */
const char *record_find(const struct record *r, const char *key);

/* The next row in plan order, written at once: one found, or a new one. line: with its newline. 0, or -1 and *e: disk, or the folder is
 * no longer the one that was opened. */
int record_keep(struct record *r, const char *line, struct err *e);
int record_add(struct record *r, const char *line, bool failed, struct err *e);

/* A line for times.csv. */
int record_time(struct record *r, const char *line, struct err *e);

/* All rows are there: counts.old.csv keeps only what belongs to no combination of the job. 0, or -1 and *e. */
int record_finish(struct record *r, struct err *e);

void record_close(struct record *r);

#endif
