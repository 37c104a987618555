/* trace(): what rays can meet itself is met so; else the surface as triangles with a tree over them, made at the first call. A hit on a
 * facet is moved along the ray onto the shape the facet stands for. */
#include "io/pov_field_trace.h"
#include "io/pov_march.h"
#include "io/pov_surface.h"

/* direct: the solid, where no facets are needed; room: working space of its rays. */
struct pov_traced {
	const struct pov_term *direct;
	double *room;
	struct pov_facets facets; /* 'material' is the number of the leaf; all in the arena of the solid */
	struct pov_term **leaves;
	uint32_t leaf_count;
	struct pov_tree tree;
};

/* Half the side of the region of planes, and of what is marched through; hits nearer than that part of the facet's size are the start. */
static const double wide = 1e5, narrow = 100, start = 1e-6;

static void number_leaves(struct pov_traced *t, struct pov_term *term)
{
	if (term->kind == TERM_LEAF) {
		if (t->leaves) {
			term->material = t->leaf_count;
			t->leaves[t->leaf_count] = term;
		}
		t->leaf_count++;
	}
	for (struct pov_term *c = term->child; c; c = c->next)
		number_leaves(t, c);
}

/* The part of an extent that is nearer than 'far'. */
static struct box near_part(struct box b, double far)
{
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = fmax(b.lo.a[i], -far);
		b.hi.a[i] = fmin(b.hi.a[i], far);
	}
	return b;
}

/* The facets of a solid and the tree over them; false when memory is out. */
static bool make_facets(struct arena *a, struct pov_traced *t, struct pov_term *term, int resolution)
{
	struct arena scratch = { 0 };
	struct pov_facets list = { .most = 10000000 };
	number_leaves(t, term);
	t->leaves = NEW(a, struct pov_term *, t->leaf_count);
	t->leaf_count = 0;
	if (t->leaves)
		number_leaves(t, term);
	struct pov_surface surface = { .region = near_part(term->extent, wide), .close = near_part(term->extent, narrow), .n = resolution,
		                       .least = 0.75, .plain = true, .scratch = &scratch };
	surface.size = box_diagonal(&surface.region);
	if (t->leaves && term->kind != TERM_EMPTY)
		pov_surface(&surface, term, false, &list);
	struct box *boxes = NEW(&scratch, struct box, list.count);
	for (size_t i = 0; boxes && i < list.count; i++)
		boxes[i] = pov_facet_box(&list.all[i]);
	t->facets.all = arena_grow(a, list.all, list.count, list.count, sizeof *list.all);
	t->facets.count = list.count;
	bool done = t->leaves && !list.lost && boxes && t->facets.all && pov_tree_build(&t->tree, a, boxes, (uint32_t)list.count) == 0;
	pov_facets_free(&list);
	arena_free(&scratch);
	return done;
}

static struct pov_traced *make(struct arena *a, const struct pov_solid *s)
{
	struct pov_mesh_options options = pov_mesh_defaults();
	struct pov_tally tally = { 0 };
	struct pov_traced *t = NEW(a, struct pov_traced, 1);
	struct pov_term *term = pov_term_resolve(a, s, &options, &tally);
	size_t room;
	if (!t || !term)
		return NULL;
	if (!pov_field_traceable(term, &room))
		return make_facets(a, t, term, options.resolution) ? t : NULL;
	t->direct = term;
	t->room = NEW(a, double, room);
	return t->room ? t : NULL;
}

struct search {
	const struct pov_traced *traced;
	struct vec from, toward; /* unit */
	double nearest;
	uint32_t facet;
};

