/* What blobs keep sealed: their components, ready for points and rays. */
#ifndef IO_POV_BLOB_H
#define IO_POV_BLOB_H

#include "io/pov_shape.h"
#include "io/pov_tree.h"

struct pov_sealed_component {
	struct pov_component given;
	struct matrix back;
	double shrink; /* the most 'back' stretches */
	struct box box;
};

/* tree: over the boxes of the components. box: of what adds to the field. finest: the least radius. area: of the boxes of all components. */
struct pov_sealed_blob {
	struct pov_sealed_component *all;
	uint32_t count;
	struct pov_tree tree;
	struct box box;
	double finest, area;
};

/* See 'cross' of struct pov_shape. */
void pov_blob_cross(const struct pov_solid *s, const struct pov_line *line);
size_t pov_blob_room(const struct pov_solid *s);

#endif
