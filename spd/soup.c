/* Random triangles (Smits 1999, "Efficiency issues for ray tracing", section 4): right triangles with legs of length 1, uniform in a
 * cube and uniformly turned. The turn is a uniform unit quaternion by rejection: square roots only, so that every machine makes
 * the same soup. */
#include "base/rng.h"
#include "spd/common.h"

enum { STREAM = 1 };

/* The images of x and y under a uniform random rotation. */
static void draw_legs(uint64_t key, uint64_t dimension, struct vec *x, struct vec *y)
{
	double q[4], square;
	do {
		square = 0;
		for (int i = 0; i < 4; i++) {
			q[i] = 2 * rng_uniform(key, dimension++) - 1;
			square += q[i] * q[i];
		}
	} while (square > 1 || square < 1e-6);
	for (int i = 0; i < 4; i++)
		q[i] /= sqrt(square);
	*x = vec(1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] + q[0] * q[3]), 2 * (q[1] * q[3] - q[0] * q[2]));
	*y = vec(2 * (q[1] * q[2] - q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] + q[0] * q[1]));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	double far = 2 * o->cube;
	spd_set_sky(s);
	spd_set_view(s, vec(far, 0.7 * far, 0.6 * far), vec(o->cube / 2, o->cube / 2, o->cube / 2), vec(0, 0, 1), 45, 0.01);
	scene_add_light(s, vec(far, 0, 2 * far));
	spd_add_material(s, (struct spd_material){ { 0.8, 0.8, 0.8 }, 0.8, 0.2, 30, 0, 1 });
	for (int64_t i = 0; i < o->count; i++) {
		uint64_t key = rng_key((uint64_t)o->seed, STREAM, (uint64_t)i);
		struct vec corner = vec(o->cube * rng_uniform(key, 0), o->cube * rng_uniform(key, 1), o->cube * rng_uniform(key, 2));
		struct vec x, y;
		draw_legs(key, 3, &x, &y);
		spd_add_triangle(s, corner, vec_add(corner, x), vec_add(corner, y));
	}
}

static const char *const options[] = { "count", "cube", "seed", NULL };
const struct spd_family spd_soup_family = { "soup", "'count' random unit right triangles in a cube", 0, 0, 0, fill, options };