static bool enter(void *context, const struct box *b)
{
	const struct search *q = context;
	double near = 0, far = q->nearest;
	for (int i = 0; i < 3; i++) {
		if (q->toward.a[i] == 0) {
			if (q->from.a[i] < b->lo.a[i] || q->from.a[i] > b->hi.a[i])
				return false;
			continue;
		}
		double s = (b->lo.a[i] - q->from.a[i]) / q->toward.a[i], t = (b->hi.a[i] - q->from.a[i]) / q->toward.a[i];
		near = fmax(near, fmin(s, t));
		far = fmin(far, fmax(s, t));
	}
	return near <= far + 1e-9 * fabs(near);
}

/* Moeller and Trumbore, two-sided. */
static void test(void *context, uint32_t i)
{
	struct search *q = context;
	const struct vec *v = q->traced->facets.all[i].v;
	struct vec e1 = vec_sub(v[1], v[0]), e2 = vec_sub(v[2], v[0]), p = vec_cross(q->toward, e2), w = vec_sub(q->from, v[0]);
	double det = vec_dot(e1, p), u = vec_dot(w, p) / det, least = start * fmax(vec_length(w), vec_length(e1));
	struct vec r = vec_cross(w, e1);
	double x = vec_dot(q->toward, r) / det, t = vec_dot(e2, r) / det;
	if (det == 0 || !(u >= -1e-12 && x >= -1e-12 && u + x <= 1 + 1e-12 && t > least))
		return;
	if (t < q->nearest || (t == q->nearest && i < q->facet)) {
		q->nearest = t;
		q->facet = i;
	}
}

static double leaf_field(const void *context, struct vec p)
{
	return pov_term_field(context, p);
}

/* Onto the leaf's own surface, which is as far off as the field says; then the normal is that of the field, else the facet's. */
static void polish(const struct search *q, const struct pov_facet *f, const struct pov_term *leaf, struct vec *at, struct vec *normal)
{
	double edge = vec_length(vec_sub(f->v[1], f->v[0])), slope = pov_shape_of(leaf->shape)->slope;
	*normal = vec_unit(vec_cross(vec_sub(f->v[1], f->v[0]), vec_sub(f->v[2], f->v[0])));
	if (leaf->half_count || leaf->shape->kind == POV_TEXT || !(slope > 0 && isfinite(slope)) || !pov_shape_has_inside(leaf->shape))
		return;
	double off = fabs(pov_term_field(leaf, *at)) / (slope * leaf->squeeze), step = fmin(8 * off, 0.25 * edge);
	struct vec before = vec_sub(*at, vec_scale(q->toward, fmin(step, q->nearest))), behind = vec_add(*at, vec_scale(q->toward, step));
	double a = pov_term_field(leaf, before), b = pov_term_field(leaf, behind);
	if (a < 0 && b > 0)
		*at = pov_root(leaf_field, leaf, before, a, behind, b);
	else if (a > 0 && b < 0)
		*at = pov_root(leaf_field, leaf, behind, b, before, a);
	struct vec own = pov_term_slope(leaf, *at, 1e-4 * edge);
	double along = vec_dot(own, *normal);
	if (fabs(along) > 0.8)
		*normal = vec_scale(own, along > 0 ? 1 : -1);
}

bool pov_solid_trace(struct arena *a, struct pov_solid *s, struct vec from, struct vec toward, struct vec *at, struct vec *normal)
{
	*at = *normal = vec(0, 0, 0);
	if (!s->traced)
		s->traced = make(a, s);
	struct search q = { s->traced, from, vec_unit(toward), INFINITY, UINT32_MAX };
	if (!s->traced || vec_length(q.toward) == 0)
		return false;
	if (s->traced->direct)
		return pov_field_trace(s->traced->direct, from, q.toward, s->traced->room, at, normal);
	pov_tree_visit(&s->traced->tree, enter, test, &q);
	if (q.facet == UINT32_MAX)
		return false;
	const struct pov_facet *f = &s->traced->facets.all[q.facet];
	*at = vec_add(from, vec_scale(q.toward, q.nearest));
	polish(&q, f, s->traced->leaves[f->material], at, normal);
	return true;
}
