#include "trace/rays.h"

#include "base/rng.h"

/* The numbers of one ray, drawn one after the other. */
struct draw {
	uint64_t key, dimension;
};

static double next(struct draw *d)
{
	return rng_uniform(d->key, d->dimension++);
}

int ray_source_open(struct ray_source *s, const struct accel *a, enum workload w, uint64_t seed, struct err *e)
{
	const struct primitives *p = a->primitives;
	*s = (struct ray_source){ .accel = a, .workload = w, .seed = seed, .root_area = box_area(&a->root) };
	s->segments = w == WORKLOAD_SEGMENTS || w == WORKLOAD_SEGMENTS_TWICE;
	s->sides = w == WORKLOAD_INVARIANT ? 2 : w == WORKLOAD_ONE_SIDED ? 1 : 0;
	s->upto = NEW(&s->mem, double, p->count);
	s->guide = NEW(&s->mem, uint32_t, p->count);
	if (!s->upto || !s->guide) {
		ray_source_close(s);
		return err_memory(e, "rays");
	}
	double sum = 0;
	for (uint32_t i = 0; i < p->count; i++)
		s->upto[i] = sum += primitive_area(&p->all[i]);
	for (uint32_t k = 0, i = 0; k < p->count; k++) {
		while (i + 1 < p->count && s->upto[i] <= sum * k / p->count)
			i++;
		s->guide[k] = i;
	}
	return 0;
}

void ray_source_close(struct ray_source *s)
{
	arena_free(&s->mem);
}

/* A uniform point of the unit disc by rejection; returns its squared radius. */
static double draw_disc(struct draw *d, double *x, double *y)
{
	double square;
	do {
		*x = 2 * next(d) - 1;
		*y = 2 * next(d) - 1;
		square = *x * *x + *y * *y;
	} while (square >= 1);
	return square;
}

/* Cosine-distributed about the unit vector n: a uniform point of the disc, lifted to the sphere (Malley). The frame about n
 * follows Duff et al. 2017. */
