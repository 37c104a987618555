/* A grid city of size x size blocks; stands in for the "lower" and "mid" Manhattan models. A block is one pitch wide and streets
 * take a fifth of it. The city has four quarters: in plan 'lower' each is turned about its own centre, shrunk to stay within its
 * ground, and its street lines are jittered; in plan 'mid' they make one regular grid of taller buildings. A quarter of the
 * blocks stays open; two buildings in five have a smaller box on top. The unit is the pitch, about 100 m. */
#include "base/rng.h"
#include "spd/common.h"

enum { STREAM_QUARTER = 1, STREAM_LINE, STREAM_BUILDING };
enum { DRAW_OPEN, DRAW_HEIGHT, DRAW_SETBACK, DRAW_KIND, DRAW_STEP, DRAW_INSET };
enum { KINDS = 4 };

#define STREET 0.2
#define EYE 0.02
#define MARGIN 1.0 /* of the ground around the blocks */

static const struct material ground = { { 0.35, 0.35, 0.36 }, 0.9, 0, 1, 0, 1 };
static const struct material kinds[KINDS] = {
	{ { 0.80, 0.76, 0.68 }, 0.9, 0, 1, 0, 1 },     /* stone */
	{ { 0.66, 0.38, 0.30 }, 0.9, 0, 1, 0, 1 },     /* brick */
	{ { 0.62, 0.63, 0.64 }, 0.85, 0.05, 11, 0, 1 }, /* concrete */
	{ { 0.40, 0.58, 0.70 }, 0.6, 0.3, 60, 0, 1 },  /* glass */
};

/* One of four. Its own coordinates have the origin at its centre and the pitch as unit; the columns of the map from them to the
 * scene are (along, aside) and (-aside, along). */
struct quarter {
	const struct spd_options *options;
	int64_t number, first[2], blocks[2]; /* first block and count, by axis */
	double center[2], along, aside, jitter;
};

/* Turn by a random angle of at most 14 degrees, given by the tangent of its half; shrink until the turned rectangle fits. */
static void turn(struct quarter *q)
{
	double half = 0.12 * (2 * rng_uniform(rng_key((uint64_t)q->options->seed, STREAM_QUARTER, (uint64_t)q->number), 0) - 1);
	double cosine = (1 - half * half) / (1 + half * half), sine = 2 * half / (1 + half * half);
	double wide = (double)q->blocks[0], deep = (double)q->blocks[1];
	double scale = fmin(wide / (wide * cosine + deep * fabs(sine)), deep / (wide * fabs(sine) + deep * cosine));
	q->along = scale * cosine;
	q->aside = scale * sine;
	q->jitter = 0.25;
}

static struct quarter make_quarter(const struct spd_options *o, int64_t number)
{
	struct quarter q = { .options = o, .number = number, .along = 1 };
	int64_t low = o->size / 2;
	for (int axis = 0; axis < 2; axis++) {
		bool high = number >> axis & 1;
		q.first[axis] = high ? low : 0;
		q.blocks[axis] = high ? o->size - low : low;
		q.center[axis] = (double)q.first[axis] + 0.5 * (double)q.blocks[axis];
	}
	if (o->plan == SPD_LOWER && q.blocks[0] > 0 && q.blocks[1] > 0)
		turn(&q);
	return q;
}

/* From the quarter's own coordinates to the scene's. */
static struct vec place(const struct quarter *q, double x, double y, double z)
{
	return vec(q->center[0] + q->along * x - q->aside * y, q->center[1] + q->aside * x + q->along * y, z);
}

/* Where street line i of an axis lies, in the quarter's own coordinates. The first and the last are its edges. */
static double street_line(const struct quarter *q, int axis, int64_t i)
{
	uint64_t key = rng_key((uint64_t)q->options->seed, STREAM_LINE, (uint64_t)(2 * q->number + axis));
	double at = (double)i - 0.5 * (double)q->blocks[axis];
	return i == 0 || i == q->blocks[axis] ? at : at + q->jitter * (2 * rng_uniform(key, (uint64_t)i) - 1);
}

