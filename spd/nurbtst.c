/* A bicubic B-spline surface of 30 x 25 x 2 triangles (SPD "nurbtst"). Basis functions are computed in single precision as SPD
 * does, which shows in the sixth digit. */
#include "spd/common.h"

enum { ORDER = 4, COLUMNS = 5, ROWS = 6, STEPS_U = 30, STEPS_V = 25, CONTROLS_MOST = 6 };

static const float knots_u[] = { 0, 0, 0, 0, 1, 2, 3, 3, 3, 3 }, knots_v[] = { 0, 0, 0, 0, 1, 2, 2, 2, 2 };
static const double heights[ROWS][COLUMNS] = {
	{ 0, 3, -3, 3, 0 }, { 0, 0, 0, 0, 0 }, { 0, 0, 5, 0, 0 }, { 0, 0, 5, 0, 0 }, { 0, 0, 0, 0, 0 }, { 0, -3, 3, -3, 0 },
};

/* 0 / 0 counts as 1. */
static float divide(float a, float b)
{
	return b == 0 ? 1 : a / b;
}

/* Basis functions of the last order and their derivatives at t, for 'count' control points (Cox, de Boor). */
static void find_basis(float t, int count, const float *knot, float *basis, float *slope)
{
	float n[CONTROLS_MOST + ORDER] = { 0 }, d[CONTROLS_MOST + ORDER] = { 0 };
	for (int i = 0; i < count + ORDER - 1; i++)
		n[i] = t >= knot[i] && t < knot[i + 1] ? 1 : 0;
	if (t >= knot[count + ORDER - 1])
		n[count - 1] = 1;
	for (int k = 2; k <= ORDER; k++)
		for (int i = 0; i < count + ORDER - k; i++) {
			float width = knot[i + k - 1] - knot[i], next_width = knot[i + k] - knot[i + 1];
			float rise = t - knot[i], fall = knot[i + k] - t, left = 0, right = 0, sum = 0;
			if (n[i] != 0) {
				left = divide(rise * n[i], width);
				sum += divide(n[i], width);
			}
			if (n[i + 1] != 0) {
				right = divide(fall * n[i + 1], next_width);
				sum -= divide(n[i + 1], next_width);
			}
			if (d[i] != 0)
				sum += divide(rise * d[i], width);
			if (d[i + 1] != 0)
				sum += divide(fall * d[i + 1], next_width);
			d[i] = sum;
			n[i] = left + right;
		}
	for (int i = 0; i < count; i++) {
		basis[i] = n[i];
		slope[i] = d[i];
	}
}

static void find_point(float u, float v, struct vec *point, struct vec *normal)
{
	float bu[ROWS], du[ROWS], bv[COLUMNS], dv[COLUMNS];
	struct vec along_u = vec(0, 0, 0), along_v = vec(0, 0, 0);
	find_basis(u, ROWS, knots_u, bu, du);
	find_basis(v, COLUMNS, knots_v, bv, dv);
	*point = vec(0, 0, 0);
	for (int i = 0; i < ROWS; i++)
		for (int j = 0; j < COLUMNS; j++) {
			struct vec control = vec(j, i, heights[i][j]);
			float here = bu[i] * bv[j], in_u = du[i] * bv[j], in_v = bu[i] * dv[j];
			*point = vec_add(*point, vec_scale(control, (double)here));
			along_u = vec_add(along_u, vec_scale(control, (double)in_u));
			along_v = vec_add(along_v, vec_scale(control, (double)in_v));
		}
	*normal = vec_unit(vec_cross(along_v, along_u));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	(void)o;
	struct vec point[STEPS_U + 1][STEPS_V + 1], normal[STEPS_U + 1][STEPS_V + 1];
	scene_set_background(s, 0, 0, 0);
	scene_set_view(s, vec(0, 5, -10), vec(0, 0, 0), vec(0, 1, 0), 30, 0.001, 256, 256);
	scene_add_light(s, vec(0, 50, -10));
	spd_add_material(s, (struct spd_material){ { 1, 0, 0 }, 0.7, 0, 10, 0, 1 });
	spd_note_finish(s, 0.1, 0.7);
	float u = 0, step_u = knots_u[ROWS] / STEPS_U, step_v = knots_v[COLUMNS] / STEPS_V;
	for (int i = 0; i <= STEPS_U; i++, u += step_u) {
		float v = 0;
		for (int j = 0; j <= STEPS_V; j++, v += step_v)
			find_point(u, v, &point[i][j], &normal[i][j]);
	}
	static const int corner[2][3][2] = { { { -1, 0 }, { 0, 0 }, { 0, 1 } }, { { -1, 0 }, { 0, 1 }, { -1, 1 } } };
	for (int i = 1; i <= STEPS_U; i++)
		for (int j = 0; j < STEPS_V; j++)
			for (int half = 0; half < 2; half++) {
				struct vec p[3], n[3];
				for (int k = 0; k < 3; k++) {
					const int *at = corner[half][k];
					p[k] = point[i + at[0]][j + at[1]];
					n[k] = normal[i + at[0]][j + at[1]];
				}
				scene_add_patch(s, p, n, 3);
			}
	struct matrix y = matrix_rotation(1, 30 * SPD_PI / 180), x = matrix_rotation(0, -90 * SPD_PI / 180);
	struct matrix move = matrix_translation(-2, -2.5, 0), turned = matrix_multiply(&x, &y);
	struct matrix all = matrix_multiply(&move, &turned);
	spd_transform(s, 0, &all);
}

static const char *const options[] = { NULL };
const struct spd_family spd_nurbtst = { "nurbtst", "B-spline surface of 1500 triangles; no size", 0, 0, 0, fill, options };
