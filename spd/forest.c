/* A small figure in a large wood: a winged one of 1 m on a mushroom, in the middle of 100 x 100 m of rolling ground with 'size' spruces,
 * grass and mushrooms near by. Stands in for the Fairy Forest of Fabianowski, Fowler and Dingliana 2009: most triangles lie in a
 * millionth of the volume. The unit is the metre. */
#include "base/rng.h"
#include "spd/parts.h"

enum { CELLS = 96, HILLS = 10, LAYERS = 7, BARK = 16, BLADES = 8000, MUSHROOMS = 16, SHEET = 32, BEADS = 32, STRANDS = 64, STRAND = 16 };
enum { STREAM_HILL = 1, STREAM_TREE, STREAM_BLADE, STREAM_MUSHROOM, STREAM_STRAND };

#define HALF 50.0  /* of the ground's side */
#define PERCH 0.5  /* where the figure's feet stand */

static const struct material moss = { { 0.24, 0.36, 0.14 }, 0.9, 0, 1, 0, 1 };
static const struct material needles = { { 0.12, 0.28, 0.16 }, 0.9, 0, 1, 0, 1 };
static const struct material bark = { { 0.33, 0.24, 0.16 }, 0.9, 0, 1, 0, 1 };
static const struct material grass = { { 0.36, 0.52, 0.18 }, 0.9, 0, 1, 0, 1 };
static const struct material stem = { { 0.85, 0.80, 0.68 }, 0.9, 0, 1, 0, 1 };
static const struct material cap = { { 0.70, 0.14, 0.10 }, 0.7, 0.15, 40, 0, 1 };
static const struct material skin = { { 0.90, 0.68, 0.55 }, 0.9, 0, 1, 0, 1 };
static const struct material dress = { { 0.30, 0.45, 0.75 }, 0.85, 0, 1, 0, 1 };
static const struct material hair = { { 0.72, 0.50, 0.18 }, 0.8, 0, 1, 0, 1 };
static const struct material wing = { { 0.75, 0.85, 0.90 }, 0.6, 0.3, 60, 0, 1 };
static const struct material pearl = { { 0.90, 0.88, 0.85 }, 0.5, 0.45, 120, 0, 1 };

/* Of a lattice's corner: -1 to 1. */
static double hill(uint64_t seed, int i, int k)
{
	return 2 * rng_uniform(rng_key(seed, STREAM_HILL, (uint64_t)(i * (HILLS + 2) + k)), 0) - 1;
}

/* Height of the ground: hills between the lattice's corners, flat around the middle. */
static double find_ground(uint64_t seed, double x, double y)
{
	double u = (x / HALF + 1) / 2 * HILLS, v = (y / HALF + 1) / 2 * HILLS, flat = (x * x + y * y) / (x * x + y * y + 300);
	int i = (int)u, k = (int)v;
	double f = u - i, g = v - k;
	f *= f * (3 - 2 * f);
	g *= g * (3 - 2 * g);
	return 2.5 * flat * ((1 - f) * ((1 - g) * hill(seed, i, k) + g * hill(seed, i, k + 1)) +
	                     f * ((1 - g) * hill(seed, i + 1, k) + g * hill(seed, i + 1, k + 1)));
}

static struct vec on_ground(uint64_t seed, double x, double y)
{
	return vec(x, y, find_ground(seed, x, y));
}

static void add_ground(struct scene *s, uint64_t seed)
{
	scene_add_material(s, moss);
	for (int i = 0; i < CELLS * CELLS; i++) {
		struct vec p[4];
		for (int c = 0; c < 4; c++)
			p[c] = on_ground(seed, HALF * (2.0 * (i % CELLS + (c == 1 || c == 2)) / CELLS - 1), HALF * (2.0 * (i / CELLS + c / 2) / CELLS - 1));
		spd_add_triangle(s, p[0], p[1], p[2]);
		spd_add_triangle(s, p[0], p[2], p[3]);
	}
	scene_add_material(s, grass);
	for (uint64_t i = 0; i < BLADES; i++) {
		uint64_t key = rng_key(seed, STREAM_BLADE, i);
		struct vec aside = spd_turn((int)(64 * rng_uniform(key, 0)), 64), lean = spd_turn((int)(64 * rng_uniform(key, 1)), 64);
		double reach = 7 * rng_uniform(key, 2), tall = 0.08 + 0.2 * rng_uniform(key, 3);
		struct vec d = spd_turn((int)(256 * rng_uniform(key, 4)), 256), at = on_ground(seed, d.x * reach, d.y * reach);
		struct vec tip = vec_add(at, vec_add(vec_scale(lean, 0.4 * tall), vec(0, 0, tall)));
		spd_add_triangle(s, vec_sub(at, vec_scale(aside, 0.006)), vec_add(at, vec_scale(aside, 0.006)), tip);
	}
}

