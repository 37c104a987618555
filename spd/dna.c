/* A double helix of reflecting spheres; stands in for "DNA" (410 spheres) of Subramanian and Fussell 1990. A base pair has ten: on
 * either strand a phosphate and, further in, a sugar; and six on the rung between them. 'size' is the number of pairs. In the view a
 * primary ray out of four or five hits one. */
#include "spd/common.h"

#define RISE 0.34
#define TWIST (36 * SPD_PI / 180)
#define GROOVE (150 * SPD_PI / 180) /* from one strand to the other, about the axis */

static const struct spd_material phosphate = { { 0.9, 0.55, 0.1 }, 0.6, 0.4, 6, 0, 1 };
static const struct spd_material sugar = { { 0.75, 0.75, 0.8 }, 0.6, 0.4, 6, 0, 1 };
static const struct spd_material bases[2] = { { { 0.2, 0.45, 0.85 }, 0.6, 0.4, 6, 0, 1 }, { { 0.85, 0.25, 0.3 }, 0.6, 0.4, 6, 0, 1 } };

static struct vec on_helix(double radius, double angle, double z)
{
	return vec(radius * cos(angle), radius * sin(angle), z);
}

/* Sphere number i of the pair at this turn: 0 and 1 phosphates, 2 and 3 sugars, from 4 on bases. */
static void add_part(struct scene *s, const struct spd_options *o, double turn, double z, int i)
{
	if (i < 2) {
		spd_add_sphere(s, o, on_helix(1, turn + i * GROOVE, z), 0.19);
		return;
	}
	struct vec sugars[2];
	for (int strand = 0; strand < 2; strand++)
		sugars[strand] = on_helix(0.8, turn + strand * GROOVE + 0.25, z + 0.1);
	double at = (i - 3) / 7.0;
	if (i < 4)
		spd_add_sphere(s, o, sugars[i - 2], 0.17);
	else
		spd_add_sphere(s, o, vec_add(vec_scale(sugars[0], 1 - at), vec_scale(sugars[1], at)), 0.15);
}

static void fill(struct scene *s, const struct spd_options *o)
{
	static const struct spd_material *const materials[10] = { &phosphate, &phosphate, &sugar, &sugar, &bases[0], &bases[0], &bases[0],
		                                                  &bases[1], &bases[1], &bases[1] };
	double top = RISE * (double)(o->size - 1), far = top > 4 ? top : 4;
	spd_set_sky(s);
	spd_set_view(s, vec(far, -0.9 * far, 0.62 * top), vec(0, 0, top / 2), vec(1, 1, 0.35), 20.2, 0.01);
	scene_add_light(s, vec(2 * far, -2 * far, 2 * far));
	scene_add_light(s, vec(2 * far, 0.5 * far, far));
	for (int i = 0; i < 10; i++) {
		if (i == 0 || materials[i] != materials[i - 1])
			spd_add_material(s, *materials[i]);
		for (int64_t pair = 0; pair < o->size; pair++)
			add_part(s, o, (double)pair * TWIST, (double)pair * RISE, i);
	}
}

static const char *const options[] = { "tessellate", NULL };
const struct spd_family spd_dna = { "dna", "a double helix of spheres, 10 a base pair", 41, 1, 100000, fill, options };
