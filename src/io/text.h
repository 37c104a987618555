/* Growing text in memory, whole files in and out, plain or gzipped. */
#ifndef IO_TEXT_H
#define IO_TEXT_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise to open; text_free closes. bytes[size] is always NUL once something was added. 'lost': memory ran out, and
 * nothing more is added. */
struct text {
	char *bytes;
	size_t size, room;
	bool lost;
};

__attribute__((format(printf, 2, 3)))
void text_print(struct text *t, const char *fmt, ...);
void text_add(struct text *t, const char *bytes, size_t n);
void text_free(struct text *t);

/* Read a whole file, gunzipped if it is gzipped, at most 'limit' bytes of content. 0, or -1 and *e: cannot open (STATUS_INPUT),
 * truncated or damaged gzip, larger than limit, beyond 64 MiB and a hundred times the packed size, not a regular file. */
int text_read_file(struct text *t, const char *path, size_t limit, struct err *e);

/* Write a file whole or not at all: beside it, fsync, rename. A path that ends in .gz is gzipped, with no name or time inside
 * so that equal content gives equal bytes. 0, or -1 and *e (STATUS_ENVIRONMENT). */
int text_write_file(const struct text *t, const char *path, struct err *e);

#endif
