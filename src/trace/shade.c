#include "trace/shade.h"

/* Of surfaces whose author gave no material. */
static const struct material plain = { { 0.8, 0.8, 0.8 }, 0.8, 0, 1, 0, 1 };

/* Weights of the corners at a point of the triangle's plane. */
static void weigh_corners(const struct triangle *t, struct vec p, double *weight)
{
	struct vec n = vec_cross(vec_sub(t->v[1], t->v[0]), vec_sub(t->v[2], t->v[0]));
	for (int i = 0; i < 3; i++) {
		struct vec a = vec_sub(t->v[(i + 1) % 3], p), b = vec_sub(t->v[(i + 2) % 3], p);
		weight[i] = vec_dot(vec_cross(a, b), n);
	}
}

/* The interpolated normal of a patch on the side of 'normal', or 'normal' where there is none. */
static struct vec shading_normal(const struct primitives *p, uint32_t id, struct vec at, struct vec normal, bool inside)
{
	const struct primitive *q = &p->all[id];
	if (!p->normals || q->kind != PRIMITIVE_TRIANGLE)
		return normal;
	double weight[3];
	struct vec sum = vec(0, 0, 0);
	weigh_corners(&q->triangle, at, weight);
	for (int i = 0; i < 3; i++)
		sum = vec_add(sum, vec_scale(vec_unit(p->normals[id][i]), weight[i]));
	sum = vec_unit(vec_scale(sum, inside ? -1 : 1));
	return vec_dot(sum, normal) > 0 ? sum : normal;
}

struct surface_point surface_point_make(const struct scene *s, const struct primitives *p, const struct ray *r, const struct hit *h)
{
	const struct primitive *q = &p->all[h->id];
	struct surface_point point = { .at = vec_add(r->o, vec_scale(r->d, h->t)) };
	struct vec n;
	if (q->kind == PRIMITIVE_TRIANGLE)
		n = vec_cross(vec_sub(q->triangle.v[1], q->triangle.v[0]), vec_sub(q->triangle.v[2], q->triangle.v[0]));
	else
		n = vec_sub(point.at, q->sphere.center);
	point.inside = vec_dot(n, r->d) > 0;
	point.normal = vec_unit(vec_scale(n, point.inside ? -1 : 1));
	point.shading = shading_normal(p, h->id, point.at, point.normal, point.inside);
	point.material = q->material < s->material_count ? &s->materials[q->material] : &plain;
	return point;
}

double light_strength(const struct scene *s)
{
	double n = (double)s->light_count;
	return n > 0 ? sqrt(n) / (2 * n) : 1;
}

struct color shade_light(const struct scene *s, size_t light, const struct surface_point *p, struct vec seen, struct vec toward)
{
	const struct material *m = p->material;
	const struct light *l = &s->lights[light];
	double strength = light_strength(s), facing = vec_dot(p->shading, toward);
	struct color color = l->colored ? l->color : (struct color){ strength, strength, strength };
	if (facing <= 0)
		return (struct color){ 0 };
	struct color sum = color_scale(color_times(color, m->color), m->kd * facing);
	struct vec mirrored = vec_sub(vec_scale(p->shading, 2 * facing), toward);
	double along = -vec_dot(mirrored, seen);
	if (m->ks > 0 && along > 0)
		color_add(&sum, color_scale(color, m->ks * pow(along, m->shine)));
	return sum;
}

struct color shade_ambient(const struct scene *s, const struct surface_point *p)
{
	return color_scale(p->material->color, p->material->kd * light_strength(s) / 2);
}

struct vec reflect(const struct surface_point *p, struct vec d)
{
	struct vec out = vec_sub(d, vec_scale(p->shading, 2 * vec_dot(d, p->shading)));
	if (vec_dot(out, p->normal) <= 0)
		out = vec_sub(d, vec_scale(p->normal, 2 * vec_dot(d, p->normal)));
	return vec_unit(out);
}

bool refract(const struct surface_point *p, struct vec d, struct vec *out)
{
	double index = p->material->ior > 0 ? p->material->ior : 1, ratio = p->inside ? index : 1 / index;
	double along = -vec_dot(d, p->normal), square = 1 - ratio * ratio * (1 - along * along);
	if (square < 0)
		return false;
	*out = vec_unit(vec_add(vec_scale(d, ratio), vec_scale(p->normal, ratio * along - sqrt(square))));
	return true;
}
