/* A Sierpinski tetrahedron: 4^size triangles (SPD "tetra"). */
#include "spd/common.h"

static const struct vec apexes[4] = { { { { -1, -1, 1 } } }, { { { -1, 1, -1 } } }, { { { 1, -1, -1 } } }, { { { 1, 1, 1 } } } };

static void add(struct scene *s, int64_t depth, struct vec center, double width)
{
	if (depth > 1) {
		for (int i = 0; i < 4; i++)
			add(s, depth - 1, vec_add(center, vec_scale(apexes[i], width / 2)), width / 2);
		return;
	}
	struct vec q[4];
	for (int i = 0; i < 4; i++)
		q[i] = vec_add(center, vec_scale(apexes[i], width));
	spd_add_triangle(s, q[0], q[1], q[2]);
	spd_add_triangle(s, q[3], q[2], q[1]);
	spd_add_triangle(s, q[2], q[3], q[0]);
	spd_add_triangle(s, q[1], q[0], q[3]);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(1.022846, -3.177154, -2.174512), vec(-0.004103, -0.004103, 0.216539),
	             vec(-0.816497, -0.816497, 0.816497), 45, 1);
	scene_add_light(s, vec(2, -18, -5));
	spd_add_material(s, (struct spd_material){ { 1, 0.2, 0.2 }, 1, 0, 0, 0, 0 });
	add(s, o->size, vec(0, 0, 0), 1);
}

static const char *const options[] = { NULL };
const struct spd_family spd_tetra = { "tetra", "Sierpinski tetrahedron, 4^size triangles", 6, 1, 13, fill, options };
