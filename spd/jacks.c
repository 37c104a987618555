/* Jacks within jacks: three crossed cylinders with six spheres, and eight of half the size inside (SPD "jacks"). */
#include "spd/common.h"

/* SPD tessellates these at their own resolution, whatever was asked for. */
enum { RESOLUTION = 2 };

static void add_jack(struct scene *s, const struct spd_options *o, const struct matrix *around)
{
	static const double sides[2] = { 1, -1 };
	struct spd_options own = *o;
	own.resolution = RESOLUTION;
	size_t first = s->object_count;
	for (int axis = 0; axis < 3; axis++) {
		struct vec end = vec(0, 0, 0);
		end.a[axis] = 1;
		struct vec start = vec(0, 0, 0);
		start.a[axis] = -1;
		spd_add_cone(s, &own, start, 0.1, end, 0.1);
	}
	for (int i = 0; i < 6; i++) {
		struct vec center = vec(0, 0, 0);
		center.a[i % 3] = sides[i / 3];
		spd_add_sphere(s, &own, center, 0.2);
	}
	struct matrix smaller = matrix_scale(0.75, 0.75, 0.75), m = matrix_multiply(&smaller, around);
	if (!o->tessellate)
		spd_note_placed(s, first, &m);
	spd_transform(s, first, &m);
}

static void add(struct scene *s, const struct spd_options *o, const struct matrix *around, int64_t depth)
{
	add_jack(s, o, around);
	for (int i = 0; depth < o->size && i < 8; i++) {
		struct matrix move = matrix_translation(i & 4 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 1 ? 0.5 : -0.5);
		struct matrix half = matrix_scale(0.5, 0.5, 0.5), moved = matrix_multiply(&move, around);
		struct matrix inner = matrix_multiply(&half, &moved);
		add(s, o, &inner, depth + 1);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	scene_set_background(s, 0.2, 0.05, 0.2);
	scene_set_view(s, vec(0, 0, -8), vec(0, 0, 0), vec(0, 1, 0), 25, 0.001, 256, 256);
	scene_add_light(s, vec(-10, 3, -20));
	struct matrix x = matrix_rotation(0, -30 * SPD_PI / 180), y = matrix_rotation(1, -20 * SPD_PI / 180);
	struct matrix all = matrix_multiply(&y, &x);
	spd_add_material(s, (struct spd_material){ { 0.737, 0.561, 0.561 }, 0.7, 0.7, 20, 0, 1 });
	spd_note_finish(s, 0.1, 0.4);
	add(s, o, &all, 1);
}

static const char *const options[] = { "tessellate", NULL };
const struct spd_family spd_jacks = { "jacks", "(8^size-1)/7 jacks of three cylinders and six spheres", 1, 1, 8, fill, options };
