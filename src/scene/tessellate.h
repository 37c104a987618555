/* Curved shapes as smooth triangles (patches of three corners), exactly as the SPD programs make them: same triangles, same
 * order, same floating-point operations (spd-spec section 4). Used by the generators' -t and wherever a cone or sphere has to
 * become triangles. 'resolution' R >= 1; SPD's default is 3. */
#ifndef SCENE_TESSELLATE_H
#define SCENE_TESSELLATE_H

#include "scene/scene.h"

enum { SPD_RESOLUTION = 3 };

/* 12 R^2 patches, counter-clockwise seen from outside: six faces of a cube with equal angles. radius > 0. */
void tessellate_sphere(struct scene *s, struct vec center, double radius, int resolution);

/* 8 R patches, facing outward, no caps. base != apex; radii >= 0. */
void tessellate_cone(struct scene *s, struct vec base, double base_radius, struct vec apex, double apex_radius,
                     int resolution);

#endif
