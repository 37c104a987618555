#include "io/pov_format.h"

#include "io/pov.h"

#include <stdio.h>
#include <string.h>

enum { FOLDERS_MOST = 64 };

/* The folders of a ':' list, behind those that are there already; the text is cut up. */
static size_t split_folders(char *list, const char **folders, size_t count)
{
	for (char *at = list; at && count < FOLDERS_MOST;) {
		char *colon = strchr(at, ':');
		if (colon)
			*colon = '\0';
		if (*at)
			folders[count++] = at;
		at = colon ? colon + 1 : NULL;
	}
	return count;
}

int pov_format_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                    struct read_summary *summary, struct err *e)
{
	struct arena mem = { 0 };
	struct pov_options options = pov_defaults();
	struct pov_summary found;
	struct text line = { 0 };
	const char *folders[FOLDERS_MOST + 1];
	char *list = o->include ? arena_text(&mem, o->include, strlen(o->include)) : NULL;
	if (o->include && !list)
		return err_memory(e, name);
	size_t count = split_folders(list, folders, 0);
	for (size_t i = 0; i < options.directory_count && count <= FOLDERS_MOST; i++)
		folders[count++] = options.directories[i];
	options.directories = folders;
	options.directory_count = count;
	options.strict = o->strict;
	options.mesh.planes = o->planes == PLANES_CLIP;
	if (o->width > 0 && o->height > 0) {
		options.width = o->width;
		options.height = o->height;
	}
	if (o->resolution > 0)
		options.mesh.resolution = (int)(4 * o->resolution);
	int status = pov_read(s, name, text, n, &options, &found, e);
	if (status == 0) {
		pov_summary_print(&found, &line);
		summary->skipped = (uint32_t)(found.tally.skipped + found.missing + found.ignored + found.tally.domes);
		/* What was read is said elsewhere: only what was not, or not exactly, is worth a line. */
		if (summary->skipped || found.unknown || *found.camera)
			snprintf(summary->text, sizeof summary->text, "%s", line.bytes);
	}
	text_free(&line);
	arena_free(&mem);
	return status;
}
