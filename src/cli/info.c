/* raycost info SCENE */
#include "batch/load.h"
#include "cli/reading.h"
#include "scene/duplicates.h"

#include <stdlib.h>
#include <string.h>

static const char help[] = "usage: raycost info SCENE [options]\n\nTell what is in a scene.\n\n" READING_HELP;

/* How many materials have objects, and whether objects have none. */
static size_t count_used(const struct scene *s, bool *without)
{
	size_t used = 0;
	bool *seen = calloc(s->material_count + 1, sizeof *seen);
	*without = false;
	for (size_t i = 0; seen && i < s->object_count; i++) {
		uint32_t m = s->objects[i].material;
		*without |= m == NO_MATERIAL;
		used += m != NO_MATERIAL && !seen[m];
		if (m != NO_MATERIAL)
			seen[m] = true;
	}
	free(seen);
	return used;
}

static void print_scene(struct text *out, const char *path, const struct scene *s, const struct read_summary *summary)
{
	static const char *const kinds[] = { "spheres", "cones", "polygons", "patches" };
	size_t count[4] = { 0 };
	bool without;
	for (size_t i = 0; i < s->object_count; i++)
		count[s->objects[i].kind]++;
	text_print(out, "%s\n", path);
	for (int i = 0; i < 4; i++)
		text_print(out, "  %-12s%zu\n", kinds[i], count[i]);
	size_t used = count_used(s, &without);
	text_print(out, "  %-12s%zu, of which %zu used%s\n  %-12s%zu\n", "materials", s->material_count, used,
	           without ? "; some objects have none" : "", "lights", s->light_count);
	if (s->view.given)
		text_print(out, "  %-12sfrom (%g, %g, %g) to (%g, %g, %g), %g degrees, %d x %d\n", "view", s->view.from.x, s->view.from.y,
		           s->view.from.z, s->view.at.x, s->view.at.y, s->view.at.z, s->view.angle, s->view.width, s->view.height);
	else
		text_print(out, "  %-12snone\n", "view");
	reading_print(out, summary);
}

/* What can be told of one kind, or of all: its number, area and bounds. */
static void print_kind(struct text *out, const char *name, const struct primitives *p, bool triangles, bool spheres)
{
	struct box b = box_empty();
	double area = 0;
	uint32_t count = 0;
	for (uint32_t i = 0; i < p->count; i++) {
		const struct primitive *q = &p->all[i];
		if (q->kind == PRIMITIVE_TRIANGLE ? !triangles : !spheres)
			continue;
		struct box own = primitive_bounds(q);
		box_join(&b, &own);
		area += primitive_area(q);
		count++;
	}
	text_print(out, "  %-12s%u, area %g", name, count, area);
	if (count)
		text_print(out, ", in (%g, %g, %g) to (%g, %g, %g)", b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z);
	text_print(out, "\n");
}

static void print_primitives(struct text *out, const struct primitives *p)
{
	size_t duplicates = primitives_duplicates(p);
	text_print(out, "  %-12s%u: %u triangles, %u spheres\n", "primitives", p->count, p->triangles, p->spheres);
	if (p->spheres && p->triangles) {
		print_kind(out, "  triangles", p, true, false);
		print_kind(out, "  spheres", p, false, true);
	}
	print_kind(out, "  all", p, true, true);
	text_print(out, "  %-12s%g\n  %-12s%u without area, left out\n", "box area", box_area(&p->bounds), "degenerate", p->skipped);
	if (duplicates != SIZE_MAX)
		text_print(out, "  %-12s%zu equal to another one\n", "duplicates", duplicates);
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
		if (primitives_make(&p, &s, CURVES_KEEP, reading_resolution(&reading), path, e) == 0)
			print_primitives(&cli->out, &p);
	}
	scene_free(&s);
	primitives_free(&p);
	return e->code;
}

const struct cli_command cli_info = { "info", "tell what is in a scene file", help, run };
