/* blob: threshold - sum of strength (1 - d^2 / radius^2)^2 over the components nearer than their radius; d is the distance to a
 * point or to a segment, in each component's own space. */
#include "io/pov_blob.h"
#include "io/pov_march.h"
#include "io/pov_place.h"

enum { CELLS_A_RADIUS = 7, CELLS_LEAST = 2, CELLS_MOST = 4000, CELLS_MANY = 200000 };

static int seal_component(struct pov_sealed_component *c, const struct pov_component *given)
{
	double least;
	*c = (struct pov_sealed_component){ .given = *given, .box = box_empty() };
	if (!pov_place_invert(&given->place, &c->back) || !(given->radius > 0) || given->strength == 0)
		return 1;
	pov_place_stretch(&c->back, &least, &c->shrink);
	for (int k = 0; k < 2; k++) {
		struct box ball = { given->end[k], given->end[k] };
		ball = box_enlarge(&ball, given->radius);
		box_join(&c->box, &ball);
	}
	c->box = pov_place_box(&c->box, &given->place);
	return 0;
}

static int seal_blob(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_blob *b = &s->shape.blob;
	struct pov_sealed_blob *q = NEW(a, struct pov_sealed_blob, 1);
	struct box *boxes = NEW(a, struct box, b->count);
	if (!q || !boxes || !(q->all = NEW(a, struct pov_sealed_component, b->count)))
		return err_memory(e, "blob");
	q->box = box_empty();
	q->finest = INFINITY;
	for (size_t i = 0; i < b->count; i++) {
		struct pov_sealed_component *c = &q->all[q->count];
		if (seal_component(c, &b->components[i]) != 0)
			continue;
		boxes[q->count++] = c->box;
		q->finest = fmin(q->finest, c->given.radius / c->shrink);
		q->area += box_area(&c->box);
		if (c->given.strength > 0)
			box_join(&q->box, &c->box);
	}
	s->sealed = q;
	*why = "blob without components";
	if (pov_tree_build(&q->tree, a, boxes, q->count) != 0)
		return err_memory(e, "blob");
	return box_is_empty(&q->box) ? 1 : 0;
}

static struct box blob_bounds(const struct pov_solid *s)
{
	return ((const struct pov_sealed_blob *)s->sealed)->box;
}

/* A question about the field at p, or within r of it. */
struct query {
	const struct pov_sealed_blob *blob;
	struct vec p;
	double r, sum;
};

static bool is_near(void *context, const struct box *b)
{
	const struct query *q = context;
	for (int i = 0; i < 3; i++)
		if (q->p.a[i] < b->lo.a[i] - q->r || q->p.a[i] > b->hi.a[i] + q->r)
			return false;
	return true;
}

static double component_distance(const struct pov_sealed_component *c, struct vec p)
{
	struct vec w = vec_sub(matrix_point(p, &c->back), c->given.end[0]), way = vec_sub(c->given.end[1], c->given.end[0]);
	double square = vec_dot(way, way), t = square > 0 ? fmin(1, fmax(0, vec_dot(w, way) / square)) : 0;
	return vec_length(vec_sub(w, vec_scale(way, t)));
}

static void add_strength(void *context, uint32_t i)
{
	struct query *q = context;
	const struct pov_sealed_component *c = &q->blob->all[i];
	double d = component_distance(c, q->p) / c->given.radius;
	if (d < 1)
		q->sum += c->given.strength * (1 - d * d) * (1 - d * d);
}

static double blob_field(const struct pov_solid *s, struct vec p)
{
	struct query q = { s->sealed, p, 0, 0 };
	pov_tree_visit(&q.blob->tree, is_near, add_strength, &q);
	return s->shape.blob.threshold - q.sum;
}

/* The steepest of (1 - d^2)^2 is 16 / (3 sqrt 3 2) = 1.5396, at d = 1 / sqrt 3. */
static void add_change(void *context, uint32_t i)
{
	struct query *q = context;
	const struct pov_sealed_component *c = &q->blob->all[i];
	double d = component_distance(c, q->p) / c->given.radius, r = q->r * c->shrink / c->given.radius;
	if (d - r < 1)
		q->sum += fabs(c->given.strength) * fmin(1, 1.5397 * r);
}

static double blob_reach(const struct pov_solid *s, struct vec p, double r)
{
	struct query q = { s->sealed, p, r, 0 };
	pov_tree_visit(&q.blob->tree, is_near, add_change, &q);
	return q.sum;
}

static double blob_feature(const struct pov_solid *s)
{
	return ((const struct pov_sealed_blob *)s->sealed)->finest;
}

static void mesh_blob(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_sealed_blob *q = s->sealed;
	double step = q->finest / CELLS_A_RADIUS * 32 / d->n;
	/* Where small components beside large ones would make too many cells these are larger. */
	step = fmin(fmax(step, sqrt(q->area / CELLS_MANY)), q->finest / CELLS_LEAST);
	pov_march(s, &q->box, fmax(step, box_longest(&q->box) / CELLS_MOST), d);
}

const struct pov_shape pov_shape_blob = {
	.name = "blob", .seal = seal_blob, .bounds = blob_bounds, .field = blob_field, .reach = blob_reach,
	.feature = blob_feature, .mesh = mesh_blob, .cross = pov_blob_cross, .room = pov_blob_room,
};
