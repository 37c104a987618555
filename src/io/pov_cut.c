#include "io/pov_cut.h"

#include "base/grow.h"
#include "io/pov_march.h"

#include <stdlib.h>

enum {
	CORNERS = 16,      /* of a triangle cut by at most six planes, and more */
	FINE = 12,         /* cuts to the thickness of a shape */
	LEVELS = 16,       /* halvings at most */
	FINEST = 400,      /* and the longest side of a shape to a cut at most */
};

static const double flush = 1e-9;       /* of the size at hand: what lies so near to a surface lies in it */
static const double surroundings = 0.87; /* of an edge, in its lengths: see halve */

/* A convex polygon while it is cut exactly. */
struct piece {
	int count;
	struct vec corner[CORNERS];
};

static void put(struct pov_facets *to, const struct vec *v, uint32_t material)
{
	if (to)
		pov_facets_add(to, v, material);
}

static void put_piece(struct pov_facets *to, const struct piece *p, uint32_t material)
{
	for (int i = 2; i < p->count; i++) {
		struct vec v[3] = { p->corner[0], p->corner[i - 1], p->corner[i] };
		put(to, v, material);
	}
}

static void add_corner(struct piece *p, struct vec v)
{
	if (p->count < CORNERS)
		p->corner[p->count++] = v;
}

/* Part the piece by the signed distances of its corners; new corners are the same on both sides. */
static void part(const struct piece *p, const double *d, struct piece *in, struct piece *out)
{
	in->count = out->count = 0;
	for (int i = 0; i < p->count; i++) {
		int j = i + 1 < p->count ? i + 1 : 0;
		if (d[i] <= 0)
			add_corner(in, p->corner[i]);
		if (d[i] >= 0)
			add_corner(out, p->corner[i]);
		if ((d[i] < 0 && d[j] > 0) || (d[i] > 0 && d[j] < 0)) {
			int a = d[i] < 0 ? i : j, b = d[i] < 0 ? j : i;
			struct vec way = vec_sub(p->corner[b], p->corner[a]), at = vec_add(p->corner[a], vec_scale(way, d[a] / (d[a] - d[b])));
			add_corner(in, at);
			add_corner(out, at);
		}
	}
}

/* Peel: what is beyond a half space is outside, the rest goes on to the next. What lies in its plane counts as inside, if it
 * faces the same way or the other way. */
struct in_plane {
	bool same, other;
};

static void cut_halves(const struct pov_half *halves, int count, struct in_plane inside, const struct pov_facet *f, struct pov_facets *in,
                       struct pov_facets *out)
{
	struct piece rest = { 3, { f->v[0], f->v[1], f->v[2] } };
	struct vec normal = vec_cross(vec_sub(f->v[1], f->v[0]), vec_sub(f->v[2], f->v[0]));
	for (int h = 0; h < count && rest.count >= 3; h++) {
		double d[CORNERS], size = fabs(halves[h].offset);
		int beyond = 0, within = 0;
		for (int i = 0; i < rest.count; i++)
			size = fmax(size, vec_length(rest.corner[i]));
		for (int i = 0; i < rest.count; i++) {
			d[i] = vec_dot(halves[h].normal, rest.corner[i]) - halves[h].offset;
			d[i] = fabs(d[i]) <= flush * size ? 0 : d[i];
			beyond += d[i] > 0;
			within += d[i] < 0;
		}
		if (beyond == 0 && (within > 0 || (vec_dot(normal, halves[h].normal) > 0 ? inside.same : inside.other)))
			continue;
		struct piece inner = { 0 }, outer = rest;
		if (within > 0)
			part(&rest, d, &inner, &outer);
		put_piece(out, &outer, f->material);
		rest = inner;
	}
	put_piece(in, &rest, f->material);
}

/* Cutting by a curved leaf. */
struct bend {
	const struct pov_term *leaf;
	struct box seen;       /* beyond it the leaf decides nothing, or nothing is wanted */
	double longest, flush; /* edges longer than that are halved; a field so near to zero is zero */
	struct pov_facets *in, *out;
	uint32_t material;
	bool *cut;
};

struct corner {
	struct vec p;
	double f;
};

static double bend_field(const void *context, struct vec p)
{
	const struct bend *b = context;
	double f = pov_term_field(b->leaf, p);
	return fabs(f) <= b->flush ? 0 : f;
}

