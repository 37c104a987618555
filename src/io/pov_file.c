/* Files that a scene names: virtual ones first, then where the language and its users look. */
#include "io/pov_reader.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { PATH_MOST = 1024, FILE_MOST = 1 << 30 };

static int load_file(const char *path, struct text *t)
{
	struct err ignored = { 0 };
	if (text_read_file(t, path, FILE_MOST, &ignored) == 0)
		return 0;
	text_free(t);
	return -1;
}

/* The first by name of the entries that differ in case only, so that the order of the folder does not matter. */
static bool match_file(const char *folder, const char *name, char *out, size_t size)
{
	DIR *d = opendir(*folder ? folder : ".");
	bool found = false;
	if (!d)
		return false;
	for (struct dirent *entry; (entry = readdir(d)) != NULL;)
		if (strcasecmp(entry->d_name, name) == 0 && strlen(entry->d_name) < size && (!found || strcmp(entry->d_name, out) < 0)) {
			snprintf(out, size, "%s", entry->d_name);
			found = true;
		}
	closedir(d);
	return found;
}

static int load(const struct pov *p, const char *path, struct text *t)
{
	const struct pov_access *a = &p->options->access;
	return a->load ? a->load(a->context, path, t) : load_file(path, t);
}

static bool match(const struct pov *p, const char *folder, const char *name, char *out, size_t size)
{
	const struct pov_access *a = &p->options->access;
	return a->match ? a->match(a->context, folder, name, out, size) : match_file(folder, name, out, size);
}

struct pov_stream *pov_stream_find(struct pov *p, const char *name)
{
	struct pov_stream *s = p->streams;
	while (s && (s->reads || strcmp(s->name, name) != 0))
		s = s->next;
	return s;
}

static const struct pov_file *find_cut(const struct pov *p, const char *path)
{
	for (const struct pov_file *f = p->files; f; f = f->next)
		if (strcmp(f->name, path) == 0)
			return f;
	return NULL;
}

/* Cut a text into tokens; the file is the reader's. */
static const struct pov_file *cut(struct pov *p, const char *path, const char *text, size_t n)
{
	const char *slash = strrchr(path, '/');
	struct pov_file *f = pov_alloc(p, 1, sizeof *f);
	char *name = pov_alloc(p, strlen(path) + 1, 1), *folder = pov_alloc(p, slash ? (size_t)(slash - path) + 2 : 1, 1);
	if (!f || !name || !folder)
		return NULL;
	memcpy(name, path, strlen(path));
	if (slash)
		memcpy(folder, path, (size_t)(slash - path) + 1);
	f->name = name;
	f->folder = folder;
	f->next = p->files;
	p->files = f;
	int status = pov_lex(f, text, n, &p->names);
	p->tokens_cut += f->count;
	if (status != 0 || (double)p->tokens_cut * sizeof *f->tokens > (double)p->options->budget.bytes) {
		f->count = 0;
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
		return NULL;
	}
	return f;
}

/* The path at which a folder has the file, in *t its content unless it is cut already. */
static bool try_path(struct pov *p, const char *path, struct text *t, bool tokens)
{
	return (tokens && find_cut(p, path)) || load(p, path, t) == 0;
}

static bool try_folder(struct pov *p, const char *folder, const char *name, bool any_case, char *path, struct text *t, bool tokens)
{
	char spelled[PATH_MOST], inner[PATH_MOST];
	const char *slash = strrchr(name, '/');
	bool joins = *folder && folder[strlen(folder) - 1] != '/';
	if (snprintf(path, PATH_MOST, "%s%s%s", folder, joins ? "/" : "", name) >= PATH_MOST)
		return false;
	if (!any_case)
		return try_path(p, path, t, tokens);
	if (snprintf(inner, sizeof inner, "%s%s%.*s", folder, joins ? "/" : "", slash ? (int)(slash - name) + 1 : 0, name) >= PATH_MOST)
		return false;
	if (!match(p, inner, slash ? slash + 1 : name, spelled, sizeof spelled) ||
	    snprintf(path, PATH_MOST, "%s%s", inner, spelled) >= PATH_MOST)
		return false;
	return try_path(p, path, t, tokens);
}

/* Look in the scene's folder, the folder of the file at hand, and the directories: the name as given, then without its
 * folders; exactly spelled, then in any case. Strictly, as POV-Ray: the name as given, and not beside the file at hand.
 * path[PATH_MOST]. */
static bool find(struct pov *p, const char *name, char *path, struct text *t, bool tokens)
{
	const char *slash = strrchr(name, '/'), *spellings[] = { name, slash ? slash + 1 : NULL };
	size_t count = p->options->directory_count + 2;
	bool strict = p->options->strict;
	if (*name == '/' && try_folder(p, "", name, false, path, t, tokens))
		return true;
	for (int any_case = 0; any_case <= !strict; any_case++)
		for (int k = 0; k < 2 - strict; k++)
			for (size_t i = 0; spellings[k] && *spellings[k] && i < count; i++) {
				const char *folder = i == 0 ? p->folder : i == 1 ? p->source->file->folder : p->options->directories[i - 2];
				if (i == 1 && (strict || strcmp(folder, p->folder) == 0))
					continue;
				if ((*spellings[k] != '/') && try_folder(p, folder, spellings[k], any_case, path, t, tokens))
					return true;
			}
	return false;
}

static bool has_ending(const char *name)
{
	const char *slash = strrchr(name, '/');
	return strchr(slash ? slash : name, '.') != NULL;
}

const struct pov_file *pov_open(struct pov *p, const char *name)
{
	char path[PATH_MOST], longer[PATH_MOST];
	struct text t = { 0 };
	const struct pov_stream *written = pov_stream_find(p, name);
	if (written)
		return cut(p, name, written->text.bytes ? written->text.bytes : "", written->text.size);
	bool found = find(p, name, path, &t, true);
	if (!found && !has_ending(name) && snprintf(longer, sizeof longer, "%s.inc", name) < PATH_MOST)
		found = find(p, longer, path, &t, true);
	const struct pov_file *f = NULL;
	if (found) {
		f = find_cut(p, path);
		if (!f)
			f = cut(p, path, t.bytes ? t.bytes : "", t.size);
	}
	text_free(&t);
	return f;
}

bool pov_load(struct pov *p, const char *name, struct text *t)
{
	char path[PATH_MOST];
	return find(p, name, path, t, false);
}
