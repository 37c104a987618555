/* The first hit of a ray on a combination of solids: of every solid the first place that the others leave on the surface. */
#include "io/pov_field_trace.h"

/* Nearer than this, or this part of the extent of what is hit, is the start itself. The field's slope is measured over 'near' of what is most
 * curved. */
static const double start = 1e-6, near = 1e-6;

static bool find_kinds(const struct pov_term *t, size_t *room, bool *wanted)
{
	if (t->bound.lo.x != -INFINITY || t->bound.hi.x != INFINITY)
		return false;
	if (t->kind == TERM_LEAF) {
		const struct pov_shape *shape = pov_shape_of(t->shape);
		size_t own = shape->room ? shape->room(t->shape) : 0;
		*room = own > *room ? own : *room;
		*wanted = *wanted || t->shape->kind == POV_BLOB || t->shape->kind == POV_ISOSURFACE;
		if (t->shape->kind == POV_ISOSURFACE && !(t->shape->shape.isosurface.gradient > 0))
			return false;
		return shape->cross || t->shape->kind == POV_BOX || t->shape->kind == POV_PLANE;
	}
	for (const struct pov_term *c = t->child; c; c = c->next)
		if (!find_kinds(c, room, wanted))
			return false;
	return true;
}

bool pov_field_traceable(const struct pov_term *t, size_t *room)
{
	bool wanted = false;
	*room = 0;
	return find_kinds(t, room, &wanted) && wanted;
}

static bool holds(const struct pov_term *t, struct vec p)
{
	bool in = t->kind == TERM_LEAF ? pov_term_field(t, p) <= 0 : t->kind == TERM_MEET || t->kind == TERM_CLIP;
	bool all = in && t->kind != TERM_LEAF;
	for (const struct pov_term *c = t->child; c && in == all; c = c->next)
		in = holds(c, p);
	return in != t->inverse;
}

/* What a part of a combination stays on the surface by: all its siblings hold the point, or none does. */
struct filter {
	const struct pov_term *first, *except;
	bool held;
	const struct filter *outer;
};

struct shot {
	struct vec from, toward;
	double *room;
	double nearest;
	const struct pov_term *hit;
	bool turned; /* the hit faces inward */
};

/* One leaf, met by a shot. */
struct meeting {
	struct shot *shot;
	const struct pov_term *leaf;
	const struct filter *filter;
	bool turned;
};

static bool meet(void *context, double t)
{
	const struct meeting *m = context;
	struct vec p = vec_add(m->shot->from, vec_scale(m->shot->toward, t));
	for (const struct filter *f = m->filter; f; f = f->outer)
		for (const struct pov_term *c = f->first; c; c = c->next)
			if (c != f->except && holds(c, p) != f->held)
				return false;
	m->shot->nearest = t;
	m->shot->hit = m->leaf;
	m->shot->turned = m->turned;
	return true;
}

/* A plane or a box: where the ray enters or leaves all its half spaces. */
static void cross_halves(struct meeting *m, double least)
{
	double enter = -INFINITY, leave = INFINITY;
	for (int i = 0; i < m->leaf->half_count; i++) {
		const struct pov_half *h = &m->leaf->halves[i];
		double way = vec_dot(h->normal, m->shot->toward), off = h->offset - vec_dot(h->normal, m->shot->from);
		if (way < 0)
			enter = fmax(enter, off / way);
		else if (way > 0)
			leave = fmin(leave, off / way);
		else if (off < 0)
			return;
	}
	if (enter >= leave)
		return;
	if (enter > least && enter < m->shot->nearest && meet(m, enter))
		return;
	if (leave > least && leave < m->shot->nearest)
		meet(m, leave);
}

static void shoot_leaf(struct shot *s, const struct pov_term *t, const struct filter *f, bool turned)
{
	struct meeting m = { s, t, f, turned };
	double least = start * (box_is_finite(&t->extent) ? fmin(1, box_diagonal(&t->extent)) : 1);
	struct pov_line line = { matrix_point(s->from, &t->back), matrix_direction(s->toward, &t->back), least, s->nearest, meet, &m, s->room };
	if (t->half_count)
		cross_halves(&m, least);
	else if (least < s->nearest)
		pov_shape_of(t->shape)->cross(t->shape, &line);
}

static bool reaches(const struct shot *s, const struct box *b)
{
	struct box about = box_enlarge(b, start);
	struct pov_line line = { .from = s->from, .toward = s->toward, .least = 0, .most = s->nearest };
	return pov_line_clip_box(&line, &about);
}

/* 'turned' where an odd number of complements is about the term, as surfaces are made of it (io/pov_surface.c). */
static void shoot(struct shot *s, const struct pov_term *t, const struct filter *f, bool turned)
{
	turned = turned != t->inverse;
	if (!reaches(s, &t->extent))
		return;
	if (t->kind == TERM_LEAF) {
		shoot_leaf(s, t, f, turned);
		return;
	}
	bool met = t->kind == TERM_MEET || t->kind == TERM_CLIP, filtered = met || t->exact || turned;
	for (const struct pov_term *c = t->child; c; c = t->kind == TERM_CLIP ? NULL : c->next) {
		struct filter own = { t->child, c, met, f };
		shoot(s, c, filtered ? &own : f, turned);
	}
}

/* Of the half space whose border is nearest. */
static struct vec half_normal(const struct pov_term *t, struct vec at)
{
	const struct pov_half *best = t->halves;
	for (int i = 1; i < t->half_count; i++) {
		const struct pov_half *h = &t->halves[i];
		if (fabs(vec_dot(h->normal, at) - h->offset) < fabs(vec_dot(best->normal, at) - best->offset))
			best = h;
	}
	return best->normal;
}

static struct vec normal_at(const struct pov_term *t, struct vec at)
{
	return t->half_count ? half_normal(t, at) : pov_term_slope(t, at, near * t->feature);
}

bool pov_field_trace(const struct pov_term *t, struct vec from, struct vec toward, double *room, struct vec *at, struct vec *normal)
{
	struct shot s = { .from = from, .toward = toward, .room = room, .nearest = INFINITY };
	shoot(&s, t, NULL, false);
	if (!s.hit)
		return false;
	*at = vec_add(from, vec_scale(toward, s.nearest));
	*normal = vec_scale(normal_at(s.hit, *at), s.turned ? -1 : 1);
	return true;
}
