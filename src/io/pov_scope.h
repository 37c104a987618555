/* Names and their values. Scoping is dynamic: frame 0 is the main file's, and every running macro and inclusion opens a further
 * one; the innermost binding of a name counts. Each name keeps its bindings in a list, the innermost first, so that looking one
 * up costs nothing, and each frame a list of what it bound, to be undone when it closes. */
#ifndef IO_POV_SCOPE_H
#define IO_POV_SCOPE_H

#include "io/pov_value.h"

struct pov_binding {
	uint32_t name, frame;
	struct pov_value value;
	struct pov_value *refers; /* what it stands for: &value, or the caller's variable */
	struct pov_binding *outer; /* of the same name */
	struct pov_binding *older; /* of the same frame; free ones too */
};

struct pov_scope {
	struct arena *mem;             /* borrowed */
	struct pov_binding **bindings; /* by name: the innermost, or NULL */
	size_t room;
	struct pov_binding *free;
};

/* The innermost binding of a name, or NULL. */
static inline struct pov_binding *scope_find(const struct pov_scope *s, uint32_t name)
{
	return name < s->room ? s->bindings[name] : NULL;
}

/* The binding of a name in this very frame, or NULL. */
struct pov_binding *scope_find_in(const struct pov_scope *s, uint32_t name, uint32_t frame);

/* A new binding of a name in a frame, whose list of bindings is *list, under those of frames further in; without a value.
 * NULL: memory out. */
struct pov_binding *scope_bind(struct pov_scope *s, uint32_t name, uint32_t frame, struct pov_binding **list);

/* Take the innermost binding of a name away. */
void scope_remove(struct pov_scope *s, uint32_t name);

/* Close a frame: take away all it bound. It must be the innermost. */
void scope_close(struct pov_scope *s, struct pov_binding **list);

#endif
