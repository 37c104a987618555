/* Three tori, a cone and a disc (SPD "sample"). */
#include "spd/common.h"

/* Turns z to the normal, then moves to the centre. */
static struct matrix make_frame(struct vec center, struct vec normal)
{
	struct vec n = vec_unit(normal), axis = fabs(n.z) == 1 ? vec(1, 0, 0) : vec_unit(vec(-n.y, n.x, 0));
	struct matrix turn = matrix_axis_rotation(axis, acos(n.z)), move = matrix_translation(center.x, center.y, center.z);
	return matrix_multiply(&turn, &move);
}

static void find_torus_point(double ring, double tube, double u, double v, struct vec *p, struct vec *n)
{
	double su = sin(u), cu = cos(u), sv = sin(v), cv = cos(v), reach = ring + tube * su;
	*p = vec(reach * cv, reach * sv, tube * cu);
	*n = vec_unit(vec_cross(vec(tube * cu * cv, tube * cu * sv, -tube * su), vec(-reach * sv, reach * cv, 0)));
}

static void add_torus(struct scene *s, const struct spd_options *o, struct vec center, struct vec normal)
{
	struct matrix frame = make_frame(center, normal);
	int n = 4 * (int)o->resolution;
	size_t first = s->object_count;
	double delta = 2 * SPD_PI / n, u = 0;
	for (int i = 0; i < n; i++, u += delta) {
		double v = 0;
		for (int j = 0; j < n; j++, v += delta) {
			struct vec p[4], q[4]; /* at (u,v), (u,v+d), (u+d,v+d), (u+d,v) */
			for (int k = 0; k < 4; k++) {
				find_torus_point(2, 0.5, k > 1 ? u + delta : u, k == 1 || k == 2 ? v + delta : v, &p[k], &q[k]);
				p[k] = matrix_point(p[k], &frame);
				q[k] = matrix_direction(q[k], &frame);
			}
			scene_add_patch(s, (const struct vec[3]){ p[2], p[1], p[0] }, (const struct vec[3]){ q[2], q[1], q[0] }, 3);
			scene_add_patch(s, (const struct vec[3]){ p[3], p[2], p[0] }, (const struct vec[3]){ q[3], q[2], q[0] }, 3);
		}
	}
	if (!o->tessellate)
		spd_note_torus(s, first, center, normal, 2, 0.5);
}

static void add_disc(struct scene *s, const struct spd_options *o, struct vec center, struct vec normal, double radius)
{
	enum { QUARTER = 4 };
	struct matrix frame = make_frame(center, normal);
	size_t first = s->object_count;
	double delta = 2 * SPD_PI / (4 * QUARTER), t = 0;
	for (int i = 0; i < 4 * QUARTER; i++, t += delta) {
		struct vec p[4];
		for (int k = 0; k < 4; k++) {
			double angle = k == 1 || k == 2 ? t + delta : t, q = k < 2 ? radius : 0;
			p[k] = matrix_point(vec(q * cos(angle), q * sin(angle), 0), &frame);
		}
		spd_add_quad(s, p[0], p[1], p[2], p[3]);
	}
	if (!o->tessellate)
		spd_note_disc(s, first, center, normal, radius);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	static const struct color colors[5] = { { 0, 1, 1 }, { 1, 1, 0 }, { 1, 0, 1 }, { 1, 0, 0 }, { 1, 0, 0 } };
	scene_set_background(s, 0.8, 0.8, 0.8);
	spd_set_view(s, vec(0, 5, -5), vec(0, 0, 0), vec(0, 1, 0), 45, 0.001);
	scene_add_light(s, vec(-10, 20, -20));
	for (int i = 0; i < 5; i++) {
		spd_add_material(s, (struct spd_material){ colors[i], 0.7, 0, 10, 0, 1 });
		spd_note_finish(s, 0.1, 0.7);
		if (i < 3)
			add_torus(s, o, vec(i - 1, 0, 0), vec(1 - i, 1, -0.5));
		else if (i == 3)
			spd_add_cone(s, o, vec(0, -2, 0), 2, vec(0, 2, 0), 0.1);
		else
			add_disc(s, o, vec(0, -2, 0), vec(0, 1, 0), 4);
	}
}

static const char *const options[] = { "tessellate", "resolution", NULL };
const struct spd_family spd_sample = { "sample", "three tori, a cone and a disc; no size", 0, 0, 0, fill, options };
