/* The importing process's side of io/mesh.h, what it sends, and who checks that. */
#ifndef IO_MESH_IMPORT_H
#define IO_MESH_IMPORT_H

#include "io/mesh.h"

#include <stddef.h>
#include <stdint.h>

/* The stream: this head, then its materials and triangles; or a head with a message. */
struct mesh_head {
	uint64_t magic, materials, triangles;
	char message[400]; /* not empty: what was wrong; nothing follows */
};

#define MESH_MAGIC UINT64_C(0x68736d74736f6372)

struct mesh_material {
	double r, g, b, ks, shine, transmit, ior;
};

struct mesh_triangle {
	double corner[3][3], normal[3][3]; /* normals: any length, all zero where there are none */
	uint64_t material;
};

/* Import n bytes of a file called 'name', whose ending names the format, and write the stream to fd. folders: as include_read's. Returns
 * an exit status for the process; 0 where the stream is whole. */
int mesh_import(int fd, const char *name, const char *text, size_t n, const char *folders);

/* The parent's side: read the stream from fd into an empty scene, believing nothing. 0, or -1 and *e; a stream that ends before it
 * is whole is -1 without a message, for the process that wrote it knows more. name: for messages. */
int mesh_receive(int fd, struct scene *s, const char *name, const struct mesh_limits *limits, struct err *e);

#endif
