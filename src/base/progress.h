/* How far a run is, on stderr: one repainted line on a terminal, elsewhere a plain line at most every 30 seconds. */
#ifndef BASE_PROGRESS_H
#define BASE_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct progress {
	bool terminal;
	double start, last; /* monotonic seconds */
};

/* Seconds of a clock that never jumps. */
double clock_seconds(void);

void progress_open(struct progress *p);

/* 'done' of 'all' steps, and what is being done. */
void progress_show(struct progress *p, size_t done, size_t all, const char *what);

/* Wipe the line. */
void progress_close(struct progress *p);

#endif
