#include "io/pov_facets.h"

#include <stdlib.h>

static bool same_place(struct vec p, struct vec q)
{
	return p.x == q.x && p.y == q.y && p.z == q.z;
}

void pov_facets_add(struct pov_facets *f, const struct vec *v, uint32_t material)
{
	if (!vec_is_finite(v[0]) || !vec_is_finite(v[1]) || !vec_is_finite(v[2]))
		return;
	if (f->lost || f->full || same_place(v[0], v[1]) || same_place(v[1], v[2]) || same_place(v[2], v[0]))
		return;
	if (f->count == f->most) {
		f->full = true;
		return;
	}
	if (f->count == f->room) {
		size_t room = f->room ? 2 * f->room : 16;
		struct pov_facet *grown = realloc(f->all, room * sizeof *grown);
		if (!grown) {
			f->lost = true;
			return;
		}
		f->all = grown;
		f->room = room;
	}
	f->all[f->count++] = (struct pov_facet){ { v[0], v[1], v[2] }, material };
}

void pov_facets_clear(struct pov_facets *f)
{
	f->count = 0;
}

void pov_facets_free(struct pov_facets *f)
{
	free(f->all);
	*f = (struct pov_facets){ .most = f->most };
}

struct box pov_facet_box(const struct pov_facet *f)
{
	struct box b = { f->v[0], f->v[0] };
	box_extend(&b, f->v[1]);
	box_extend(&b, f->v[2]);
	return b;
}
