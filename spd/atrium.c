/* A court with arcades on two storeys, open to the sky; stands in for the Sponza atrium of Fabianowski, Fowler and Dingliana 2009. The
 * long sides have 'size' arches, the short ones a third of them, each with its column; the upper storey has balusters below its arches, and
 * curtains hang between the columns of the lower one. The unit is the metre. */
#include "spd/parts.h"

enum { SIDES = 32, ARC = 16, BALUSTERS = 5, FOLDS = 24, DROPS = 6, TILES = 6 };

#define BAY 2.8
#define PIER 0.7    /* thickness of the arcade's wall, side of the square piers at the corners */
#define DEEP 3.2    /* of the galleries behind the arcade */
#define STOREY 5.0
#define SPRING 3.0  /* where arches begin */
#define RADIUS 1.15 /* of their openings */

static const struct material stone = { { 0.80, 0.73, 0.60 }, 0.9, 0, 1, 0, 1 };
static const struct material plaster = { { 0.76, 0.66, 0.52 }, 0.9, 0, 1, 0, 1 };
static const struct material marble = { { 0.62, 0.60, 0.58 }, 0.7, 0.25, 60, 0, 1 };
static const struct material slate = { { 0.40, 0.38, 0.36 }, 0.75, 0.15, 30, 0, 1 };
static const struct material cloth[2] = { { { 0.60, 0.12, 0.12 }, 0.9, 0, 1, 0, 1 }, { { 0.15, 0.30, 0.45 }, 0.9, 0, 1, 0, 1 } };

static const double column[][2] = {
	{ 0.36, 0 }, { 0.36, 0.1 }, { 0.3, 0.2 }, { 0.3, 0.28 }, { 0.25, 0.34 }, { 0.24, 1.4 }, { 0.21, 2.4 }, { 0.25, 2.46 },
	{ 0.27, 2.6 }, { 0.31, 2.7 }, { 0.36, 2.8 }, { 0.36, SPRING },
};
static const double baluster[][2] = { { 0.05, 0 }, { 0.09, 0.2 }, { 0.08, 0.32 }, { 0.04, 0.45 }, { 0.04, 0.6 }, { 0.06, 0.7 } };

enum { COLUMN = sizeof column / sizeof *column, BALUSTER = sizeof baluster / sizeof *baluster };

/* An arch over the bay from x = 0 on, the wall from y = 0 to PIER: its inner side, both faces up to the next storey, and a moulding
 * around the opening in front. */
static void add_arch(struct scene *s)
{
	const struct vec centre = vec(BAY / 2, 0, SPRING), depth = vec(0, PIER, 0);
	struct vec inner[ARC + 1], outer[ARC + 1];
	for (int i = 0; i <= ARC; i++) {
		struct vec d = spd_turn(ARC - i, 2 * ARC), out = vec(d.x, 0, d.y);
		inner[i] = vec_add(centre, vec_scale(out, RADIUS));
		outer[i] = vec_add(centre, vec_scale(out, RADIUS + 0.14));
	}
	for (int i = 0; i < ARC; i++) {
		struct vec a = inner[i], b = inner[i + 1], top_a = vec(i ? a.x : 0, 0, STOREY), top_b = vec(i + 1 < ARC ? b.x : BAY, 0, STOREY);
		spd_add_quad(s, a, b, top_b, top_a);
		spd_add_quad(s, vec_add(b, depth), vec_add(a, depth), vec_add(top_a, depth), vec_add(top_b, depth));
		spd_add_quad(s, a, vec_add(a, depth), vec_add(b, depth), b);
	}
	for (int i = 0; i < 2; i++) { /* between the opening and the middle of the column */
		double from = i ? BAY / 2 + RADIUS : 0, to = i ? BAY : BAY / 2 - RADIUS;
		spd_add_quad(s, vec(from, 0, SPRING), vec(from, PIER, SPRING), vec(to, PIER, SPRING), vec(to, 0, SPRING));
		for (int face = 0; face < 2; face++) {
			const struct vec a = vec(from, face * PIER, SPRING), b = vec(to, face * PIER, SPRING), top = vec(i ? to : from, face * PIER, STOREY);
			spd_add_triangle(s, face ? b : a, face ? a : b, top);
		}
	}
	spd_add_rib(s, outer, inner, ARC + 1, vec(0, 1, 0), 0.06);
}

static void add_balustrade(struct scene *s)
{
	spd_add_box(s, vec(0, 0.2, 0.9), vec(BAY, 0.5, 1.02));
	for (int i = 0; i < BALUSTERS; i++)
		spd_add_lathe(s, vec(BAY / 2 + (i - BALUSTERS / 2) * 0.4, 0.35, 0.2), baluster, BALUSTER, SIDES / 2);
	spd_add_box(s, vec(0, 0.2, 0), vec(BAY, 0.5, 0.2));
}

