/* A sea shell: 180 * 2^size + 1 overlapping spheres along a spiral (SPD "shells"). */
#include "spd/common.h"

static void fill(struct scene *s, const struct spd_options *o)
{
	int steps = 180 * (1 << o->size);
	spd_set_sky(s);
	spd_set_view(s, vec(-6, -60, 35), vec(0, 8, -15), vec(0, 0, 1), 45, 0.5);
	scene_add_light(s, vec(-100, -100, 100));
	spd_add_material(s, (struct spd_material){ { 1, 0.8, 0.4 }, 0.8, 0.2, 10, 0, 1 });
	spd_note_finish(s, 0, 0.5);
	for (int i = -2 * steps / 3; i <= steps / 3; i++) {
		double angle = 3 * 6 * SPD_PI * i / steps, r = exp(o->exponent * angle);
		double z = o->alpha > 0 ? o->alpha * angle : o->beta * r;
		spd_add_sphere(s, o, vec(r * sin(angle), r * cos(angle), z), r / o->gamma);
	}
}

static const char *const options[] = { "tessellate", "resolution", "exponent", "alpha", "beta", "gamma", NULL };
const struct spd_family spd_shells = { "shells", "sea shell of 180*2^size+1 spheres", 5, 1, 20, fill, options };
