/* OBJ, PLY, STL, glTF and what else Assimp reads.
 *
 * The importer runs in a process of its own, with a limit on memory and time, that can write no file and opens, for reading only, what
 * the scene file names (io/include.h); the geometry comes back through a pipe and is checked. Whatever the importer does to
 * itself there is one line here.
 *
 * Faces of more than three corners are triangulated by Assimp, points and lines left out; the transforms of the nodes above a mesh are
 * applied, every instance is there. Corners are single precision, as Assimp's. A material's colour and kd are its diffuse colour
 * and the largest part of it, ks is the largest specular component, transmit what is not opaque. Lights and cameras stay out. */
#ifndef IO_MESH_H
#define IO_MESH_H

#include "io/read.h"
#include "scene/scene.h"

/* What the process may take: address space in bytes, wall-clock time. */
struct mesh_limits {
	size_t memory;
	double seconds;
};

/* As a format's 'read', within limits that grow with the file: 2 GiB and 100 times its size; 10 s and 2 more each MiB. A mesh without
 * triangles or with more than 20 million, a fault, a crash or a limit met is "name: reason" with STATUS_INPUT; built without Assimp,
 * so is every file. */
int mesh_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
              struct read_summary *summary, struct err *e);

/* The same within given limits. */
int mesh_read_within(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                     const struct mesh_limits *limits, struct err *e);

/* Whether Assimp is built in. */
bool mesh_available(void);

#endif
