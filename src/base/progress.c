#include "base/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double clock_seconds(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_open(struct progress *p)
{
	*p = (struct progress){ .terminal = isatty(STDERR_FILENO) == 1, .start = clock_seconds() };
	p->last = p->start;
}

void progress_show(struct progress *p, size_t done, size_t all, const char *what)
{
	double now = clock_seconds();
	if (now - p->last < (p->terminal ? 0.1 : 30))
		return;
	p->last = now;
	if (p->terminal)
		fprintf(stderr, "\r\033[K%zu/%zu  %.0f s  %.80s", done, all, now - p->start, what);
	else
		fprintf(stderr, "%zu/%zu rows, %.0f s, at %s\n", done, all, now - p->start, what);
}

void progress_close(struct progress *p)
{
	if (p->terminal)
		fputs("\r\033[K", stderr);
}