/* Four walls and a roof over lo..hi. */
static void add_box(struct scene *s, const struct quarter *q, struct vec lo, struct vec hi)
{
	const double corners[4][2] = { { lo.x, lo.y }, { hi.x, lo.y }, { hi.x, hi.y }, { lo.x, hi.y } };
	struct vec foot[4], top[4];
	for (int i = 0; i < 4; i++) {
		foot[i] = place(q, corners[i][0], corners[i][1], lo.z);
		top[i] = place(q, corners[i][0], corners[i][1], hi.z);
	}
	for (int i = 0; i < 4; i++)
		spd_add_quad(s, foot[i], foot[(i + 1) % 4], top[(i + 1) % 4], top[i]);
	spd_add_quad(s, top[0], top[1], top[2], top[3]);
}

/* What stands on block (x, y) of the quarter, if it is of this kind. */
static void add_building(struct scene *s, const struct quarter *q, int64_t x, int64_t y, int kind)
{
	int64_t block = (q->first[1] + y) * q->options->size + q->first[0] + x;
	uint64_t key = rng_key((uint64_t)q->options->seed, STREAM_BUILDING, (uint64_t)block);
	if (rng_uniform(key, DRAW_OPEN) < 0.25 || (int)(KINDS * rng_uniform(key, DRAW_KIND)) != kind)
		return;
	double u = rng_uniform(key, DRAW_HEIGHT), height = (0.2 + 6 * u * u * u) * (q->options->plan == SPD_MID ? 1.7 : 1);
	struct vec lo = vec(street_line(q, 0, x) + STREET / 2, street_line(q, 1, y) + STREET / 2, 0);
	struct vec hi = vec(street_line(q, 0, x + 1) - STREET / 2, street_line(q, 1, y + 1) - STREET / 2, height);
	if (rng_uniform(key, DRAW_SETBACK) >= 0.4) {
		add_box(s, q, lo, hi);
		return;
	}
	double step = height * (0.4 + 0.4 * rng_uniform(key, DRAW_STEP)), inset = 0.12 + 0.18 * rng_uniform(key, DRAW_INSET);
	double dx = inset * (hi.x - lo.x), dy = inset * (hi.y - lo.y);
	add_box(s, q, lo, vec(hi.x, hi.y, step));
	add_box(s, q, vec(lo.x + dx, lo.y + dy, step), vec(hi.x - dx, hi.y - dy, height));
}

/* A quad under every quarter. */
static void add_ground(struct scene *s, double size, double middle)
{
	const double at[3] = { -MARGIN, middle, size + MARGIN };
	scene_add_material(s, ground);
	for (int y = 0; y < 2; y++)
		for (int x = 0; x < 2; x++)
			spd_add_quad(s, vec(at[x], at[y], 0), vec(at[x + 1], at[y], 0), vec(at[x + 1], at[y + 1], 0),
			             vec(at[x], at[y + 1], 0));
}

/* Over the city from one corner, or in the middle street of the last quarter, looking down along it through the city. */
static void set_camera(struct scene *s, const struct quarter *last)
{
	double size = (double)last->options->size, span = size + 4, deep = (double)last->blocks[1];
	struct vec up = vec(0, 0, 1), middle = vec(size / 2, size / 2, 1);
	if (last->options->camera == SPD_INTERIOR) {
		double street = street_line(last, 0, last->blocks[0] / 2), begin = 0.5 * deep - 0.5;
		spd_set_view(s, place(last, street, begin, EYE), place(last, street, begin - 1, 5 * EYE), up, 60, 0.001);
		return;
	}
	struct vec away = vec_scale(vec(-0.38, -0.66, 0.66), span);
	spd_set_view(s, vec_add(middle, away), middle, up, 45, 0.01);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	double size = (double)o->size;
	struct quarter quarters[4];
	for (int i = 0; i < 4; i++)
		quarters[i] = make_quarter(o, i);
	spd_set_sky(s);
	set_camera(s, &quarters[3]);
	scene_add_light(s, vec(-size, -0.5 * size, 2 * size + 20));
	scene_add_light(s, vec(0.6 * size, 1.6 * size, 3 * size + 20));
	add_ground(s, size, (double)(o->size / 2));
	for (int kind = 0; kind < KINDS; kind++) {
		scene_add_material(s, kinds[kind]);
		for (int i = 0; i < 4; i++)
			for (int64_t y = 0; y < quarters[i].blocks[1]; y++)
				for (int64_t x = 0; x < quarters[i].blocks[0]; x++)
					add_building(s, &quarters[i], x, y, kind);
	}
}

static const char *const options[] = { "plan", "camera", "seed", NULL };
const struct spd_family spd_city = { "city", "a grid city of size^2 blocks", 20, 1, 200, fill, options };
