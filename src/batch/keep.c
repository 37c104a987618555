#include "batch/keep.h"

#include "batch/drawing.h"
#include "io/png.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_MOST = 4096 };

/* FOLDER/KIND/NAME + ending into path[PATH_MOST], its folder made if need be. */
static int make_path(char *path, const char *folder, const char *kind, const char *name, const char *ending, struct err *e)
{
	snprintf(path, PATH_MOST, "%s/%s", folder, kind);
	if (mkdir(path, 0777) != 0 && errno != EEXIST)
		return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	snprintf(path, PATH_MOST, "%s/%s/%s%s", folder, kind, name, ending);
	return 0;
}

/* Whether a file is there and has this content. */
static bool is_kept(const char *path, const struct text *content)
{
	struct text found = { 0 };
	struct err ignored = { 0 };
	bool same = text_read_file(&found, path, content->size, &ignored) == 0 && found.size == content->size &&
	            memcmp(found.bytes, content->bytes, found.size) == 0;
	text_free(&found);
	return same;
}

int keep_scene(const char *folder, const char *name, const struct text *nff, struct err *e)
{
	char path[PATH_MOST];
	if (make_path(path, folder, "scenes", name, ".nff.gz", e) != 0)
		return -1;
	return is_kept(path, nff) ? 0 : text_write_file(nff, path, e);
}

int keep_image(const char *folder, const char *name, size_t number, const struct rendering *image, const struct render_options *o,
               struct err *e)
{
	char path[PATH_MOST], ending[32] = ".png";
	if (number > 0)
		snprintf(ending, sizeof ending, "-%zu.png", number);
	if (make_path(path, folder, "images", name, ending, e) != 0)
		return -1;
	return png_write_rgb(path, image->pixels, (int)o->width, (int)o->height, e);
}

int keep_drawing(const char *folder, const char *name, const struct accel *a, uint64_t seed, struct err *e)
{
	char path[PATH_MOST];
	struct text text = { 0 };
	if (a->primitives->count > DRAWING_PRIMITIVES_MOST)
		return 0;
	int status = make_path(path, folder, "drawings", name, ".dat", e);
	if (status == 0)
		status = drawing_print(&text, a, seed, e);
	if (status == 0)
		status = text_write_file(&text, path, e);
	text_free(&text);
	return status;
}
