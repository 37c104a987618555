#include "io/include.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* FOLDER/NAME, or the same with .gz, whichever is there. */
static bool find_in(const char *folder, int length, const char *name, char *path, size_t size)
{
	static const char *const endings[] = { "", ".gz" };
	for (int i = 0; i < 2; i++) {
		int n = snprintf(path, size, "%.*s%s%s%s", length, folder, length > 0 && folder[length - 1] != '/' ? "/" : "", name, endings[i]);
		if (n < (int)size && access(path, R_OK) == 0)
			return true;
	}
	return false;
}

static bool find(const char *from, const char *name, const char *folders, char *path, size_t size)
{
	const char *slash = strrchr(from, '/');
	if (find_in(from, slash ? (int)(slash + 1 - from) : 0, name, path, size))
		return true;
	for (const char *p = folders; p && *p; p += strcspn(p, ":"), p += *p == ':')
		if (*p != ':' && find_in(p, (int)strcspn(p, ":"), name, path, size))
			return true;
	return false;
}

int include_read(const char *from, long line, const char *named, const char *folders, size_t limit, char *path, size_t size,
                 struct text *out, struct err *e)
{
	const char *slash = strrchr(named, '/'), *name = slash && (*named == '/' || strstr(named, "..")) ? slash + 1 : named;
	if (!*name || !find(from, name, folders, path, size))
		return err_at(e, STATUS_INPUT, from, line, "%s: no such file there, nor in the include folders", named);
	return text_read_file(out, path, limit, e);
}
