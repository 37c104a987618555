#include "io/pov_scope.h"

static bool make_room(struct pov_scope *s, uint32_t name)
{
	if (name < s->room)
		return true;
	size_t room = s->room ? s->room : 4096;
	while (room <= name)
		room *= 2;
	struct pov_binding **grown = arena_grow(s->mem, s->bindings, s->room, room, sizeof *grown);
	if (!grown)
		return false;
	s->bindings = grown;
	s->room = room;
	return true;
}

struct pov_binding *scope_find_in(const struct pov_scope *s, uint32_t name, uint32_t frame)
{
	struct pov_binding *b = scope_find(s, name);
	while (b && b->frame > frame)
		b = b->outer;
	return b && b->frame == frame ? b : NULL;
}

struct pov_binding *scope_bind(struct pov_scope *s, uint32_t name, uint32_t frame, struct pov_binding **list)
{
	if (!make_room(s, name))
		return NULL;
	struct pov_binding *b = s->free;
	if (b)
		s->free = b->older;
	else if (!(b = NEW(s->mem, struct pov_binding, 1)))
		return NULL;
	struct pov_binding **place = &s->bindings[name];
	while (*place && (*place)->frame > frame)
		place = &(*place)->outer;
	*b = (struct pov_binding){ .name = name, .frame = frame, .refers = &b->value, .outer = *place, .older = *list };
	*list = b;
	*place = b;
	return b;
}

void scope_remove(struct pov_scope *s, uint32_t name)
{
	struct pov_binding *b = scope_find(s, name);
	if (!b)
		return;
	s->bindings[name] = b->outer;
	b->name = 0; /* stays in its frame's list, as nobody's */
	b->value = (struct pov_value){ 0 };
}

void scope_close(struct pov_scope *s, struct pov_binding **list)
{
	while (*list) {
		struct pov_binding *b = *list;
		*list = b->older;
		if (b->name)
			s->bindings[b->name] = b->outer;
		b->older = s->free;
		s->free = b;
	}
}
