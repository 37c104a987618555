#include "batch/drawing.h"

#include "trace/rays.h"

enum { RAYS_IN_SCENE = 50, RAYS_FROM_TRIANGLE = 20, TRIES = 100000 };

static void add_line(struct text *out, struct vec p, struct vec q)
{
	text_print(out, "%.6g %.6g %.6g\n%.6g %.6g %.6g\n\n", p.x, p.y, p.z, q.x, q.y, q.z);
}

static void add_triangle(struct text *out, const struct primitive *p)
{
	for (int i = 0; p->kind == PRIMITIVE_TRIANGLE && i < 3; i++)
		add_line(out, p->triangle.v[i], p->triangle.v[(i + 1) % 3]);
}

static void end_block(struct text *out)
{
	text_print(out, "\n\n");
}

/* The edges of a box as one stroke each. */
static void add_box(struct text *out, const struct box *b)
{
	for (int i = 0; i < 8; i++)
		for (int axis = 0; axis < 3; axis++) {
			struct vec p = vec(i & 1 ? b->hi.x : b->lo.x, i & 2 ? b->hi.y : b->lo.y, i & 4 ? b->hi.z : b->lo.z), q = p;
			if (i >> axis & 1)
				continue;
			q.a[axis] = b->hi.a[axis];
			add_line(out, p, q);
		}
}

/* Where the ray is inside the box: false if it meets it in no piece of some length. */
static bool cut_ray(const struct ray *r, const struct box *b, double *low, double *high)
{
	*low = 0;
	*high = r->t_max;
	for (int i = 0; i < 3; i++) {
		double per = 1 / (r->d.a[i] == 0 ? 1e-300 : r->d.a[i]), t = (b->lo.a[i] - r->o.a[i]) * per, u = (b->hi.a[i] - r->o.a[i]) * per;
		*low = fmax(*low, fmin(t, u));
		*high = fmin(*high, fmax(t, u));
	}
	return *high > *low + r->slack;
}

static struct ray draw_ray(const struct ray_source *s, uint64_t index)
{
	struct ray r = ray_source_draw(s, index);
	struct hit h;
	double low;
	s->accel->ops->shoot(s->accel, &r, &h);
	if (h.id == NO_PRIMITIVE)
		cut_ray(&r, &s->accel->root, &low, &h.t);
	r.t_max = h.t;
	return r;
}

static void add_ray(struct text *out, const struct ray *r)
{
	add_line(out, r->o, vec_add(r->o, vec_scale(r->d, r->t_max)));
}

/* Leaves of one walk. */
struct walk {
	struct text *out;
	const struct ray *ray;
};

static int visit(void *ctx, const struct cell *c)
{
	struct walk *w = ctx;
	double low, high;
	if (c->leaf && cut_ray(w->ray, &c->bounds, &low, &high))
		add_box(w->out, &c->bounds);
	return 0;
}

/* Of some random rays the longest that ends on a primitive, if any does. */
static struct ray find_long_ray(const struct ray_source *s)
{
	struct ray best = draw_ray(s, 0);
	bool found = false;
	for (uint64_t i = 0; i < RAYS_IN_SCENE; i++) {
		struct ray r = ray_source_draw(s, i);
		struct hit h;
		bool hit = s->accel->ops->shoot(s->accel, &r, &h);
		if (hit && (!found || h.t > best.t_max))
			best = draw_ray(s, i);
		found |= hit;
	}
	return best;
}

int drawing_print(struct text *out, const struct accel *a, uint64_t seed, struct err *e)
{
	const struct primitives *p = a->primitives;
	struct ray_source source;
	if (ray_source_open(&source, a, WORKLOAD_INVARIANT, seed, e) != 0)
		return -1;
	for (uint32_t i = 0; i < p->count; i++)
		add_triangle(out, &p->all[i]);
	end_block(out);
	uint32_t from = NO_PRIMITIVE;
	for (uint64_t i = 0; i < RAYS_IN_SCENE; i++) {
		struct ray r = draw_ray(&source, i);
		add_ray(out, &r);
		if (from == NO_PRIMITIVE && r.from != NO_PRIMITIVE)
			from = r.from;
	}
	end_block(out);
	if (from != NO_PRIMITIVE)
		add_triangle(out, &p->all[from]);
	end_block(out);
	for (uint64_t i = 0, found = 0; i < TRIES && found < RAYS_FROM_TRIANGLE; i++) {
		struct ray r = ray_source_draw(&source, i);
		if (r.from != from || from == NO_PRIMITIVE)
			continue;
		r = draw_ray(&source, i);
		add_ray(out, &r);
		found++;
	}
	end_block(out);
	struct ray ray = find_long_ray(&source);
	struct walk walk = { .out = out, .ray = &ray };
	a->ops->cells(a, visit, &walk);
	end_block(out);
	add_ray(out, &ray);
	ray_source_close(&source);
	return out->lost ? err_memory(e, "drawing") : 0;
}
