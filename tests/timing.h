/* What the benches share: the clock, and what rounds come to. */
#ifndef TESTS_TIMING_H
#define TESTS_TIMING_H

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS_MOST = 99 };

/* Of this thread's own work. */
static inline double seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int compare_seconds(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* n at most ROUNDS_MOST. */
static inline double median(const double *values, int n)
{
	double sorted[ROUNDS_MOST];
	memcpy(sorted, values, (size_t)n * sizeof *sorted);
	qsort(sorted, (size_t)n, sizeof *sorted, compare_seconds);
	return sorted[n / 2];
}

#endif
