/* The walls of an office floor without floor and ceiling; stands in for "la_wall" and "second wall", walls of a Bell Labs building.
 * size x size/2 bays of 3 m lie within four opaque outer walls, each a single rectangle. A bay has two partitions, which leave a
 * door open, and six short panels standing apart: 16 triangles, and 8 for the outer walls. The unit is the metre. */
#include "base/rng.h"
#include "spd/common.h"

enum { STREAM_BAY = 1 };
enum { DRAW_DOORS, DRAW_MIRROR = 2, DRAW_PANELS };

#define BAY 3.0
#define TALL 3.0
#define EYE 1.6
#define CELL 0.85 /* of the three by three in a bay; those of a diagonal stay free */

static const struct material stone = { { 0.72, 0.68, 0.60 }, 0.85, 0.05, 11, 0, 1 };
static const struct material paint = { { 0.88, 0.87, 0.82 }, 0.9, 0, 1, 0, 1 };
static const struct material glass = { { 0.45, 0.62, 0.70 }, 0.6, 0.3, 60, 0, 1 };

/* A wall over the line from p to q; its front is to the right of that way. */
static void add_wall(struct scene *s, struct vec p, struct vec q)
{
	struct vec up = vec(0, 0, TALL);
	spd_add_quad(s, p, q, vec_add(q, up), vec_add(p, up));
}

static void add_outer_walls(struct scene *s, double wide, double deep)
{
	const struct vec corners[4] = { vec(0, 0, 0), vec(wide, 0, 0), vec(wide, deep, 0), vec(0, deep, 0) };
	for (int i = 0; i < 4; i++)
		add_wall(s, corners[i], corners[(i + 1) % 4]);
}

/* One wall along each axis near the bay's corner; the door is at either end. */
static void add_partitions(struct scene *s, struct vec corner, uint64_t key)
{
	const double length = 1.9;
	for (int axis = 0; axis < 2; axis++) {
		struct vec from = vec_add(corner, vec(0.2, 0.2, 0)), to;
		from.a[axis] += rng_uniform(key, DRAW_DOORS + (uint64_t)axis) < 0.5 ? 0.1 : 0.8;
		to = from;
		to.a[axis] += length;
		add_wall(s, from, to);
	}
}

/* A panel in each cell off the diagonal, along x or y. */
static void add_panels(struct scene *s, struct vec corner, uint64_t key)
{
	bool mirrored = rng_uniform(key, DRAW_MIRROR) < 0.5;
	uint64_t draw = DRAW_PANELS;
	for (int i = 0; i < 9; i++) {
		if (i / 3 == (mirrored ? 2 - i % 3 : i % 3))
			continue;
		int axis = rng_uniform(key, draw) < 0.5;
		double length = 0.4 + 0.3 * rng_uniform(key, draw + 1), aside = CELL * (0.2 + 0.6 * rng_uniform(key, draw + 2));
		struct vec from = vec_add(corner, vec(0.35 + CELL * (i % 3), 0.35 + CELL * (i / 3), 0)), to;
		from.a[axis] += 0.05 + (CELL - 0.1 - length) * rng_uniform(key, draw + 3);
		from.a[1 - axis] += aside;
		to = from;
		to.a[axis] += length;
		add_wall(s, from, to);
		draw += 4;
	}
}

static struct vec bay_center(int64_t x, int64_t y, double z)
{
	return vec(BAY * (double)x + 0.35 + 1.5 * CELL, BAY * (double)y + 0.35 + 1.5 * CELL, z);
}

/* Before the front wall with a lamp at each side, or in a bay, looking diagonally through the plan, with lamps inside. */
static void set_camera(struct scene *s, const struct spd_options *o)
{
	double wide = BAY * (double)o->size;
	struct vec up = vec(0, 0, 1);
	if (o->camera == SPD_INTERIOR) {
		struct vec eye = bay_center(o->size / 4, o->size / 8, EYE);
		spd_set_view(s, eye, vec_add(eye, vec(1, 1, 0)), up, 60, 0.001);
		scene_add_light(s, bay_center(o->size / 4, o->size / 8, 0.9 * TALL));
		scene_add_light(s, bay_center(o->size / 2, o->size / 4, 0.9 * TALL));
		return;
	}
	spd_set_view(s, vec(wide / 2, -4, EYE + 0.4), vec(wide / 2, 0, TALL / 2), up, 45, 0.01);
	scene_add_light(s, vec(wide / 2 - 4, -5, 4));
	scene_add_light(s, vec(wide / 2 + 4, -5, 4));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	set_camera(s, o);
	scene_add_material(s, stone);
	add_outer_walls(s, BAY * (double)o->size, BAY * (double)(o->size / 2));
	for (int pass = 0; pass < 2; pass++) {
		scene_add_material(s, pass ? glass : paint);
		for (int64_t y = 0; y < o->size / 2; y++)
			for (int64_t x = 0; x < o->size; x++) {
				struct vec corner = vec(BAY * (double)x, BAY * (double)y, 0);
				uint64_t key = rng_key((uint64_t)o->seed, STREAM_BAY, (uint64_t)(y * o->size + x));
				if (pass)
					add_panels(s, corner, key);
				else
					add_partitions(s, corner, key);
			}
	}
}

static const char *const options[] = { "camera", "seed", NULL };
const struct spd_family spd_wall = { "wall", "the walls of an office floor, size*(size/2) bays of 16 triangles", 12, 2, 64, fill,
	                             options };
