/* Four rows of six round arches on a floor; stands in for "Arches" (4818 polygons) of Subramanian and Fussell 1990. An arch is a half
 * ring of 40 segments with four faces each on two piers of five courses; the floor has 18 tiles. */
#include "spd/common.h"

enum { COLUMNS = 6, ROWS = 4, SEGMENTS = 40, COURSES = 5 };

#define INNER 1.0   /* radius of the opening */
#define OUTER 1.35
#define THICK 0.5
#define SPRING 2.0  /* height of the piers */
#define PITCH 3.2   /* from arch to arch */
#define DEPTH 3.0   /* from row to row */

static const struct spd_material stone = { { 0.78, 0.70, 0.55 }, 0.8, 0.2, 12, 0, 1 };
static const struct spd_material tile = { { 0.45, 0.42, 0.40 }, 0.7, 0.3, 8, 0, 1 };

/* A corner of the ring's cross-section number i. bit 0: outer, bit 1: back. */
static struct vec ring_corner(struct vec o, int i, int corner)
{
	double angle = SPD_PI * i / SEGMENTS, r = corner & 1 ? OUTER : INNER;
	return vec_add(o, vec(-r * cos(angle), corner & 2 ? THICK : 0, SPRING + r * sin(angle)));
}

static void add_ring(struct scene *s, struct vec o)
{
	static const int face[4][2] = { { 0, 1 }, { 1, 3 }, { 3, 2 }, { 2, 0 } };
	for (int i = 0; i < SEGMENTS; i++)
		for (int f = 0; f < 4; f++)
			spd_add_quad(s, ring_corner(o, i, face[f][0]), ring_corner(o, i, face[f][1]), ring_corner(o, i + 1, face[f][1]),
			             ring_corner(o, i + 1, face[f][0]));
}

static void add_pier(struct scene *s, struct vec o)
{
	const double wide = OUTER - INNER;
	const struct vec corner[4] = { o, vec_add(o, vec(wide, 0, 0)), vec_add(o, vec(wide, THICK, 0)), vec_add(o, vec(0, THICK, 0)) };
	for (int c = 0; c < COURSES; c++)
		for (int i = 0; i < 4; i++) {
			struct vec low = vec(0, 0, SPRING * c / COURSES), high = vec(0, 0, SPRING * (c + 1) / COURSES);
			const struct vec *p = &corner[i], *q = &corner[(i + 1) % 4];
			spd_add_quad(s, vec_add(*p, low), vec_add(*q, low), vec_add(*q, high), vec_add(*p, high));
		}
}

static void add_floor(struct scene *s, double wide, double deep)
{
	for (int y = 0; y < 3; y++)
		for (int x = 0; x < 6; x++) {
			double x0 = wide * x / 6, x1 = wide * (x + 1) / 6, y0 = deep * y / 3, y1 = deep * (y + 1) / 3;
			spd_add_quad(s, vec(x0, y0, 0), vec(x1, y0, 0), vec(x1, y1, 0), vec(x0, y1, 0));
		}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	const double wide = PITCH * COLUMNS, deep = DEPTH * ROWS;
	(void)o;
	spd_set_sky(s);
	spd_set_view(s, vec(-0.35 * wide, -1.1 * deep, 9), vec(wide / 2, deep / 2, 1.2), vec(0, 0, 1), 48.5, 0.01);
	scene_add_light(s, vec(-10, -20, 30));
	scene_add_light(s, vec(25, -15, 20));
	spd_add_material(s, tile);
	add_floor(s, wide, deep);
	spd_add_material(s, stone);
	for (int row = 0; row < ROWS; row++)
		for (int column = 0; column < COLUMNS; column++) {
			struct vec at = vec(PITCH * (column + 0.5), DEPTH * (row + 0.5) - THICK / 2, 0);
			add_ring(s, at);
			add_pier(s, vec_add(at, vec(-OUTER, 0, 0)));
			add_pier(s, vec_add(at, vec(INNER, 0, 0)));
		}
}

static const char *const options[] = { NULL };
const struct spd_family spd_arches = { "arches", "four rows of six round arches, 4818 polygons", 0, 0, 0, fill, options };
