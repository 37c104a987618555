/* The walk through a bvh8, written once for all instruction sets. A file that includes it defines before:
 *   WIDE             eight floats
 *   wide_load(p), wide_spread(x), wide_min(a, b), wide_max(a, b)   the second of two zeros, too
 *   wide_mul_sub(a, b, c)    a b - c, rounded once or twice
 *   wide_mask(a, b)          bit i set where a[i] <= b[i]
 *   quad_mul_add(a, b, c), quad_mul_sub(a, b, c)
 *   quad_mask(m)             bit i set where lane i of the comparison m is true
 *   BVH8_KERNEL              the name of the kernel it becomes */
#include "accel/bvh8.h"
#include "accel/walk.h"

#include <string.h>

/* References no node has: the end of the stack. */
#define END UINT32_MAX
enum { STACK = (BVH8_WIDE - 1) * BVH_DEPTH + 1, CANDIDATES = 8 };

/* A primitive that may end the ray, at 'least' or later. */
struct candidate {
	uint32_t id;
	float least;
};

/* A ray on its way. Times are in the frame and from 'base' on. limit: nothing beyond it can end the ray. */
struct walker {
	float per_d[3], o_per_d[3], o[3], d[3];
	uint32_t near[3], far[3]; /* byte offsets of the planes in a node */
	float limit, sure, reach; /* sure: a hit before it counts */
	double base;
	uint32_t candidates;
	struct candidate candidate[CANDIDATES];
};

static inline float round_up(double x)
{
	return (float)(x * (1 + 0x1p-22)) + 0x1p-100f;
}

/* What the double precision hit h leaves of the ray. */
static inline float limit_of(const struct walker *w, const struct bvh8 *b, const struct hit *h)
{
	return round_up(fmax(0, h->t * b->frame.scale - w->base));
}

/* Whether the ray, starting outside, meets the root; moves the origin along to it if it is far. */
static inline bool enter(struct walker *w, const struct bvh8 *b, const struct ray *r, struct vec *o)
{
	double in = 0, out = r->t_max * b->frame.scale;
	for (int i = 0; i < 3; i++) {
		double per_d = 1 / nonzero(r->d.a[i]), half = per_d < 0 ? -b->half.a[i] : b->half.a[i];
		double near = (-half - o->a[i]) * per_d, far = (half - o->a[i]) * per_d;
		in = near > in ? near : in;
		out = far < out ? far : out;
	}
	if (!(in <= out + b->slack))
		return false;
	if (fmax(fmax(fabs(o->x), fabs(o->y)), fabs(o->z)) > BVH8_NEAR) {
		w->base = fmax(0, in - b->slack);
		*o = vec_add(*o, vec_scale(r->d, w->base));
	}
	return true;
}

/* False when the ray visits nothing. */
static inline bool start(struct walker *w, const struct bvh8 *b, const struct ray *r)
{
	struct vec o = vec_scale(vec_sub(r->o, b->frame.center), b->frame.scale);
	w->base = 0;
	w->candidates = 0;
	if ((fabs(o.x) > b->half.x || fabs(o.y) > b->half.y || fabs(o.z) > b->half.z) && !enter(w, b, r, &o))
		return false;
	w->reach = 1;
	for (int i = 0; i < 3; i++) {
		float d = (float)r->d.a[i];
		w->o[i] = (float)o.a[i];
		w->d[i] = d;
		w->per_d[i] = 1 / (fabsf(d) < 1e-18f ? copysignf(1e-18f, d) : d);
		w->o_per_d[i] = w->o[i] * w->per_d[i];
		w->reach += fabsf(w->o[i]);
		uint32_t down = d < 0 || (d == 0 && signbit(d));
		w->near[i] = (2 * (uint32_t)i + down) * sizeof(float[BVH8_WIDE]);
		w->far[i] = (2 * (uint32_t)i + !down) * sizeof(float[BVH8_WIDE]);
	}
	w->limit = round_up(r->t_max * b->frame.scale - w->base);
	w->sure = w->limit * (1 - 0x1p-20f);
	return true;
}

/* The exact test of what may end the ray. */
static inline void settle(struct walker *w, const struct accel *a, const struct ray *r, struct hit *h)
{
	const struct bvh8 *b = a->impl;
	for (uint32_t i = 0; i < w->candidates; i++)
		if (w->candidate[i].least <= w->limit)
			primitive_hit(&a->primitives->all[w->candidate[i].id], w->candidate[i].id, r, h);
	w->candidates = 0;
	if (h->id != NO_PRIMITIVE) {
		float limit = limit_of(w, b, h);
		w->limit = limit < w->limit ? limit : w->limit;
	}
}

