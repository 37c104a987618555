/* A conference room; stands in for that of Fabianowski, Fowler and Dingliana 2009: an oval table with 'size' upholstered swivel chairs,
 * a glass, a microphone and papers before each, lamps in the ceiling, blinds, plants. The unit is the metre. */
#include "base/rng.h"
#include "spd/parts.h"

enum { SIDES = 64, TURNS = 1024, LEGS = 5, STALK = 12, LAMPS = 18, WINDOWS = 5, SLATS = 40, PLANTS = 4, LEAVES = 3000, ARM = 16 };
enum { STREAM_LEAF = 1, STREAM_PAPER };

#define HIGH 3.2
#define TABLE 0.74 /* its height */

static const struct material plaster = { { 0.84, 0.82, 0.78 }, 0.9, 0, 1, 0, 1 };
static const struct material carpet = { { 0.32, 0.34, 0.40 }, 0.9, 0, 1, 0, 1 };
static const struct material walnut = { { 0.42, 0.26, 0.15 }, 0.65, 0.25, 60, 0, 1 };
static const struct material leather = { { 0.16, 0.17, 0.20 }, 0.8, 0.08, 20, 0, 1 };
static const struct material chrome = { { 0.75, 0.76, 0.78 }, 0.3, 0.6, 150, 0, 1 };
static const struct material glass = { { 0.80, 0.88, 0.90 }, 0.4, 0.4, 150, 0, 1 };
static const struct material paper = { { 0.95, 0.95, 0.93 }, 0.9, 0, 1, 0, 1 };
static const struct material leaf = { { 0.18, 0.42, 0.16 }, 0.85, 0, 1, 0, 1 };
static const struct material clay = { { 0.60, 0.33, 0.22 }, 0.9, 0, 1, 0, 1 };

static const struct vec x_axis = { { { 1, 0, 0 } } }, y_axis = { { { 0, 1, 0 } } };

/* Scale what was added from number 'first' on. */
static void stretch(struct scene *s, size_t first, double x, double y)
{
	const struct matrix m = matrix_scale(x, y, 1);
	spd_transform(s, first, &m);
}

/* Half the table's length and width. */
struct oval {
	double a, b;
};

static void add_table(struct scene *s, struct vec at, const struct oval *o)
{
	static const double top[][2] = { { 0, TABLE - 0.06 }, { 0.9, TABLE - 0.06 }, { 0.96, TABLE - 0.055 }, { 0.985, TABLE - 0.045 },
		                         { 1, TABLE - 0.03 }, { 1, TABLE - 0.015 }, { 0.99, TABLE - 0.005 }, { 0.98, TABLE },
		                         { 0.7, TABLE }, { 0.35, TABLE }, { 0, TABLE } };
	static const double foot[][2] = { { 0.36, 0 }, { 0.36, 0.04 }, { 0.2, 0.08 }, { 0.14, 0.2 }, { 0.14, 0.5 }, { 0.3, TABLE - 0.06 } };
	size_t first = s->object_count;
	scene_add_material(s, walnut);
	spd_add_lathe(s, vec(0, 0, 0), top, sizeof top / sizeof *top, 2 * SIDES);
	stretch(s, first, o->a, o->b);
	for (int i = -1; i <= 1; i++)
		spd_add_lathe(s, vec(0.55 * o->a * i, 0, 0), foot, sizeof foot / sizeof *foot, SIDES);
	spd_place(s, first, x_axis, y_axis, at);
}

