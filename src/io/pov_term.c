#include "io/pov_term.h"

#include "io/pov_place.h"

#include <string.h>

struct resolver {
	struct arena *mem;
	const struct pov_mesh_options *options;
	struct pov_tally *tally;
	bool lost;
};

/* What a node hands down to its parts. */
struct context {
	struct matrix place;
	uint32_t material;
	struct box bound;
	bool turned; /* an odd number of complements is about it */
};

double pov_term_field(const struct pov_term *t, struct vec p)
{
	return pov_shape_of(t->shape)->field(t->shape, matrix_point(p, &t->back));
}

struct vec pov_term_slope(const struct pov_term *t, struct vec at, double h)
{
	struct vec slope;
	for (int i = 0; i < 3; i++) {
		struct vec p = at, q = at;
		p.a[i] -= h;
		q.a[i] += h;
		slope.a[i] = pov_term_field(t, q) - pov_term_field(t, p);
	}
	return vec_unit(slope);
}

static struct pov_term *new_term(struct resolver *r, enum pov_term_kind kind)
{
	struct pov_term *t = NEW(r->mem, struct pov_term, 1);
	if (!t) {
		r->lost = true;
		return NULL;
	}
	t->kind = kind;
	t->box = t->extent = box_empty();
	t->bound = box_infinite();
	return t;
}

static void count_skipped(struct pov_tally *tally, const char *reason)
{
	tally->skipped++;
	for (int i = 0; i < POV_REASONS; i++) {
		if (tally->reasons[i].reason && strcmp(tally->reasons[i].reason, reason) != 0)
			continue;
		tally->reasons[i].reason = reason;
		tally->reasons[i].count++;
		return;
	}
}

/* Planes and boxes as half spaces of the scene. */
static void find_halves(struct resolver *r, struct pov_term *t)
{
	const struct pov_solid *s = t->shape;
	struct pov_half *h = NEW(r->mem, struct pov_half, 6);
	if (!h) {
		r->lost = true;
		return;
	}
	if (s->kind == POV_BOX) {
		for (int i = 0; i < 6; i++) {
			h[i].normal.a[i / 2] = i % 2 ? 1 : -1;
			h[i].offset = i % 2 ? s->shape.box.corner[1].a[i / 2] : -s->shape.box.corner[0].a[i / 2];
		}
		t->half_count = 6;
	} else {
		h->normal = s->kind == POV_PLANE ? s->shape.plane.normal : s->shape.disc.normal;
		h->offset = s->kind == POV_PLANE ? s->shape.plane.distance : vec_dot(h->normal, s->shape.disc.center);
		t->half_count = 1;
	}
	for (int i = 0; i < t->half_count; i++) {
		struct vec foot = vec_scale(h[i].normal, h[i].offset / vec_dot(h[i].normal, h[i].normal));
		h[i].normal = vec_unit(matrix_normal(h[i].normal, &t->place));
		h[i].offset = vec_dot(h[i].normal, matrix_point(foot, &t->place));
	}
	t->halves = h;
}

static struct pov_term *resolve_shape(struct resolver *r, const struct pov_solid *s, const struct context *c)
{
	const struct pov_shape *shape = pov_shape_of(s);
	struct pov_term *t = new_term(r, TERM_LEAF);
	double least, most;
	r->tally->objects++;
	if (!t)
		return NULL;
	t->shape = s;
	t->place = c->place;
	t->material = c->material;
	t->bound = c->bound;
	if (s->kind == POV_UNKNOWN || !pov_place_invert(&t->place, &t->back)) {
		count_skipped(r->tally, s->kind == POV_UNKNOWN ? s->shape.unknown : "flattened by a transform");
		t->kind = TERM_EMPTY;
		return t;
	}
	pov_place_stretch(&t->back, &least, &t->squeeze);
	pov_place_stretch(&t->place, &least, &most);
	t->extent = pov_shape_placed(s, &t->place);
	struct box filled = shape->filled ? shape->filled(s) : box_empty(), own = shape->bounds(s);
	t->full = c->turned && !pov_shape_has_inside(s);
	t->box = t->full                    ? box_infinite()
	         : !pov_shape_has_inside(s) ? box_empty()
	         : shape->filled            ? pov_place_box(&filled, &t->place)
	                                    : t->extent;
	t->feature = (shape->feature ? shape->feature(s) : box_longest(&own)) * least;
	if (s->kind == POV_BOX || s->kind == POV_PLANE || s->kind == POV_DISC)
		find_halves(r, t);
	return t;
}

