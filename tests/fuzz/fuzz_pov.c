/* POV-Ray scenes: within small budgets, whatever the program does, either a reason or a scene whose surfaces hit as they should. Behind a
 * zero byte stands the file part.inc, the only one there is. The first byte chooses strictness. */
#include "tests/fuzz/fuzz.h"

#include "io/pov.h"

#include <math.h>
#include <string.h>

enum { TOKENS = 20000, ROUNDS = 2000, OBJECTS = 60, BYTES = 1 << 26, DEPTH = 12, TRIANGLES = 20000, RESOLUTION = 4 };

struct part {
	const char *bytes;
	size_t n;
};

static int load_part(void *context, const char *path, struct text *t)
{
	const struct part *part = context;
	if (!part->bytes || strcmp(path, "part.inc") != 0)
		return -1;
	text_add(t, part->bytes, part->n);
	return 0;
}

static bool match_none(void *context, const char *folder, const char *name, char *out, size_t size)
{
	(void)context, (void)folder, (void)name, (void)out, (void)size;
	return false;
}

/* What pov.h promises of a scene: numbers, triangles and spheres. */
static void check_scene(const struct scene *s)
{
	for (size_t i = 0; i < s->point_count; i++)
		MUST(vec_is_finite(s->points[i]));
	for (size_t i = 0; i < s->object_count; i++)
		MUST(s->objects[i].material == NO_MATERIAL || s->objects[i].material < s->material_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct scene s = { 0 };
	struct pov_summary summary;
	struct text line = { 0 };
	struct err e = { 0 };
	const char *bytes = n > 0 ? (const char *)data : "";
	bool strict = n > 0 && bytes[0] == '!';
	bytes += strict;
	n -= strict;
	const char *zero = memchr(bytes, '\0', n);
	struct part part = { zero ? zero + 1 : NULL, zero ? (size_t)(bytes + n - zero) - 1 : 0 };
	struct pov_options o = pov_defaults();
	o.strict = strict;
	o.directory_count = 0;
	o.access = (struct pov_access){ load_part, match_none, &part };
	o.budget = (struct pov_budget){ .tokens = TOKENS, .rounds = ROUNDS, .objects = OBJECTS, .bytes = BYTES, .depth = DEPTH };
	o.mesh.most_triangles = TRIANGLES;
	o.mesh.resolution = RESOLUTION;
	if (pov_read(&s, "fuzz.pov", bytes, zero ? (size_t)(zero - bytes) : n, &o, &summary, &e) == 0) {
		pov_summary_print(&summary, &line);
		MUST(line.size > 0 && !strchr(line.bytes, '\n'));
		check_scene(&s);
		fuzz_scene(&s);
	} else {
		MUST(e.code == STATUS_INPUT || e.code == STATUS_ENVIRONMENT);
		MUST(*e.text && !strchr(e.text, '\n'));
	}
	text_free(&line);
	scene_free(&s);
	return 0;
}
