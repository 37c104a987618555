/* A binary tree of cones with a sphere at every joint, on a field (SPD "tree"). */
#include "spd/common.h"

struct branches {
	struct scene *scene;
	const struct spd_options *options;
	struct matrix child[2];
};

static struct matrix make_child(double tilt, double turn, double scale)
{
	struct matrix a = matrix_rotation(0, tilt * SPD_PI / 180), b = matrix_rotation(2, turn * SPD_PI / 180);
	struct matrix move = matrix_scale(scale, scale, scale), both = matrix_multiply(&a, &b);
	move.m[3][2] = 1;
	return matrix_multiply(&both, &move);
}

static void add(const struct branches *b, const struct matrix *m, double scale, int64_t depth)
{
	struct vec base = matrix_point(vec(0, 0, 0), m), apex = matrix_point(vec(0, 0, 1), m);
	double base_radius = scale * 0.15, apex_radius = base_radius * 0.67;
	spd_add_cone(b->scene, b->options, base, base_radius, apex, apex_radius);
	spd_add_sphere(b->scene, b->options, apex, apex_radius);
	for (int i = 0; depth > 0 && i < 2; i++) {
		struct matrix next = matrix_multiply(&b->child[i], m);
		add(b, &next, scale * 0.67, depth - 1);
	}
}

static void fill(struct scene *s, const struct spd_options *o)
{
	static const struct vec lights[7] = {
		{ { { -5, 5, 50 } } }, { { { 30, -30, 30 } } }, { { { -40, -30, 20 } } }, { { { 10, 30, 40 } } },
		{ { { -30, 40, 10 } } }, { { { 50, 25, 20 } } }, { { { -10, -60, 30 } } },
	};
	spd_set_sky(s);
	spd_set_view(s, vec(4.5, 0.4, 2), vec(0, 0, 1.5), vec(0, 0, 1), 45, 1);
	for (int i = 0; i < 7; i++)
		scene_add_light(s, lights[i]);
	spd_add_material(s, (struct spd_material){ { 0.2, 0.7, 0.2 }, 1, 0, 0, 0, 0 });
	spd_add_quad(s, vec(50, 50, 0), vec(-50, 50, 0), vec(-50, -50, 0), vec(50, -50, 0));
	spd_add_material(s, (struct spd_material){ { 0.55, 0.4, 0.2 }, 1, 0, 0, 0, 0 });
	struct branches b = { s, o, { make_child(40, 90, 0.65), make_child(25, 230, 0.7) } };
	struct matrix root = matrix_identity();
	add(&b, &root, 1, o->size);
}

static const char *const options[] = { "tessellate", "resolution", NULL };
const struct spd_family spd_tree = { "tree", "binary tree of 2^(size+1)-1 cones and spheres on a field", 11, 1, 24, fill, options };
