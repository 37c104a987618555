#include "batch/row_key.h"

#include "base/rng.h"

#include <stdio.h>

/* Part of every key: to be raised when the same inputs give other rows. */
enum { FORMAT = 8 };

static uint64_t hash_text(uint64_t hash, const char *text)
{
	for (const char *p = text; *p; p++)
		hash = rng_mix(hash ^ (uint64_t)(unsigned char)*p);
	return rng_mix(hash);
}

uint64_t hash_bytes(const char *bytes, size_t count)
{
	uint64_t hash = rng_mix(count);
	for (size_t i = 0; i < count; i++)
		hash = rng_mix(hash ^ (unsigned char)bytes[i]);
	return hash;
}

/* An option, numbers to the last bit, texts whole. */
static uint64_t hash_option(uint64_t hash, const struct key *k, const void *options)
{
	const void *at = (const char *)options + k->offset;
	char value[64];
	if (k->type == KEY_TEXT)
		return hash_text(hash_text(hash, k->name), *(const char *const *)at);
	key_print(k, options, value, sizeof value);
	if (k->type == KEY_REAL)
		snprintf(value, sizeof value, "%.17g", *(const double *)at);
	return hash_text(hash_text(hash, k->name), value);
}

/* Every option of the structure that means something. */
static uint64_t hash_structure(uint64_t hash, const struct structure_spec *s)
{
	for (const struct key *k = s->ops->keys; k->name; k++)
		if (accel_applies(s->ops, s->options, k->name))
			hash = hash_option(hash, k, s->options);
	return rng_mix(hash);
}

static uint64_t hash_measure(uint64_t hash, const struct measure_spec *m)
{
	for (const struct key *k = measure_keys(m); k->name; k++)
		if (measure_applies(m, k->name))
			hash = hash_option(hash, k, m);
	return rng_mix(hash);
}

uint64_t row_key(const struct job *job, const struct scene_spec *scene, const struct structure_spec *structure,
                 const struct measure_spec *measure, const struct primitives *p, uint64_t text_hash)
{
	uint64_t hash = hash_text(rng_mix(FORMAT), structure->ops->name);
	hash = hash_measure(hash_structure(hash, structure), measure);
	if (measure->render)
		hash = rng_mix(hash ^ text_hash);
	hash = rng_mix(hash ^ (uint64_t)job->seed);
	hash = hash_text(hash_text(hash, job->name), scene->name);
	hash = hash_text(hash, scene->family ? scene->family->name : "");
	return p ? rng_mix(hash ^ p->hash) : hash;
}
