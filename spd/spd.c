#include "spd/spd.h"

#include "scene/triangulate.h"
#include "scene/tessellate.h"

#include <string.h>

extern const struct spd_family spd_tetra, spd_balls, spd_gears, spd_teapot, spd_mount, spd_rings, spd_tree, spd_lattice,
	spd_shells, spd_sombrero, spd_jacks, spd_nurbtst, spd_sample, spd_sphere, spd_soup_family, spd_city, spd_town,
	spd_wall, spd_dna, spd_arches, spd_geo58, spd_theater, spd_lab,
	spd_room, spd_atrium, spd_nave, spd_forest, spd_conference;

const struct spd_family *const spd_families[] = {
	&spd_tetra, &spd_balls, &spd_gears, &spd_teapot, &spd_mount, &spd_rings, &spd_tree, &spd_lattice, &spd_shells,
	&spd_sombrero, &spd_jacks, &spd_nurbtst, &spd_sample, &spd_sphere, &spd_soup_family, &spd_city, &spd_town,
	&spd_wall, &spd_dna, &spd_arches, &spd_geo58, &spd_theater, &spd_lab,
	&spd_room, &spd_atrium, &spd_nave, &spd_forest, &spd_conference, NULL
};

static const char *const variants[] = { "current", "pre2021", NULL };
static const char *const plans[] = { "lower", "mid", NULL };
static const char *const cameras[] = { "exterior", "interior", NULL };

#define AT(field) offsetof(struct spd_options, field)
const struct key spd_keys[] = {
	{ "size", KEY_INT, AT(size), SPD_DEFAULT_SIZE, 1e6, SPD_DEFAULT_SIZE, NULL, "the family's size; -1: its default" },
	{ "tessellate", KEY_BOOL, AT(tessellate), 0, 1, 0, NULL, "spheres and cones as triangles" },
	{ "resolution", KEY_INT, AT(resolution), 1, 1000, SPD_RESOLUTION, NULL, "of the tessellation: a sphere has 12 R^2 triangles" },
	{ "variant", KEY_WORD, AT(variant), 0, 0, SPD_CURRENT, variants, "balls as programs before 2021 placed them" },
	{ "count", KEY_INT, AT(count), 1, 2e9, 10000, NULL, "number of triangles" },
	{ "cube", KEY_REAL, AT(cube), 1e-6, 1e6, 20, NULL, "side of the cube the triangles' right angles lie in" },
	{ "seed", KEY_INT, AT(seed), 0, 9e15, 1, NULL, "of the random numbers" },
	{ "plan", KEY_WORD, AT(plan), 0, 0, SPD_LOWER, plans, "irregular quarters, or a grid with taller buildings" },
	{ "camera", KEY_WORD, AT(camera), 0, 0, SPD_EXTERIOR, cameras, "where it stands: outside, or inside among the walls" },
	{ "exponent", KEY_REAL, AT(exponent), 1e-6, 10, 0.15, NULL, "growth of the spiral" },
	{ "alpha", KEY_REAL, AT(alpha), 0, 1e6, 0, NULL, "if positive: height = alpha * angle" },
	{ "beta", KEY_REAL, AT(beta), -1e6, 1e6, -2, NULL, "else: height = beta * distance from the axis" },
	{ "gamma", KEY_REAL, AT(gamma), 1e-6, 1e6, 1, NULL, "sphere radius = distance from the axis / gamma" },
	{ 0 }
};
#undef AT

const struct spd_family *spd_find(const char *name)
{
	for (const struct spd_family *const *f = spd_families; *f; f++)
		if (strcmp((*f)->name, name) == 0)
			return *f;
	return NULL;
}

int spd_generate(struct scene *s, const struct spd_family *f, const struct spd_options *o, struct err *e)
{
	struct spd_options set = *o;
	if (f->default_size == 0)
		set.size = 0;
	else if (set.size == SPD_DEFAULT_SIZE)
		set.size = f->default_size;
	else if (set.size < f->least_size || set.size > f->most_size)
		return err_at(e, STATUS_INPUT, NULL, 0, "%s: size %lld is not in %d..%d", f->name, (long long)set.size, f->least_size,
		              f->most_size);
	f->fill(s, &set);
	return scene_complete(s, f->name, e);
}

/* Every triangle of a polygon of n corners, as polygons of three. */
static void add_triangles(struct scene *to, const struct vec *corners, size_t n, struct arena *scratch)
{
	uint32_t *triples = NEW(scratch, uint32_t, 3 * (n - 2));
	if (!triples || triangulate_polygon(corners, n, triples, scratch) != 0) {
		to->lost = true;
		return;
	}
	for (size_t i = 0; i + 2 < n; i++) {
		const uint32_t *t = &triples[3 * i];
		scene_add_polygon(to, (const struct vec[3]){ corners[t[0]], corners[t[1]], corners[t[2]] }, 3);
	}
}

static void add_as_triangles(struct scene *to, const struct scene *from, const struct object *o, int resolution,
                             struct arena *scratch)
{
	const struct vec *p = &from->points[o->first];
	if (o->kind == OBJECT_POLYGON || o->kind == OBJECT_PATCH) {
		if (o->count == 3)
			scene_add_polygon(to, p, 3);
		else if (o->count > 3)
			add_triangles(to, p, o->count, scratch);
		return;
	}
	struct scene curve = { 0 };
	if (o->kind == OBJECT_SPHERE)
		tessellate_sphere(&curve, p[0], fabs(o->radius[0]), resolution);
	else
		tessellate_cone(&curve, p[0], fabs(o->radius[0]), p[1], fabs(o->radius[1]), resolution);
	for (size_t i = 0; i < curve.object_count; i++)
		scene_add_polygon(to, &curve.points[curve.objects[i].first], 3);
	to->lost |= curve.lost;
	scene_free(&curve);
}

int spd_soup(struct scene *to, const struct scene *from, int resolution, struct err *e)
{
	struct arena scratch = { 0 };
	size_t materials = 0;
	to->background_given = from->background_given;
	to->background = from->background;
	to->view = from->view;
	for (size_t i = 0; i < from->light_count; i++) {
		if (from->lights[i].colored)
			scene_add_colored_light(to, from->lights[i].at, from->lights[i].color);
		else
			scene_add_light(to, from->lights[i].at);
	}
	for (size_t i = 0; i < from->object_count; i++) {
		const struct object *o = &from->objects[i];
		while (o->material != NO_MATERIAL && materials <= o->material)
			scene_add_material(to, from->materials[materials++]);
		add_as_triangles(to, from, o, resolution, &scratch);
	}
	arena_free(&scratch);
	return scene_complete(to, "soup", e);
}
