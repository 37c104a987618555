/* size^3 meshing gears over a square; their faces are concave polygons of 144 corners (SPD "gears"). */
#include "spd/common.h"

enum { TEETH = 36, RIM = 4 * TEETH };
#define EDGE (1.0 - 0.9) /* how much smaller than the outer radius the inner one is */

static double fraction(double x)
{
	return x - (int)x;
}

static void add_material(struct scene *s, int x, int y, int z)
{
	double r = 0.01 + fraction((3 * x + 2 * y + z + 1) * 5 / 7.0);
	double g = 0.01 + fraction((3 * y + 2 * z + x + 1) * 3 / 7.0);
	double b = 0.01 + fraction((3 * z + 2 * x + y + 1) * 2 / 7.0);
	double most = r > g ? r : g;
	most = most > b ? most : b;
	struct color color = { r / most, g / most, b / most };
	if ((4 * x + 2 * y + z) % 5 == 0)
		spd_add_material(s, (struct spd_material){ color, 0.2, 0, 0, 0.8, 1.1 });
	else
		spd_add_material(s, (struct spd_material){ color, 1, 0, 0, 0, 0 });
}

/* The corners of a face: four a tooth. way: +1 for the top face, -1 for the bottom one. */
static void list_rim(struct vec *rim, struct vec center, double phase, double outer, double inner, double below, int way)
{
	static const double place[4] = { -0.19, 0.19, 0.3, 0.7 };
	double tooth = way * (2 * SPD_PI / TEETH);
	for (int i = 0; i < RIM; i++) {
		double angle = phase + way * (2 * SPD_PI * (i / 4) / TEETH);
		struct matrix turn = matrix_rotation(2, angle + place[i % 4] * tooth);
		rim[i] = vec_add(matrix_point(vec(i % 4 < 2 ? outer : inner, 0, -below), &turn), center);
	}
}

static void add_gear(struct scene *s, struct vec center, double phase, double outer, double inner, double thickness)
{
	struct vec rim[RIM];
	list_rim(rim, center, phase, outer, inner, 0, 1);
	scene_add_polygon(s, rim, RIM);
	for (int i = 0; i < RIM; i++) {
		struct vec p = rim[i], q = rim[(i + 1) % RIM], down = vec(0, 0, thickness);
		spd_add_quad(s, p, vec_sub(p, down), vec_sub(q, down), q);
	}
	list_rim(rim, center, phase, outer, inner, thickness, -1);
	scene_add_polygon(s, rim, RIM);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(-1.1, -2.1, 2.6), vec(0, 0, 0), vec(0, 0, 1), 45, 1);
	scene_add_light(s, vec(2, 4, 4));
	scene_add_light(s, vec(-2, 4, 3));
	scene_add_light(s, vec(2, -2.5, 2.5));
	scene_add_light(s, vec(-1, -4, 2));
	scene_add_light(s, vec(-1.111, -2.121, 2.626));
	spd_add_material(s, (struct spd_material){ { 1, 0.85, 0.7 }, 0.3, 0.6, 37, 0, 0 });
	spd_note_finish(s, 0, 0.3);
	spd_add_quad(s, vec(2, 2, 0), vec(-2, 2, 0), vec(-2, -2, 0), vec(2, -2, 0));
	int size = (int)o->size;
	double outer = 1.0 / (size - (size - 1) * EDGE / 2), start = -1 + outer, step = outer * (2 - EDGE);
	double thickness = 1.0 / (2 * size) < 0.1 ? 1.0 / (2 * size) : 0.1;
	for (int z = 0; z < size; z++)
		for (int y = 0; y < size; y++)
			for (int x = 0; x < size; x++) {
				struct vec center = vec(start + x * step, start + y * step, 1 + z * (-1.0 / size));
				add_material(s, x, y, z);
				add_gear(s, center, SPD_PI * ((x + y + z) % 2) / TEETH, 0.995 * outer, (1.0 - EDGE) * outer, thickness);
			}
}

static const char *const options[] = { NULL };
const struct spd_family spd_gears = { "gears", "size^3 gears with concave faces over a square", 4, 1, 200, fill, options };
