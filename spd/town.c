/* A town on a river; stands in for the model of Rosslyn, Virginia. The terrain is a strip of size x size cells of two triangles, a
 * channel with the river at x = 0, and hills that roll gently behind it. A front of 3/2 size towers follows the curved bank in two
 * staggered rows; low houses with gable roofs line the streets behind. The unit is a cell, about 25 m. */
#include "base/rng.h"
#include "spd/common.h"

enum { STREAM_HILL = 1, STREAM_TOWER, STREAM_HOUSE };
enum { DRAW_HERE, DRAW_X, DRAW_Y, DRAW_LONG, DRAW_WIDE, DRAW_TALL, DRAW_WAY };

#define BED (-0.8)
#define WATER (-0.3)
#define FRONT 2.6 /* how far from the bank the towers end */
#define EYE 0.07
#define SINK 0.05 /* how deep walls reach below the lowest ground under them */

static const struct material grass = { { 0.42, 0.55, 0.30 }, 0.9, 0, 1, 0, 1 };
static const struct material water = { { 0.20, 0.32, 0.42 }, 0.6, 0.3, 100, 0, 1 };
static const struct material office[2] = {
	{ { 0.78, 0.76, 0.72 }, 0.85, 0.05, 11, 0, 1 },
	{ { 0.40, 0.58, 0.70 }, 0.6, 0.3, 60, 0, 1 }, /* glass */
};
static const struct material plaster = { { 0.88, 0.82, 0.70 }, 0.9, 0, 1, 0, 1 };
static const struct material tile = { { 0.62, 0.30, 0.22 }, 0.85, 0.05, 11, 0, 1 };

struct town {
	struct scene *scene;
	uint64_t seed;
	int size;
};

/* An upright box: centre, unit vector along it in the plane, half length and half width, where it begins and ends. */
struct upright {
	double x, y, along_x, along_y, length, width, foot, top;
};

/* The point at u half lengths along and v half widths to the left. */
static struct vec place(const struct upright *b, double u, double v, double z)
{
	return vec(b->x + u * b->length * b->along_x - v * b->width * b->along_y,
	           b->y + u * b->length * b->along_y + v * b->width * b->along_x, z);
}

/* 0 up to 0, 1 from 1 on, smooth between. */
static double ease(double x)
{
	x = fmin(fmax(x, 0), 1);
	return x * x * (3 - 2 * x);
}

/* The x of the river bank. */
static double bank(const struct town *t, double y)
{
	double f = y / t->size;
	return t->size * (0.15 + 0.4 * f * (1 - f));
}

/* A vertex of the terrain: bed and bank of the river, then hills between the points of a wide lattice. */
static struct vec vertex(const struct town *t, int x, int y)
{
	double inland = x - bank(t, y), u = ease(x % 8 / 8.0), v = ease(y % 8 / 8.0), hill = 0;
	if (inland < 0)
		return vec(x, y, BED * ease(-inland / 1.5));
	for (int k = 0; k < 4; k++) {
		int i = x / 8 + k % 2, j = y / 8 + k / 2;
		double share = (k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v);
		hill += share * rng_uniform(rng_key(t->seed, STREAM_HILL, (uint64_t)(i * 4096 + j)), 0);
	}
	return vec(x, y, 0.03 * inland + 1.4 * ease(inland / 10) * hill);
}

/* Raise *foot and *top, given from the ground, to where the ground below the box is lowest and highest. */
static void stand(const struct town *t, struct upright *b)
{
	double reach_x = b->length * fabs(b->along_x) + b->width * fabs(b->along_y);
	double reach_y = b->length * fabs(b->along_y) + b->width * fabs(b->along_x);
	double low = HUGE_VAL, high = -HUGE_VAL;
	for (int y = (int)floor(b->y - reach_y); y <= (int)ceil(b->y + reach_y); y++)
		for (int x = (int)floor(b->x - reach_x); x <= (int)ceil(b->x + reach_x); x++) {
			low = fmin(low, vertex(t, x, y).z);
			high = fmax(high, vertex(t, x, y).z);
		}
	b->foot = low - SINK;
	b->top += high;
}

static void add_terrain(const struct town *t)
{
	scene_add_material(t->scene, grass);
	for (int y = 0; y < t->size; y++)
		for (int x = 0; x < t->size; x++) {
			struct vec a = vertex(t, x, y), c = vertex(t, x + 1, y + 1);
			spd_add_triangle(t->scene, a, vertex(t, x + 1, y), c);
			spd_add_triangle(t->scene, c, vertex(t, x, y + 1), a);
		}
	double shore = 0.25 * t->size;
	scene_add_material(t->scene, water);
	spd_add_quad(t->scene, vec(0, 0, WATER), vec(shore, 0, WATER), vec(shore, t->size, WATER), vec(0, t->size, WATER));
}

