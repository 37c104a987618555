/* What rays are tested against: triangles and spheres only, made from a scene once and read-only from then on.
 * The index of a primitive is its id; ids follow the order of the scene's objects. */
#ifndef SCENE_PRIMITIVES_H
#define SCENE_PRIMITIVES_H

#include "base/arena.h"
#include "base/err.h"
#include "geom/primitive.h"
#include "scene/scene.h"

struct primitives {
	struct arena mem; /* owned */
	struct primitive *all;
	struct vec (*normals)[3]; /* at the corners of each, any length, zero where flat; NULL: the scene has no patches */
	uint32_t count, triangles, spheres;
	uint32_t skipped;  /* degenerate objects and triangles of zero area left out (they have no measure) */
	struct box bounds; /* of all primitives */
	double area;       /* one-sided surface of all, scene units^2 */
	uint64_t hash;     /* of the geometry, bit for bit: equal scenes have equal hashes */
};

/* spheres: kept as they are, or tessellated at 'resolution'. Cones are tessellated at 'resolution' always. */
enum curves { CURVES_KEEP, CURVES_TESSELLATE };

/* Fill *p (zeroed by the caller) from the scene. Polygons of more than three corners are triangulated: n - 2 triangles that
 * cover the polygon, concave ones too. 0, or -1 and *e: no primitive with positive area left, farther from the origin
 * than a million of its diagonals or larger than 1e100, memory. name: for messages. */
int primitives_make(struct primitives *p, const struct scene *s, enum curves curves, int resolution, const char *name,
                    struct err *e);

void primitives_free(struct primitives *p);

#endif