static void add_child(struct pov_term *t, struct pov_term **end, struct pov_term *child)
{
	*end = child;
	child->index = t->child_count++;
	t->clipped = t->clipped || child->clipped || child->kind == TERM_CLIP;
}

/* Drop what is empty from a union and what is everything from an intersection; the other way round it decides all. */
static struct pov_term *finish(struct resolver *r, struct pov_term *t)
{
	struct pov_term **end = &t->child;
	bool meet = t->kind != TERM_UNION;
	for (struct pov_term *c = t->child; c; c = c->next) {
		if (c->kind == TERM_EMPTY && c->inverse != meet) {
			*t = (struct pov_term){ .kind = TERM_EMPTY, .inverse = !meet, .box = box_empty(), .extent = box_empty() };
			return t;
		}
		if (c->kind == TERM_EMPTY) {
			t->child_count--;
			continue;
		}
		*end = c;
		end = &c->next;
	}
	*end = NULL;
	if (!t->child) {
		t->kind = TERM_EMPTY;
		t->inverse = meet;
	} else if (t->kind == TERM_UNION) {
		r->lost = pov_term_union_box(r->mem, t) != 0 || r->lost;
	} else if (t->kind == TERM_MEET) {
		r->lost = pov_term_meet_box(r->mem, t) != 0 || r->lost;
	} else {
		r->lost = pov_term_clip_box(r->mem, t) != 0 || r->lost;
	}
	return t;
}

/* Turn inside out: clips stay as they are, so that where there are any the inversion goes down to the solids they clip. */
static struct pov_term *turn_over(struct resolver *r, struct pov_term *t)
{
	if (t->kind == TERM_CLIP) {
		struct pov_term *rest = t->child->next;
		t->child->next = NULL;
		t->child = turn_over(r, t->child);
		t->child->next = rest;
		r->lost = pov_term_clip_box(r->mem, t) != 0 || r->lost;
		return t;
	}
	if (!t->clipped) {
		t->inverse = !t->inverse;
		return t;
	}
	struct pov_term *u = new_term(r, t->kind == TERM_UNION ? TERM_MEET : TERM_UNION), **end;
	if (!u)
		return t;
	u->inverse = t->inverse;
	u->exact = true;
	end = &u->child;
	for (struct pov_term *c = t->child, *next; c; c = next, end = &(*end)->next) {
		next = c->next;
		c->next = NULL;
		add_child(u, end, turn_over(r, c));
	}
	return finish(r, u);
}

static struct pov_term *resolve(struct resolver *r, const struct pov_solid *s, const struct context *from);

/* The parts in a row, from *end on. */
static void resolve_row(struct resolver *r, struct pov_term *t, struct pov_term **end, const struct pov_solid *row, const struct context *c)
{
	for (; row && !r->lost; row = row->next) {
		struct pov_term *part = resolve(r, row, c);
		if (!part)
			return;
		add_child(t, end, part);
		end = &part->next;
	}
}

/* What a difference takes away, as the complement of its union. */
static struct pov_term *resolve_difference(struct resolver *r, const struct pov_solid *s, const struct context *c)
{
	struct pov_term *t = new_term(r, TERM_MEET), *first = s->child ? resolve(r, s->child, c) : new_term(r, TERM_EMPTY);
	struct pov_term *rest = new_term(r, TERM_UNION);
	struct context taken = *c;
	taken.turned = !c->turned;
	if (!t || !first || !rest)
		return NULL;
	add_child(t, &t->child, first);
	if (s->child)
		resolve_row(r, rest, &rest->child, s->child->next, &taken);
	if (r->lost)
		return NULL;
	rest = turn_over(r, finish(r, rest));
	add_child(t, &first->next, rest);
	return finish(r, t);
}

