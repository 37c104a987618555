/* The ray tracer: an image, and what its rays cost by class.
 *
 * A primary ray a sample; every hit sends one shadow ray to every light, which ends there, a mirrored ray where the material has
 * ks > 0, and a refracted one where it transmits, up to a depth. Which rays there are, and what they hit, does not depend on the
 * structure. */
#ifndef TRACE_RENDER_H
#define TRACE_RENDER_H

#include "accel/accel.h"
#include "scene/scene.h"
#include "trace/lights.h"
#include "trace/shoot.h"

#include <stdatomic.h>

/* CENTERS: a sample in the middle of every pixel. CORNERS: one at every pixel corner, (width + 1)(height + 1) of them, the first and
 * the last on the image's edges; a pixel is the mean of its four. LATTICE: as many samples as pixels, but evenly spread in all
 * directions (x by rank, y by the golden section) where the rows of a small image would miss what repeats; for pilots, no image. */
enum render_sampling { SAMPLE_CENTERS, SAMPLE_CORNERS, SAMPLE_LATTICE };

/* ALL: every hit sends a shadow ray to every light; FACING: only to the lights its side of the surface faces. */
enum render_shadows { SHADOWS_ALL, SHADOWS_FACING };

/* PRESET_SPD: the procedure of the SPD scenes: pixel corners, rays to the depth of 5, no limit on their weight. */
enum render_preset { PRESET_NONE, PRESET_SPD };

struct render_options {
	int64_t width, height; /* pixels */
	int64_t ray_depth;     /* a primary ray has 1, one it spawns 2, ...; shadow rays are not limited */
	double weight;         /* rays that could add less than this share to a pixel are not shot */
	int sampling, shadows, preset;
	int light;             /* enum light_place, by the box of the primitives */
	const char *flight;    /* borrowed; as flight.h reads it; NULL: the scene's view, once */
	int64_t frames;        /* of the flight; the first is at its first place, the last at its last one */
};

/* Images that make up the rendering. */
static inline size_t render_frames(const struct render_options *o)
{
	return o->flight ? (size_t)o->frames : 1;
}

/* The table of its options; ends with a NULL name. RENDER_KEYS: the same rows for a struct that holds the options as 'field'. */
extern const struct key render_keys[];
extern const char *const render_sampling_words[], *const render_shadows_words[], *const render_preset_words[],
	*const render_light_words[];

#define RENDER_KEYS(type, field) \
	{ "preset", KEY_WORD, offsetof(type, field.preset), 0, 0, PRESET_NONE, render_preset_words, \
	  "spd: the procedure of the SPD scenes: pixel corners, depth 5, no limit on weight" }, \
	{ "width", KEY_INT, offsetof(type, field.width), 1, 16384, 512, NULL, "pixels" }, \
	{ "height", KEY_INT, offsetof(type, field.height), 1, 16384, 512, NULL, "pixels" }, \
	{ "sampling", KEY_WORD, offsetof(type, field.sampling), 0, 0, SAMPLE_CENTERS, render_sampling_words, \
	  "primary rays through pixel centres or corners" }, \
	{ "shadows", KEY_WORD, offsetof(type, field.shadows), 0, 0, SHADOWS_ALL, render_shadows_words, \
	  "a hit sends shadow rays to all lights, or to those its side of the surface faces" }, \
	{ "ray_depth", KEY_INT, offsetof(type, field.ray_depth), 1, 32, 5, NULL, "of the tree of rays; a primary ray has 1" }, \
	{ "weight", KEY_REAL, offsetof(type, field.weight), 0, 1, 0, NULL, \
	  "rays that could add less than this share to a pixel are not shot" }, \
	{ "light", KEY_WORD, offsetof(type, field.light), 0, 0, LIGHT_SCENE, render_light_words, \
	  "where lights stand: as in the scene, or all of them inside, or outside, the box of the primitives" }, \
	{ "flight", KEY_TEXT, offsetof(type, field.flight), 0, 0, 0, NULL, \
	  "'x y z to x y z, ...': places the camera flies through, and what it looks at; the rays of all frames count together" }, \
	{ "frames", KEY_INT, offsetof(type, field.frames), 1, 10000, 100, NULL, "of the flight" }

/* What the preset stands for put in the places of the single options. */
void render_resolve(struct render_options *o);

enum ray_class { RAY_PRIMARY, RAY_SHADOW, RAY_REFLECTED, RAY_REFRACTED, RAY_CLASSES };
extern const char *const ray_class_words[];

/* One class: its rays, those of them that visit no cell, and what the others cost. */
struct class_tally {
	uint64_t rays, missed;
	struct tally sum;
};

/* Where a ray ended: ray.t_max is where it hit, or its light, or infinite. */
struct segment {
	struct ray ray;
	uint32_t sample; /* counted through all frames */
	uint8_t class;
	bool hit;
};

struct rendering {
	struct class_tally classes[RAY_CLASSES];
	struct actual actual; /* means over the rays that visit a cell; standard errors take the sample as the unit */
	unsigned char *pixels; /* [height][width][3], 0..255; in mem; of a flight's first frame */
	struct segment *segments; /* in the order of frames and samples, if wanted; in mem */
	size_t segment_count;
	struct arena mem;     /* owned */
};

/* What a rendering is asked to do besides. */
struct render_run {
	double alpha, beta;
	int threads;
	bool segments;           /* keep them */
	const atomic_int *stop;  /* as for shoot_rays */
	void (*progress)(void *ctx, size_t done, size_t all); /* may be NULL; called by any thread, one at a time */
	void *ctx;
};

/* Render scene s, whose primitives 'a' holds; s needs no objects. o is resolved. 0, or -1 and *e: memory, a flight that
 * cannot be read, stopped ("interrupted").
 * Free it in any case. */
int render_scene(struct rendering *out, const struct scene *s, const struct accel *a, const struct render_options *o,
                 const struct render_run *run, struct err *e);

void rendering_free(struct rendering *r);

#endif
