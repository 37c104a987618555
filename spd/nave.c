/* A church; stands in for the Sibenik cathedral of Fabianowski, Fowler and Dingliana 2009: a nave of 'size' square bays and an aisle on
 * either side under groin vaults with ribs, columns of clustered shafts between them, tall windows in the outer walls, benches. The unit is
 * the metre. */
#include "spd/parts.h"

enum { ARC = 32, STRIPS = 3, SIDES = 32, SHAFT = 8, BENCHES = 3, PANES = 4, SHAFTS = 8, TILES = 32 };

#define BAY 6.0
#define AISLE 4.0   /* its width */
#define SPRING 7.0  /* where the vaults of the nave begin, */
#define RISE 4.0    /* and how high they rise */
#define LOW 4.0     /* the same of the aisles */
#define CLIMB 2.4
#define RADIUS 0.34 /* of a column */

static const struct material stone = { { 0.74, 0.70, 0.62 }, 0.9, 0, 1, 0, 1 };
static const struct material rib = { { 0.60, 0.55, 0.48 }, 0.9, 0, 1, 0, 1 };
static const struct material floor_stone = { { 0.50, 0.46, 0.42 }, 0.7, 0.2, 50, 0, 1 };
static const struct material oak = { { 0.36, 0.24, 0.14 }, 0.85, 0, 1, 0, 1 };
static const struct material panes[2] = { { { 0.25, 0.35, 0.65 }, 0.7, 0.2, 80, 0, 1 }, { { 0.65, 0.25, 0.20 }, 0.7, 0.2, 80, 0, 1 } };

/* Where a bay's vault stands: half its sides, its height at the corners and in the middle. */
struct vault {
	struct vec half;
	double spring, rise;
};

/* A point of the arch over one side of a bay: across from -1 to 1, and how high. */
static struct vec on_arch(int i)
{
	struct vec d = spd_turn(ARC - i, 2 * ARC);
	return vec(d.x, 0, d.y);
}

/* Four webs between the diagonals: each is a part of a barrel, straight across from a diagonal to a side. */
static void add_webs(struct scene *s, const struct vault *v)
{
	for (int k = 0; k < 4 * ARC * STRIPS; k++) {
		int web = k / (ARC * STRIPS), strip = k % STRIPS, i = k / STRIPS % ARC;
		double sign = web % 2 ? 1 : -1;
		struct vec p[4];
		for (int c = 0; c < 4; c++) {
			struct vec arch = on_arch(i + (c == 1 || c == 2));
			double from = fabs(arch.x), out = from + (1 - from) * (strip + c / 2) / STRIPS;
			double x = web < 2 ? sign * out : arch.x, y = web < 2 ? arch.x : sign * out;
			p[c] = vec(x * v->half.x, y * v->half.y, v->spring + v->rise * arch.z);
		}
		if (vec_length(vec_sub(p[0], p[3])) < 1e-9) /* the middle of the vault, or its corner: three corners are left */
			spd_add_triangle(s, p[0], p[1], p[2]);
		else if (vec_length(vec_sub(p[1], p[2])) < 1e-9)
			spd_add_triangle(s, p[0], p[1], p[3]);
		else
			spd_add_quad(s, p[0], p[1], p[2], p[3]);
	}
}

/* A rib of a vault along the line from (-x, -y) to (x, y), seen from above, about 'at'. */
static void add_vault_rib(struct scene *s, const struct vault *v, struct vec at, double x, double y, double depth)
{
	struct vec outer[ARC + 1], inner[ARC + 1], along = vec(x, y, 0), across = vec_unit(vec(-y, x, 0));
	double shrink = 1 - depth / vec_length(along), lower = 1 - depth / v->rise;
	for (int i = 0; i <= ARC; i++) {
		struct vec arch = on_arch(i);
		outer[i] = vec_add(at, vec_add(vec_scale(along, arch.x), vec(0, 0, v->spring + v->rise * arch.z)));
		inner[i] = vec_add(at, vec_add(vec_scale(along, arch.x * shrink), vec(0, 0, v->spring + v->rise * lower * arch.z)));
	}
	spd_add_rib(s, outer, inner, ARC + 1, across, 0.6 * depth);
}

