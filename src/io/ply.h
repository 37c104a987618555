/* Stanford PLY out, as text. In it comes through io/mesh.h. */
#ifndef IO_PLY_H
#define IO_PLY_H

#include "io/format.h"

/* As a format's 'write': vertices in double precision, with normals where the scene has patches, and triangles in the scene's order. */
int ply_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);

#endif
