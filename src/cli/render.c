/* raycost render SCENE */
#include "base/par.h"
#include "base/progress.h"
#include "batch/load.h"
#include "cli/reading.h"
#include "cost/stop.h"
#include "io/png.h"
#include "trace/render.h"

#include <inttypes.h>
#include <string.h>

static const char help[] =
	"usage: raycost render SCENE -o IMAGE.png [options]\n\n"
	"Render a scene and print what its rays cost, by class.\n\n"
	"  -o IMAGE.png            where the image goes; without it only the costs are printed\n"
	"  --preset spd            the procedure of the SPD scenes: rays through pixel corners, depth 5\n"
	"  --width N --height N    pixels (512 x 512)\n"
	"  --sampling corners      primary rays through pixel corners instead of centers\n"
	"  --ray_depth N           of the tree of rays; a primary ray has 1 (5)\n"
	"  --shadows facing        shadow rays only to lights that the surface faces, not to all\n"
	"  --light inside|outside  lights moved inside, or outside, the box of the primitives\n"
	"  --flight 'X Y Z to X Y Z, ...' --frames N   a camera flight; the image is its first frame\n"
	"  --weight X              rays that could add less than this share to a pixel are not shot (0)\n"
	"  --structure NAME        octree, list, kd, bsp, grid, bvh or bvh8; its options follow, e.g. --max_objects 5 --root box\n"
	"  --threads N             threads (default: all processors); the results do not depend on it\n" READING_HELP;

struct arguments {
	const char *scene, *image;
	struct reading reading;
	struct render_options render;
	const struct accel_ops *ops;
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	int threads;
};

/* --NAME VALUE for an option of the image or of the structure. */
static bool set_option(struct arguments *a, const char *name, const char *value)
{
	const struct key *k = key_find(render_keys, name);
	if (k)
		return cli_set_key(k, value, &a->render);
	k = key_find(a->ops->keys, name);
	return k && cli_set_key(k, value, a->options);
}

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 0; i < count; i++) {
		const char *word = words[i], *value = i + 1 < count ? words[i + 1] : NULL;
		long long n;
		int status;
		if (reading_parse(&a->reading, "render", count, words, &i, &status, e)) {
			if (status != 0)
				return status;
			continue;
		}
		if (*word != '-' && !a->scene) {
			a->scene = word;
			continue;
		}
		if (*word != '-')
			return cli_usage(e, "render", "'%s' is not understood", word);
		if (!value)
			return cli_usage(e, "render", "%s needs a value, or is not understood", word);
		i++;
		if (strcmp(word, "-o") == 0) {
			a->image = value;
		} else if (strcmp(word, "--threads") == 0 && cli_integer(value, 1, 256, &n)) {
			a->threads = (int)n;
		} else if (strcmp(word, "--structure") == 0 && accel_find(value)) {
			a->ops = accel_find(value);
			key_defaults(a->ops->keys, a->options);
		} else if (strncmp(word, "--", 2) != 0 || !set_option(a, word + 2, value)) {
			return cli_usage(e, "render", "%s %s is not understood, or not a value it can have", word, value);
		}
	}
	return a->scene ? 0 : cli_usage(e, "render", "no scene given");
}

static void print_classes(struct text *out, const struct rendering *r)
{
	struct class_tally all = { 0 };
	text_print(out, "%-10s %12s %12s %12s %12s %12s %12s\n", "class", "rays", "missed", "hits", "leaves", "tests", "inner");
	for (int c = 0; c <= RAY_CLASSES; c++) {
		const struct class_tally *t = c < RAY_CLASSES ? &r->classes[c] : &all;
		text_print(out, "%-10s %12" PRIu64 " %12" PRIu64 " %12" PRIu64 " %12" PRIu64 " %12" PRIu64 " %12" PRIu64 "\n",
		           c < RAY_CLASSES ? ray_class_words[c] : "all", t->rays, t->missed, t->sum.hits, t->sum.leaves, t->sum.tests,
		           t->sum.inner_step + t->sum.inner_start);
		all.rays += t->rays;
		all.missed += t->missed;
		all.sum = r->actual.sum;
	}
	text_print(out, "cost a ray %.4f +- %.4f: %.4f leaves + %.4f tests\n", r->actual.cost.mean, r->actual.cost.se,
	           r->actual.leaves.mean, r->actual.tests.mean);
}

static void show(void *ctx, size_t done, size_t all)
{
	progress_show(ctx, done, all, "blocks of rays");
}

static int render(const struct arguments *a, struct cli *cli, const struct scene *s, const struct primitives *p, struct err *e)
{
	struct progress progress;
	struct accel accel;
	struct rendering image = { 0 };
	struct render_run run = { .alpha = 1, .beta = 1, .threads = a->threads, .stop = cli->stop, .progress = show, .ctx = &progress };
	if (stop_build(&accel, a->ops, a->options, p, a->threads, NULL, e) != 0)
		return -1;
	progress_open(&progress);
	int status = render_scene(&image, s, &accel, &a->render, &run, e);
	progress_close(&progress);
	if (status != 0 && *cli->stop)
		e->code = 128 + *cli->stop;
	if (status == 0)
		print_classes(&cli->out, &image);
	if (status == 0 && a->image)
		status = png_write_rgb(a->image, image.pixels, (int)a->render.width, (int)a->render.height, e);
	rendering_free(&image);
	accel_free(&accel);
	return status;
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { .ops = accel_find("octree"), .threads = par_processors() };
	struct scene scene = { 0 };
	struct primitives primitives = { 0 };
	struct read_summary summary;
	key_defaults(render_keys, &a.render);
	key_defaults(a.ops->keys, a.options);
	int status = parse(&a, count, words, e);
	if (status != 0)
		return status;
	render_resolve(&a.render);
	reading_set_image(&a.reading, a.render.width, a.render.height);
	if (load_file(&scene, a.scene, &a.reading.options, &summary, e) == 0 &&
	    primitives_make(&primitives, &scene, CURVES_KEEP, reading_resolution(&a.reading), a.scene, e) == 0)
		render(&a, cli, &scene, &primitives, e);
	primitives_free(&primitives);
	scene_free(&scene);
	return e->code;
}

const struct cli_command cli_render = { "render", "render a scene, and count what its rays cost", help, run };
