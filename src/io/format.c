#include "io/format.h"

#include "io/aff.h"
#include "io/mesh.h"
#include "io/nff.h"
#include "io/obj.h"
#include "io/ply.h"
#include "io/pov_format.h"
#include "io/pov_write.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

struct alone {
	struct read_options options;
};

const char *const read_planes_words[] = { "clip", "skip", NULL };
const struct key read_keys[] = { READ_KEYS(struct alone, options), { 0 } };

static int read_nff(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                    struct read_summary *summary, struct err *e)
{
	struct nff_skipped skipped;
	int status = aff_read(s, name, text, n, o, &skipped, e);
	summary->skipped = skipped.records;
	summary->first_line = skipped.first_line;
	return status;
}

static int write_nff(const struct scene *s, const struct write_options *o, struct text *out, struct err *e)
{
	return nff_write(s, o->digits, out, e);
}

static bool is_ply(const char *text, size_t n)
{
	return n >= 4 && memcmp(text, "ply", 3) == 0 && isspace((unsigned char)text[3]);
}

static bool is_glb(const char *text, size_t n)
{
	return n >= 4 && memcmp(text, "glTF", 4) == 0;
}

const struct format formats[] = {
	{ .name = "NFF", .endings = "nff aff", .read = read_nff, .write = write_nff, .is = nff_is },
	{ .name = "POV-Ray", .endings = "pov inc", .read = pov_format_read, .write = pov_write },
	{ .name = "OBJ", .endings = "obj", .read = mesh_read, .write = obj_write, .write_companion = obj_write_materials,
	  .companion_ending = "mtl" },
	{ .name = "PLY", .endings = "ply", .read = mesh_read, .write = ply_write, .is = is_ply },
	{ .name = "glTF", .endings = "gltf glb", .read = mesh_read, .is = is_glb },
	{ .name = "mesh", .endings = "stl 3ds 3mf ac amf ase b3d dae dxf fbx hmp lwo lxo md2 md3 ms3d off q3o sib smd x x3d xgl",
	  .read = mesh_read },
	{ 0 }
};

/* Where the ending of a path starts and how long it is, without a .gz behind it. */
static const char *find_ending(const char *path, size_t *n)
{
	const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *end = base + strlen(base), *dot;
	if (end - base > 3 && strcasecmp(end - 3, ".gz") == 0)
		end -= 3;
	for (dot = end; dot > base && dot[-1] != '.'; dot--)
		;
	*n = dot > base ? (size_t)(end - dot) : 0;
	return dot;
}

/* Whether a word of n characters is in a list with blanks between. */
static bool holds(const char *list, const char *word, size_t n)
{
	for (const char *p = list; *p; p += strcspn(p, " "), p += *p == ' ')
		if (strcspn(p, " ") == n && strncasecmp(p, word, n) == 0)
			return true;
	return false;
}

const struct format *format_of_path(const char *path)
{
	size_t n;
	const char *ending = find_ending(path, &n);
	for (const struct format *f = formats; n > 0 && f->name; f++)
		if (holds(f->endings, ending, n))
			return f;
	return NULL;
}

void format_list(bool writable, char *out, size_t size)
{
	size_t n = 0;
	*out = '\0';
	for (const struct format *f = formats; f->name; f++)
		if ((writable ? f->write != NULL : f->read != NULL) && n < size)
			n += (size_t)snprintf(out + n, size - n, "%s%s", n ? " " : "", f->endings);
}

int format_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                struct read_summary *summary, struct err *e)
{
	char known[400];
	const struct format *f = format_of_path(name);
	*summary = (struct read_summary){ 0 };
	if (!f)
		for (f = formats; f->name && !(f->is && f->is(text, n)); f++)
			;
	if (f->read)
		return f->read(s, name, text, n, o, summary, e);
	format_list(false, known, sizeof known);
	return err_at(e, STATUS_INPUT, name, 0, "no reader for %s; known endings are: %s (each also .gz)",
	              f->name ? f->name : "this kind of file", known);
}

/* The path of the second file; false if it is too long. */
static bool name_companion(const char *path, const char *ending, char *out, size_t size)
{
	size_t n;
	const char *at = find_ending(path, &n);
	return snprintf(out, size, "%.*s%s", (int)(at - path), path, ending) < (int)size;
}

int format_write(const struct scene *s, const char *path, const struct write_options *o, struct err *e)
{
	char known[400], companion[4096];
	const struct format *f = format_of_path(path);
	struct write_options options = *o;
	struct text first = { 0 }, second = { 0 };
	if (!f || !f->write) {
		format_list(true, known, sizeof known);
		return err_at(e, STATUS_INPUT, path, 0, "no writer for %s; known endings are: %s (each also .gz)",
		              f ? f->name : "this ending", known);
	}
	if (f->write_companion) {
		if (!name_companion(path, f->companion_ending, companion, sizeof companion))
			return err_at(e, STATUS_ENVIRONMENT, path, 0, "path too long");
		const char *slash = strrchr(companion, '/');
		options.companion = slash ? slash + 1 : companion;
	}
	int status = f->write(s, &options, &first, e);
	if (status == 0 && f->write_companion)
		status = f->write_companion(s, &options, &second, e);
	if (status == 0 && f->write_companion)
		status = text_write_file(&second, companion, e);
	if (status == 0)
		status = text_write_file(&first, path, e);
	text_free(&first);
	text_free(&second);
	return status;
}
