/* The sphereflake: each ball carries nine of a third of its radius; (9^(size+1) - 1) / 8 balls over a square (SPD "balls").
 *
 * Programs released before 2021 turn the children of a ball that points straight up or down only when its direction is exactly
 * so; rounding then decides where some balls of size 3 and beyond sit. The variant pre2021 does as they did. */
#include "spd/common.h"

struct flake {
	struct scene *scene;
	const struct spd_options *options;
	struct vec offset[9]; /* directions to the children of a ball that points up */
	double straight;      /* z of a direction from which on it counts as straight */
};

static void set_offsets(struct flake *f)
{
	double d = 1 / sqrt(2.0);
	const struct vec trio[3] = { vec(d, d, 0), vec(d, 0, -d), vec(0, d, -d) };
	struct matrix tilt = matrix_axis_rotation(vec_unit(vec(1, -1, 0)), asin(2 / sqrt(6.0)));
	for (int k = 0; k < 3; k++) {
		struct matrix turn = matrix_rotation(2, k * 2 * SPD_PI / 3);
		for (int j = 0; j < 3; j++)
			f->offset[3 * k + j] = matrix_direction(matrix_direction(trio[j], &tilt), &turn);
	}
}

static struct matrix turn_toward(const struct flake *f, struct vec direction)
{
	const struct vec up = vec(0, 0, 1);
	if (direction.z >= f->straight)
		return matrix_identity();
	if (direction.z <= -f->straight)
		return matrix_rotation(1, SPD_PI);
	return matrix_axis_rotation(vec_unit(vec_cross(up, direction)), acos(vec_dot(up, direction)));
}

static void add(const struct flake *f, int64_t depth, struct vec center, double radius, struct vec direction)
{
	spd_add_sphere(f->scene, f->options, center, radius);
	if (depth == 0)
		return;
	struct matrix turn = turn_toward(f, direction);
	double reach = radius * (1 + 1.0 / 3);
	for (int i = 0; i < 9; i++) {
		struct vec child = vec_add(vec_scale(matrix_direction(f->offset[i], &turn), reach), center);
		struct vec out = vec_sub(child, center);
		add(f, depth - 1, child, radius * (1.0 / 3), vec(out.x / reach, out.y / reach, out.z / reach));
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(2.1, 1.3, 1.7), vec(0, 0, 0), vec(0, 0, 1), 45, 0.01);
	scene_add_light(s, vec(4, 3, 2));
	scene_add_light(s, vec(1, -4, 4));
	scene_add_light(s, vec(-3, 1, 5));
	spd_add_material(s, (struct spd_material){ { 1, 0.75, 0.33 }, 0.8, 0, 0, 0, 1 });
	spd_note_finish(s, 0.2, 0);
	spd_add_quad(s, vec(12, 12, -0.5), vec(-12, 12, -0.5), vec(-12, -12, -0.5), vec(12, -12, -0.5));
	spd_add_material(s, (struct spd_material){ { 1, 0.9, 0.7 }, 0.5, 0.5, 37, 0, 1 });
	spd_note_finish(s, 0, 0.5);
	struct flake f = { .scene = s, .options = o, .straight = o->variant == SPD_PRE2021 ? 1.0 : 0.9999 };
	set_offsets(&f);
	add(&f, o->size, vec(0, 0, 0), 0.5, vec(0, 0, 1));
}

static const char *const options[] = { "tessellate", "resolution", "variant", NULL };
const struct spd_family spd_balls = { "balls", "sphereflake, (9^(size+1)-1)/8 spheres over a square", 4, 1, 8, fill, options };
