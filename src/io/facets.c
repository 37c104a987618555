#include "io/facets.h"

#include "base/rng.h"
#include "scene/tessellate.h"
#include "scene/triangulate.h"

#include <stdlib.h>
#include <string.h>

static void add(struct facets *f, const struct facet *facet)
{
	if (f->count == f->room && !f->lost) {
		size_t want = f->room ? 2 * f->room : 256;
		struct facet *grown = arena_grow(&f->mem, f->all, f->count, want, sizeof *grown);
		f->lost = !grown;
		f->all = grown ? grown : f->all;
		f->room = grown ? want : f->room;
	}
	if (!f->lost)
		f->all[f->count++] = *facet;
}

/* Corners i, j, k of a polygon or patch whose points are p. */
static void add_corners(struct facets *f, const struct object *o, const struct vec *p, uint32_t material, const uint32_t *k)
{
	struct facet facet = { .corner = { p[k[0]], p[k[1]], p[k[2]] }, .material = material, .smooth = o->kind == OBJECT_PATCH };
	for (int i = 0; facet.smooth && i < 3; i++)
		facet.normal[i] = p[o->count + k[i]];
	add(f, &facet);
}

static void add_polygon(struct facets *f, const struct object *o, const struct vec *p)
{
	static const uint32_t three[3] = { 0, 1, 2 };
	struct arena scratch = { 0 };
	if (o->count == 3) {
		add_corners(f, o, p, o->material, three);
	} else if (o->count > 3) {
		uint32_t *t = NEW(&scratch, uint32_t, 3 * ((size_t)o->count - 2));
		if (!t || triangulate_polygon(p, o->count, t, &scratch) != 0)
			f->lost = true;
		for (size_t i = 0; !f->lost && i + 2 < o->count; i++)
			add_corners(f, o, p, o->material, t + 3 * i);
	}
	arena_free(&scratch);
}

void facets_add(struct facets *f, const struct scene *s, const struct object *o, int resolution)
{
	const struct vec *p = &s->points[o->first];
	if (o->kind == OBJECT_POLYGON || o->kind == OBJECT_PATCH) {
		add_polygon(f, o, p);
		return;
	}
	struct scene curve = { 0 };
	if (o->kind == OBJECT_SPHERE)
		tessellate_sphere(&curve, p[0], fabs(o->radius[0]), resolution);
	else
		tessellate_cone(&curve, p[0], fabs(o->radius[0]), p[1], fabs(o->radius[1]), resolution);
	for (size_t i = 0; i < curve.object_count; i++) {
		struct object patch = curve.objects[i];
		patch.material = o->material;
		add_polygon(f, &patch, &curve.points[patch.first]);
	}
	f->lost |= curve.lost;
	scene_free(&curve);
}

void facets_free(struct facets *f)
{
	arena_free(&f->mem);
	*f = (struct facets){ 0 };
}

static uint64_t hash_row(const double *row, int width)
{
	uint64_t hash = 0;
	for (int i = 0; i < width; i++) {
		uint64_t bits;
		memcpy(&bits, &row[i], sizeof bits);
		hash = rng_mix(hash ^ bits);
	}
	return hash;
}

size_t facets_weld(const double *keys, size_t n, int width, uint32_t *index, uint32_t *rows)
{
	size_t room = 16, count = 0, bytes = (size_t)width * sizeof *keys;
	while (room < 2 * n)
		room *= 2;
	uint32_t *slots = n < UINT32_MAX ? malloc(room * sizeof *slots) : NULL;
	if (!slots)
		return SIZE_MAX;
	memset(slots, 0xff, room * sizeof *slots);
	for (size_t i = 0; i < n; i++) {
		const double *row = keys + i * (size_t)width;
		size_t at = hash_row(row, width) & (room - 1);
		while (slots[at] != UINT32_MAX && memcmp(keys + rows[slots[at]] * (size_t)width, row, bytes) != 0)
			at = (at + 1) & (room - 1);
		if (slots[at] == UINT32_MAX) {
			slots[at] = (uint32_t)count;
			rows[count++] = (uint32_t)i;
		}
		index[i] = slots[at];
	}
	free(slots);
	return count;
}
