#include "scene/scene.h"

#include <string.h>

/* Make room for 'more' elements behind 'count' in *array; false (and s->lost) when memory is out. */
static bool reserve(struct scene *s, void *array, size_t count, size_t *room, size_t more, size_t size)
{
	if (s->lost)
		return false;
	if (*room - count >= more)
		return true;
	size_t want = *room < 64 ? 64 : *room * 2;
	if (want < count + more)
		want = count + more;
	void *old, *grown;
	memcpy(&old, array, sizeof old);
	grown = arena_grow(&s->mem, old, count, want, size);
	if (!grown) {
		s->lost = true;
		return false;
	}
	memcpy(array, &grown, sizeof grown);
	*room = want;
	return true;
}

void scene_free(struct scene *s)
{
	arena_free(&s->mem);
	*s = (struct scene){ 0 };
}

void scene_set_view(struct scene *s, struct vec from, struct vec at, struct vec up, double angle, double hither, int width,
                    int height)
{
	s->view = (struct view){ .given = true, .from = from, .at = at, .up = up, .angle = angle, .hither = hither, .width = width,
		                 .height = height };
}

void scene_set_background(struct scene *s, double r, double g, double b)
{
	s->background_given = true;
	s->background = (struct color){ r, g, b };
}

static void add_light(struct scene *s, struct light l)
{
	if (reserve(s, &s->lights, s->light_count, &s->light_room, 1, sizeof l))
		s->lights[s->light_count++] = l;
}

void scene_add_light(struct scene *s, struct vec at)
{
	add_light(s, (struct light){ at, false, { 1, 1, 1 } });
}

void scene_add_colored_light(struct scene *s, struct vec at, struct color color)
{
	add_light(s, (struct light){ at, true, color });
}

void scene_add_material(struct scene *s, struct material m)
{
	if (reserve(s, &s->materials, s->material_count, &s->material_room, 1, sizeof m))
		s->materials[s->material_count++] = m;
}

/* Add an object of 'count' corners and copy its points: 'corners', then 'normals' unless NULL. */
static void add_object(struct scene *s, struct object o, const struct vec *corners, const struct vec *normals)
{
	size_t n = o.count;
	if (!reserve(s, &s->objects, s->object_count, &s->object_room, 1, sizeof o) ||
	    !reserve(s, &s->points, s->point_count, &s->point_room, 2 * n, sizeof *corners))
		return;
	o.material = s->material_count ? (uint32_t)(s->material_count - 1) : NO_MATERIAL;
	o.first = s->point_count;
	memcpy(s->points + s->point_count, corners, n * sizeof *corners);
	s->point_count += n;
	if (normals) {
		memcpy(s->points + s->point_count, normals, n * sizeof *normals);
		s->point_count += n;
	}
	s->objects[s->object_count++] = o;
}

void scene_add_sphere(struct scene *s, struct vec center, double radius)
{
	add_object(s, (struct object){ .kind = OBJECT_SPHERE, .count = 1, .radius = { radius } }, &center, NULL);
}

void scene_add_cone(struct scene *s, struct vec base, double base_radius, struct vec apex, double apex_radius)
{
	struct vec ends[2] = { base, apex };
	add_object(s, (struct object){ .kind = OBJECT_CONE, .count = 2, .radius = { base_radius, apex_radius } }, ends, NULL);
}

void scene_add_polygon(struct scene *s, const struct vec *corners, size_t count)
{
	add_object(s, (struct object){ .kind = OBJECT_POLYGON, .count = (uint32_t)count }, corners, NULL);
}

void scene_add_patch(struct scene *s, const struct vec *corners, const struct vec *normals, size_t count)
{
	add_object(s, (struct object){ .kind = OBJECT_PATCH, .count = (uint32_t)count }, corners, normals);
}

void scene_copy_setting(struct scene *to, const struct scene *from)
{
	to->background_given = from->background_given;
	to->background = from->background;
	to->view = from->view;
	for (size_t i = 0; i < from->light_count; i++)
		add_light(to, from->lights[i]);
	for (size_t i = 0; i < from->material_count; i++)
		scene_add_material(to, from->materials[i]);
}

int scene_complete(const struct scene *s, const char *name, struct err *e)
{
	return s->lost ? err_memory(e, name) : 0;
}
