#include "geom/matrix.h"

struct matrix matrix_identity(void)
{
	return matrix_scale(1, 1, 1);
}

struct matrix matrix_scale(double x, double y, double z)
{
	return (struct matrix){ { { x, 0, 0, 0 }, { 0, y, 0, 0 }, { 0, 0, z, 0 }, { 0, 0, 0, 1 } } };
}

struct matrix matrix_translation(double x, double y, double z)
{
	return (struct matrix){ { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { x, y, z, 1 } } };
}

struct matrix matrix_rotation(int axis, double angle)
{
	struct matrix r = matrix_identity();
	int i = (axis + 1) % 3, j = (axis + 2) % 3;
	double c = cos(angle), s = sin(angle);
	r.m[i][i] = r.m[j][j] = c;
	r.m[i][j] = s;
	r.m[j][i] = -s;
	return r;
}

struct matrix matrix_axis_rotation(struct vec a, double angle)
{
	double x = a.x, y = a.y, z = a.z, c = cos(angle), s = sin(angle), k = 1 - c;
	struct matrix r = matrix_identity();
	r.m[0][0] = x * x + (1 - x * x) * c;
	r.m[0][1] = x * y * k + z * s;
	r.m[0][2] = x * z * k - y * s;
	r.m[1][0] = x * y * k - z * s;
	r.m[1][1] = y * y + (1 - y * y) * c;
	r.m[1][2] = y * z * k + x * s;
	r.m[2][0] = x * z * k + y * s;
	r.m[2][1] = y * z * k - x * s;
	r.m[2][2] = z * z + (1 - z * z) * c;
	return r;
}

struct matrix matrix_multiply(const struct matrix *a, const struct matrix *b)
{
	struct matrix r;
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
			r.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j] +
			            a->m[i][3] * b->m[3][j];
	return r;
}

struct vec matrix_direction(struct vec v, const struct matrix *m)
{
	struct vec r;
	for (int j = 0; j < 3; j++)
		r.a[j] = v.x * m->m[0][j] + v.y * m->m[1][j] + v.z * m->m[2][j];
	return r;
}

struct vec matrix_point(struct vec v, const struct matrix *m)
{
	struct vec r;
	for (int j = 0; j < 3; j++)
		r.a[j] = v.x * m->m[0][j] + v.y * m->m[1][j] + v.z * m->m[2][j] + m->m[3][j];
	return r;
}

struct vec matrix_normal(struct vec n, const struct matrix *m)
{
	/* The rows of the linear part span the image of the axes; their cross products over the determinant are the inverse
	 * transpose. */
	struct vec r[3], c[3], out;
	for (int i = 0; i < 3; i++)
		r[i] = vec(m->m[i][0], m->m[i][1], m->m[i][2]);
	for (int i = 0; i < 3; i++)
		c[i] = vec_cross(r[(i + 1) % 3], r[(i + 2) % 3]);
	double det = vec_dot(r[0], c[0]);
	for (int j = 0; j < 3; j++)
		out.a[j] = n.x * (c[0].a[j] / det) + n.y * (c[1].a[j] / det) + n.z * (c[2].a[j] / det);
	return out;
}
