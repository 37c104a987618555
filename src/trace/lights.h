/* Where the lights of a rendering stand. */
#ifndef TRACE_LIGHTS_H
#define TRACE_LIGHTS_H

#include "geom/box.h"
#include "scene/scene.h"

/* As in the scene; those outside a box drawn into it; those inside drawn out of it. */
enum light_place { LIGHT_SCENE, LIGHT_INSIDE, LIGHT_OUTSIDE };

/* Copies of a scene's lights, in mem. A light that is to move stays on the line through the middle of the box: it comes to 0.9 (inside) or
 * 1.5 (outside) times as far as where that leaves the box. NULL when memory is out. */
struct light *lights_place(struct arena *mem, const struct scene *s, const struct box *bounds, enum light_place where);

#endif
