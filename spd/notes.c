#include "spd/notes.h"

#include <string.h>

/* Room for one element more behind 'count'; NULL, and s->lost, when memory is out. */
static void *grow(struct scene *s, void *old, size_t count, size_t *room, size_t size)
{
	if (count < *room)
		return old;
	size_t want = *room ? 2 * *room : 16;
	while (want <= count)
		want *= 2;
	void *grown = arena_grow(&s->notes->mem, old, *room, want, size);
	s->lost |= !grown;
	*room = grown ? want : *room;
	return grown ? grown : old;
}

void spd_notes_free(struct spd_notes *n)
{
	arena_free(&n->mem);
	*n = (struct spd_notes){ 0 };
}

void spd_note_finish(struct scene *s, double ambient, double highlight)
{
	struct spd_notes *n = s->notes;
	if (!n || s->lost)
		return;
	n->finishes = grow(s, n->finishes, s->material_count, &n->finish_room, sizeof *n->finishes);
	if (s->lost)
		return;
	n->finishes[s->material_count - 1] = (struct spd_finish){ ambient, highlight };
	n->finish_count = s->material_count;
}

static struct spd_shape *add(struct scene *s, enum spd_shape_kind kind, size_t first)
{
	struct spd_notes *n = s->notes;
	if (!n || s->lost)
		return NULL;
	n->shapes = grow(s, n->shapes, n->shape_count, &n->shape_room, sizeof *n->shapes);
	if (s->lost)
		return NULL;
	struct spd_shape *shape = &n->shapes[n->shape_count++];
	*shape = (struct spd_shape){ .kind = kind, .first = first, .count = s->object_count - first };
	return shape;
}

void spd_note_torus(struct scene *s, size_t first, struct vec center, struct vec normal, double ring, double tube)
{
	struct spd_shape *shape = add(s, SPD_TORUS, first);
	if (shape) {
		shape->center = center;
		shape->normal = normal;
		shape->radius[0] = ring;
		shape->radius[1] = tube;
	}
}

void spd_note_disc(struct scene *s, size_t first, struct vec center, struct vec normal, double radius)
{
	struct spd_shape *shape = add(s, SPD_DISC, first);
	if (shape) {
		shape->center = center;
		shape->normal = normal;
		shape->radius[0] = radius;
	}
}

void spd_note_heights(struct scene *s, size_t first, const float *heights, int n)
{
	struct spd_shape *shape = add(s, SPD_HEIGHTS, first);
	if (!shape)
		return;
	shape->n = n;
	shape->heights = NEW(&s->notes->mem, float, (size_t)n * (size_t)n);
	s->lost |= !shape->heights;
	if (!s->lost)
		memcpy(shape->heights, heights, (size_t)n * (size_t)n * sizeof *heights);
}

void spd_note_placed(struct scene *s, size_t first, const struct matrix *m)
{
	struct spd_shape *shape = add(s, SPD_PLACED, first);
	if (!shape || shape->count == 0)
		return;
	size_t base = s->objects[first].first, points = s->point_count - base;
	shape->matrix = *m;
	shape->objects = NEW(&s->notes->mem, struct object, shape->count);
	shape->points = NEW(&s->notes->mem, struct vec, points);
	s->lost |= !shape->objects || !shape->points;
	if (s->lost)
		return;
	memcpy(shape->points, s->points + base, points * sizeof *shape->points);
	memcpy(shape->objects, s->objects + first, shape->count * sizeof *shape->objects);
	for (size_t i = 0; i < shape->count; i++)
		shape->objects[i].first -= base;
}
