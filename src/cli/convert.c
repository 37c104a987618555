/* raycost convert IN OUT */
#include "batch/load.h"
#include "cli/reading.h"

#include <stdio.h>
#include <string.h>

static const char help[] =
	"usage: raycost convert IN OUT [options]\n\n"
	"Read a scene and write it in the format of OUT's ending; each also .gz. What is written is read back as the same scene, as far\n"
	"as its format holds it:\n\n"
	"  .nff         everything but names\n"
	"  .pov         everything; polygons and patches as mesh2 (POV-Ray 3.7)\n"
	"  .obj         triangles with normals; materials go into a .mtl beside it\n"
	"  .ply         triangles with normals\n\n"
	"  --digits N              significant digits of a number (17: the fewest that read back as the same)\n" READING_HELP;

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct reading reading = { 0 };
	struct scene s = { 0 };
	struct read_summary summary;
	const char *paths[2] = { NULL, NULL };
	long long digits = DIGITS_EXACT;
	int n = 0, status = 0;
	for (int i = 0; i < count; i++) {
		if (reading_parse(&reading, "convert", count, words, &i, &status, e)) {
			if (status != 0)
				return status;
		} else if (strcmp(words[i], "--digits") == 0 && i + 1 < count && cli_integer(words[i + 1], 1, 17, &digits)) {
			i++;
		} else if (*words[i] == '-' || n == 2) {
			return cli_usage(e, "convert", "'%s' is not understood, or has no value it can have", words[i]);
		} else {
			paths[n++] = words[i];
		}
	}
	if (n < 2)
		return cli_usage(e, "convert", "IN and OUT are needed");
	const struct write_options options = { .digits = (int)digits, .resolution = reading_resolution(&reading) };
	const struct format *f = format_of_path(paths[1]);
	if (f && f->write) {
		if (load_file(&s, paths[0], &reading.options, &summary, e) == 0 && format_write(&s, paths[1], &options, e) == 0)
			reading_print(&cli->out, &summary);
	} else {
		format_write(&s, paths[1], &options, e);
	}
	scene_free(&s);
	return e->code;
}

const struct cli_command cli_convert = { "convert", "read a scene in one format, write it in another", help, run };