/* A spruce: a trunk, and layers of branches that grow smaller. */
static void add_tree(struct scene *s, uint64_t seed, uint64_t number)
{
	uint64_t key = rng_key(seed, STREAM_TREE, number);
	double tall = 7 + 7 * rng_uniform(key, 0), profile[2 * LAYERS + 1][2];
	const double trunk[2][2] = { { 0.025 * tall, -0.5 }, { 0.012 * tall, 0.3 * tall } };
	double x = 0, y = 0;
	for (uint64_t k = 1; x * x + y * y < 100; k += 2) { /* none within 10 m of the figure */
		x = 0.96 * HALF * (2 * rng_uniform(key, k) - 1);
		y = 0.96 * HALF * (2 * rng_uniform(key, k + 1) - 1);
	}
	for (int i = 0; i < LAYERS; i++) {
		double share = (double)i / LAYERS, step = 0.85 * tall / LAYERS;
		profile[2 * i][0] = 0.24 * tall * (1 - share) + 0.1;
		profile[2 * i][1] = tall * (0.15 + 0.85 * share);
		profile[2 * i + 1][0] = i + 1 < LAYERS ? 0.4 * profile[2 * i][0] : 0;
		profile[2 * i + 1][1] = profile[2 * i][1] + 1.15 * step;
	}
	scene_add_material(s, bark);
	spd_add_lathe(s, on_ground(seed, x, y), trunk, 2, BARK);
	scene_add_material(s, needles);
	spd_add_lathe(s, on_ground(seed, x, y), (const double (*)[2])profile, 2 * LAYERS, BARK);
}

static void add_mushroom(struct scene *s, struct vec at, double tall)
{
	double profile[18][2];
	const double foot[5][2] = { { 0.2 * tall, -0.05 * tall }, { 0.16 * tall, 0.1 * tall }, { 0.12 * tall, 0.4 * tall }, 
		                      { 0.12 * tall, 0.7 * tall }, { 0.14 * tall, 0.8 * tall } };
	for (int i = 0; i < 17; i++) { /* from below the rim to the top */
		struct vec d = spd_turn(i, 64);
		profile[i + 1][0] = i < 16 ? 0.55 * tall * d.x : 0;
		profile[i + 1][1] = tall * (0.66 + 0.34 * d.y);
	}
	profile[0][0] = 0.12 * tall;
	profile[0][1] = 0.75 * tall;
	scene_add_material(s, stem);
	spd_add_lathe(s, at, foot, 5, 32);
	scene_add_material(s, cap);
	spd_add_lathe(s, at, (const double (*)[2])profile, 18, 32);
}

/* An ellipsoid from one point to another. */
static void add_limb(struct scene *s, struct vec from, struct vec to, double radius, int n)
{
	struct vec way = vec_sub(to, from), z = vec_unit(way), x = vec_unit(vec_cross(vec(0.1, 1, 0.2), z));
	size_t first = s->object_count;
	spd_add_blob(s, vec(0, 0, 0), vec(radius, radius, 0.5 * vec_length(way) + 0.4 * radius), n, false);
	spd_place(s, first, x, vec_cross(z, x), vec_scale(vec_add(from, to), 0.5));
}

/* A curved sheet from the origin to 'tip', 'wide' at most. */
static void add_wing(struct scene *s, struct vec root, struct vec tip, double wide)
{
	struct vec along = vec_sub(tip, root), across = vec_scale(vec_unit(vec_cross(along, vec(0, 1, 0))), wide);
	for (int i = 0; i < SHEET * SHEET; i++) {
		struct vec p[4];
		for (int c = 0; c < 4; c++) {
			double u = (double)(i % SHEET + (c == 1 || c == 2)) / SHEET, v = 2.0 * (i / SHEET + c / 2) / SHEET - 1;
			double half = 2 * sqrt(u * (1 - u)) * (0.4 + 0.6 * u);
			p[c] = vec_add(root, vec_add(vec_scale(along, u), vec_scale(across, v * half)));
			p[c].y += 0.2 * wide * (u * u - v * v * half);
		}
		if (i % SHEET > 0)
			spd_add_triangle(s, p[0], p[1], p[3]);
		if (i % SHEET < SHEET - 1)
			spd_add_triangle(s, p[1], p[2], p[3]);
	}
}

static void add_head(struct scene *s, uint64_t seed, struct vec at)
{
	scene_add_material(s, skin);
	spd_add_blob(s, at, vec(0.075, 0.085, 0.1), 28, false);
	scene_add_material(s, pearl);
	for (int side = -1; side <= 1; side += 2)
		spd_add_blob(s, vec_add(at, vec(0.03 * side, -0.072, 0.02)), vec(0.014, 0.014, 0.014), 10, false);
	scene_add_material(s, hair);
	spd_add_blob(s, vec_add(at, vec(0, 0.03, 0.03)), vec(0.085, 0.08, 0.09), 20, false);
	for (int i = 0; i < STRANDS; i++) {
		uint64_t key = rng_key(seed, STREAM_STRAND, (uint64_t)i);
		struct vec outer[STRAND + 1], inner[STRAND + 1], out = vec_unit(vec((double)(2 * i - STRANDS) / STRANDS, 0.8, 0));
		double length = 0.2 + 0.15 * rng_uniform(key, 0), curl = 0.03 * rng_uniform(key, 1);
		for (int k = 0; k <= STRAND; k++) {
			double t = (double)k / STRAND, far = 0.085 + 0.05 * t + curl * spd_turn(2 * k % 16, 16).y;
			outer[k] = vec_add(at, vec_add(vec_scale(out, far), vec(0, 0, 0.03 - length * t)));
			inner[k] = vec_sub(outer[k], vec_scale(out, 0.006));
		}
		spd_add_rib(s, outer, inner, STRAND + 1, vec(-out.y, out.x, 0), 0.004);
	}
}

