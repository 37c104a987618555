/* The scenes of a job: generated families and files, their options and names. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "batch/job_reader.h"

#include "scene/tessellate.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const curves_words[] = { "keep", "tessellate", NULL };

/* What a scene entry can say besides the options of its family. */
#define AT(field) offsetof(struct scene_spec, field)
static const struct key file_keys[] = {
	{ "file", KEY_TEXT, AT(path), 0, 0, 0, NULL, "a scene file of any known format, plain or gzipped, relative to the job file" },
	{ "curves", KEY_WORD, AT(curves), 0, 0, CURVES_KEEP, curves_words, "spheres as they are, or as triangles" },
	READ_KEYS(struct scene_spec, read),
	{ 0 }
};
static const struct key made_keys[] = {
	{ "soup", KEY_BOOL, AT(soup), 0, 1, 0, NULL, "everything as triangles" },
	{ "curves", KEY_WORD, AT(curves), 0, 0, CURVES_KEEP, curves_words, "spheres as they are, or as triangles" },
	{ 0 }
};
#undef AT

int64_t scene_resolution(const struct scene_spec *s)
{
	return !s->path ? s->spd.resolution : s->read.resolution ? s->read.resolution : SPD_RESOLUTION;
}

/* "family-size" and whatever differs from the defaults, or the file's name without its endings. */
static const char *name_scene(struct job_reader *r)
{
	const struct scene_spec *s = &r->scene;
	char name[512];
	size_t n;
	if (s->path) {
		const char *slash = strrchr(s->path, '/'), *base = slash ? slash + 1 : s->path;
		n = (size_t)snprintf(name, sizeof name, "%.*s", (int)(strcspn(base, ".") ? strcspn(base, ".") : strlen(base)), base);
		if (s->read.resolution && s->curves == CURVES_KEEP && n < sizeof name)
			n += (size_t)snprintf(name + n, sizeof name - n, "-resolution-%lld", (long long)s->read.resolution);
		if (s->read.planes != PLANES_CLIP && n < sizeof name)
			n += (size_t)snprintf(name + n, sizeof name - n, "-planes-%s", read_planes_words[s->read.planes]);
		for (char *p = name; *p; p++) /* a line of a table, and a file */
			if ((unsigned char)*p < 0x20 || *p == 0x7f)
				*p = '_';
	} else {
		int64_t size = s->spd.size == SPD_DEFAULT_SIZE ? s->family->default_size : s->spd.size;
		n = (size_t)snprintf(name, sizeof name, "%s", s->family->name);
		if (s->family->default_size)
			n += (size_t)snprintf(name + n, sizeof name - n, "-%lld", (long long)size);
		for (const char *const *option = s->family->options; *option; option++) {
			struct spd_options defaults;
			char value[64], usual[64];
			const struct key *k = key_find(spd_keys, *option);
			key_defaults(spd_keys, &defaults);
			key_print(k, &s->spd, value, sizeof value);
			key_print(k, &defaults, usual, sizeof usual);
			if (strcmp(value, usual) != 0 && k->type == KEY_BOOL)
				n += (size_t)snprintf(name + n, sizeof name - n, "-%s", *option);
			else if (strcmp(value, usual) != 0)
				n += (size_t)snprintf(name + n, sizeof name - n, "-%s-%s", *option, value);
		}
		n += (size_t)snprintf(name + n, sizeof name - n, "%s", s->soup ? "-soup" : "");
	}
	if (s->curves == CURVES_TESSELLATE && n < sizeof name)
		n += (size_t)snprintf(name + n, sizeof name - n, "-curves-%lld", (long long)scene_resolution(s));
	return arena_text(&r->job->mem, name, strlen(name));
}

/* Whether two scenes of one name are one: a generated scene is named after all its options. */
static bool is_same(const struct scene_spec *s, const struct scene_spec *t)
{
	return s->family == t->family && (s->family || strcmp(s->path, t->path) == 0);
}

static int emit_scene(void *ctx)
{
	struct job_reader *r = ctx;
	struct scene_spec *s = &r->scene;
	s->name = name_scene(r);
	if (!s->name)
		return err_memory(r->values.err, "job");
	for (size_t i = 0; i < r->job->scene_count; i++)
		if (strcmp(r->job->scenes[i].name, s->name) == 0 &&
		    (i >= r->experiment.scene_first || !is_same(&r->job->scenes[i], s)))
			return values_fault(&r->values, r->line, "two scenes are called '%s'", s->name);
	void *array = r->job->scenes;
	int status = job_append(r, &array, &r->job->scene_count, &r->scene_room, s, sizeof *s);
	r->job->scenes = array;
	return status;
}

/* The map without its entry 'key'; the rest is copied. */
static const struct yaml_node *without(struct job_reader *r, const struct yaml_node *map, const char *key)
{
	struct yaml_node *first = NULL, **end = &first;
	for (const struct yaml_node *e = map->first; e; e = e->next) {
		if (strcmp(e->key, key) == 0)
			continue;
		struct yaml_node *copy = NEW(&r->job->mem, struct yaml_node, 1);
		if (!copy) {
			err_memory(r->values.err, "job");
			return NULL;
		}
		*copy = *e;
		copy->next = NULL;
		*end = copy;
		end = &copy->next;
	}
	return first;
}

