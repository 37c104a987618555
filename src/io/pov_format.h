/* POV-Ray scenes as one of the formats. */
#ifndef IO_POV_FORMAT_H
#define IO_POV_FORMAT_H

#include "io/read.h"
#include "scene/scene.h"

/* As the 'read' of a format (io/format.h), of io/pov.h. resolution: a quarter of the segments of a full circle. */
int pov_format_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                    struct read_summary *summary, struct err *e);

#endif
