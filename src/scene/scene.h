/* A scene as its author wrote it: view, lights, materials and objects in file order. Generators and readers fill it, writers
 * print it, scene/primitives.h turns it into what rays are tested against. Coordinates are right-handed, without unit. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include "base/arena.h"
#include "base/err.h"
#include "geom/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct color {
	double r, g, b; /* 0..1 */
};

/* NFF's view. angle: full vertical angle in degrees; resolution in pixels. given: the scene has one.
 * window: the picture is a window in space of any shape and handedness, as in POV-Ray; then the ray through (x, y), each 0 to 1 from
 * the upper left, starts at 'from' and points along direction + (x - 1/2) right + (1/2 - y) window_up; parallel: it points along
 * 'direction' and starts aside instead. The rest then says the same as nearly as it can. */
struct view {
	bool given;
	struct vec from, at, up;
	double angle, hither;
	int width, height;
	bool window, parallel;
	struct vec direction, right, window_up;
};

/* A point light; 'colored' is false where the scene gives no colour (then it is white, its strength unspecified). */
struct light {
	struct vec at;
	bool colored;
	struct color color;
};

/* NFF's material: kd, ks factors, shine the Phong power, transmit the transmitted fraction, ior the index of refraction. */
struct material {
	struct color color;
	double kd, ks, shine, transmit, ior;
};

enum object_kind { OBJECT_SPHERE, OBJECT_CONE, OBJECT_POLYGON, OBJECT_PATCH };

/* One object. Its points are points[first .. first + count) of the scene:
 *   sphere   1: centre; radius[0] (negative: seen from inside only)
 *   cone     2: base, apex; radius[0] at the base, radius[1] at the apex; no caps
 *   polygon  the corners, planar, counter-clockwise seen from the front, may be concave
 *   patch    the corners; their normals, any length, follow at points[first + count .. first + 2 count)
 * material is an index, or NO_MATERIAL before the first one. */
struct object {
	enum object_kind kind;
	uint32_t material, count;
	size_t first;
	double radius[2];
};

#define NO_MATERIAL UINT32_MAX

struct spd_notes;

/* Arrays belong to 'mem'; zero-initialise to open, scene_free to close. 'lost' is set when memory ran out while adding:
 * adding then does nothing more, and scene_complete reports it, so that fillers need no checks of their own. */
struct scene {
	struct arena mem;
	bool background_given, lost;
	struct color background; /* black where not given */
	struct view view;
	struct light *lights;
	struct material *materials;
	struct object *objects;
	struct vec *points;
	size_t light_count, material_count, object_count, point_count;
	size_t light_room, material_room, object_room, point_room;
	struct spd_notes *notes; /* what a generator is asked to tell besides (spd/notes.h), the asker's; NULL: nothing */
};

void scene_free(struct scene *s);

void scene_set_view(struct scene *s, struct vec from, struct vec at, struct vec up, double angle, double hither, int width,
                    int height);
void scene_set_background(struct scene *s, double r, double g, double b);
void scene_add_light(struct scene *s, struct vec at);
void scene_add_colored_light(struct scene *s, struct vec at, struct color color);

/* Becomes the material of all objects added from now on. Adding an equal one again is kept as written. */
void scene_add_material(struct scene *s, struct material m);

void scene_add_sphere(struct scene *s, struct vec center, double radius);
void scene_add_cone(struct scene *s, struct vec base, double base_radius, struct vec apex, double apex_radius);
/* corners[count]; copied */
void scene_add_polygon(struct scene *s, const struct vec *corners, size_t count);
/* corners[count] and normals[count]; copied */
void scene_add_patch(struct scene *s, const struct vec *corners, const struct vec *normals, size_t count);

/* Copy all but the objects: view, background, lights, materials. to: empty. */
void scene_copy_setting(struct scene *to, const struct scene *from);

/* 0, or -1 and *e when memory ran out while the scene was filled. Call once after filling. */
int scene_complete(const struct scene *s, const char *name, struct err *e);

#endif
