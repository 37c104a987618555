/* What every reader of scene files can be told, and what it tells back. */
#ifndef IO_READ_H
#define IO_READ_H

#include "base/key.h"

#include <stdbool.h>
#include <stdint.h>

/* What becomes of surfaces without end: cut to the region of the scene, or left out. */
enum read_planes { PLANES_CLIP, PLANES_SKIP };

struct read_options {
	bool strict;         /* refuse what a tolerant reader skips */
	const char *include; /* folders where files named in files are looked for, after the file's own; ':' between; NULL: none */
	int64_t resolution;  /* R of curves that become triangles, 4 R sides a turn; 0: the format's own */
	int planes;          /* enum read_planes */
	int width, height;   /* of the image, for scenes that ask; no option of its own, but the command's. 0: the format's own, POV-Ray 800 x 600 */
};

/* The table of these options; ends with a NULL name. READ_KEYS: the same rows for a struct that holds them as 'field'. */
extern const struct key read_keys[];
extern const char *const read_planes_words[];

#define READ_KEYS(type, field) \
	{ "strict", KEY_BOOL, offsetof(type, field.strict), 0, 1, 0, NULL, "refuse what a tolerant reader skips" }, \
	{ "include", KEY_TEXT, offsetof(type, field.include), 0, 0, 0, NULL, \
	  "folders of files that the scene's files name, ':' between, besides their own" }, \
	{ "resolution", KEY_INT, offsetof(type, field.resolution), 0, 1000, 0, NULL, \
	  "of curves as triangles, a quarter of the sides a turn; 0: the format's own (3; POV-Ray 8)" }, \
	{ "planes", KEY_WORD, offsetof(type, field.planes), 0, 0, PLANES_CLIP, read_planes_words, \
	  "surfaces without end: cut to the region of the scene, or left out" }

/* Tallies of what a tolerant reader passed over. */
struct read_summary {
	uint32_t skipped;    /* records or objects */
	uint32_t first_line; /* of the first; 0: unknown */
	char text[400];      /* what was skipped or approximated, by kind, one line; may be empty */
};

#endif