/* About the origin. */
static void add_vault(struct scene *s, const struct vault *v)
{
	scene_add_material(s, stone);
	add_webs(s, v);
	scene_add_material(s, rib);
	add_vault_rib(s, v, vec(0, 0, 0), v->half.x, v->half.y, 0.2);
	add_vault_rib(s, v, vec(0, 0, 0), -v->half.x, v->half.y, 0.2);
	add_vault_rib(s, v, vec(-v->half.x, 0, 0), 0, v->half.y, 0.3);
}

/* A column with shafts around it that go up to the vault of the nave. */
static void add_column(struct scene *s, struct vec at)
{
	static const double core[][2] = {
		{ 0.6, 0 }, { 0.6, 0.3 }, { 0.55, 0.36 }, { 0.5, 0.42 }, { 0.42, 0.5 }, { RADIUS, 0.56 }, { RADIUS, LOW - 0.6 },
		{ RADIUS + 0.06, LOW - 0.5 }, { RADIUS + 0.06, LOW - 0.4 }, { 0.45, LOW - 0.25 }, { 0.6, LOW - 0.1 },
		{ 0.6, LOW }, { 0.3, LOW + 0.2 }, { 0.3, SPRING },
	};
	static const double shaft[][2] = { { 0.1, 0.5 }, { 0.1, 2 }, { 0.1, LOW }, { 0.1, 5.5 }, { 0.1, SPRING - 0.3 },
		                           { 0.16, SPRING - 0.15 }, { 0.2, SPRING } };
	spd_add_lathe(s, at, core, sizeof core / sizeof *core, SIDES);
	for (int i = 0; i < SHAFTS; i++)
		spd_add_lathe(s, vec_add(at, vec_scale(spd_turn(i, SHAFTS), RADIUS + 0.02)), shaft, sizeof shaft / sizeof *shaft, 2 * SHAFT);
}

/* The wall above an arch that leads from the nave into the aisle, from -x to x at y = 0, and the arch's edge. */
static void add_arcade(struct scene *s)
{
	const double half = BAY / 2, radius = half - 0.3;
	struct vec outer[ARC + 1], inner[ARC + 1];
	for (int i = 0; i <= ARC; i++) {
		struct vec arch = on_arch(i);
		inner[i] = vec(arch.x * radius, 0, LOW + arch.z * (CLIMB - 0.3));
		outer[i] = vec(arch.x * half, 0, LOW + arch.z * CLIMB);
	}
	scene_add_material(s, rib);
	spd_add_rib(s, outer, inner, ARC + 1, vec(0, 1, 0), 0.35);
	scene_add_material(s, stone);
	for (int i = 0; i < ARC; i++) { /* up to where the nave's vault meets it */
		struct vec a = outer[i], b = outer[i + 1], arch = on_arch(i), next = on_arch(i + 1);
		spd_add_quad(s, a, b, vec(b.x, 0, SPRING + RISE * next.z), vec(a.x, 0, SPRING + RISE * arch.z));
	}
}

/* A round window in a wall from -x to x at y = 0, 'tall' high: panes with bars between them, and the splay around. */
static void add_window(struct scene *s, double half, double tall, double sill)
{
	struct vec outer[2 * ARC + 1], inner[2 * ARC + 1];
	const struct vec middle = vec(0, 0, (sill + tall) / 2);
	double wide = half / 2.4, high = (tall - sill) / 2 - 0.4;
	for (int i = 0; i <= 2 * ARC; i++) {
		struct vec d = spd_turn(i, 2 * ARC);
		outer[i] = vec_add(middle, vec(d.x * wide, 0, d.y * high));
		inner[i] = vec_add(middle, vec(d.x * wide * 0.85, 0, d.y * high * 0.9));
	}
	scene_add_material(s, rib);
	spd_add_rib(s, outer, inner, 2 * ARC + 1, vec(0, 1, 0), 0.12);
	for (int i = 0; i < 2 * ARC; i++) {
		scene_add_material(s, panes[i / PANES % 2]);
		spd_add_triangle(s, vec_add(middle, vec(0, -0.02, 0)), vec_add(inner[i], vec(0, -0.02, 0)), vec_add(inner[i + 1], vec(0, -0.02, 0)));
	}
}

