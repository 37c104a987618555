#include "batch/measure.h"

#include <stdio.h>
#include <string.h>

static const char *const rays_words[] = { "invariant", "lines", "segments", "segments-twice", "interior", "interior-hits", NULL };
static const char *const sides_words[] = { "two", "one", "ext", NULL };

#define AT(field) offsetof(struct measure_spec, field)
#define WEIGHTS \
	{ "alpha", KEY_REAL, AT(alpha), 0, 1e9, 1, NULL, "cost of a visited leaf" }, \
	{ "beta", KEY_REAL, AT(beta), 0, 1e9, 1, NULL, "cost of a ray-primitive test" }, \
	{ 0 }

const struct key measure_rays_keys[] = {
	{ "rays", KEY_WORD, AT(rays), 0, 0, RAYS_INVARIANT, rays_words,
	  "invariant: uniform by area over root and surfaces, cosine law; lines: through the root, nothing stops them; "
	  "segments: any hit between two points of a box 20 % larger; segments-twice: each of them twice; "
	  "interior: from anywhere inside the root, in any direction, nothing stops them; interior-hits: up to their hits" },
	{ "sides", KEY_WORD, AT(sides), 0, 0, SIDES_TWO, sides_words,
	  "sides of every surface that rays start on: both, the front, or the front of closed solids" },
	{ "count", KEY_INT, AT(count), 1, 1e12, 1e6, NULL, "number of rays" },
	{ "error", KEY_REAL, AT(error), 0, 1, 0, NULL, "more rays, up to 100 times as many, until the standard error of every count is at "
	  "most this share of its mean; 0: no more" },
	WEIGHTS
};

const struct key measure_image_keys[] = {
	RENDER_KEYS(struct measure_spec, image),
	{ "pilot_width", KEY_INT, AT(pilot_width), 1, 4096, 32, NULL, "pixels of the pilot image the predictors replay" },
	{ "pilot_height", KEY_INT, AT(pilot_height), 1, 4096, 32, NULL, "pixels of the pilot image the predictors replay" },
	WEIGHTS
};

const char *measure_workload(const struct measure_spec *m)
{
	static const char *const sides[] = { "invariant", "invariant-one-sided", "invariant-ext" };
	if (m->render)
		return "render";
	return m->rays == RAYS_INVARIANT ? sides[m->sides] : rays_words[m->rays];
}

bool measure_applies(const struct measure_spec *m, const char *key)
{
	if (strcmp(key, "light") == 0)
		return m->image.light != LIGHT_SCENE;
	if (strcmp(key, "flight") == 0 || strcmp(key, "frames") == 0)
		return m->image.flight;
	return true;
}

void measure_print(const struct measure_spec *m, char *out, size_t size)
{
	size_t n = (size_t)snprintf(out, size, "%s", m->render ? "render" : "");
	for (const struct key *k = measure_keys(m); k->name && n < size; k++) {
		char value[64];
		if (!measure_applies(m, k->name))
			continue;
		key_print(k, m, value, sizeof value);
		n += (size_t)snprintf(out + n, size - n, "%s%s=%s", n ? " " : "", k->name, value);
	}
}
