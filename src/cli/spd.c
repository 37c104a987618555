/* raycost spd FAMILY */
#include "cli/cli.h"
#include "io/format.h"
#include "io/nff.h"
#include "io/spd_pov.h"
#include "spd/notes.h"
#include "spd/spd.h"

#include <stdio.h>
#include <string.h>

static const char help[] =
	"usage: raycost spd FAMILY [-s SIZE] [-c | -t [R]] [-r FORMAT] [--soup] [-o FILE[.gz]] [options]\n\n"
	"Print a scene as NFF, byte for byte as the original SPD programs do. 'raycost spd' lists the families.\n\n"
	"  -s SIZE             size; each family has its own default\n"
	"  -c                  spheres and cones as such (the default)\n"
	"  -t [R]              spheres and cones as triangles, at resolution R (3)\n"
	"  -r FORMAT           nff (the default), or pov1, pov2, pov3: POV-Ray scenes as the programs' -r 2, 3, 4; sombrero's refer to\n"
	"                      an image hf000.tga, written into the folder of FILE, or the current one\n"
	"  --soup              everything as triangles of the form 'p 3'\n"
	"  -o FILE             into a file, gzipped if it ends in .gz; default stdout\n"
	"  --variant pre2021   balls: as programs before 2021 placed them\n"
	"  -n COUNT --cube SIDE --seed S        soup: how many triangles, where, which\n"
	"  --seed S --camera exterior|interior  city, town, wall: which, and where the camera stands\n"
	"  --seed S            theater, lab, room, forest, conference: which\n"
	"  --plan lower|mid    city: irregular quarters, or a regular grid with taller buildings\n"
	"  -e X -a X -b X -g X                  shells: exponent, alpha, beta, gamma\n";

struct arguments {
	const struct spd_family *family;
	struct spd_options options;
	bool soup;
	int pov; /* version of POV-Ray; 0: NFF */
	const char *path;
};

/* Options that set a key to the word that follows. */
static const struct {
	const char *option, *key;
} settings[] = {
	{ "-s", "size" },   { "--variant", "variant" }, { "-n", "count" }, { "--cube", "cube" }, { "--seed", "seed" },
	{ "-e", "exponent" }, { "-a", "alpha" },        { "-b", "beta" },  { "-g", "gamma" },
	{ "--plan", "plan" }, { "--camera", "camera" },
};

static bool has_option(const struct spd_family *f, const char *key)
{
	if (strcmp(key, "size") == 0)
		return f->default_size != 0;
	for (const char *const *option = f->options; *option; option++)
		if (strcmp(*option, key) == 0)
			return true;
	return false;
}

static int set_option(struct arguments *a, const char *option, const char *key, const char *value, struct err *e)
{
	if (!value)
		return cli_usage(e, "spd", "%s needs a value", option);
	/* Sizes of families without one are taken and ignored, as by the original programs. */
	if (!has_option(a->family, key) && strcmp(key, "size") != 0)
		return cli_usage(e, "spd", "%s has no %s", a->family->name, option);
	if (!cli_set_key(key_find(spd_keys, key), value, &a->options) || (strcmp(key, "size") == 0 && a->options.size < 0))
		return cli_usage(e, "spd", "%s %s: not a value it can have", option, value);
	return 0;
}