/* The triangles of a block that the ray may hit, and what is known of where. */
struct lanes_hit {
	uint32_t may, must; /* bit i: lane i */
	quad least, most;   /* of t, in lanes of 'must' */
};

static inline uint32_t test_block(const struct bvh8_block *k, const struct walker *w, struct lanes_hit *hit)
{
#define LOAD(field) (*(const quad *)(const void *)(field))
	quad e1[3], e2[3], p[3], o[3], q[3], d[3];
	for (int i = 0; i < 3; i++) {
		e1[i] = LOAD(k->edge1[i]);
		e2[i] = LOAD(k->edge2[i]);
		d[i] = quad_of(w->d[i]);
		o[i] = quad_of(w->o[i]) - LOAD(k->corner[i]);
	}
#undef LOAD
	p[0] = quad_mul_sub(d[1], e2[2], d[2] * e2[1]);
	p[1] = quad_mul_sub(d[2], e2[0], d[0] * e2[2]);
	p[2] = quad_mul_sub(d[0], e2[1], d[1] * e2[0]);
	q[0] = quad_mul_sub(o[1], e1[2], o[2] * e1[1]);
	q[1] = quad_mul_sub(o[2], e1[0], o[0] * e1[2]);
	q[2] = quad_mul_sub(o[0], e1[1], o[1] * e1[0]);
	quad det = quad_mul_add(e1[0], p[0], quad_mul_add(e1[1], p[1], e1[2] * p[2]));
	quad u = quad_mul_add(o[0], p[0], quad_mul_add(o[1], p[1], o[2] * p[2]));
	quad v = quad_mul_add(d[0], q[0], quad_mul_add(d[1], q[1], d[2] * q[2]));
	quad t = quad_mul_add(e2[0], q[0], quad_mul_add(e2[1], q[1], e2[2] * q[2]));
	quad_int sign = (quad_int)det & (quad_int)quad_of(-0.0f);
	det = (quad)((quad_int)det ^ sign);
	u = (quad)((quad_int)u ^ sign);
	v = (quad)((quad_int)v ^ sign);
	t = (quad)((quad_int)t ^ sign);
	float margin = k->margin * w->reach, off = margin * k->edge, off_det = k->margin * k->edge;
	quad m = quad_of(margin), rest = det - u - v;
	quad least = quad_min(quad_min(u, v), rest);
	hit->may = quad_mask((least >= -m) & (t >= quad_of(-off)) & ~(t > quad_mul_add(det, quad_of(w->limit), quad_of(off + off_det * w->limit))));
	if (hit->may == 0)
		return 0;
	hit->must = hit->may & quad_mask((least > m) & (det > quad_of(4 * off_det)) & (t > quad_of(2 * off)));
	hit->least = (t - quad_of(off)) / (det + quad_of(off_det)) * quad_of(1 - 0x1p-20f);
	hit->most = (t + quad_of(off)) / (det - quad_of(off_det)) * quad_of(1 + 0x1p-20f);
	return hit->may;
}

static inline void push_candidate(struct walker *w, const struct accel *a, const struct ray *r, struct hit *h, uint32_t id, float least)
{
	if (w->candidates == CANDIDATES)
		settle(w, a, r, h);
	w->candidate[w->candidates++] = (struct candidate){ id, least };
	__builtin_prefetch(&a->primitives->all[id]);
	__builtin_prefetch((const char *)(&a->primitives->all[id] + 1) - 1);
}

/* What may be hit in a block; true when that ends the ray. */
static inline bool take_hits(struct walker *w, const struct bvh8_block *k, const struct lanes_hit *hit, const struct accel *a,
                             const struct ray *r, struct hit *h, const bool any)
{
	const struct bvh8 *b = a->impl;
	bool spheres = !(k->margin < INFINITY);
	for (uint32_t lane = 0; lane < k->count; lane++) {
		uint32_t id = k->id[lane];
		bool must = hit->must >> lane & 1;
		if (!(hit->may >> lane & 1) || (id == r->from && !spheres))
			continue;
		if (any && must && hit->most[lane] < w->sure) {
			*h = (struct hit){ (hit->most[lane] + w->base) / b->frame.scale, id };
			return true;
		}
		if (spheres || any) {
			primitive_hit(&a->primitives->all[id], id, r, h);
			if (h->id == id)
				w->limit = limit_of(w, b, h);
		} else {
			push_candidate(w, a, r, h, id, must ? hit->least[lane] : 0);
			if (must && hit->most[lane] < w->limit)
				w->limit = hit->most[lane];
		}
	}
	return any && h->id != NO_PRIMITIVE;
}

