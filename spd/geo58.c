/* Stepped towers about a court; stands in for "Geo58" (306 polygons, architecture) of Subramanian and Fussell 1990. Fifty boxes of six
 * polygons: twelve towers of four, each box narrower than the one it stands on, and two pools; on a ground of six polygons. */
#include "base/rng.h"
#include "spd/common.h"

enum { TOWERS = 12, STEPS = 4, STREAM_TOWER = 1 };

static const struct spd_material paving = { { 0.55, 0.52, 0.48 }, 0.7, 0.3, 10, 0, 1 };
static const struct spd_material wall = { { 0.80, 0.74, 0.62 }, 0.7, 0.3, 10, 0, 1 };
static const struct spd_material water = { { 0.20, 0.35, 0.45 }, 0.4, 0.6, 3, 0, 1 };

static void add_box(struct scene *s, struct vec lo, struct vec hi)
{
	static const int face[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
	spd_add_sides(s, lo, hi, face);
}

static void add_ground(struct scene *s)
{
	for (int y = 0; y < 2; y++)
		for (int x = 0; x < 3; x++)
			spd_add_quad(s, vec(-18 + 12 * x, -18 + 18 * y, 0), vec(-6 + 12 * x, -18 + 18 * y, 0), vec(-6 + 12 * x, 18 * y, 0),
			             vec(-18 + 12 * x, 18 * y, 0));
}

/* Four boxes, each on the one below; the towers stand around the court, four a side but for the corners they share. */
static void add_tower(struct scene *s, int i, uint64_t key)
{
	static const int place[TOWERS][2] = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 1 }, { 3, 2 }, { 3, 3 }, { 2, 3 }, { 1, 3 },
		                              { 0, 3 }, { 0, 2 }, { 0, 1 } };
	double x = -13.5 + 9 * place[i][0], y = -13.5 + 9 * place[i][1], half = 2.6 + rng_uniform(key, 0), z = 0;
	for (int k = 0; k < STEPS; k++) {
		double tall = (1.2 + 2.2 * rng_uniform(key, 1 + (uint64_t)k)) * (k == 0 ? 0.5 : 1);
		add_box(s, vec(x - half, y - half, z), vec(x + half, y + half, z + tall));
		z += tall;
		half *= 0.62 + 0.2 * rng_uniform(key, 5 + (uint64_t)k);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(-5.5, -6.5, 1.7), vec(4, 5, 3.0), vec(0, 0, 1), 55, 0.01);
	scene_add_light(s, vec(-40, -30, 60));
	scene_add_light(s, vec(30, -40, 50));
	scene_add_light(s, vec(0, 0, 30));
	spd_add_material(s, paving);
	add_ground(s);
	spd_add_material(s, wall);
	for (int i = 0; i < TOWERS; i++)
		add_tower(s, i, rng_key((uint64_t)o->seed, STREAM_TOWER, (uint64_t)i));
	spd_add_material(s, water);
	add_box(s, vec(-4, 1, 0), vec(-1, 4, 0.4));
	add_box(s, vec(1, -4, 0), vec(4, -1, 0.4));
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_geo58 = { "geo58", "stepped towers about a court, 306 polygons", 0, 0, 0, fill, options };
