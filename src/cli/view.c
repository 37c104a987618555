/* raycost view SCENE */
#include "base/par.h"
#include "batch/load.h"
#include "cli/reading.h"
#include "io/png.h"
#include "trace/camera.h"
#include "trace/render.h"

#include <string.h>

static const char help[] =
	"usage: raycost view SCENE -o IMAGE.png [options]\n\n"
	"See what was read: every triangle flat, lit from the eye, in the colour of its material; nothing mirrors, shines or lets\n"
	"light through. The scene's own view, or else all of it.\n\n"
	"  -o IMAGE.png            where the image goes\n"
	"  --width N --height N    pixels (512 x 512)\n" READING_HELP;

struct arguments {
	const char *scene, *image;
	struct reading reading;
	struct render_options render;
};

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 0; i < count; i++) {
		const char *word = words[i], *value = i + 1 < count ? words[i + 1] : NULL;
		const struct key *k = strcmp(word, "--width") == 0 || strcmp(word, "--height") == 0 ? key_find(render_keys, word + 2) : NULL;
		int status;
		if (reading_parse(&a->reading, "view", count, words, &i, &status, e)) {
			if (status != 0)
				return status;
		} else if (strcmp(word, "-o") == 0 && value) {
			a->image = value;
			i++;
		} else if (k && value && cli_set_key(k, value, &a->render)) {
			i++;
		} else if (*word == '-' || a->scene) {
			return cli_usage(e, "view", "'%s' is not understood, or has no value it can have", word);
		} else {
			a->scene = word;
		}
	}
	if (!a->scene || !a->image)
		return cli_usage(e, "view", a->scene ? "-o IMAGE.png is needed" : "no scene given");
	return 0;
}

/* The scene's colours under one light at the eye, over white. */
static void set_flat(struct scene *flat, const struct scene *s, const struct primitives *p, const struct render_options *o)
{
	struct camera eye = camera_make(&s->view, &p->bounds, (double)o->width, (double)o->height);
	flat->view = s->view;
	scene_set_background(flat, 1, 1, 1);
	scene_add_colored_light(flat, eye.from, (struct color){ 0.75, 0.75, 0.75 });
	for (size_t i = 0; i < s->material_count; i++)
		scene_add_material(flat, (struct material){ .color = s->materials[i].color, .kd = 1, .shine = 1, .ior = 1 });
}

static int draw(const struct arguments *a, struct cli *cli, const struct scene *flat, const struct primitives *p, struct err *e)
{
	const struct accel_ops *ops = accel_find("octree");
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	struct accel accel;
	struct rendering image = { 0 };
	const struct render_run run = { .alpha = 1, .beta = 1, .threads = par_processors(), .stop = cli->stop };
	key_defaults(ops->keys, options);
	if (accel_build(&accel, ops, options, p, e) != 0)
		return -1;
	int status = render_scene(&image, flat, &accel, &a->render, &run, e);
	if (status != 0 && *cli->stop)
		e->code = 128 + *cli->stop;
	if (status == 0)
		status = png_write_rgb(a->image, image.pixels, (int)a->render.width, (int)a->render.height, e);
	rendering_free(&image);
	accel_free(&accel);
	return status;
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { 0 };
	struct scene scene = { 0 }, flat = { 0 };
	struct primitives primitives = { 0 };
	struct read_summary summary;
	key_defaults(render_keys, &a.render);
	int status = parse(&a, count, words, e);
	if (status != 0)
		return status;
	reading_set_image(&a.reading, a.render.width, a.render.height);
	if (load_file(&scene, a.scene, &a.reading.options, &summary, e) == 0 &&
	    primitives_make(&primitives, &scene, CURVES_KEEP, reading_resolution(&a.reading), a.scene, e) == 0) {
		primitives.normals = NULL;
		set_flat(&flat, &scene, &primitives, &a.render);
		if (scene_complete(&flat, a.scene, e) == 0)
			draw(&a, cli, &flat, &primitives, e);
	}
	scene_free(&flat);
	primitives_free(&primitives);
	scene_free(&scene);
	return e->code;
}

const struct cli_command cli_view = { "view", "see what is in a scene file: flat shaded, lit from the eye", help, run };