static struct vec draw_direction(struct draw *d, struct vec n)
{
	double x, y, square = draw_disc(d, &x, &y), z = sqrt(1 - square);
	double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
	struct vec s = vec(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t = vec(b, sign + n.y * n.y * a, -n.y);
	return vec_unit(vec_add(vec_add(vec_scale(s, x), vec_scale(t, y)), vec_scale(n, z)));
}

/* A uniform point of the root's surface; *n is the inner normal. 'pick' is uniform in [0, area). */
static struct vec draw_on_root(struct draw *d, const struct box *root, double pick, struct vec *n)
{
	struct vec size = vec_sub(root->hi, root->lo), p;
	int axis = 0;
	for (; axis < 2; axis++) {
		double pair = 2 * size.a[(axis + 1) % 3] * size.a[(axis + 2) % 3];
		if (pick < pair)
			break;
		pick -= pair;
	}
	bool upper = pick >= size.a[(axis + 1) % 3] * size.a[(axis + 2) % 3];
	for (int i = 0; i < 3; i++)
		p.a[i] = i == axis ? (upper ? root->hi.a[i] : root->lo.a[i]) : root->lo.a[i] + next(d) * size.a[i];
	*n = vec(0, 0, 0);
	n->a[axis] = upper ? -1 : 1;
	return p;
}

/* Uniform on the unit sphere (Marsaglia 1972). */
static struct vec draw_sphere(struct draw *d)
{
	double x, y, square = draw_disc(d, &x, &y), root = sqrt(1 - square);
	return vec(2 * x * root, 2 * y * root, 1 - 2 * square);
}

/* A uniform point of a primitive; *n is the unit normal of its front. */
static struct vec draw_on_primitive(struct draw *d, const struct primitive *p, struct vec *n)
{
	if (p->kind == PRIMITIVE_SPHERE) {
		*n = draw_sphere(d);
		return vec_add(p->sphere.center, vec_scale(*n, p->sphere.radius));
	}
	const struct vec *v = p->triangle.v;
	struct vec e1 = vec_sub(v[1], v[0]), e2 = vec_sub(v[2], v[0]);
	double u = next(d), w = next(d);
	if (u + w > 1) {
		u = 1 - u;
		w = 1 - w;
	}
	*n = vec_unit(vec_cross(e1, e2));
	return vec_add(v[0], vec_add(vec_scale(e1, u), vec_scale(e2, w)));
}

static uint32_t find_primitive(const struct ray_source *s, double pick)
{
	uint32_t last = s->accel->primitives->count - 1;
	double total = s->upto[last], at = pick / total * (last + 1.0);
	uint32_t i = s->guide[at < last ? (uint32_t)at : last];
	while (i < last && s->upto[i] <= pick)
		i++;
	while (i > 0 && s->upto[i - 1] > pick)
		i--;
	return i;
}

static struct ray draw_segment(const struct ray_source *s, uint64_t index)
{
	const struct box *b = &s->accel->primitives->bounds;
	struct draw d = { rng_key(s->seed, WORKLOAD_SEGMENTS, s->workload == WORKLOAD_SEGMENTS_TWICE ? index / 2 : index), 0 };
	struct vec from, to;
	for (int i = 0; i < 3; i++) {
		double length = b->hi.a[i] - b->lo.a[i];
		from.a[i] = b->lo.a[i] + length * (1.2 * next(&d) - 0.1);
		to.a[i] = b->lo.a[i] + length * (1.2 * next(&d) - 0.1);
	}
	struct vec way = vec_sub(to, from);
	return (struct ray){ .o = from, .d = vec_unit(way), .t_max = vec_length(way), .slack = s->accel->slack, .from = NO_PRIMITIVE, .any = true };
}

static struct ray draw_interior(const struct ray_source *s, uint64_t index)
{
	const struct box *b = &s->accel->root;
	struct draw d = { rng_key(s->seed, WORKLOAD_INTERIOR, index), 0 };
	struct ray r = { .t_max = INFINITY, .slack = s->accel->slack, .from = NO_PRIMITIVE, .through = s->workload == WORKLOAD_INTERIOR };
	for (int i = 0; i < 3; i++)
		r.o.a[i] = b->lo.a[i] + next(&d) * (b->hi.a[i] - b->lo.a[i]);
	r.d = vec_unit(draw_sphere(&d));
	return r;
}

struct ray ray_source_draw(const struct ray_source *s, uint64_t index)
{
	if (s->segments)
		return draw_segment(s, index);
	if (s->workload == WORKLOAD_INTERIOR || s->workload == WORKLOAD_INTERIOR_HITS)
		return draw_interior(s, index);
	const struct primitives *p = s->accel->primitives;
	struct draw d = { rng_key(s->seed, s->workload, index), 0 };
	struct ray r = { .t_max = INFINITY, .slack = s->accel->slack, .from = NO_PRIMITIVE, .through = s->sides == 0 };
	struct vec n;
	double surface = s->upto[p->count - 1], pick = next(&d) * (s->root_area + s->sides * surface);
	if (pick < s->root_area || s->sides == 0) {
		r.o = draw_on_root(&d, &s->accel->root, pick, &n);
	} else {
		pick -= s->root_area;
		bool back = s->sides > 1 && pick >= surface;
		r.from = find_primitive(s, back ? pick - surface : pick);
		r.o = draw_on_primitive(&d, &p->all[r.from], &n);
		if (back)
			n = vec_scale(n, -1);
	}
	r.d = draw_direction(&d, n);
	return r;
}

void ray_source_draw_many(const struct ray_source *s, uint64_t first, size_t n, struct ray *rays)
{
	for (size_t k = 0; k < n; k++)
		rays[k] = ray_source_draw(s, first + k);
}