static bool ball_meets(struct vec p, double r, const struct box *b)
{
	for (int i = 0; i < 3; i++)
		if (p.a[i] + r < b->lo.a[i] || p.a[i] - r > b->hi.a[i])
			return false;
	return true;
}

/* Whether to halve an edge: *middle is its middle then. A short one only where it goes in and out again. The ball about the
 * middle of the longest edge with sqrt 3 / 2 of its length holds the whole triangle, so that a triangle with no edge to halve is short or
 * provably on one side. */
static bool halve(const struct bend *b, const struct corner *p, const struct corner *q, struct corner *middle)
{
	double length = vec_length(vec_sub(q->p, p->p)), r = surroundings * length;
	middle->p = vec_scale(vec_add(p->p, q->p), 0.5);
	if (!isfinite(length) || !ball_meets(middle->p, r, &b->seen)) /* too long for a double's square: cut as it is */
		return false;
	middle->f = bend_field(b, middle->p);
	if (length <= b->longest)
		return (p->f <= 0) == (q->f <= 0) && (middle->f <= 0) != (p->f <= 0);
	double reach = pov_shape_reach(b->leaf->shape, matrix_point(middle->p, &b->leaf->back), r * b->leaf->squeeze);
	return !(fabs(middle->f) > reach);
}

static void put_corners(struct pov_facets *to, struct vec p, struct vec q, struct vec r, uint32_t material)
{
	struct vec v[3] = { p, q, r };
	put(to, v, material);
}

/* A triangle with short edges: cut off the corner that is alone on its side. */
static void settle(const struct bend *b, const struct corner *c)
{
	int inside = 0, lone = 0;
	for (int i = 0; i < 3; i++)
		inside += c[i].f <= 0;
	if (inside == 0 || inside == 3) {
		put_corners(inside ? b->in : b->out, c[0].p, c[1].p, c[2].p, b->material);
		return;
	}
	while ((c[lone].f <= 0) != (inside == 1))
		lone++;
	const struct corner *p = &c[lone], *q = &c[(lone + 1) % 3], *r = &c[(lone + 2) % 3];
	struct vec pq = p->f <= 0 ? pov_root(bend_field, b, p->p, p->f, q->p, q->f) : pov_root(bend_field, b, q->p, q->f, p->p, p->f);
	struct vec pr = p->f <= 0 ? pov_root(bend_field, b, p->p, p->f, r->p, r->f) : pov_root(bend_field, b, r->p, r->f, p->p, p->f);
	put_corners(p->f <= 0 ? b->in : b->out, p->p, pq, pr, b->material);
	put_corners(p->f <= 0 ? b->out : b->in, pq, q->p, r->p, b->material);
	put_corners(p->f <= 0 ? b->out : b->in, pq, r->p, pr, b->material);
	*b->cut = true;
}

static void refine(const struct bend *b, const struct corner *c, int level)
{
	struct corner m[3];
	bool split[3];
	int n = 0;
	for (int i = 0; i < 3; i++) {
		split[i] = level < LEVELS && halve(b, &c[i], &c[(i + 1) % 3], &m[i]);
		n += split[i];
	}
	if (n == 0) {
		settle(b, c);
		return;
	}
	/* Turn so that edge 0 is the one alone: the only one halved, or the only one not; with three any. */
	int t = 0;
	while (n < 3 && split[t] != (n == 1))
		t++;
	struct corner p = c[t], q = c[(t + 1) % 3], r = c[(t + 2) % 3], pq = m[t], qr = m[(t + 1) % 3], rp = m[(t + 2) % 3];
	if (n == 1) {
		refine(b, (struct corner[]){ p, pq, r }, level + 1);
		refine(b, (struct corner[]){ pq, q, r }, level + 1);
		return;
	}
	refine(b, (struct corner[]){ qr, r, rp }, level + 1);
	if (n == 2) {
		refine(b, (struct corner[]){ p, q, qr }, level + 1);
		refine(b, (struct corner[]){ p, qr, rp }, level + 1);
		return;
	}
	refine(b, (struct corner[]){ p, pq, rp }, level + 1);
	refine(b, (struct corner[]){ pq, q, qr }, level + 1);
	refine(b, (struct corner[]){ pq, qr, rp }, level + 1);
}

