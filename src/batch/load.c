#include "batch/load.h"

#include "io/nff.h"

/* Content of a scene file at the most, unpacked. */
static const size_t bytes_most = (size_t)8 << 30;

int load_file(struct scene *s, const char *path, const struct read_options *o, struct read_summary *summary, struct err *e)
{
	struct text text = { 0 };
	int status = text_read_file(&text, path, bytes_most, e);
	if (status == 0)
		status = format_read(s, path, text.bytes, text.size, o, summary, e);
	text_free(&text);
	return status;
}

/* Generate, and cut into triangles where a soup is wanted; then NFF. */
static int write_generated(struct text *text, const struct scene_spec *spec, struct err *e)
{
	struct scene made = { 0 }, soup = { 0 };
	int status = spd_generate(&made, spec->family, &spec->spd, e);
	if (status == 0 && spec->soup)
		status = spd_soup(&soup, &made, (int)spec->spd.resolution, e);
	if (status == 0)
		status = nff_write(spec->soup ? &soup : &made, DIGITS_SPD, text, e);
	scene_free(&made);
	scene_free(&soup);
	return status;
}

int load_scene(struct primitives *p, struct scene *setting, struct text *text, const struct scene_spec *spec, struct err *e)
{
	struct scene s = { 0 };
	struct nff_skipped skipped;
	struct read_summary summary;
	int status;
	if (spec->path) {
		status = load_file(&s, spec->path, &spec->read, &summary, e);
		if (status == 0)
			status = nff_write(&s, DIGITS_EXACT, text, e);
	} else {
		status = write_generated(text, spec, e);
		if (status == 0)
			status = nff_read(&s, spec->name, text->bytes, text->size, true, &skipped, e);
	}
	if (status == 0)
		status = primitives_make(p, &s, (enum curves)spec->curves, (int)scene_resolution(spec),
		                         spec->path ? spec->path : spec->name, e);
	if (status == 0) {
		scene_copy_setting(setting, &s);
		status = scene_complete(setting, spec->name, e);
	}
	scene_free(&s);
	return status;
}