/* The seat over the origin, the back towards -y. */
static void add_chair(struct scene *s)
{
	static const double post[][2] = { { 0.03, 0.1 }, { 0.03, 0.3 }, { 0.05, 0.32 }, { 0.05, 0.4 } };
	scene_add_material(s, leather);
	spd_add_blob(s, vec(0, 0, 0.46), vec(0.26, 0.25, 0.06), 17, true);
	spd_add_blob(s, vec(0, -0.25, 0.8), vec(0.24, 0.05, 0.28), 20, true);
	spd_add_blob(s, vec(0, -0.24, 1.14), vec(0.16, 0.05, 0.09), 10, true);
	for (int side = -1; side <= 1; side += 2)
		spd_add_blob(s, vec(0.29 * side, -0.02, 0.68), vec(0.035, 0.16, 0.025), 6, true);
	scene_add_material(s, chrome);
	for (int side = -1; side <= 1; side += 2) {
		struct vec outer[ARM + 1], inner[ARM + 1];
		for (int i = 0; i <= ARM; i++) {
			struct vec d = spd_turn(i, 2 * ARM);
			outer[i] = vec(0.27 * side, 0.02 + 0.16 * d.x, 0.46 + 0.21 * d.y);
			inner[i] = vec(0.27 * side, 0.02 + 0.13 * d.x, 0.46 + 0.18 * d.y);
		}
		spd_add_rib(s, outer, inner, ARM + 1, x_axis, 0.015);
	}
	spd_add_lathe(s, vec(0, 0, 0), post, sizeof post / sizeof *post, SIDES / 4);
	for (int leg = 0; leg < LEGS; leg++) {
		struct vec d = spd_turn(leg * TURNS / LEGS, TURNS), outer[4], inner[4];
		for (int i = 0; i < 4; i++) {
			outer[i] = vec_add(vec_scale(d, 0.02 + 0.1 * i), vec(0, 0, 0.13 - 0.015 * i));
			inner[i] = vec_sub(outer[i], vec(0, 0, 0.03));
		}
		spd_add_rib(s, outer, inner, 4, vec(-d.y, d.x, 0), 0.02);
		spd_add_blob(s, vec_add(vec_scale(d, 0.32), vec(0, 0, 0.03)), vec(0.03, 0.03, 0.03), 4, false);
	}
}

/* What lies and stands on the table before a chair at the origin that looks towards +y. */
static void add_place(struct scene *s, uint64_t key)
{
	static const double tumbler[][2] = { { 0, 0 }, { 0.03, 0 }, { 0.032, 0.01 }, { 0.034, 0.06 }, { 0.036, 0.11 },
		                             { 0.033, 0.11 }, { 0.03, 0.05 }, { 0, 0.02 } };
	const struct vec at = vec(0, 0.62, TABLE + 0.001);
	const struct vec turn = vec_unit(vec(1, 0.4 * rng_uniform(key, 0) - 0.2, 0)), tilt = vec(-turn.y, turn.x, 0);
	struct vec outer[STALK + 1], inner[STALK + 1];
	scene_add_material(s, glass);
	spd_add_lathe(s, vec_add(at, vec(0.26, 0.12, 0)), tumbler, sizeof tumbler / sizeof *tumbler, SIDES / 2);
	scene_add_material(s, chrome);
	for (int i = 0; i <= STALK; i++) {
		double t = (double)i / STALK;
		outer[i] = vec_add(at, vec(-0.25, 0.25 - 0.15 * t * t, 0.3 * t));
		inner[i] = vec_add(outer[i], vec(0, 0.008, 0));
	}
	spd_add_rib(s, outer, inner, STALK + 1, x_axis, 0.004);
	spd_add_blob(s, outer[STALK], vec(0.014, 0.014, 0.02), 6, false);
	scene_add_material(s, paper);
	for (int i = 0; i < 2; i++) {
		struct vec o = vec_add(at, vec(-0.02, 0.1, 0.001 * i)), u = vec_scale(turn, 0.1), v = vec_scale(tilt, 0.14);
		o.x += 0.03 * i;
		spd_add_quad(s, vec_sub(vec_sub(o, u), v), vec_sub(vec_add(o, u), v), vec_add(vec_add(o, u), v), vec_add(vec_sub(o, u), v));
	}
}

static void add_seats(struct scene *s, struct vec at, const struct oval *o, int64_t chairs, uint64_t seed)
{
	for (int64_t i = 0; i < chairs; i++) {
		struct vec d = spd_turn((int)((TURNS * i + TURNS / 2) / chairs), TURNS), out = vec_unit(vec(d.x / o->a, d.y / o->b, 0));
		struct vec place = vec(o->a * d.x + 0.35 * out.x, o->b * d.y + 0.35 * out.y, 0);
		size_t first = s->object_count;
		add_chair(s);
		add_place(s, rng_key(seed, STREAM_PAPER, (uint64_t)i));
		spd_place(s, first, vec(-out.y, out.x, 0), vec_scale(out, -1), vec_add(at, place));
	}
}

