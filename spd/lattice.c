/* A cubic lattice of spheres joined by cylinders (SPD "lattice"). */
#include "spd/common.h"

static void fill(struct scene *s, const struct spd_options *o)
{
	static const struct vec lights[6] = {
		{ { { 2, 0.5, 0.5 } } }, { { { -1, 0.5, 0.5 } } }, { { { 0.5, 2, 0.5 } } }, { { { 0.5, -1, 0.5 } } },
		{ { { 0.5, 0.5, 2 } } }, { { { 0.5, 0.5, -1 } } },
	};
	int size = (int)o->size;
	double eye = (size / 2 + 0.5) / size;
	spd_set_sky(s);
	spd_set_view(s, vec(eye, 1, 1 - 1.0 / (2 * size)), vec(eye, -1, -1 - 1.0 / (2 * size)), vec(0.2, 1, 0), 60, 0);
	for (int i = 0; i < 6; i++)
		scene_add_light(s, lights[i]);
	double ball = 0.25 / size, bar = (1.0 / 16) / size, gap = ball * (1 - sqrt((1.0 / 16) / (1.0 / 4))) * 0.99;
	for (int i = 0; i < (size + 1) * (size + 1) * (size + 1); i++) {
		const int at[3] = { i / (size + 1) / (size + 1), i / (size + 1) % (size + 1), i % (size + 1) };
		struct vec p = vec((double)at[0] / size, (double)at[1] / size, (double)at[2] / size);
		spd_add_material(s, (struct spd_material){ { 0.9, 0.9, 0.9 }, 0.5, 0.5, 37, 0, 0 });
		spd_note_finish(s, 0, 0.5);
		spd_add_sphere(s, o, p, ball);
		for (int axis = 0; axis < 3; axis++) {
			if (at[axis] == size)
				continue;
			double color[3] = { 0.1, 0.1, 0.1 };
			color[axis] = 0.9;
			spd_add_material(s, (struct spd_material){ { color[0], color[1], color[2] }, 0.99, 0, 0, 0, 0 });
			spd_note_finish(s, 0.1, 0);
			struct vec base = p, apex = p;
			base.a[axis] += gap;
			apex.a[axis] = p.a[axis] + 1.0 / size - gap;
			spd_add_cone(s, o, base, bar, apex, bar);
		}
	}
}

static const char *const options[] = { "tessellate", "resolution", NULL };
const struct spd_family spd_lattice = { "lattice", "(size+1)^3 spheres joined by 3 size (size+1)^2 cylinders", 12, 1, 400, fill,
	                                options };