/* The bay whose first columns stand at x = 0; the nave's axis is y = 0. */
static void add_bay(struct scene *s, bool benches)
{
	const struct vault nave = { vec(BAY / 2, BAY / 2, 0), SPRING, RISE }, aisle = { vec(BAY / 2, AISLE / 2, 0), LOW, CLIMB };
	const struct vec x = vec(1, 0, 0), y = vec(0, 1, 0);
	for (int side = -1; side <= 1; side++) {
		size_t first = s->object_count;
		add_vault(s, side ? &aisle : &nave);
		spd_place(s, first, x, y, vec(BAY / 2, side * (BAY + AISLE) / 2, 0));
		if (side == 0)
			continue;
		first = s->object_count;
		add_arcade(s);
		spd_place(s, first, x, y, vec(BAY / 2, side * BAY / 2, 0));
		add_column(s, vec(0, side * BAY / 2, 0));
		first = s->object_count;
		add_window(s, BAY / 2, LOW + 1, 1.2);
		spd_place(s, first, x, y, vec(BAY / 2, side * (BAY / 2 + AISLE - 0.05), 0));
	}
	scene_add_material(s, oak);
	for (int i = 0; benches && i < 2 * BENCHES; i++) {
		double at = 1.4 + 1.4 * (i / 2), from = i % 2 ? 0.6 : -2.4;
		spd_add_box(s, vec(at, from, 0.42), vec(at + 0.4, from + 1.8, 0.46));
		spd_add_box(s, vec(at - 0.06, from, 0.4), vec(at, from + 1.8, 0.95));
		for (int end = 0; end < 2; end++)
			spd_add_box(s, vec(at - 0.1, from + (end ? 1.8 : -0.06), 0), vec(at + 0.5, from + (end ? 1.86 : 0), end ? 1 : 0.9));
	}
}

/* Outer walls and floor; the walls at the ends rise to the nave's vault. */
static void add_shell(struct scene *s, double length)
{
	const double out = BAY / 2 + AISLE;
	scene_add_material(s, stone);
	for (int side = -1; side <= 1; side += 2)
		spd_add_quad(s, vec(0, side * out, 0), vec(length, side * out, 0), vec(length, side * out, LOW + CLIMB),
		             vec(0, side * out, LOW + CLIMB));
	for (int end = 0; end < 2; end++)
		spd_add_quad(s, vec(end * length, -out, 0), vec(end * length, out, 0), vec(end * length, out, SPRING + RISE),
		             vec(end * length, -out, SPRING + RISE));
	scene_add_material(s, floor_stone);
	for (int i = 0; i < TILES; i++) {
		double from = length / TILES * i, to = length / TILES * (i + 1);
		spd_add_quad(s, vec(from, -out, 0), vec(to, -out, 0), vec(to, out, 0), vec(from, out, 0));
	}
	size_t first = s->object_count;
	add_window(s, 3.2, SPRING + RISE - 0.5, 4);
	spd_place(s, first, vec(0, -1, 0), vec(1, 0, 0), vec(length - 0.05, 0, 0));
	scene_add_material(s, stone);
	spd_add_box(s, vec(length - 4, -1.3, 0), vec(length - 2.6, 1.3, 1.05));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	double length = BAY * (double)o->size;
	spd_set_sky(s);
	spd_set_view(s, vec(1, 0.9, 1.7), vec(length * 0.7, -0.5, 4.2), vec(0, 0, 1), 65, 0.001);
	scene_add_light(s, vec(length * 0.45, 0, SPRING + 1.5));
	add_shell(s, length);
	for (int64_t bay = 0; bay < o->size; bay++) {
		size_t first = s->object_count;
		add_bay(s, bay + 2 < o->size);
		spd_place(s, first, vec(1, 0, 0), vec(0, 1, 0), vec(BAY * (double)bay, 0, 0));
	}
}

static const char *const options[] = { NULL };
const struct spd_family spd_nave = { "nave", "a church of size bays, vaults on ribs", 8, 1, 1000, fill, options };
