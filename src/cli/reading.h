/* The options of reading on the command line, the same for every subcommand that reads scenes. */
#ifndef CLI_READING_H
#define CLI_READING_H

#include "cli/cli.h"
#include "io/read.h"

#define READING_HELP \
	"  --strict                refuse what a tolerant reader skips and counts\n" \
	"  -L DIR                  a folder of files that the scene names; may be repeated\n" \
	"  --resolution R          of curves that become triangles: 4 R sides a turn (3; POV-Ray 8)\n" \
	"  --planes clip|skip      surfaces without end: cut to the region of the scene (the default), or left out\n"

/* The options, and room for the folders of -L. Zero-initialise. */
struct reading {
	struct read_options options;
	char folders[4096];
};

/* Whether words[*i] is an option of reading. Takes its value too, moving *i on; *status is 0, or the fault's with *e filled. */
bool reading_parse(struct reading *r, const char *command, int count, char **words, int *i, int *status, struct err *e);

/* The image that will be made of the scene, for scenes that ask: in pixels. */
void reading_set_image(struct reading *r, int64_t width, int64_t height);

/* R of curves that become triangles: what was asked for, or 3. */
int reading_resolution(const struct reading *r);

/* One line on what was skipped, or nothing. */
void reading_print(struct text *out, const struct read_summary *s);

#endif
