/* A laboratory; stands in for the "lab" of Smits 1999, a science center of 4,045 polygons: 12 benches with drawers and instruments,
 * stools, columns, shelves, and a grid with lamps below the ceiling, in a room of 30 x 20 m. */
#include "base/rng.h"
#include "spd/parts.h"

enum { BENCHES = 12, DRAWERS = 9, INSTRUMENTS = 20, STOOLS = 24, COLUMNS = 8, LAMPS = 40, SHELVES = 29, BOARDS = 5 };
enum { STREAM_INSTRUMENT = 1 };

#define LONG 30.0
#define WIDE 20.0
#define HIGH 3.6
#define GRID 3.0 /* height of the grid */

static const struct material plaster = { { 0.85, 0.85, 0.82 }, 0.9, 0, 1, 0, 1 };
static const struct material wood = { { 0.55, 0.40, 0.25 }, 0.8, 0.1, 20, 0, 1 };
static const struct material metal = { { 0.60, 0.62, 0.65 }, 0.5, 0.4, 60, 0, 1 };

static void add_room(struct scene *s)
{
	scene_add_material(s, plaster);
	spd_add_hall(s, vec(0, 0, 0), vec(LONG, WIDE, HIGH));
	for (int i = 0; i < COLUMNS; i++) {
		struct vec lo = vec(5 + 6.5 * (i / 2), i % 2 ? 13.8 : 5.8, 0), hi = vec_add(lo, vec(0.4, 0.4, HIGH));
		spd_add_quad(s, lo, vec(hi.x, lo.y, 0), vec(hi.x, lo.y, HIGH), vec(lo.x, lo.y, HIGH));
		spd_add_quad(s, vec(hi.x, lo.y, 0), vec(hi.x, hi.y, 0), hi, vec(hi.x, lo.y, HIGH));
		spd_add_quad(s, vec(hi.x, hi.y, 0), vec(lo.x, hi.y, 0), vec(lo.x, hi.y, HIGH), hi);
		spd_add_quad(s, vec(lo.x, hi.y, 0), lo, vec(lo.x, lo.y, HIGH), vec(lo.x, hi.y, HIGH));
	}
	for (int i = 0; i < BOARDS; i++)
		spd_add_quad(s, vec(3 + 5 * i, 0.05, 1), vec(6 + 5 * i, 0.05, 1), vec(6 + 5 * i, 0.05, 2.2), vec(3 + 5 * i, 0.05, 2.2));
}

static void add_ceiling(struct scene *s)
{
	scene_add_material(s, metal);
	for (int i = 1; i < (int)LONG; i++)
		spd_add_box(s, vec(i - 0.02, 0.02, GRID), vec(i + 0.02, WIDE - 0.02, GRID + 0.04));
	for (int i = 1; i < (int)WIDE; i++)
		spd_add_box(s, vec(0.02, i - 0.02, GRID + 0.05), vec(LONG - 0.02, i + 0.02, GRID + 0.09));
	for (int i = 0; i < LAMPS; i++)
		spd_add_part(s, vec(2 + 3.5 * (i % 8), 2 + 4 * (i / 8), GRID - 0.2), vec(0, 0, 0), vec(1.2, 0.3, 0.1));
}

/* Top, body, drawers with handles, and on the bench two rows of instruments with a dial each. */
static void add_bench(struct scene *s, struct vec at, uint64_t seed, int bench)
{
	scene_add_material(s, wood);
	spd_add_part(s, at, vec(0, 0, 0.86), vec(5, 1.4, 0.04));
	spd_add_part(s, at, vec(0.1, 0.1, 0.05), vec(4.8, 1.2, 0.8));
	for (int i = 0; i < DRAWERS; i++) {
		double x = at.x + 0.15 + 1.58 * (i % 3), z = 0.1 + 0.25 * (i / 3), y = at.y + 0.08;
		spd_add_quad(s, vec(x, y, z), vec(x + 1.5, y, z), vec(x + 1.5, y, z + 0.22), vec(x, y, z + 0.22));
		spd_add_part(s, vec(x, y, z), vec(0.65, -0.05, 0.1), vec(0.2, 0.04, 0.03));
	}
	scene_add_material(s, metal);
	for (int i = 0; i < INSTRUMENTS; i++) {
		uint64_t key = rng_key(seed, STREAM_INSTRUMENT, (uint64_t)(bench * INSTRUMENTS + i));
		struct vec place = vec_add(at, vec(0.05 + 0.5 * (i % 10), i < 10 ? 0.1 : 0.8, 0.9));
		struct vec size = vec(0.15 + 0.3 * rng_uniform(key, 0), 0.15 + 0.3 * rng_uniform(key, 1), 0.1 + 0.4 * rng_uniform(key, 2));
		spd_add_part(s, place, vec(0, 0, 0), size);
		double y = place.y - 0.005, z = place.z + 0.02, right = place.x + size.x - 0.02, top = place.z + size.z - 0.02;
		spd_add_quad(s, vec(place.x + 0.02, y, z), vec(right, y, z), vec(right, y, top), vec(place.x + 0.02, y, top));
	}
}

static void add_furniture(struct scene *s, uint64_t seed)
{
	for (int i = 0; i < BENCHES; i++)
		add_bench(s, vec(2 + 7 * (i % 4), 3 + 5.5 * (i / 4), 0), seed, i);
	scene_add_material(s, wood);
	for (int i = 0; i < STOOLS; i++) {
		struct vec at = vec(3 + 7 * (i / 2 % 4) + 2.2 * (i % 2), 2 + 5.5 * (i / 8), 0);
		spd_add_part(s, at, vec(0, 0, 0.6), vec(0.4, 0.4, 0.05));
		for (int leg = 0; leg < 4; leg++)
			spd_add_part(s, at, vec(leg & 1 ? 0.34 : 0.02, leg & 2 ? 0.34 : 0.02, 0), vec(0.04, 0.04, 0.6));
	}
	for (int i = 0; i < SHELVES; i++)
		spd_add_part(s, vec(1 + 2.8 * (i % 10), WIDE - 0.5, 0.8 + 0.7 * (i / 10)), vec(0, 0, 0), vec(2.4, 0.4, 0.04));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(0.6, 1, 2.2), vec(18, 12, 0.8), vec(0, 0, 1), 60, 0.001);
	scene_add_light(s, vec(8, 10, 2.7));
	scene_add_light(s, vec(22, 10, 2.7));
	add_room(s);
	add_ceiling(s);
	add_furniture(s, (uint64_t)o->seed);
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_lab = { "lab", "a laboratory, 4045 polygons", 0, 0, 0, fill, options };
