/* A fractal mountain of 2 * 4^size triangles and four glass balls (SPD "mount"). */
#include "spd/common.h"

struct mountain {
	struct scene *scene;
	int levels, width;
	double rough;
};

/* The hash SPD keeps although it repeats: shifts by 8 and more bits than the word holds count as zero. */
static int hash(const struct mountain *m, int x, int y)
{
	unsigned a = (unsigned)x, b = (unsigned)y;
	unsigned first = 23 - m->levels >= 0 ? a << (23 - m->levels) : 0;
	unsigned second = 15 - m->levels >= 0 ? b << (15 - m->levels) : 0;
	unsigned third = 7 - m->levels >= 0 ? a << (7 - m->levels) : 0;
	return (int)((first + second + third) & 0xffff);
}

/* A normal deviate from a seed, by the polar method over a linear congruential sequence. */
static double gauss(int seed)
{
	int x1, x2 = seed;
	double v1, v2, r;
	do {
		x1 = (28411 + x2 * 8121) % 134456;
		x2 = (28411 + x1 * 8121) % 134456;
		v1 = x1 * 2.0 / 134456 - 1;
		v2 = x2 * 2.0 / 134456 - 1;
		r = v1 * v1 + v2 * v2;
	} while (r >= 1);
	return v1 * sqrt(-2 * log(r) / r);
}

static double displace(const struct mountain *m, int x, int y)
{
	return gauss(21 + hash(m, x, y));
}

static struct vec place(const struct mountain *m, int x, int y, double height)
{
	return vec(-1 + x * 2.0 / m->width, -1 + y * 2.0 / m->width, height);
}

/* The square at (x, y) with the heights of its corners. */
static void add(const struct mountain *m, int width, int x, int y, double ll, double lr, double ur, double ul)
{
	if (width == 1) {
		struct vec a = place(m, x, y, ll), b = place(m, x + 1, y, lr), c = place(m, x + 1, y + 1, ur),
		           d = place(m, x, y + 1, ul);
		spd_add_triangle(m->scene, a, b, c);
		spd_add_triangle(m->scene, c, d, a);
		return;
	}
	int h = width / 2;
	double rise = (h * 2.0 / m->width) * m->rough;
	double low = (ll + lr) / 2 + rise * displace(m, x + h, y), right = (lr + ur) / 2 + rise * displace(m, x + width, y + h);
	double up = (ur + ul) / 2 + rise * displace(m, x + h, y + width), left = (ul + ll) / 2 + rise * displace(m, x, y + h);
	double mid = (ll + lr + ur + ul) / 4 + 1.4142136 * rise * displace(m, x + h, y + h);
	add(m, h, x, y, ll, low, mid, left);
	add(m, h, x + h, y, low, lr, right, mid);
	add(m, h, x + h, y + h, mid, right, ur, up);
	add(m, h, x, y + h, left, mid, up, ul);
}

static void add_balls(struct scene *s, const struct spd_options *o)
{
	const struct vec center = vec(-0.8, 0.8, 1), top = vec(0, 0, 0.17 * sqrt(1.5));
	struct matrix tilt = matrix_axis_rotation(vec_unit(vec(1, 1, 0)), acos(-1.0 / 3));
	struct vec side = matrix_direction(top, &tilt);
	spd_add_sphere(s, o, vec_add(top, center), 0.17);
	for (int i = 0; i < 3; i++) {
		struct matrix turn = matrix_rotation(2, i * 2 * SPD_PI / 3);
		spd_add_sphere(s, o, vec_add(matrix_direction(side, &turn), center), 0.17);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(-1.6, 1.6, 1.7), vec(0, 0, 0), vec(0, 0, 1), 45, 0.01);
	scene_add_light(s, vec(-100, -100, 100));
	spd_add_material(s, (struct spd_material){ { 1, 1, 1 }, 0.1, 0.1, 6.7, 0.9, 1.5 });
	spd_note_finish(s, 0, 0.4);
	add_balls(s, o);
	spd_add_material(s, (struct spd_material){ { 0.5, 0.45, 0.35 }, 1, 0, 0, 0, 0 });
	double ratio = 2 / exp(log(2) / (2.2 - 1));
	struct mountain m = { s, (int)o->size, 1 << o->size, sqrt(ratio * ratio - 1) };
	add(&m, m.width, 0, 0, 0, 0, 0, 0);
}

static const char *const options[] = { "tessellate", "resolution", NULL };
const struct spd_family spd_mount = { "mount", "fractal mountain, 2*4^size triangles, and four glass balls", 6, 1, 13, fill,
	                              options };
