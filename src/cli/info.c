/* raycost info SCENE */
#include "batch/load.h"
#include "cli/reading.h"
#include "scene/tessellate.h"

#include <string.h>

static const char help[] = "usage: raycost info SCENE [options]\n\nTell what is in a scene.\n\n" READING_HELP;

static void print_scene(struct text *out, const char *path, const struct scene *s, const struct read_summary *summary)
{
	static const char *const kinds[] = { "spheres", "cones", "polygons", "patches" };
	size_t count[4] = { 0 };
	for (size_t i = 0; i < s->object_count; i++)
		count[s->objects[i].kind]++;
	text_print(out, "%s\n", path);
	for (int i = 0; i < 4; i++)
		text_print(out, "  %-12s%zu\n", kinds[i], count[i]);
	text_print(out, "  %-12s%zu\n  %-12s%zu\n", "materials", s->material_count, "lights", s->light_count);
	if (s->view.given)
		text_print(out, "  %-12sfrom (%g, %g, %g) to (%g, %g, %g), %g degrees, %d x %d\n", "view", s->view.from.x, s->view.from.y,
		           s->view.from.z, s->view.at.x, s->view.at.y, s->view.at.z, s->view.angle, s->view.width, s->view.height);
	reading_print(out, summary);
}

static void print_primitives(struct text *out, const struct primitives *p)
{
	const struct box *b = &p->bounds;
	text_print(out, "  %-12s%u: %u triangles, %u spheres\n", "primitives", p->count, p->triangles, p->spheres);
	if (p->skipped)
		text_print(out, "  %-12s%u without area, left out\n", "degenerate", p->skipped);
	text_print(out, "  %-12s(%g, %g, %g) to (%g, %g, %g)\n  %-12s%g\n  %-12s%g\n", "bounds", b->lo.x, b->lo.y, b->lo.z, b->hi.x,
	           b->hi.y, b->hi.z, "box area", box_area(b), "area", p->area);
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	const char *path = NULL;
	struct reading reading = { 0 };
	for (int i = 0, status; i < count; i++) {
		if (reading_parse(&reading, "info", count, words, &i, &status, e)) {
			if (status != 0)
				return status;
		} else if (*words[i] == '-' || path) {
			return cli_usage(e, "info", "'%s' is not understood", words[i]);
		} else {
			path = words[i];
		}
	}
	if (!path)
		return cli_usage(e, "info", "no scene given");
	struct scene s = { 0 };
	struct primitives p = { 0 };
	struct read_summary summary;
	if (load_file(&s, path, &reading.options, &summary, e) == 0) {
		print_scene(&cli->out, path, &s, &summary);
		if (primitives_make(&p, &s, CURVES_KEEP, SPD_RESOLUTION, path, e) == 0)
			print_primitives(&cli->out, &p);
	}
	scene_free(&s);
	primitives_free(&p);
	return e->code;
}

const struct cli_command cli_info = { "info", "tell what is in a scene file", help, run };