/* Which POV-Ray a format is for; 0: NFF; -1: unknown. The numbers are the original programs'. */
static int find_pov(const char *format)
{
	static const struct {
		const char *name;
		int version;
	} known[] = { { "nff", 0 },  { "1", 0 }, { "pov1", 1 }, { "2", 1 }, { "pov2", 2 },
		        { "3", 2 },    { "pov3", 3 }, { "pov", 3 }, { "4", 3 } };
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (strcmp(known[i].name, format) == 0)
			return known[i].version;
	return -1;
}

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 1; i < count; i++) {
		const char *word = words[i], *next = i + 1 < count ? words[i + 1] : NULL, *key = NULL;
		long long n;
		for (size_t k = 0; k < sizeof settings / sizeof *settings; k++)
			if (strcmp(settings[k].option, word) == 0)
				key = settings[k].key;
		if (key) {
			int status = set_option(a, word, key, next, e);
			if (status != 0)
				return status;
			i++;
		} else if (strcmp(word, "-c") == 0) {
			a->options.tessellate = false;
		} else if (strcmp(word, "-t") == 0) {
			a->options.tessellate = true;
			if (next && *next != '-') {
				if (!cli_integer(next, 1, 1000, &n))
					return cli_usage(e, "spd", "-t %s: not a resolution", next);
				a->options.resolution = n;
				i++;
			}
		} else if (strcmp(word, "-r") == 0 && next) {
			if ((a->pov = find_pov(next)) < 0)
				return cli_usage(e, "spd", "-r %s: no such format; known are nff, pov (pov3), pov1, pov2, pov3", next);
			i++;
		} else if (strcmp(word, "--soup") == 0) {
			a->soup = true;
		} else if (strcmp(word, "-o") == 0 && next) {
			a->path = next;
			i++;
		} else {
			return cli_usage(e, "spd", "'%s' is not understood", word);
		}
	}
	return 0;
}

/* The image of a height field, beside the scene's file. */
static int write_image(const struct arguments *a, const struct scene *s, struct err *e)
{
	char path[4096];
	struct text image = { 0 };
	const char *slash = a->path ? strrchr(a->path, '/') : NULL;
	spd_pov_image(s, &image);
	int status = 0, n = snprintf(path, sizeof path, "%.*s%s", slash ? (int)(slash + 1 - a->path) : 0, a->path ? a->path : "",
	                             spd_pov_image_name);
	if (image.lost)
		status = err_memory(e, path);
	else if (image.size)
		status = n < (int)sizeof path ? text_write_file(&image, path, e) : err_at(e, STATUS_ENVIRONMENT, a->path, 0, "path too long");
	text_free(&image);
	return status;
}

static int generate(const struct arguments *a, struct text *out, struct err *e)
{
	struct spd_notes notes = { 0 };
	struct scene made = { .notes = a->pov && !a->soup ? &notes : NULL }, soup = { 0 };
	int status = spd_generate(&made, a->family, &a->options, e);
	if (status == 0 && a->soup)
		status = spd_soup(&soup, &made, (int)a->options.resolution, e);
	const struct scene *s = a->soup ? &soup : &made;
	if (status == 0)
		status = a->pov ? spd_pov_write(s, a->pov, out, e) : nff_write(s, DIGITS_SPD, out, e);
	if (status == 0 && a->pov)
		status = write_image(a, s, e);
	scene_free(&made);
	scene_free(&soup);
	spd_notes_free(&notes);
	return status;
}

static void list_families(struct text *out)
{
	for (const struct spd_family *const *f = spd_families; *f; f++) {
		text_print(out, "%-10s%s", (*f)->name, (*f)->text);
		if ((*f)->default_size)
			text_print(out, "; size %d..%d, default %d", (*f)->least_size, (*f)->most_size, (*f)->default_size);
		text_print(out, "\n");
	}
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { 0 };
	struct text scene = { 0 };
	if (count == 0) {
		list_families(&cli->out);
		return STATUS_DONE;
	}
	a.family = spd_find(words[0]);
	if (!a.family)
		return cli_usage(e, "spd", "no family '%s'", words[0]);
	key_defaults(spd_keys, &a.options);
	int status = parse(&a, count, words, e);
	if (status != 0)
		return status;
	if (generate(&a, a.path ? &scene : &cli->out, e) != 0)
		text_free(&cli->out);
	else if (a.path)
		text_write_file(&scene, a.path, e);
	text_free(&scene);
	return e->code;
}

const struct cli_command cli_spd = { "spd", "print an SPD scene, a sphere or a random soup", help, run };
