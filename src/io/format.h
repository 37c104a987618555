/* Formats of scene files: one table, one row a format. What reads or writes scenes asks here. */
#ifndef IO_FORMAT_H
#define IO_FORMAT_H

#include "io/read.h"
#include "io/text.h"
#include "scene/scene.h"

/* What every writer can be told. */
struct write_options {
	int digits;            /* significant ones a number; 17: the fewest that read back as the same double */
	int resolution;        /* R of curves, where the format has triangles only */
	const char *companion; /* name of the second file, for formats with two; NULL: there is none */
};

enum { DIGITS_SPD = 6, DIGITS_EXACT = 17 };

/* One format. Functions that a format lacks are NULL. */
struct format {
	const char *name, *endings; /* endings without dot, blanks between */

	/* Fill an empty scene from n bytes of text[n + 1], the last of them NUL. name: the file's path, for messages and to find the
	 * files it names. 0, or -1 and *e with "name:line: message". */
	int (*read)(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
	            struct read_summary *summary, struct err *e);

	/* Append the scene to *out. 0, or -1 and *e (memory). */
	int (*write)(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);

	/* The second file and its ending; its name is the first one's with this ending. */
	int (*write_companion)(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);
	const char *companion_ending;

	/* Whether n bytes look like the format: for files whose ending says nothing. */
	bool (*is)(const char *text, size_t n);
};

extern const struct format formats[]; /* ends with a NULL name */

/* The row whose endings hold that of a path (in any case; a .gz behind it does not count), or NULL. */
const struct format *format_of_path(const char *path);

/* Read n bytes of a scene file in the format of its ending, or else of its content; as the row's 'read'. A format that cannot be
 * told or read is STATUS_INPUT with the known endings. */
int format_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                struct read_summary *summary, struct err *e);

/* Write a scene to a path in the format of its ending, its second file beside it. 0, or -1 and *e: no such writer
 * (STATUS_INPUT), memory, I/O. */
int format_write(const struct scene *s, const char *path, const struct write_options *o, struct err *e);

/* The endings that can be read, or written, blanks between, into out[size]. */
void format_list(bool writable, char *out, size_t size);

#endif
