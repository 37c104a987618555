/* A scene of a job, from its specification to its primitives. */
#ifndef BATCH_LOAD_H
#define BATCH_LOAD_H

#include "batch/job.h"
#include "io/format.h"

/* Fill *p and *setting (the scene without its objects; both zeroed by the caller) and append the scene's NFF text to *text. A generated scene is what its NFF file says, six digits a
 * number: it is written and read again, so that results are those of the file and do not hang on the last bits of a C library's
 * sine. 0, or -1 and *e. */
int load_scene(struct primitives *p, struct scene *setting, struct text *text, const struct scene_spec *spec, struct err *e);

/* The scene of a file of any format that io/format.h knows, plain or gzipped. */
int load_file(struct scene *s, const char *path, const struct read_options *o, struct read_summary *summary, struct err *e);

#endif
