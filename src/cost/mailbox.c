#include "cost/mailbox.h"

#include "cost/faces.h"
#include "cost/surface.h"

#include <stdlib.h>

struct sparing {
	const struct accel *accel;
	struct err *err;
	bool lines;
	uint32_t *common; /* ids that both lists have */
	size_t room;
	double sum;
};

static int find_common(struct sparing *s, const struct cell *b, const struct cell *c, uint32_t *count)
{
	size_t most = b->count < c->count ? b->count : c->count;
	*count = 0;
	if (most > s->room) {
		uint32_t *grown = realloc(s->common, 2 * most * sizeof *grown);
		if (!grown)
			return err_memory(s->err, "mailbox");
		s->common = grown;
		s->room = 2 * most;
	}
	for (uint32_t i = 0, k = 0; i < b->count && k < c->count;) {
		uint32_t id = b->ids[i], other = c->ids[k];
		if (id == other)
			s->common[(*count)++] = id;
		i += id <= other;
		k += other <= id;
	}
	return 0;
}

static bool lies_in_plane(const struct primitive *p, int axis, double plane, double slack)
{
	for (int i = 0; i < 3; i++)
		if (p->kind != PRIMITIVE_TRIANGLE || fabs(p->triangle.v[i].a[axis] - plane) > slack)
			return false;
	return true;
}

/* Area of the piece that triangles lying in its plane cover: both leaves list them. */
static int measure_covered(struct sparing *s, const struct shared_face *f, uint32_t count, double *covered)
{
	struct cell thin = { .bounds = f->piece, .ids = s->common, .count = count, .leaf = true };
	struct surface surface;
	bool any = false;
	*covered = 0;
	for (uint32_t i = 0; !s->lines && !any && i < count; i++)
		any = lies_in_plane(&s->accel->primitives->all[s->common[i]], f->axis, f->piece.hi.a[f->axis], s->accel->slack);
	if (!any)
		return 0;
	thin.bounds.lo.a[f->axis] = f->lower->bounds.lo.a[f->axis];
	if (surface_measure(&surface, s->accel, &thin, s->err) != 0)
		return -1;
	*covered = surface.covered[2 * f->axis + 1];
	return 0;
}

static int add_face(void *ctx, const struct shared_face *f)
{
	struct sparing *s = ctx;
	uint32_t count;
	double covered;
	if (f->lower->count == 0 || f->upper->count == 0)
		return 0;
	if (find_common(s, f->lower, f->upper, &count) != 0)
		return -1;
	if (count == 0)
		return 0;
	if (measure_covered(s, f, count, &covered) != 0)
		return -1;
	s->sum += 2 * count * (face_area(&f->piece, 2 * f->axis) - covered);
	return 0;
}

int mailbox_measure_spared(double *spared, const struct accel *a, bool lines, struct err *e)
{
	struct sparing s = { .accel = a, .err = e, .lines = lines };
	int status = faces_visit(a, add_face, &s, e);
	free(s.common);
	*spared = s.sum;
	return status;
}