static struct pov_term *resolve_combination(struct resolver *r, const struct pov_solid *s, const struct context *c)
{
	if (s->kind == POV_DIFFERENCE)
		return resolve_difference(r, s, c);
	struct pov_term *t = new_term(r, s->kind == POV_INTERSECTION ? TERM_MEET : TERM_UNION);
	if (!t)
		return NULL;
	t->exact = s->kind == POV_MERGE && r->options->merge_exact;
	resolve_row(r, t, &t->child, s->child, c);
	return r->lost ? NULL : finish(r, t);
}

/* An isosurface is capped by its container, unless it is open; a parametric surface is clipped by it. */
static struct pov_term *contain(struct resolver *r, struct pov_term *leaf)
{
	const struct pov_solid *s = leaf->shape;
	struct pov_solid *around = NEW(r->mem, struct pov_solid, 1);
	struct context c = { leaf->place, leaf->material, leaf->bound, false };
	if (!around) {
		r->lost = true;
		return NULL;
	}
	if (leaf->kind == TERM_EMPTY || !pov_shape_container(s, around))
		return leaf;
	struct pov_term *container = resolve_shape(r, around, &c);
	struct pov_term *t = new_term(r, s->kind == POV_ISOSURFACE && !s->open ? TERM_MEET : TERM_CLIP);
	if (!container || !t)
		return NULL;
	r->tally->objects--;
	add_child(t, &t->child, leaf);
	add_child(t, &leaf->next, container);
	return finish(r, t);
}

static struct pov_term *resolve_clips(struct resolver *r, struct pov_term *of, const struct pov_solid *clips, const struct context *c)
{
	struct pov_term *t = new_term(r, TERM_CLIP);
	struct context upright = *c;
	upright.turned = false;
	if (!t)
		return NULL;
	add_child(t, &t->child, of);
	resolve_row(r, t, &of->next, clips, &upright);
	/* A clip that cannot be computed clips nothing. */
	for (struct pov_term *p = of->next; p; p = p->next)
		p->inverse = p->inverse || p->kind == TERM_EMPTY;
	return r->lost ? NULL : finish(r, t);
}

/* What bounded_by lets through. */
static struct box bound_box(const struct pov_solid *bounds, const struct matrix *place)
{
	struct box b = box_infinite();
	for (; bounds; bounds = bounds->next) {
		struct box own = pov_solid_extent(bounds), part = pov_place_box(&own, place);
		b = box_common(&b, &part);
	}
	return b;
}

static struct pov_term *resolve(struct resolver *r, const struct pov_solid *s, const struct context *from)
{
	struct context c = *from;
	struct box bound = bound_box(s->bound, &from->place);
	c.place = matrix_multiply(&s->place, &from->place);
	c.material = s->material != NO_MATERIAL ? s->material : from->material;
	c.bound = box_common(&bound, &from->bound);
	c.turned = from->turned != s->inverse;
	struct pov_term *t = s->kind < POV_UNION ? resolve_shape(r, s, &c) : resolve_combination(r, s, &c);
	if (t && (s->kind == POV_ISOSURFACE || s->kind == POV_PARAMETRIC))
		t = contain(r, t);
	if (t && s->inverse)
		t = turn_over(r, t);
	if (t && s->clip)
		t = resolve_clips(r, t, s->clip, from);
	if (t)
		t->bound = c.bound;
	return r->lost ? NULL : t;
}

struct pov_term *pov_term_resolve(struct arena *a, const struct pov_solid *s, const struct pov_mesh_options *options,
                                  struct pov_tally *tally)
{
	struct resolver r = { a, options, tally, false };
	struct context c = { matrix_identity(), NO_MATERIAL, box_infinite(), false };
	return resolve(&r, s, &c);
}
