/* Objects of a scene moved after they were added. */
#ifndef IO_AFF_MOVE_H
#define IO_AFF_MOVE_H

#include "geom/matrix.h"
#include "scene/scene.h"
#include "scene/tessellate.h"

/* Move the objects from number 'objects' on and the lights from number 'lights' on by m, which is invertible. What faced outward
 * does so afterwards; spheres and cones that an uneven scale would deform become patches of this resolution. 0, or -1 and *e
 * (memory). */
int aff_move(struct scene *s, size_t objects, size_t lights, const struct matrix *m, int resolution, const char *name, struct err *e);

#endif
