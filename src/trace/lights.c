#include "trace/lights.h"

/* How far from the middle of a box along 'way', in its lengths, the box ends. */
static double find_side(const struct box *b, struct vec way)
{
	double far = INFINITY;
	for (int i = 0; i < 3; i++)
		if (way.a[i] != 0)
			far = fmin(far, (b->hi.a[i] - b->lo.a[i]) / 2 / fabs(way.a[i]));
	return far;
}

struct light *lights_place(struct arena *mem, const struct scene *s, const struct box *bounds, enum light_place where)
{
	struct light *lights = NEW(mem, struct light, s->light_count);
	struct vec middle = vec_scale(vec_add(bounds->lo, bounds->hi), 0.5);
	for (size_t i = 0; lights && i < s->light_count; i++) {
		lights[i] = s->lights[i];
		struct vec way = vec_sub(lights[i].at, middle);
		if (vec_length(way) == 0)
			way = vec(0, 0, bounds->hi.z - bounds->lo.z);
		double side = find_side(bounds, way);
		if ((where == LIGHT_INSIDE && side < 1) || (where == LIGHT_OUTSIDE && side >= 1))
			lights[i].at = vec_add(middle, vec_scale(way, (where == LIGHT_INSIDE ? 0.9 : 1.5) * side));
	}
	return lights;
}