/* Tower i of the front, a box turned as the bank is. */
static void add_tower(const struct town *t, int i, int count)
{
	uint64_t key = rng_key(t->seed, STREAM_TOWER, (uint64_t)i);
	double y = t->size * (i + 0.5) / count, slope = bank(t, y + 0.5) - bank(t, y - 0.5), steep = sqrt(1 + slope * slope);
	struct upright b = { bank(t, y) + 0.7 + i % 2, y, slope / steep, 1 / steep, 0.15 + 0.07 * rng_uniform(key, DRAW_LONG),
		             0.2 + 0.1 * rng_uniform(key, DRAW_WIDE), 0, 1.2 + 2.8 * rng_uniform(key, DRAW_TALL) };
	stand(t, &b);
	for (int turn = 1; turn >= -1; turn -= 2) {
		struct vec p = place(&b, turn, -turn, b.foot), q = place(&b, turn, turn, b.foot);
		struct vec r = place(&b, -turn, turn, b.foot), up = vec(0, 0, b.top - b.foot);
		spd_add_quad(t->scene, p, q, vec_add(q, up), vec_add(p, up));
		spd_add_quad(t->scene, q, r, vec_add(r, up), vec_add(q, up));
	}
	spd_add_quad(t->scene, place(&b, -1, -1, b.top), place(&b, 1, -1, b.top), place(&b, 1, 1, b.top), place(&b, -1, 1, b.top));
}

/* The house of a cell, if one stands there: its walls, or its roof. Both halves are one shape, turned by half a circle. */
static void add_house(const struct town *t, int x, int y, bool roof)
{
	uint64_t key = rng_key(t->seed, STREAM_HOUSE, (uint64_t)(x * 4096 + y));
	if ((t->size - 1 - x) % 3 == 0 || x < bank(t, y + 0.5) + FRONT || rng_uniform(key, DRAW_HERE) >= 0.6)
		return;
	bool across = rng_uniform(key, DRAW_WAY) < 0.3;
	struct upright b = { x + 0.4 + 0.2 * rng_uniform(key, DRAW_X), y + 0.4 + 0.2 * rng_uniform(key, DRAW_Y), across, !across,
		             0.22 + 0.12 * rng_uniform(key, DRAW_LONG), 0.14 + 0.08 * rng_uniform(key, DRAW_WIDE), 0,
		             0.16 + 0.16 * rng_uniform(key, DRAW_TALL) };
	stand(t, &b);
	double ridge = b.top + 0.8 * b.width;
	for (int k = 1; k >= -1; k -= 2) {
		struct vec left = place(&b, -k, -k, b.top), right = place(&b, k, -k, b.top), foot = place(&b, k, -k, b.foot);
		struct vec peak = place(&b, k, 0, ridge), back = place(&b, k, k, b.top);
		if (roof) {
			spd_add_quad(t->scene, left, right, peak, place(&b, -k, 0, ridge));
			continue;
		}
		spd_add_quad(t->scene, place(&b, -k, -k, b.foot), foot, right, left);
		scene_add_polygon(t->scene, (const struct vec[5]){ foot, place(&b, k, k, b.foot), back, peak, right }, 5);
	}
}

/* Over the river, or in the street nearest to the front, looking along it. */
static void set_camera(const struct town *t, int camera)
{
	double n = t->size;
	if (camera == SPD_EXTERIOR) {
		spd_set_view(t->scene, vec(-0.22 * n, 0.12 * n, 0.48 * n), vec(0.4 * n, 0.5 * n, 0), vec(0, 0, 1), 45, 0.01);
		return;
	}
	int column = t->size - 1 - (int)((0.75 * n - FRONT - 1) / 3) * 3, row = t->size / 10;
	struct upright eye = { column + 0.5, row + 0.5, 0, 1, 0.4, 0.4, 0, EYE };
	stand(t, &eye);
	spd_set_view(t->scene, vec(eye.x, eye.y, eye.top), vec(eye.x, eye.y + 1, eye.top), vec(0, 0, 1), 60, 0.001);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	struct town t = { s, (uint64_t)o->seed, (int)o->size };
	double n = t.size;
	spd_set_sky(s);
	set_camera(&t, o->camera);
	scene_add_light(s, vec(-n, -0.5 * n, n + 10));
	scene_add_light(s, vec(-0.5 * n, 2 * n, n + 10));
	add_terrain(&t);
	for (int kind = 0; kind < 2; kind++) {
		scene_add_material(s, office[kind]);
		for (int i = 0; i < 3 * t.size / 2; i++)
			if ((rng_uniform(rng_key(t.seed, STREAM_TOWER, (uint64_t)i), DRAW_WAY) < 0.5) == kind)
				add_tower(&t, i, 3 * t.size / 2);
	}
	for (int roof = 0; roof < 2; roof++) {
		scene_add_material(s, roof ? tile : plaster);
		for (int y = 0; y < t.size; y++)
			for (int x = 0; x < t.size; x++)
				add_house(&t, x, y, roof);
	}
}

static const char *const options[] = { "camera", "seed", NULL };
const struct spd_family spd_town = { "town", "a river town on size^2 cells of terrain", 40, 4, 200, fill, options };
