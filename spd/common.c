#include "spd/common.h"

static double shine_of(double angle)
{
	if (angle <= 0)
		return 100000;
	if (angle >= 90)
		return 1;
	return log(0.5) / log(cos(SPD_PI * angle / 180));
}

void spd_add_material(struct scene *s, struct spd_material m)
{
	scene_add_material(s, (struct material){ m.color, m.kd, m.ks, shine_of(m.angle), m.transmit, m.ior });
}

void spd_set_sky(struct scene *s)
{
	scene_set_background(s, 0.078, 0.361, 0.753);
}

void spd_set_view(struct scene *s, struct vec from, struct vec at, struct vec up, double angle, double hither)
{
	scene_set_view(s, from, at, up, angle, hither, 512, 512);
}

void spd_add_sphere(struct scene *s, const struct spd_options *o, struct vec center, double radius)
{
	if (o->tessellate)
		tessellate_sphere(s, center, radius, (int)o->resolution);
	else
		scene_add_sphere(s, center, radius);
}

void spd_add_cone(struct scene *s, const struct spd_options *o, struct vec base, double base_radius, struct vec apex,
                  double apex_radius)
{
	if (o->tessellate)
		tessellate_cone(s, base, base_radius, apex, apex_radius, (int)o->resolution);
	else
		scene_add_cone(s, base, base_radius, apex, apex_radius);
}

void spd_add_quad(struct scene *s, struct vec a, struct vec b, struct vec c, struct vec d)
{
	const struct vec corners[4] = { a, b, c, d };
	scene_add_polygon(s, corners, 4);
}

void spd_add_sides(struct scene *s, struct vec lo, struct vec hi, const int side[6][4])
{
	struct vec p[8];
	for (int i = 0; i < 8; i++)
		p[i] = vec(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
	for (int i = 0; i < 6; i++)
		spd_add_quad(s, p[side[i][0]], p[side[i][1]], p[side[i][2]], p[side[i][3]]);
}

void spd_add_box(struct scene *s, struct vec lo, struct vec hi)
{
	static const int side[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
	spd_add_sides(s, lo, hi, side);
}

void spd_add_triangle(struct scene *s, struct vec a, struct vec b, struct vec c)
{
	const struct vec corners[3] = { a, b, c };
	scene_add_polygon(s, corners, 3);
}

void spd_transform(struct scene *s, size_t first, const struct matrix *m)
{
	for (size_t i = first; i < s->object_count; i++) {
		struct object *o = &s->objects[i];
		struct vec *p = &s->points[o->first];
		for (uint32_t k = 0; k < o->count; k++)
			p[k] = matrix_point(p[k], m);
		for (uint32_t k = o->count; o->kind == OBJECT_PATCH && k < 2 * o->count; k++)
			p[k] = matrix_normal(p[k], m);
		double scale = vec_length(vec(m->m[0][0], m->m[0][1], m->m[0][2]));
		o->radius[0] *= scale;
		o->radius[1] *= scale;
	}
}
