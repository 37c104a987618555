/* A unit sphere of 8 * 4^size triangles: the octahedron, each triangle cut into four and pushed out to the sphere, size times. */
#include "spd/common.h"

static struct vec between(struct vec a, struct vec b)
{
	return vec_unit(vec_add(a, b));
}

static void add(struct scene *s, int64_t depth, struct vec a, struct vec b, struct vec c)
{
	if (depth == 0) {
		spd_add_triangle(s, a, b, c);
		return;
	}
	struct vec ab = between(a, b), bc = between(b, c), ca = between(c, a);
	add(s, depth - 1, a, ab, ca);
	add(s, depth - 1, ab, b, bc);
	add(s, depth - 1, ca, bc, c);
	add(s, depth - 1, ab, bc, ca);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	spd_set_sky(s);
	spd_set_view(s, vec(3, 2, 2), vec(0, 0, 0), vec(0, 0, 1), 45, 0.01);
	scene_add_light(s, vec(5, 3, 8));
	spd_add_material(s, (struct spd_material){ { 0.9, 0.9, 0.8 }, 0.8, 0.2, 30, 0, 1 });
	for (int i = 0; i < 8; i++) {
		struct vec x = vec(i & 1 ? -1 : 1, 0, 0), y = vec(0, i & 2 ? -1 : 1, 0), z = vec(0, 0, i & 4 ? -1 : 1);
		bool mirrored = (i & 1) ^ (i >> 1 & 1) ^ (i >> 2 & 1);
		add(s, o->size, x, mirrored ? z : y, mirrored ? y : z);
	}
}

static const char *const options[] = { NULL };
const struct spd_family spd_sphere = { "sphere", "subdivided octahedron on the unit sphere, 8*4^size triangles", 3, 0, 13, fill,
	                               options };
