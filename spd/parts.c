#include "spd/parts.h"

struct vec spd_turn(int k, int n)
{
	if (n == 4)
		return vec((k % 4 == 0) - (k == 2), (k == 1) - (k == 3), 0);
	if (k % 2 == 0)
		return spd_turn(k / 2, n / 2);
	return vec_unit(vec_add(spd_turn(k / 2, n / 2), spd_turn(k / 2 + 1, n / 2)));
}

void spd_place(struct scene *s, size_t first, struct vec x, struct vec y, struct vec at)
{
	struct vec z = vec_cross(x, y);
	const struct matrix m = { { { x.x, x.y, x.z, 0 }, { y.x, y.y, y.z, 0 }, { z.x, z.y, z.z, 0 }, { at.x, at.y, at.z, 1 } } };
	spd_transform(s, first, &m);
}

void spd_add_hall(struct scene *s, struct vec lo, struct vec hi)
{
	static const int side[6][4] = { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 }, { 0, 4, 5, 1 }, { 2, 3, 7, 6 } };
	spd_add_sides(s, lo, hi, side);
}

void spd_add_part(struct scene *s, struct vec at, struct vec corner, struct vec size)
{
	struct vec lo = vec_add(at, corner);
	spd_add_box(s, lo, vec_add(lo, size));
}

/* One of the sides of a ring of a lathe. */
static void add_facet(struct scene *s, struct vec at, const double *low, const double *high, struct vec from, struct vec to)
{
	const struct vec up = vec(0, 0, 1);
	const struct vec around[4] = { from, to, to, from };
	struct vec corners[4], normals[4];
	size_t count = 0;
	for (int i = 0; i < 4; i++) {
		const double *end = i < 2 ? low : high;
		if (end[0] == 0 && i % 2)
			continue; /* the axis is one corner */
		corners[count] = vec_add(at, vec_add(vec_scale(around[i], end[0]), vec_scale(up, end[1])));
		normals[count++] = vec_add(vec_scale(around[i], high[1] - low[1]), vec_scale(up, low[0] - high[0]));
	}
	scene_add_patch(s, corners, normals, count);
}

void spd_add_lathe(struct scene *s, struct vec at, const double (*profile)[2], int count, int sides)
{
	for (int k = 0; k < sides; k++) {
		struct vec from = spd_turn(k, sides), to = spd_turn(k + 1, sides);
		for (int i = 0; i + 1 < count; i++)
			add_facet(s, at, profile[i], profile[i + 1], from, to);
	}
}

void spd_add_rib(struct scene *s, const struct vec *outer, const struct vec *inner, int count, struct vec across, double half)
{
	struct vec left = vec_scale(across, half), right = vec_scale(across, -half);
	for (int i = 0; i + 1 < count; i++) {
		struct vec a = outer[i], b = outer[i + 1], c = inner[i + 1], d = inner[i];
		spd_add_quad(s, vec_add(a, left), vec_add(b, left), vec_add(c, left), vec_add(d, left));
		spd_add_quad(s, vec_add(d, right), vec_add(c, right), vec_add(b, right), vec_add(a, right));
		spd_add_quad(s, vec_add(d, left), vec_add(c, left), vec_add(c, right), vec_add(d, right));
	}
}

/* A point of a cube's surface pushed to where the sum of the coordinates' squares, or fourth powers, is 1. */
static struct vec push(struct vec p, bool rounded)
{
	struct vec q = vec(p.x * p.x, p.y * p.y, p.z * p.z);
	return vec_scale(p, 1 / (rounded ? sqrt(vec_length(q)) : vec_length(p)));
}

void spd_add_blob(struct scene *s, struct vec center, struct vec half, int n, bool rounded)
{
	for (int k = 0; k < 12 * n * n; k++) {
		int face = k / 2 / (n * n), axis = face / 2, u = k / 2 % n, v = k / 2 / n % n;
		double sign = face % 2 ? 1 : -1;
		struct vec corners[3], normals[3];
		for (int i = 0; i < 3; i++) {
			const int turn = k % 2 ? (i + 2) % 4 : i, right = turn == 1 || turn == 2, up = turn >= 2;
			struct vec p;
			p.a[axis] = sign;
			p.a[(axis + 1) % 3] = sign * (2.0 * (u + right) / n - 1);
			p.a[(axis + 2) % 3] = 2.0 * (v + up) / n - 1;
			p = push(p, rounded);
			for (int c = 0; c < 3; c++) {
				corners[i].a[c] = center.a[c] + half.a[c] * p.a[c];
				normals[i].a[c] = (rounded ? p.a[c] * p.a[c] * p.a[c] : p.a[c]) / half.a[c];
			}
		}
		scene_add_patch(s, corners, normals, 3);
	}
}
