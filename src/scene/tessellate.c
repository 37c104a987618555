#include "scene/tessellate.h"

#include "geom/matrix.h"

static const double pi = 3.141592653589793;

/* The six faces as maps applied one after the other to the grid of the +z face. */
static struct vec turn_face(int face, struct vec p)
{
	switch (face % 3) {
	case 0: return vec(-p.z, p.y, p.x);
	case 1: return vec(-p.y, p.x, p.z);
	default: return vec(p.x, -p.z, p.y);
	}
}

static void add_triangle(struct scene *s, struct vec a, struct vec b, struct vec c, struct vec na, struct vec nb, struct vec nc)
{
	const struct vec corners[3] = { a, b, c }, normals[3] = { na, nb, nc };
	scene_add_patch(s, corners, normals, 3);
}

void tessellate_sphere(struct scene *s, struct vec center, double radius, int resolution)
{
	int n = resolution;
	struct arena scratch = { 0 };
	struct vec *grid = NEW(&scratch, struct vec, (size_t)(n + 1) * (size_t)(n + 1));
	if (!grid) {
		s->lost = true;
		return;
	}
	for (int u = 0; u <= n; u++)
		for (int v = 0; v <= n; v++) {
			double au = (pi / 4) * (2.0 * u / n - 1), av = (pi / 4) * (2.0 * v / n - 1);
			grid[u * (n + 1) + v] = vec_unit(vec_cross(vec(cos(au), 0, -sin(au)), vec(0, cos(av), sin(av))));
		}
	for (int face = 0; face < 6; face++) {
		for (int i = 0; i < (n + 1) * (n + 1); i++)
			grid[i] = turn_face(face, grid[i]);
		for (int u = 0; u < n; u++)
			for (int v = 0; v < n; v++) {
				const struct vec *k = &grid[u * (n + 1) + v];
				struct vec p[4] = { k[0], k[1], k[n + 2], k[n + 1] }, q[4];
				for (int i = 0; i < 4; i++)
					q[i] = vec_add(vec_scale(p[i], radius), center);
				add_triangle(s, q[0], q[1], q[2], p[0], p[1], p[2]);
				add_triangle(s, q[2], q[3], q[0], p[2], p[3], p[0]);
			}
	}
	arena_free(&scratch);
}

void tessellate_cone(struct scene *s, struct vec base, double base_radius, struct vec apex, double apex_radius, int resolution)
{
	struct vec axis = vec_sub(apex, base), along = vec_unit(axis), side = vec_cross(axis, vec(0, 0, 1));
	double height = vec_length(axis);
	if (vec_length(side) < 1e-6)
		side = vec_cross(axis, vec(1, 0, 0));
	side = vec_unit(side);
	struct vec normal = side;
	if (base_radius != apex_radius)
		normal = vec_unit(vec_add(vec_scale(side, height), vec_scale(along, base_radius - apex_radius)));
	struct vec rim_a = vec_scale(side, apex_radius), rim_b = vec_scale(side, base_radius);
	struct vec pa = vec_add(apex, rim_a), pb = vec_add(base, rim_b), pn = normal;
	double step = 2 * pi / (4 * resolution), angle = step;
	for (int i = 0; i < 4 * resolution; i++, angle += step) {
		struct matrix m = matrix_axis_rotation(along, angle);
		struct vec qa = vec_add(matrix_direction(rim_a, &m), apex), qb = vec_add(matrix_direction(rim_b, &m), base);
		struct vec qn = matrix_normal(normal, &m);
		add_triangle(s, qa, pa, pb, qn, pn, pn);
		add_triangle(s, qb, qa, pb, qn, qn, pn);
		pa = qa;
		pb = qb;
		pn = qn;
	}
}