static void cut_bent(const struct pov_cutter *c, struct pov_term *leaf, const struct pov_facet *f, struct pov_facets *in,
                     struct pov_facets *out)
{
	struct box seen = box_common(&leaf->extent, &c->region);
	double size = box_longest(&seen), fine = fmax(fmin(leaf->feature, size) / FINE, size / FINEST);
	double slope = pov_shape_of(leaf->shape)->slope, part = c->size > 0 ? fmin(1, fmax(c->least, sqrt(size / c->size))) : 1;
	struct bend b = { leaf, box_common(&leaf->box, &c->within), 1.5 * fine * 32 / (c->n * part), 0, in, out, f->material, &leaf->cut };
	struct corner corner[3];
	if (slope > 0 && isfinite(slope))
		b.flush = flush * slope * (box_longest(&leaf->extent) + vec_length(leaf->extent.lo)) * leaf->squeeze;
	for (int i = 0; i < 3; i++)
		corner[i] = (struct corner){ f->v[i], bend_field(&b, f->v[i]) };
	refine(&b, corner, 0);
}

static void cut_facet(const struct pov_cutter *c, const struct pov_facet *f, struct pov_term *t, const struct pov_term *except,
                      struct pov_facets *in, struct pov_facets *out);

/* The box of all that decides how the facet is cut: with the surroundings of its edges, so that a neighbour is never cut by what it
 * is not. */
static struct box decision_box(const struct pov_facet *f)
{
	struct box b = pov_facet_box(f);
	return box_enlarge(&b, surroundings * box_diagonal(&b));
}

/* The facet against the parts in turn: what one decides is done, the rest goes on to the next. decided: the side a part decides. */
struct turns {
	struct pov_cutter cutter;
	const struct pov_term *except;
	struct pov_facets rest[2], *in, *out;
	int at; /* which of rest is to go on */
	bool meet;
};

/* Among siblings of what is excepted, the one of lower index keeps what both share. */
static const struct pov_cutter *cutter_for(struct turns *s, const struct pov_term *part)
{
	if (s->except)
		s->cutter.flush = part->index > s->except->index;
	return &s->cutter;
}

static void take_turn(struct turns *s, struct pov_term *part)
{
	struct pov_facets *from = &s->rest[s->at], *to = &s->rest[!s->at];
	if (part == s->except)
		return;
	pov_facets_clear(to);
	for (size_t i = 0; i < from->count; i++)
		cut_facet(cutter_for(s, part), &from->all[i], part, NULL, s->meet ? to : s->in, s->meet ? s->out : to);
	s->at = !s->at;
}

static void pass_lost(struct pov_facets *to, const struct pov_facets *from)
{
	if (to) {
		to->lost = to->lost || from->lost;
		to->full = to->full || from->full;
	}
}

static void end_turns(struct turns *s)
{
	struct pov_facets *to = s->meet ? s->in : s->out;
	for (size_t i = 0; i < s->rest[s->at].count; i++)
		put(to, s->rest[s->at].all[i].v, s->rest[s->at].all[i].material);
	for (int k = 0; k < 2; k++) {
		pass_lost(s->in ? s->in : s->out, &s->rest[k]);
		pov_facets_free(&s->rest[k]);
	}
}

/* A facet that has still to meet parts of a union: those in the tree from this place on. */
struct waiting {
	struct pov_facet facet;
	uint32_t node, item;
};

/* The next part it may meet, or NULL; the place is behind that part. */
static struct pov_term *next_part(const struct pov_term *t, struct waiting *w)
{
	struct box own = decision_box(&w->facet);
	while (w->node < t->tree.node_count) {
		const struct pov_tree_node *n = &t->tree.nodes[w->node];
		if (!box_meets(&n->box, &own)) {
			w->node = n->skip;
			w->item = 0;
			continue;
		}
		while (w->item < n->count) {
			struct pov_term *part = t->children[t->tree.order[n->first + w->item++]];
			if (part->inverse || box_meets(&part->box, &own))
				return part;
		}
		w->node++;
		w->item = 0;
	}
	return NULL;
}