/* Feet at the origin, looking towards -y. */
static void add_figure(struct scene *s, uint64_t seed)
{
	static const double body[][2] = { { 0.075, 0.5 }, { 0.07, 0.54 }, { 0.066, 0.57 }, { 0.07, 0.6 }, { 0.08, 0.64 }, { 0.088, 0.68 },
		                          { 0.085, 0.72 }, { 0.07, 0.75 }, { 0.035, 0.77 }, { 0.03, 0.82 } };
	double skirt[41][2];
	for (int i = 0; i <= 40; i++) { /* from the hem up; waves hang from the waist */
		double t = i / 40.0;
		skirt[i][0] = 0.075 + 0.17 * (1 - t) * (1 - 0.4 * t) + 0.012 * spd_turn(i % 8, 8).y * (1 - t);
		skirt[i][1] = 0.24 + 0.28 * t;
	}
	scene_add_material(s, dress);
	spd_add_lathe(s, vec(0, 0, 0), body, sizeof body / sizeof *body, 64);
	spd_add_lathe(s, vec(0, 0, 0), (const double (*)[2])skirt, 41, 128);
	scene_add_material(s, skin);
	for (int side = -1; side <= 1; side += 2) {
		struct vec hip = vec(0.045 * side, 0, 0.46), knee = vec(0.06 * side, -0.05, 0.25), foot = vec(0.05 * side, 0.02 * side, 0.03);
		struct vec shoulder = vec(0.085 * side, 0, 0.72), elbow = vec(0.19 * side, -0.03, 0.64 + 0.06 * side);
		struct vec hand = vec(0.24 * side, -0.12, 0.74 + 0.12 * side);
		add_limb(s, hip, knee, 0.035, 16);
		add_limb(s, knee, foot, 0.027, 16);
		add_limb(s, foot, vec_add(foot, vec(0, -0.07, -0.015)), 0.02, 16);
		add_limb(s, shoulder, elbow, 0.022, 16);
		add_limb(s, elbow, hand, 0.018, 16);
		spd_add_blob(s, hand, vec(0.022, 0.024, 0.026), 16, false);
	}
	add_head(s, seed, vec(0, -0.01, 0.9));
	scene_add_material(s, pearl);
	for (int i = 0; i < BEADS; i++) {
		struct vec d = spd_turn(i, BEADS);
		spd_add_blob(s, vec(0.062 * d.x, 0.062 * d.y, 0.765 + 0.012 * d.y), vec(0.006, 0.006, 0.006), 5, false);
	}
	scene_add_material(s, wing);
	for (int side = -1; side <= 1; side += 2) {
		add_wing(s, vec(0.02 * side, 0.07, 0.68), vec(0.42 * side, 0.2, 1), 0.13);
		add_wing(s, vec(0.02 * side, 0.07, 0.64), vec(0.36 * side, 0.18, 0.42), 0.09);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	uint64_t seed = (uint64_t)o->seed;
	spd_set_sky(s);
	spd_set_view(s, vec(0.9, -2.6, 1.5), vec(0, 0, 0.95), vec(0, 0, 1), 50, 0.001);
	scene_add_light(s, vec(6, -9, 8));
	add_ground(s, seed);
	for (int64_t i = 0; i < o->size; i++)
		add_tree(s, seed, (uint64_t)i);
	for (int i = 0; i < MUSHROOMS; i++) {
		uint64_t key = rng_key(seed, STREAM_MUSHROOM, (uint64_t)i);
		struct vec d = spd_turn((int)(256 * rng_uniform(key, 0)), 256);
		double reach = 0.8 + 4 * rng_uniform(key, 1);
		add_mushroom(s, on_ground(seed, d.x * reach, d.y * reach), 0.1 + 0.3 * rng_uniform(key, 2));
	}
	add_mushroom(s, vec(0, 0, 0), PERCH);
	size_t first = s->object_count;
	add_figure(s, seed);
	spd_place(s, first, vec(1, 0, 0), vec(0, 1, 0), vec(0, 0, PERCH));
}

static const char *const options[] = { "seed", NULL };
const struct spd_family spd_forest = { "forest", "a figure of 1 m in a wood of 100 m with size trees", 80, 0, 100000, fill, options };
