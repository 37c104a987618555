/* Newell's teapot, each patch as 2 size^2 triangles, over a checkerboard of size^2 squares (SPD "teapot"). */
#include "spd/common.h"
#include "spd/teapot_patches.h"

/* Coefficients of a patch in the powers s^i t^j, highest first, one 4 x 4 matrix a coordinate. */
struct patch {
	struct matrix power[3];
};

static struct patch read_patch(const unsigned short *net)
{
	static const struct matrix bezier = { { { -1, 3, -3, 1 }, { 3, -6, 3, 0 }, { -3, 3, 0, 0 }, { 1, 0, 0, 0 } } };
	struct patch p;
	for (int k = 0; k < 3; k++) {
		struct matrix g;
		for (int i = 0; i < 16; i++)
			g.m[i / 4][i % 4] = teapot_points[net[i]][k];
		struct matrix half = matrix_multiply(&bezier, &g);
		p.power[k] = matrix_multiply(&half, &bezier); /* the Bezier matrix is its own transpose */
	}
	return p;
}

/* sum of a[i] M[i][j] b[j], rows first. */
static double evaluate(const struct matrix *m, const double *a, const double *b)
{
	double row[4];
	for (int j = 0; j < 4; j++)
		row[j] = a[0] * m->m[0][j] + a[1] * m->m[1][j] + a[2] * m->m[2][j] + a[3] * m->m[3][j];
	return row[0] * b[0] + row[1] * b[1] + row[2] * b[2] + row[3] * b[3];
}

static void find_point(const struct patch *p, double s, double t, struct vec *point, struct vec *normal)
{
	const double a[4] = { s * s * s, s * s, s, 1 }, da[4] = { 3 * s * s, 2 * s, 1, 0 };
	const double b[4] = { t * t * t, t * t, t, 1 }, db[4] = { 3 * t * t, 2 * t, 1, 0 };
	struct vec along_s, along_t;
	for (int k = 0; k < 3; k++) {
		point->a[k] = evaluate(&p->power[k], a, b);
		along_s.a[k] = evaluate(&p->power[k], da, b);
		along_t.a[k] = evaluate(&p->power[k], a, db);
	}
	*normal = vec_unit(vec_cross(along_t, along_s));
}

/* Leave out a triangle with two corners at a pole; where one is, the normal there is the pole's. */
static void add_triangle(struct scene *s, const struct vec *corner, struct vec *normal)
{
	int poles = 0, pole = 0;
	for (int i = 0; i < 3; i++)
		if (fabs(corner[i].x) <= 1e-4 && fabs(corner[i].y) <= 1e-4) {
			poles++;
			pole = i;
		}
	if (poles > 1)
		return;
	if (poles == 1)
		normal[pole] = vec(0, 0, corner[pole].z > 1.5 ? 1 : -1);
	scene_add_patch(s, corner, normal, 3);
}

static void add_patch(struct scene *s, const unsigned short *net, int size)
{
	struct patch p = read_patch(net);
	for (int i = 0; i < size; i++)
		for (int j = 0; j < size; j++) {
			static const int corner[2][3] = { { 0, 1, 2 }, { 2, 3, 0 } };
			struct vec point[4], normal[4];
			for (int k = 0; k < 4; k++)
				find_point(&p, (double)(i + (k > 1)) / size, (double)(j + (k == 1 || k == 2)) / size, &point[k],
				           &normal[k]);
			for (int half = 0; half < 2; half++) {
				const int *c = corner[half];
				const struct vec q[3] = { point[c[0]], point[c[1]], point[c[2]] };
				struct vec n[3] = { normal[c[0]], normal[c[1]], normal[c[2]] };
				add_triangle(s, q, n);
			}
		}
}

/* The squares of one colour: those whose i + j is odd, or even. */
static void add_squares(struct scene *s, int size, int odd)
{
	for (int i = 0; i < size; i++)
		for (int j = 0; j < size; j++) {
			if ((i + j) % 2 != odd)
				continue;
			double x[2], y[2];
			for (int k = 0; k < 2; k++) {
				x[k] = 4 * (2.0 * (i + k) / size - 1);
				y[k] = 4 * (2.0 * (j + k) / size - 1);
			}
			spd_add_quad(s, vec(x[0], y[0], 0), vec(x[1], y[0], 0), vec(x[1], y[1], 0), vec(x[0], y[1], 0));
		}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	int size = (int)o->size;
	spd_set_sky(s);
	spd_set_view(s, vec(4.86, 7.2, 5.4), vec(0, 0, 0), vec(0, 0, 1), 45, 1);
	scene_add_light(s, vec(-3.1, 9.8, 12.1));
	scene_add_light(s, vec(11.3, 5.1, 8.8));
	spd_add_material(s, (struct spd_material){ { 1, 1, 1 }, 0.5, 0.5, 30, 0, 0 });
	spd_note_finish(s, 0, 0.5);
	add_squares(s, size, 1);
	spd_add_material(s, (struct spd_material){ { 0.5, 0.5, 0.5 }, 0.5, 0.5, 30, 0, 0 });
	spd_note_finish(s, 0, 0.5);
	add_squares(s, size, 0);
	spd_add_material(s, (struct spd_material){ { 1, 0.5, 0.1 }, 0.75, 0.25, 37, 0, 0 });
	spd_note_finish(s, 0, 0.25);
	for (int i = 0; i < TEAPOT_PATCHES; i++)
		add_patch(s, teapot_patches[i], size);
}

static const char *const options[] = { NULL };
const struct spd_family spd_teapot = { "teapot", "Newell's teapot over a checkerboard, 64 size^2 - 8 size triangles", 6, 1, 4000,
	                               fill, options };