/* Against a union of many. Each piece that is left of the facet goes on by itself, for it meets fewer of the parts. */
static void cut_by_many(struct turns *s, const struct pov_term *t, const struct pov_facet *f)
{
	struct pov_facets *rest = &s->rest[0];
	struct waiting *all = malloc(sizeof *all);
	size_t count = 0, room = 1;
	struct err ignored = { 0 };
	rest->lost = rest->lost || !all;
	if (all)
		all[count++] = (struct waiting){ .facet = *f };
	while (count > 0 && !rest->lost) {
		struct waiting w = all[--count];
		struct pov_term *part = next_part(t, &w);
		pov_facets_clear(rest);
		if (!part)
			put(s->out, w.facet.v, w.facet.material);
		else if (part == s->except)
			pov_facets_add(rest, w.facet.v, w.facet.material);
		else
			cut_facet(cutter_for(s, part), &w.facet, part, NULL, s->in, rest);
		rest->lost = rest->lost || array_reserve((void **)&all, count, &room, rest->count, sizeof *all, "facets", &ignored) != 0;
		for (size_t i = rest->count; i-- > 0 && !rest->lost;)
			all[count++] = (struct waiting){ rest->all[i], w.node, w.item };
	}
	pov_facets_clear(rest);
	free(all);
}

static void cut_parts(const struct pov_cutter *c, bool turned, const struct pov_facet *f, struct pov_term *t, const struct pov_term *except,
                      struct pov_facets *in, struct pov_facets *out)
{
	size_t most = in ? in->most : out->most;
	struct turns s = { .cutter = *c, .except = except, .rest = { { .most = most }, { .most = most } }, .in = in, .out = out,
		           .meet = t->kind != TERM_UNION };
	s.cutter.turned = turned;
	if (t->children) {
		cut_by_many(&s, t, f);
	} else {
		pov_facets_add(&s.rest[0], f->v, f->material);
		/* Exact cuts first: they leave less to the others. */
		for (int pass = 0; pass < 2; pass++)
			for (struct pov_term *part = t->child; part && s.rest[s.at].count; part = part->next)
				if ((part->half_count > 0) == (pass == 0))
					take_turn(&s, part);
	}
	end_turns(&s);
}

static void cut_facet(const struct pov_cutter *c, const struct pov_facet *f, struct pov_term *t, const struct pov_term *except,
                      struct pov_facets *in, struct pov_facets *out)
{
	struct box own = decision_box(f);
	bool turned = c->turned != t->inverse;
	if (t->inverse) {
		struct pov_facets *swap = in;
		in = out;
		out = swap;
	}
	if (!in && !out)
		return;
	if (t->kind == TERM_LEAF && !pov_shape_has_inside(t->shape))
		put(t->full ? in : out, f->v, f->material);
	else if (t->kind == TERM_EMPTY || !box_meets(&own, &t->box))
		put(out, f->v, f->material);
	else if (t->kind != TERM_LEAF)
		cut_parts(c, turned, f, t, except, in, out);
	else if (t->halves)
		/* Against a complement the same way is the other, and inside is outside. */
		cut_halves(t->halves, t->half_count, turned ? (struct in_plane){ true, !c->flush } : (struct in_plane){ c->flush, false }, f, in, out);
	else
		cut_bent(c, t, f, in, out);
}

void pov_cut(const struct pov_cutter *c, const struct pov_facets *list, struct pov_term *term, const struct pov_term *except,
             struct pov_facets *in, struct pov_facets *out)
{
	pass_lost(in ? in : out, list);
	for (size_t i = 0; i < list->count && !(in && (in->lost || in->full)) && !(out && (out->lost || out->full)); i++)
		cut_facet(c, &list->all[i], term, except, in, out);
}

void pov_cut_box(const struct pov_facets *list, const struct box *b, struct pov_facets *in)
{
	struct pov_half walls[6];
	int n = 0;
	for (int i = 0; i < 6; i++) {
		double at = i % 2 ? b->hi.a[i / 2] : -b->lo.a[i / 2];
		if (!isfinite(at))
			continue;
		walls[n] = (struct pov_half){ vec(0, 0, 0), at };
		walls[n++].normal.a[i / 2] = i % 2 ? 1 : -1;
	}
	pass_lost(in, list);
	for (size_t i = 0; i < list->count; i++)
		cut_halves(walls, n, (struct in_plane){ true, true }, &list->all[i], in, NULL);
}