static void add_plant(struct scene *s, struct vec at, uint64_t seed, uint64_t number)
{
	static const double pot[][2] = { { 0.16, 0 }, { 0.2, 0.35 }, { 0.23, 0.36 }, { 0.23, 0.42 }, { 0.2, 0.42 }, { 0, 0.38 } };
	static const double trunk[][2] = { { 0.03, 0.35 }, { 0.025, 1.2 } };
	scene_add_material(s, clay);
	spd_add_lathe(s, at, pot, sizeof pot / sizeof *pot, SIDES / 2);
	spd_add_lathe(s, at, trunk, 2, SIDES / 4);
	scene_add_material(s, leaf);
	for (int i = 0; i < LEAVES; i++) {
		uint64_t key = rng_key(seed, STREAM_LEAF + 2 * (number + 1), (uint64_t)i), draw = 0;
		struct vec p[3];
		do {
			for (int k = 0; k < 3; k++)
				p[0].a[k] = 2 * rng_uniform(key, draw++) - 1;
		} while (vec_dot(p[0], p[0]) > 1);
		p[0] = vec_add(at, vec(0.42 * p[0].x, 0.42 * p[0].y, 1.35 + 0.5 * p[0].z));
		for (int c = 1; c < 3; c++)
			for (int k = 0; k < 3; k++)
				p[c].a[k] = p[0].a[k] + (k < 2 ? 0.1 * rng_uniform(key, draw++) - 0.05 : 0.05 * rng_uniform(key, draw++) - 0.04);
		spd_add_triangle(s, p[0], p[1], p[2]);
	}
}

/* The room itself, lamps in its ceiling, blinds on one long wall and a screen on a short one. */
static void add_shell(struct scene *s, double length, double width)
{
	static const double lamp[][2] = { { 0.05, 0.1 }, { 0.1, 0.09 }, { 0.2, 0.05 }, { 0.22, 0 }, { 0, 0 } };
	scene_add_material(s, plaster);
	spd_add_hall(s, vec(0, 0, 0), vec(length, width, HIGH));
	scene_add_material(s, carpet);
	spd_add_quad(s, vec(0.02, 0.02, 0.001), vec(length - 0.02, 0.02, 0.001), vec(length - 0.02, width - 0.02, 0.001),
	             vec(0.02, width - 0.02, 0.001));
	scene_add_material(s, paper);
	spd_add_quad(s, vec(0.03, width / 2 - 1.2, 1), vec(0.03, width / 2 + 1.2, 1), vec(0.03, width / 2 + 1.2, 2.6),
	             vec(0.03, width / 2 - 1.2, 2.6));
	scene_add_material(s, chrome);
	for (int i = 0; i < LAMPS; i++)
		spd_add_lathe(s, vec(length * (i % 6 + 0.5) / 6, width * (i / 6 + 0.5) / 3, HIGH - 0.12), lamp, sizeof lamp / sizeof *lamp, SIDES / 2);
	for (int w = 0; w < WINDOWS; w++) {
		double from = length * (w + 0.15) / WINDOWS, to = length * (w + 0.85) / WINDOWS;
		for (int i = 0; i < SLATS; i++)
			spd_add_box(s, vec(from, width - 0.07, 0.9 + 0.045 * i), vec(to, width - 0.035, 0.905 + 0.045 * i));
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	/* Chairs stand 0.68 m apart along an oval twice as long as wide, whose way around is nearly 4.84 times its half length. */
	double reach = 0.68 / 4.84 * (double)(o->size > 10 ? o->size : 10), length = 2 * reach + 5, width = reach + 4.4;
	const struct oval oval = { reach, reach / 2 };
	const struct vec middle = vec(length / 2, width / 2, 0);
	spd_set_sky(s);
	spd_set_view(s, vec(length - 0.6, 0.7, 1.9), vec(length / 2 - 0.6, width / 2 + 0.2, 0.7), vec(0, 0, 1), 60, 0.001);
	scene_add_light(s, vec(length * 0.52, width * 0.45, HIGH - 0.4));
	add_shell(s, length, width);
	add_table(s, middle, &oval);
	add_seats(s, middle, &oval, o->size, (uint64_t)o->seed);
	for (int i = 0; i < PLANTS; i++)
		add_plant(s, vec(i & 1 ? length - 0.6 : 0.6, i & 2 ? width - 0.6 : 0.6, 0), (uint64_t)o->seed, (uint64_t)i);
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_conference = { "conference", "a conference room, an oval table with size chairs", 20, 0, 1000, fill, options };