static inline bool visit_leaf(struct walker *w, uint32_t ref, const struct accel *a, const struct ray *r, struct hit *h,
                              struct tally *tally, const bool count, const bool any)
{
	const struct bvh8 *b = a->impl;
	const struct bvh8_block *k = bvh8_leaf(b, ref), *end = k + (ref & 15);
	COUNT(leaves, 1);
	for (; k < end; k++) {
		struct lanes_hit hit;
		COUNT(tests, k->count);
		if (!r->through && __builtin_expect(test_block(k, w, &hit) != 0, 0) && take_hits(w, k, &hit, a, r, h, any))
			return true;
	}
	return false;
}

/* A child on the stack: where the ray comes in above, its reference below. Times are not negative, so that keys sort as they do. */
static inline uint64_t key_of(float t, uint32_t ref)
{
	uint32_t bits;
	memcpy(&bits, &t, sizeof bits);
	return (uint64_t)bits << 32 | ref;
}

static inline void sort_pair(uint64_t *far, uint64_t *near)
{
	uint64_t p = *far, q = *near;
	*far = p > q ? p : q;
	*near = p > q ? q : p;
}

/* The children met, the nearest on top of the stack; returns the new top. */
static inline uint64_t *visit_node(const struct walker *w, const struct bvh8_node *n, uint64_t *top)
{
	const char *at = (const char *)n->planes;
	WIDE near[3], far[3];
	for (int i = 0; i < 3; i++) {
		WIDE per_d = wide_spread(w->per_d[i]), o_per_d = wide_spread(w->o_per_d[i]);
		near[i] = wide_mul_sub(wide_load(at + w->near[i]), per_d, o_per_d);
		far[i] = wide_mul_sub(wide_load(at + w->far[i]), per_d, o_per_d);
	}
	WIDE in = wide_max(wide_max(near[0], near[1]), wide_max(near[2], wide_spread(0)));
	WIDE out = wide_min(wide_min(far[0], far[1]), wide_min(far[2], wide_spread(w->limit)));
	uint32_t mask = wide_mask(in, out);
	if (!mask)
		return top;
	float t[BVH8_WIDE];
	memcpy(t, &in, sizeof t);
	uint32_t first = (uint32_t)__builtin_ctz(mask);
	top[0] = key_of(t[first], n->child[first]);
	mask &= mask - 1;
	if (!mask)
		return top + 1;
	uint32_t second = (uint32_t)__builtin_ctz(mask);
	top[1] = key_of(t[second], n->child[second]);
	mask &= mask - 1;
	sort_pair(&top[0], &top[1]);
	if (!mask)
		return top + 2;
	uint32_t third = (uint32_t)__builtin_ctz(mask);
	top[2] = key_of(t[third], n->child[third]);
	mask &= mask - 1;
	sort_pair(&top[0], &top[2]);
	sort_pair(&top[1], &top[2]);
	top += 3;
	for (int sorted = 3; mask; mask &= mask - 1, sorted++) {
		uint32_t i = (uint32_t)__builtin_ctz(mask);
		uint64_t key = key_of(t[i], n->child[i]), *place = top++;
		for (int k = 0; k < sorted && place[-1] < key; k++, place--)
			*place = place[-1];
		*place = key;
	}
	return top;
}

static inline __attribute__((always_inline)) bool walk_as(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally,
                                                          const bool count, const bool any)
{
	const struct bvh8 *b = a->impl;
	struct walker w;
	uint64_t stack[STACK], *top = stack;
	uint32_t ref = b->root;
	*h = hit_none(r);
	if (!start(&w, b, r))
		return false;
	*top++ = key_of(0, END);
	while (ref != END) {
		if (!(ref & 15)) {
			const struct bvh8_node *n = bvh8_node(b, ref);
			COUNT(inner_step, 1);
			COUNT(boxes, n->children);
			top = visit_node(&w, n, top);
		} else if (visit_leaf(&w, ref, a, r, h, tally, count, any)) {
			break;
		}
		uint64_t most = key_of(w.limit, UINT32_MAX), key;
		do
			key = *--top;
		while (key > most);
		ref = (uint32_t)key;
	}
	settle(&w, a, r, h);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	return r->any ? walk_as(a, r, h, tally, count, true) : walk_as(a, r, h, tally, count, false);
}
WALK_TWICE(walk)

static void shoot_many(const struct accel *a, const struct ray *r, const uint32_t *order, size_t count, struct hit *h, struct tally *n)
{
	for (size_t i = 0; i < count; i++) {
		size_t k = order ? order[i] : i;
		n[k] = (struct tally){ 0 };
		shoot_counted(a, &r[k], &h[k], &n[k]);
	}
}

#define NAME_OF(x) NAME_AS(x)
#define NAME_AS(x) #x
const struct bvh8_kernel BVH8_KERNEL = { NAME_OF(BVH8_KERNEL), shoot, shoot_counted, shoot_many };
