/* A small room; stands in for "Scene 6" of Fabianowski, Fowler and Dingliana 2009, which has some 800 triangles: a table with 'size'
 * chairs on its long sides, a shelf with books, a lamp, a mirror. Ten boxes of shelf and table, books, and six boxes a chair. The unit
 * is the metre. */
#include "base/rng.h"
#include "spd/parts.h"

enum { BOARDS = 5, BOOKS = 10, LAMP = 16 };
enum { STREAM_BOOK = 1 };

#define WIDE 4.5
#define HIGH 2.7
#define PITCH 0.75 /* from chair to chair */
#define ENDS 3.3   /* of the room beyond the chairs */

static const struct material plaster = { { 0.86, 0.82, 0.74 }, 0.9, 0, 1, 0, 1 };
static const struct material carpet = { { 0.45, 0.15, 0.17 }, 0.9, 0, 1, 0, 1 };
static const struct material varnish = { { 0.50, 0.32, 0.18 }, 0.7, 0.2, 40, 0, 1 };
static const struct material wood = { { 0.58, 0.42, 0.26 }, 0.85, 0, 1, 0, 1 };
static const struct material mirror = { { 0.80, 0.85, 0.88 }, 0.15, 0.8, 200, 0, 1 };
static const struct material shade = { { 0.90, 0.80, 0.45 }, 0.9, 0, 1, 0, 1 };
static const struct material covers[2] = { { { 0.20, 0.30, 0.50 }, 0.9, 0, 1, 0, 1 }, { { 0.55, 0.45, 0.20 }, 0.9, 0, 1, 0, 1 } };

/* Its seat is over the origin, its back towards -y. */
static void add_chair(struct scene *s, struct vec at, bool turned)
{
	const struct vec o = vec(0, 0, 0);
	size_t first = s->object_count;
	for (int i = 0; i < 4; i++)
		spd_add_part(s, o, vec(i & 1 ? 0.17 : -0.21, i & 2 ? 0.17 : -0.21, 0), vec(0.04, 0.04, i & 2 ? 0.44 : 0.95));
	spd_add_part(s, o, vec(-0.22, -0.17, 0.44), vec(0.44, 0.40, 0.04));
	spd_add_part(s, o, vec(-0.17, -0.2, 0.65), vec(0.34, 0.025, 0.26));
	double sign = turned ? -1 : 1;
	spd_place(s, first, vec(sign, 0, 0), vec(0, sign, 0), at);
}

static void add_table(struct scene *s, double middle, double length, int64_t chairs)
{
	scene_add_material(s, varnish);
	spd_add_part(s, vec(middle, WIDE / 2, 0.72), vec(-length / 2, -0.45, 0), vec(length, 0.9, 0.04));
	scene_add_material(s, wood);
	for (int i = 0; i < 4; i++)
		spd_add_part(s, vec(middle, WIDE / 2, 0), vec(i & 1 ? length / 2 - 0.12 : 0.05 - length / 2, i & 2 ? 0.33 : -0.4, 0.02),
		             vec(0.07, 0.07, 0.7));
	for (int64_t i = 0; i < chairs; i++) {
		double along = middle - length / 2 + 0.15 + PITCH * ((double)(i / 2) + 0.5);
		add_chair(s, vec(along, WIDE / 2 + (i % 2 ? 0.68 : -0.68), 0.02), i % 2);
	}
}

static void add_shelf(struct scene *s, uint64_t seed)
{
	const struct vec at = vec(0.02, 1.2, 0);
	scene_add_material(s, wood);
	spd_add_part(s, at, vec(0, 0, 0), vec(0.02, 2.04, 2));
	for (int i = 0; i < 2; i++)
		spd_add_part(s, at, vec(0.02, i ? 2.02 : 0, 0), vec(0.3, 0.02, 2));
	for (int i = 0; i < BOARDS; i++)
		spd_add_part(s, at, vec(0.02, 0.02, 0.05 + 0.48 * i), vec(0.3, 2, 0.02));
	for (int i = 0; i < BOOKS; i++) {
		uint64_t key = rng_key(seed, STREAM_BOOK, (uint64_t)i);
		scene_add_material(s, covers[i % 2]);
		spd_add_part(s, at, vec(0.04, 0.1 + 0.36 * (i % 5) + 0.1 * rng_uniform(key, 0), i < 5 ? 0.55 : 1.03),
		             vec(0.2, 0.06 + 0.2 * rng_uniform(key, 1), 0.22 + 0.14 * rng_uniform(key, 2)));
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	static const double profile[][2] = { { 0.28, 0 }, { 0.08, 0.18 }, { 0.015, 0.2 }, { 0.015, HIGH - 1.85 } };
	double table = 0.3 + PITCH * (double)((o->size + 1) / 2), length = table + ENDS, middle = length / 2 + 0.3;
	spd_set_sky(s);
	spd_set_view(s, vec(length - 0.3, 0.4, 1.75), vec(middle - 0.8, WIDE / 2 + 0.3, 0.7), vec(0, 0, 1), 65, 0.001);
	scene_add_light(s, vec(middle, WIDE / 2, 1.8));
	scene_add_material(s, plaster);
	spd_add_hall(s, vec(0, 0, 0), vec(length, WIDE, HIGH));
	scene_add_material(s, carpet);
	spd_add_box(s, vec(middle - table / 2 - 0.5, 0.8, 0.001), vec(middle + table / 2 + 0.5, WIDE - 0.8, 0.02));
	add_table(s, middle, table, o->size);
	add_shelf(s, (uint64_t)o->seed);
	scene_add_material(s, mirror);
	spd_add_quad(s, vec(middle - 0.6, WIDE - 0.02, 1.1), vec(middle + 0.6, WIDE - 0.02, 1.1), vec(middle + 0.6, WIDE - 0.02, 2),
	             vec(middle - 0.6, WIDE - 0.02, 2));
	scene_add_material(s, shade);
	spd_add_lathe(s, vec(middle, WIDE / 2, 1.85), profile, 4, LAMP);
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_room = { "room", "a small room, a table with 'size' chairs", 6, 0, 1000, fill, options };
