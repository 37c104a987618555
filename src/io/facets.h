/* The surface of a scene as triangles with shared corners, for formats that have no other shape. */
#ifndef IO_FACETS_H
#define IO_FACETS_H

#include "scene/scene.h"

struct facet {
	struct vec corner[3], normal[3]; /* normals of any length; zero where not smooth */
	uint32_t material;               /* as the object's */
	bool smooth;
};

/* Zero-initialise to open. Everything is in mem; 'lost': memory ran out and nothing more is added. */
struct facets {
	struct arena mem;
	struct facet *all;
	size_t count, room;
	bool lost;
};

/* Append an object's triangles: a polygon's n - 2, those of a curve tessellated at this resolution. Triangles without area stay. */
void facets_add(struct facets *f, const struct scene *s, const struct object *o, int resolution);

void facets_free(struct facets *f);

/* Points that are equal bit for bit, told once. keys: n rows of 'width' doubles. index[n] receives the number of each row's first
 * like; rows[n] which row each number stands for. Returns how many there are, or SIZE_MAX when memory is out. */
size_t facets_weld(const double *keys, size_t n, int width, uint32_t *index, uint32_t *rows);

#endif
