#include "io/aff_move.h"

#include <stdlib.h>
#include <string.h>

static struct vec row(const struct matrix *m, int i)
{
	return vec(m->m[i][0], m->m[i][1], m->m[i][2]);
}

/* How much m enlarges everything, or 0 if that depends on the direction. */
static double even_scale(const struct matrix *m)
{
	double size = vec_length(row(m, 0));
	for (int i = 0; i < 3; i++) {
		struct vec p = row(m, i), q = row(m, (i + 1) % 3);
		if (fabs(vec_length(p) - size) > 1e-9 * size || fabs(vec_dot(p, q)) > 1e-9 * size * size)
			return 0;
	}
	return size;
}

static void turn_over(struct vec *p, uint32_t n)
{
	for (uint32_t i = 0; i < n / 2; i++) {
		struct vec q = p[i];
		p[i] = p[n - 1 - i];
		p[n - 1 - i] = q;
	}
}

static void move_polygon(struct scene *s, const struct object *o, const struct matrix *m, bool mirrored)
{
	struct vec *p = &s->points[o->first];
	for (uint32_t i = 0; i < o->count; i++)
		p[i] = matrix_point(p[i], m);
	for (uint32_t i = o->count; o->kind == OBJECT_PATCH && i < 2 * o->count; i++)
		p[i] = matrix_normal(p[i], m);
	if (mirrored)
		turn_over(p, o->count);
	if (mirrored && o->kind == OBJECT_PATCH)
		turn_over(p + o->count, o->count);
}

/* Add object o of the scene again, moved; 'size' as from even_scale. */
static void add_moved(struct scene *s, const struct object *o, const struct matrix *m, double size, bool mirrored, int resolution)
{
	size_t first = s->object_count;
	const struct vec p[2] = { s->points[o->first], o->kind == OBJECT_CONE ? s->points[o->first + 1] : vec(0, 0, 0) };
	if (o->kind == OBJECT_POLYGON || o->kind == OBJECT_PATCH) {
		const struct vec *corners = &s->points[o->first];
		if (o->kind == OBJECT_PATCH)
			scene_add_patch(s, corners, corners + o->count, o->count);
		else
			scene_add_polygon(s, corners, o->count);
		if (s->object_count > first)
			move_polygon(s, &s->objects[first], m, mirrored);
	} else if (size > 0 && o->kind == OBJECT_SPHERE) {
		scene_add_sphere(s, matrix_point(p[0], m), o->radius[0] * size);
	} else if (size > 0) {
		scene_add_cone(s, matrix_point(p[0], m), o->radius[0] * size, matrix_point(p[1], m), o->radius[1] * size);
	} else {
		if (o->kind == OBJECT_SPHERE)
			tessellate_sphere(s, p[0], fabs(o->radius[0]), resolution);
		else
			tessellate_cone(s, p[0], fabs(o->radius[0]), p[1], fabs(o->radius[1]), resolution);
		for (size_t i = first; i < s->object_count; i++)
			move_polygon(s, &s->objects[i], m, mirrored);
	}
	for (size_t i = first; i < s->object_count; i++)
		s->objects[i].material = o->material;
}

int aff_move(struct scene *s, size_t objects, size_t lights, const struct matrix *m, int resolution, const char *name, struct err *e)
{
	size_t n = s->object_count - objects;
	double size = even_scale(m);
	bool mirrored = vec_dot(vec_cross(row(m, 0), row(m, 1)), row(m, 2)) < 0;
	for (size_t i = lights; i < s->light_count; i++)
		s->lights[i].at = matrix_point(s->lights[i].at, m);
	if (n == 0)
		return 0;
	struct object *copy = malloc(n * sizeof *copy);
	if (!copy)
		return err_memory(e, name);
	memcpy(copy, s->objects + objects, n * sizeof *copy);
	s->object_count = objects;
	for (size_t i = 0; i < n && !s->lost; i++)
		add_moved(s, &copy[i], m, size, mirrored, resolution);
	free(copy);
	return scene_complete(s, name, e);
}
