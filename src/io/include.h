/* Files that scene files name. */
#ifndef IO_INCLUDE_H
#define IO_INCLUDE_H

#include "io/text.h"

/* Read the file called 'named' in the file 'from': beside that file, then in each of 'folders' (':' between; NULL: none), as it is or
 * gzipped. Its path goes to path[size], its content, at most 'limit' bytes unpacked, to *out. Only regular files below those
 * folders: a name that is absolute or has '..' in it is looked for by its last part alone. 0, or -1 and *e, with 'from' and
 * 'line' as the place where nothing was found. */
int include_read(const char *from, long line, const char *named, const char *folders, size_t limit, char *path, size_t size,
                 struct text *out, struct err *e);

#endif
