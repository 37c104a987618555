/* Wavefront OBJ out. In it comes through io/mesh.h. */
#ifndef IO_OBJ_H
#define IO_OBJ_H

#include "io/format.h"

/* As a format's 'write': triangles in the scene's order, equal corners told once, normals where the scene has patches; materials m0, m1,
 * ... of the companion file o->companion. */
int obj_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);

/* The companion: Kd is colour * kd, Ks is ks, d what is not transmitted. */
int obj_write_materials(const struct scene *s, const struct write_options *o, struct text *out, struct err *e);

#endif