/* Keys of a generated scene: the family's options of spd_keys, shifted to where they lie in a scene_spec, and made_keys. */
static void list_family_keys(struct job_reader *r, const struct spd_family *f)
{
	size_t n = 0;
	for (const struct key *k = made_keys; k->name; k++)
		r->keys[n++] = *k;
	for (const struct key *k = spd_keys; k->name; k++) {
		bool takes = strcmp(k->name, "size") == 0 && f->default_size;
		for (const char *const *option = f->options; *option; option++)
			takes |= strcmp(*option, k->name) == 0;
		takes |= strcmp(k->name, "resolution") == 0;
		if (!takes)
			continue;
		r->keys[n] = *k;
		r->keys[n++].offset += offsetof(struct scene_spec, spd);
		if (strcmp(k->name, "size") == 0) {
			r->keys[n - 1].low = f->least_size;
			r->keys[n - 1].high = f->most_size;
		}
	}
	r->keys[n] = (struct key){ 0 };
}

static int read_family(struct job_reader *r, const struct yaml_node *entry, const struct yaml_node *spd)
{
	const char *word = values_text(&r->values, spd);
	const struct spd_family *f = word ? spd_find(word) : NULL;
	if (!word)
		return -1;
	if (!f) {
		char known[400] = "";
		for (const struct spd_family *const *k = spd_families; *k; k++) {
			size_t n = strlen(known);
			snprintf(known + n, sizeof known - n, "%s%s", n ? ", " : "", (*k)->name);
		}
		return values_fault(&r->values, spd->line, "no scene family '%s'; known are: %s", word, known);
	}
	r->scene = (struct scene_spec){ .family = f };
	key_defaults(spd_keys, &r->scene.spd);
	list_family_keys(r, f);
	return values_sweep(&r->values, f->name, without(r, entry, "spd"), r->keys, NULL, &r->scene, emit_scene, r);
}

/* Whether a path, taken from the job file's folder, leads out of it. */
static bool leads_out(const char *path)
{
	int depth = 0;
	if (*path == '/')
		return true;
	for (const char *p = path; *p; p += strcspn(p, "/"), p += *p == '/') {
		size_t n = strcspn(p, "/");
		if (n == 2 && p[0] == '.' && p[1] == '.')
			depth--;
		else if (n > 0 && !(n == 1 && p[0] == '.'))
			depth++;
		if (depth < 0)
			return true;
	}
	return false;
}

/* Whether a file that is there lies in a folder, symbolic links followed; false, too, where that cannot be told. */
static bool is_inside(const char *folder, const char *path)
{
	char *outer = realpath(*folder ? folder : ".", NULL), *inner = realpath(path, NULL);
	size_t n = outer ? strlen(outer) : 0;
	bool inside = outer && inner && strncmp(outer, inner, n) == 0 && (inner[n] == '/' || n == 1);
	free(outer);
	free(inner);
	return inside;
}

/* The folders of a list, those that are relative taken from the job file's; NULL after a fault. */
static const char *place_folders(struct job_reader *r, const char *list)
{
	char out[4096];
	size_t n = 0;
	*out = '\0';
	for (const char *p = list; *p; p += strcspn(p, ":"), p += *p == ':') {
		char folder[2048];
		snprintf(folder, sizeof folder, "%.*s", (int)strcspn(p, ":"), p);
		if (!r->options->allow_outside && leads_out(folder)) {
			values_fault(&r->values, r->line, "%s lies outside the job file's folder; --allow-outside lets it", folder);
			return NULL;
		}
		size_t before = n + (n > 0);
		if (n < sizeof out)
			n += (size_t)snprintf(out + n, sizeof out - n, "%s%s%s", n ? ":" : "", *folder == '/' ? "" : r->folder, folder);
		if (!r->options->allow_outside && n < sizeof out && access(out + before, F_OK) == 0 && !is_inside(r->folder, out + before)) {
			values_fault(&r->values, r->line, "%s is a link out of the job file's folder; --allow-outside lets it", folder);
			return NULL;
		}
	}
	const char *kept = arena_text(&r->job->mem, out, strlen(out));
	if (!kept)
		err_memory(r->values.err, "job");
	return kept;
}

static int emit_file(void *ctx)
{
	struct job_reader *r = ctx;
	const char *given = r->scene.path, *folders = r->scene.read.include;
	char path[4096];
	if (folders && !(r->scene.read.include = place_folders(r, folders)))
		return -1;
	if (!r->options->allow_outside && leads_out(given))
		return values_fault(&r->values, r->line, "%s lies outside the job file's folder; --allow-outside lets it", given);
	snprintf(path, sizeof path, "%s%s", *given == '/' ? "" : r->folder, given);
	if (access(path, R_OK) != 0)
		return values_fault(&r->values, r->line, "%s: %s", path, strerror(errno));
	if (!r->options->allow_outside && !is_inside(r->folder, path))
		return values_fault(&r->values, r->line, "%s is a link out of the job file's folder; --allow-outside lets it", given);
	r->scene.path = arena_text(&r->job->mem, path, strlen(path));
	int status = r->scene.path ? emit_scene(r) : err_memory(r->values.err, "job");
	r->scene.path = given;
	r->scene.read.include = folders;
	return status;
}

int job_read_scene(struct job_reader *r, const struct yaml_node *entry)
{
	const struct yaml_node *spd = yaml_find(entry, "spd");
	r->line = entry->line;
	if (entry->kind != YAML_MAP || (!spd && !yaml_find(entry, "file")))
		return values_fault(&r->values, entry->line, "a scene is {spd: FAMILY, ...} or {file: PATH, ...}");
	if (spd)
		return read_family(r, entry, spd);
	r->scene = (struct scene_spec){ 0 };
	key_defaults(spd_keys, &r->scene.spd);
	key_defaults(file_keys, &r->scene);
	return values_sweep(&r->values, "a file", entry->first, file_keys, NULL, &r->scene, emit_file, r);
}
