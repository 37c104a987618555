/* A theatre; stands in for the "theater" of Smits 1999: 46,502 polygons, most of them small ones in the seats, and much open space. A
 * hall of 40 x 30 x 15 m holds 20 rising rows of 30 seats, 72 polygons each, a balcony, a stage, and lights on trusses above. */
#include "base/rng.h"
#include "spd/parts.h"

enum { ROWS = 20, SEATS = 30, STRIPS = 40, TRUSSES = 16, BARS = 32, PROPS = 5, BALCONIES = 8, PANELS = 20 };
enum { STREAM_PROP = 1 };

#define WIDE 30.0  /* along y */
#define DEEP 40.0  /* along x, from the stage to the last row */
#define HIGH 15.0
#define STAGE 10.0 /* its depth */
#define ROW 1.1
#define RISE 0.25

static const struct material plaster = { { 0.75, 0.70, 0.62 }, 0.9, 0, 1, 0, 1 };
static const struct material velvet = { { 0.55, 0.08, 0.10 }, 0.9, 0, 1, 0, 1 };
static const struct material wood = { { 0.45, 0.30, 0.18 }, 0.8, 0.1, 20, 0, 1 };
static const struct material steel = { { 0.30, 0.30, 0.32 }, 0.6, 0.3, 60, 0, 1 };

/* Twelve boxes: four legs, a bar between them, the seat, the back and its rest for the head, and two arms on posts. */
static void add_seat(struct scene *s, struct vec at)
{
	for (int i = 0; i < 4; i++)
		spd_add_part(s, at, vec(i & 1 ? 0.42 : 0.06, i & 2 ? 0.44 : 0.1, 0), vec(0.04, 0.04, 0.4));
	spd_add_part(s, at, vec(0.06, 0.26, 0.1), vec(0.4, 0.04, 0.04));
	spd_add_part(s, at, vec(0.04, 0.08, 0.4), vec(0.44, 0.42, 0.08));
	spd_add_part(s, at, vec(0.46, 0.08, 0.48), vec(0.08, 0.42, 0.5));
	spd_add_part(s, at, vec(0.48, 0.16, 0.98), vec(0.05, 0.26, 0.15));
	for (int i = 0; i < 2; i++) {
		spd_add_part(s, at, vec(0.1, i ? 0.54 : 0, 0.48), vec(0.04, 0.04, 0.16));
		spd_add_part(s, at, vec(0.08, i ? 0.53 : 0, 0.64), vec(0.4, 0.06, 0.04));
	}
}

static struct vec row_place(int row, double y)
{
	return vec(STAGE + 4 + ROW * row, y, RISE * row);
}

static void add_rows(struct scene *s)
{
	const double pitch = 0.8, side = (WIDE - SEATS * pitch) / 2;
	scene_add_material(s, wood);
	for (int row = 0; row < ROWS; row++) {
		struct vec a = row_place(row, 0), b = row_place(row, WIDE);
		struct vec up = vec(0, 0, row ? RISE : 0.02), back = vec(ROW, 0, 0);
		spd_add_quad(s, vec_sub(a, up), a, b, vec_sub(b, up));
		spd_add_quad(s, a, vec_add(a, back), vec_add(b, back), b);
	}
	scene_add_material(s, velvet);
	for (int row = 0; row < ROWS; row++)
		for (int seat = 0; seat < SEATS; seat++)
			add_seat(s, row_place(row, side + pitch * seat));
}

/* The hall seen from inside, the balcony at the back, the stage with its curtains. */
static void add_hall(struct scene *s)
{
	scene_add_material(s, plaster);
	spd_add_hall(s, vec(0, 0, 0), vec(DEEP, WIDE, HIGH));
	for (int i = 0; i < BALCONIES; i++)
		spd_add_box(s, vec(DEEP - 2.2 + 0.2 * i, 0.5, 8 + 0.15 * i), vec(DEEP - 2 + 0.2 * i, WIDE - 0.5, 8.9 + 0.15 * i));
	scene_add_material(s, wood);
	for (int i = 0; i < PANELS; i++) {
		double from = STAGE + 2 + 2.6 * (i / 2), at = i % 2 ? WIDE - 0.05 : 0.05;
		spd_add_quad(s, vec(from, at, 7), vec(from + 2, at, 7), vec(from + 2, at, 12), vec(from, at, 12));
	}
	spd_add_box(s, vec(0.01, 2, 0.01), vec(STAGE, WIDE - 2, 1));
	scene_add_material(s, velvet);
	for (int side = 0; side < 2; side++)
		for (int i = 0; i < STRIPS; i++) {
			double at = side ? WIDE - 3 - 0.1 * i : 3 + 0.1 * i, fold = i % 2 ? 0.12 : 0;
			spd_add_quad(s, vec(STAGE - 0.5 + fold, at, 1), vec(STAGE - 0.38 - fold, at + 0.1, 1), vec(STAGE - 0.38 - fold, at + 0.1, 10),
			             vec(STAGE - 0.5 + fold, at, 10));
		}
}

/* Every bar of a truss is a box: two chords in eight pieces each, and posts between them that carry the lights. */
static void add_rig(struct scene *s, uint64_t seed)
{
	scene_add_material(s, steel);
	for (int truss = 0; truss < TRUSSES; truss++)
		for (int i = 0; i < BARS; i++) {
			double x = 1 + 1.2 * truss, piece = (WIDE - 4) / 8, y = 2 + piece * (i % 8);
			if (i < 16)
				spd_add_part(s, vec(x, y, i < 8 ? 12 : 12.6), vec(0, 0, 0), vec(0.06, piece, 0.06));
			else if (i < 24)
				spd_add_part(s, vec(x, y, 12.06), vec(0.01, 0.3, 0), vec(0.04, 0.04, 0.54));
			else
				spd_add_part(s, vec(x, y, 11.6), vec(-0.1, 0.2, 0), vec(0.26, 0.24, 0.4));
		}
	scene_add_material(s, wood);
	for (int i = 0; i < PROPS; i++) {
		uint64_t key = rng_key(seed, STREAM_PROP, (uint64_t)i);
		spd_add_part(s, vec(2 + 5 * rng_uniform(key, 0), 6 + 3.6 * i, 1), vec(0, 0, 0),
		         vec(0.5 + rng_uniform(key, 1), 0.5 + rng_uniform(key, 2), 0.5 + 1.5 * rng_uniform(key, 3)));
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(DEEP - 4, WIDE / 2 - 3, 7.5), vec(STAGE / 2, WIDE / 2, 2.5), vec(0, 0, 1), 60, 0.001);
	scene_add_light(s, vec(STAGE + 3, WIDE / 2, HIGH - 1));
	scene_add_light(s, vec(DEEP / 2 + 8, WIDE / 2, HIGH - 1));
	add_hall(s);
	add_rows(s);
	add_rig(s, (uint64_t)o->seed);
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_theater = { "theater", "a theatre with 600 seats, 46502 polygons in much open space", 0, 0, 0, fill, options };
