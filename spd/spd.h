/* Scene generators: the "Standard Procedural Databases" of Eric Haines, and a few families of our own. Each is one file that
 * fills a struct scene; printing is somebody else's work (io/nff_write.h). */
#ifndef SPD_SPD_H
#define SPD_SPD_H

#include "base/err.h"
#include "base/key.h"
#include "scene/scene.h"

/* What a generator can be told; those it does not use it ignores. */
struct spd_options {
	int64_t size;       /* meaning and default are the family's; SPD_DEFAULT_SIZE: its default */
	bool tessellate;    /* curves as triangles (-t) */
	int64_t resolution; /* of tessellation, >= 1 */
	int variant;        /* enum spd_variant: balls */
	int64_t count;      /* soup: triangles */
	double cube;        /* soup: side of the cube the triangles lie in */
	int64_t seed;       /* soup, city, town, wall, theater, lab, room, forest, conference */
	int plan;           /* enum spd_plan: city */
	int camera;         /* enum spd_camera: city, town, wall */
	double exponent, alpha, beta, gamma; /* shells */
};

enum { SPD_DEFAULT_SIZE = -1 };
enum spd_variant { SPD_CURRENT, SPD_PRE2021 };
enum spd_plan { SPD_LOWER, SPD_MID };
enum spd_camera { SPD_EXTERIOR, SPD_INTERIOR };

/* One family. fill adds everything to an empty scene; it cannot fail otherwise than by memory (scene_complete tells).
 * options: names of the keys in spd_keys it uses besides size, NULL-terminated. */
struct spd_family {
	const char *name, *text;
	int default_size, least_size, most_size; /* all 0: the family has no size */
	void (*fill)(struct scene *s, const struct spd_options *o); /* o->size is set and in range */
	const char *const *options;
};

/* NULL-terminated; and the table of all options with ranges and defaults. */
extern const struct spd_family *const spd_families[];
extern const struct key spd_keys[];

/* The family called 'name', or NULL. */
const struct spd_family *spd_find(const char *name);

/* Fill an empty scene. 0, or -1 and *e: size outside the family's range (the message names it), memory. */
int spd_generate(struct scene *s, const struct spd_family *f, const struct spd_options *o, struct err *e);

/* A copy of 'from' as a pure soup: view, lights, materials, and every object as polygons of three corners; curves are
 * tessellated at 'resolution'. to: empty. 0, or -1 and *e (memory). */
int spd_soup(struct scene *to, const struct scene *from, int resolution, struct err *e);

#endif
