/* Primitives that are there more than once. */
#ifndef SCENE_DUPLICATES_H
#define SCENE_DUPLICATES_H

#include "scene/primitives.h"

/* How many primitives are equal to one before them: triangles with the same three corners in any order, spheres with the same centre
 * and radius; equal means every bit, but -0 is 0. SIZE_MAX when memory is out. */
size_t primitives_duplicates(const struct primitives *p);

#endif