/* Gathered at the sides, and hanging down in the middle. */
static void add_curtain(struct scene *s, int which)
{
	scene_add_material(s, cloth[which % 2]);
	for (int i = 0; i < FOLDS; i++)
		for (int k = 0; k < DROPS; k++) {
			struct vec p[4];
			for (int c = 0; c < 4; c++) {
				int u = i + (c == 1 || c == 2), v = k + c / 2;
				double aside = 2.0 * u / FOLDS - 1, low = SPRING - 0.25 - 1.7 * (1 - 0.75 * aside * aside) * v / DROPS;
				p[c] = vec(BAY / 2 + aside * RADIUS * (1 - 0.02 * v), PIER - 0.1 + spd_turn(u % 8, 8).x * 0.03 * (1 + 0.3 * v), low);
			}
			spd_add_triangle(s, p[0], p[1], p[2]);
			spd_add_triangle(s, p[0], p[2], p[3]);
		}
}

/* One storey of one side, from the pier at the origin along x; the court is before it. */
static void add_side(struct scene *s, int bays, int storey)
{
	for (int bay = 0; bay < bays; bay++) {
		size_t first = s->object_count;
		scene_add_material(s, stone);
		add_arch(s);
		if (bay > 0)
			spd_add_lathe(s, vec(0, PIER / 2, 0), column, COLUMN, SIDES);
		if (storey > 0)
			add_balustrade(s);
		else
			add_curtain(s, bay);
		spd_place(s, first, vec(1, 0, 0), vec(0, 1, 0), vec(BAY * bay, 0, 0));
	}
	scene_add_material(s, stone);
	spd_add_box(s, vec(-PIER, 0, 0), vec(0, PIER, STOREY));
	spd_add_box(s, vec(0, -0.15, STOREY - 0.2), vec(BAY * bays, 0, STOREY));
}

/* Floors, the outer walls, the roof over the galleries. */
static void add_shell(struct scene *s, double length, double width)
{
	const double out = PIER + DEEP;
	const struct vec corner[2][4] = {
		{ vec(0, 0, 0), vec(length, 0, 0), vec(length, width, 0), vec(0, width, 0) },
		{ vec(-out, -out, 0), vec(length + out, -out, 0), vec(length + out, width + out, 0), vec(-out, width + out, 0) },
	};
	scene_add_material(s, plaster);
	for (int i = 0; i < 4; i++) {
		struct vec a = corner[1][i], b = corner[1][(i + 1) % 4], c = corner[0][(i + 1) % 4], d = corner[0][i];
		struct vec top = vec(0, 0, 2 * STOREY), floor = vec(0, 0, STOREY - 0.1);
		spd_add_quad(s, b, a, vec_add(a, top), vec_add(b, top));
		spd_add_quad(s, a, b, c, d);
		spd_add_quad(s, vec_add(a, floor), vec_add(b, floor), vec_add(c, floor), vec_add(d, floor));
		spd_add_quad(s, vec_add(a, top), vec_add(b, top), vec_add(c, top), vec_add(d, top));
	}
	for (int i = 0; i < TILES * TILES; i++) {
		double x = length / TILES * (i % TILES), y = width / TILES * (i / TILES);
		scene_add_material(s, (i + i / TILES) % 2 ? marble : slate);
		spd_add_quad(s, vec(x, y, 0), vec(x + length / TILES, y, 0), vec(x + length / TILES, y + width / TILES, 0), vec(x, y + width / TILES, 0));
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	int along = (int)o->size, across = (along + 2) / 3;
	double length = BAY * along, width = BAY * across;
	spd_set_sky(s);
	spd_set_view(s, vec(1.2, width * 0.6, 1.8), vec(length, width * 0.42, 4), vec(0, 0, 1), 65, 0.001);
	scene_add_light(s, vec(0.4 * length, 0.55 * width, 2 * STOREY - 0.5));
	add_shell(s, length, width);
	for (int storey = 0; storey < 2; storey++)
		for (int side = 0; side < 4; side++) {
			size_t first = s->object_count;
			const struct vec at = vec(side < 2 ? length : 0, side == 1 || side == 2 ? width : 0, STOREY * storey);
			add_side(s, side % 2 ? across : along, storey);
			spd_place(s, first, spd_turn((side + 2) % 4, 4), spd_turn((side + 3) % 4, 4), at);
		}
}

static const char *const options[] = { NULL };
const struct spd_family spd_atrium = { "atrium", "a court with arcades on two storeys, size arches along it", 9, 3, 100, fill, options };
