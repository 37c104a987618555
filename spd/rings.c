/* Pyramids of interlocked rings, each five cylinders and five spheres long, before a wall (SPD "rings"). */
#include "spd/common.h"

enum { POINTS = 30 };
#define THICKNESS 0.07412

/* Five corners for each of the six rings of a dodecahedron's faces. */
static void list_points(struct vec *d)
{
	double q = 1 / (1 + THICKNESS);
	for (int k = 0; k < 5; k++)
		d[k] = vec(q * cos(k * 2 * SPD_PI / 5), q * sin(k * 2 * SPD_PI / 5), 0);
	struct matrix tilt = matrix_rotation(0, 2 * acos(cos(SPD_PI / 3) / sin(SPD_PI / 5)));
	for (int p = 1; p < 6; p++) {
		struct matrix turn = matrix_rotation(2, SPD_PI * (2 * (p - 1) + 1) / 5);
		for (int k = 0; k < 5; k++)
			d[5 * p + k] = matrix_direction(matrix_direction(d[k], &tilt), &turn);
	}
}

static void add_rings(struct scene *s, const struct spd_options *o, const struct vec *d, struct vec offset)
{
	static const struct color colors[6] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 1, 0, 1 }, { 1, 1, 0 } };
	for (int e = 0; e < POINTS; e++) {
		if (e % 5 == 0) {
			spd_add_material(s, (struct spd_material){ colors[e / 5], 0.5, 0.2, 37, 0, 0 });
			spd_note_finish(s, 0, 0.3);
		}
		struct vec base = vec_add(d[e], offset), apex = vec_add(d[e % 5 ? e - 1 : e + 4], offset);
		spd_add_cone(s, o, base, THICKNESS, apex, THICKNESS);
		spd_add_sphere(s, o, base, THICKNESS);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	int size = (int)o->size;
	double space = 1 / sin(SPD_PI / 8);
	spd_set_view(s, vec(-1, -space, 0.5), vec(-1, -space + 1, 0.5), vec(0, 0, 1), 45, 1);
	spd_set_sky(s);
	scene_add_light(s, vec(3, -space, 3));
	scene_add_light(s, vec(-4, -space, 1));
	scene_add_light(s, vec(2, -space, -4));
	spd_add_material(s, (struct spd_material){ { 1, 1, 1 }, 1, 0, 0, 0, 0 });
	double y = space * (size + 1), x = 1.01 * (y + space) * tan(SPD_PI / 8);
	spd_add_quad(s, vec(x - 1, y, x + 0.5), vec(-x - 1, y, x + 0.5), vec(-x - 1, y, -x + 0.5), vec(x - 1, y, -x + 0.5));
	struct vec d[POINTS];
	list_points(d);
	for (int depth = 0; depth < size; depth++)
		for (int jz = 0; jz <= depth; jz++)
			for (int jx = 0; jx <= depth; jx++)
				add_rings(s, o, d, vec(2 * jx - depth, space * (depth + 1), 2 * jz - depth));
}

static const char *const options[] = { "tessellate", "resolution", NULL };
const struct spd_family spd_rings = { "rings", "rings of cylinders and spheres before a wall, 5 s (s+1) (2s+1) of each", 7, 1, 300,
	                              fill, options };
