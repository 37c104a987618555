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
enum { TILE = 128, FLIGHTS = 16, STACK = (BVH8_WIDE - 1) * BVH_DEPTH + 1, CANDIDATES = 8 };

/* A primitive that is hit, somewhere from 'least' to 'most'. */
struct candidate {
	uint32_t id;
	float least, most;
};

/* A ray on its way. Times are in the frame and from 'base' on. limit: nothing beyond it can end the ray. */
struct walker {
	quad o, d, per_d, o_per_d;
	uint32_t near[3];         /* byte offsets of the planes in a node where the ray comes in */
	float limit, sure, reach; /* sure: a hit before it counts */
	uint32_t from;            /* the triangle it starts on, which it does not hit */
	uint32_t candidates;
	double base;
	struct candidate candidate[CANDIDATES];
};

typedef double quad_double __attribute__((vector_size(32)));

static inline quad quad_of_vec(struct vec v)
{
	return __builtin_convertvector(((quad_double){ v.x, v.y, v.z, 0 }), quad);
}

static inline quad quad_abs(quad a)
{
	return (quad)((quad_int)a & INT32_MAX);
}

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
		double per_d = 1 / nonzero(r->d.a[i]), half = per_d < 0 ? -b->half[i] : b->half[i];
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

/* False when the ray visits nothing. Uncounted, one that misses the root from nearby may find that out among the root's children. */
static inline __attribute__((always_inline)) bool start(struct walker *w, const struct accel *a, const struct ray *r, const bool count)
{
	const struct bvh8 *b = a->impl;
	struct vec o = vec_scale(vec_sub(r->o, b->frame.center), b->frame.scale);
	quad inside = count ? b->half : quad_of((float)BVH8_NEAR), d = quad_of_vec(r->d);
	w->base = 0;
	w->candidates = 0;
	w->from = b->spheres ? NO_PRIMITIVE : r->from;
	w->o = quad_of_vec(o);
	if (__builtin_expect(quad_mask(quad_abs(w->o) > inside) != 0, 0)) {
		if (!enter(w, b, r, &o))
			return false;
		w->o = quad_of_vec(o);
	}
	quad_int sign = (quad_int)d & INT32_MIN, tiny = quad_abs(d) < quad_of(1e-18f);
	uint32_t down = quad_mask(sign < 0);
	w->d = d;
	w->per_d = quad_of(1) / (quad)(((quad_int)d & ~tiny) | (((quad_int)quad_of(1e-18f) | sign) & tiny));
	w->o_per_d = w->o * w->per_d;
	for (uint32_t i = 0; i < 3; i++)
		w->near[i] = (2 * i + (down >> i & 1)) * (uint32_t)sizeof(float[BVH8_WIDE]);
	quad reach = quad_abs(w->o);
	w->reach = 1 + reach[0] + reach[1] + reach[2];
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

/* The first hit where one candidate is left that is certain: its t to float precision, by what is known at most 2^-14 off. */
static inline void settle_fast(struct walker *w, const struct accel *a, const struct ray *r, struct hit *h)
{
	const struct bvh8 *b = a->impl;
	const struct candidate *last = &w->candidate[w->candidates - 1];
	bool alone = h->id == NO_PRIMITIVE && w->candidates > 0 && last->most <= w->limit;
	for (uint32_t i = 0; i + 1 < w->candidates; i++)
		alone &= w->candidate[i].least > w->limit;
	if (alone && last->most < w->sure && last->most - last->least < 0x1p-13f)
		*h = (struct hit){ (0.5 * ((double)last->least + last->most) + w->base) / b->frame.scale, last->id };
	else
		settle(w, a, r, h);
}

/* The triangles of a block that the ray may hit, or must. */
struct lanes_hit {
	uint32_t may, must;   /* bit i: lane i */
	quad t, det;          /* t is still to be divided by det */
	float off, off_det;   /* how far off they are */
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
	quad inside = quad_min(quad_min(u, v), det - u - v);
	quad_int other = *(const quad_int *)(const void *)k->id != (int32_t)w->from;
	hit->may = quad_mask(other & (inside >= quad_of(-margin)) & (t >= quad_of(-off)) &
	                     ~(t > quad_mul_add(det, quad_of(w->limit), quad_of(off + off_det * w->limit))));
	if (__builtin_expect(hit->may == 0, 1))
		return 0;
	hit->must = hit->may & quad_mask((inside > quad_of(margin)) & (det > quad_of(16 * off_det)) & (t > quad_of(2 * off)));
	hit->t = t;
	hit->det = det;
	hit->off = off;
	hit->off_det = off_det;
	return hit->may;
}

static inline void push_candidate(struct walker *w, const struct accel *a, const struct ray *r, struct hit *h, struct candidate c,
                                  const bool exact)
{
	if (w->candidates == CANDIDATES)
		settle(w, a, r, h);
	w->candidate[w->candidates++] = c;
	w->limit = c.most < w->limit ? c.most : w->limit;
	if (exact) {
		__builtin_prefetch(&a->primitives->all[c.id]);
		__builtin_prefetch((const char *)(&a->primitives->all[c.id] + 1) - 1);
	}
}

/* What may be hit in a block; true when that ends the ray. */
static inline bool take_hits(struct walker *w, const struct bvh8_block *k, const struct lanes_hit *hit, const struct accel *a,
                             const struct ray *r, struct hit *h, const bool exact, const bool any)
{
	const struct bvh8 *b = a->impl;
	float t[BVH8_LANES], det[BVH8_LANES];
	memcpy(t, &hit->t, sizeof t);
	memcpy(det, &hit->det, sizeof det);
	for (uint32_t may = hit->may & ((1u << k->count) - 1); may; may &= may - 1) {
		uint32_t lane = (uint32_t)__builtin_ctz(may), id = k->id[lane];
		float per_det = 1 / det[lane], at = t[lane] * per_det, off = (hit->off + hit->off_det * at) * per_det * 1.25f;
		struct candidate c = { id, at - off, at + off };
		bool must = hit->must >> lane & 1;
		if (any && must && c.most < w->sure) {
			*h = (struct hit){ (c.most + w->base) / b->frame.scale, id };
			return true;
		}
		if (must && !any) {
			push_candidate(w, a, r, h, c, exact);
			continue;
		}
		primitive_hit(&a->primitives->all[id], id, r, h);
		float limit = h->id == id ? limit_of(w, b, h) : INFINITY;
		w->limit = limit < w->limit ? limit : w->limit;
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
		if (!r->through && __builtin_expect(test_block(k, w, &hit) != 0, 0) && take_hits(w, k, &hit, a, r, h, count, any))
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

/* What a ray's box tests need again and again. */
struct slabs {
	WIDE per_d[3], o_per_d[3];
	uintptr_t near[3];
};

static inline struct slabs slabs_of(const struct walker *w)
{
	struct slabs s;
	for (int i = 0; i < 3; i++) {
		s.per_d[i] = wide_spread(w->per_d[i]);
		s.o_per_d[i] = wide_spread(w->o_per_d[i]);
		s.near[i] = w->near[i];
	}
	return s;
}

/* The children met, as bits; t: where the ray comes in. */
static inline uint32_t test_boxes(const struct slabs *s, const struct bvh8_node *n, float limit, WIDE *t)
{
	const char *at = (const char *)n->planes;
	WIDE near[3], far[3];
	for (int i = 0; i < 3; i++) {
		near[i] = wide_mul_sub(wide_load(at + s->near[i]), s->per_d[i], s->o_per_d[i]);
		far[i] = wide_mul_sub(wide_load(at + (s->near[i] ^ sizeof(float[BVH8_WIDE]))), s->per_d[i], s->o_per_d[i]);
	}
	*t = wide_max(wide_max(near[0], near[1]), wide_max(near[2], wide_spread(0)));
	return wide_mask(*t, wide_min(wide_min(far[0], far[1]), wide_min(far[2], wide_spread(limit))));
}

static inline uint32_t take_bit(uint32_t *mask)
{
	uint32_t bit = (uint32_t)__builtin_ctz(*mask);
	*mask &= *mask - 1;
	return bit;
}

/* The nearest of the children met is next; the others go onto the stack, nearer ones above. mask: not 0. */
static inline uint32_t choose_nearest(const struct bvh8_node *n, uint32_t mask, const WIDE *in, uint64_t **stack)
{
	uint32_t t[BVH8_WIDE], i = take_bit(&mask);
	uint64_t *top = *stack;
	if (!mask)
		return n->child[i];
	memcpy(t, in, sizeof t);
#define KEY(i) ((uint64_t)t[i] << 32 | n->child[i])
	uint64_t near = KEY(i), next;
	i = take_bit(&mask);
	next = KEY(i);
	sort_pair(&next, &near);
	top[0] = next;
	if (mask) {
		i = take_bit(&mask);
		next = KEY(i);
		sort_pair(&next, &near);
		top[1] = next;
		sort_pair(&top[0], &top[1]);
		top++;
	}
	top++;
	for (int sorted = 2; mask; sorted++) {
		i = take_bit(&mask);
		next = KEY(i);
		sort_pair(&next, &near);
		uint64_t *place = top++;
		for (int k = 0; k < sorted && place[-1] < next; k++, place--)
			*place = place[-1];
		*place = next;
	}
#undef KEY
	*stack = top;
	return (uint32_t)near;
}

/* Where any hit will do, the order does not matter. */
static inline uint32_t choose_any(const struct bvh8_node *n, uint32_t mask, uint64_t **stack)
{
	uint32_t i = take_bit(&mask);
	while (mask)
		*(*stack)++ = n->child[take_bit(&mask)];
	return n->child[i];
}

/* From the root on until nothing nearer than the limit is left; candidates remain to be settled. */
static inline __attribute__((always_inline)) void traverse(struct walker *w, const struct accel *a, const struct ray *r, struct hit *h,
                                                           struct tally *sum, const bool count, const bool any)
{
	const struct bvh8 *b = a->impl;
	const struct slabs slabs = slabs_of(w);
	struct tally counted = { 0 }, *tally = &counted;
	uint64_t stack[STACK], *top = stack;
	uint32_t ref = b->root;
	*top++ = END;
	while (ref != END) {
		if (!(ref & 15)) {
			const struct bvh8_node *n = bvh8_node(b, ref);
			WIDE t;
			uint32_t mask = test_boxes(&slabs, n, w->limit, &t);
			COUNT(inner_step, 1);
			COUNT(boxes, n->children);
			if (mask) {
				ref = any ? choose_any(n, mask, &top) : choose_nearest(n, mask, &t, &top);
				continue;
			}
		} else if (visit_leaf(w, ref, a, r, h, tally, count, any)) {
			break;
		}
		uint64_t most = key_of(w->limit, UINT32_MAX), key;
		do
			key = *--top;
		while (!any && key > most);
		ref = (uint32_t)key;
	}
	if (count) {
		sum->leaves += counted.leaves;
		sum->tests += counted.tests;
		sum->inner_step += counted.inner_step;
		sum->boxes += counted.boxes;
	}
}

static inline __attribute__((always_inline)) bool walk_as(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally,
                                                          const bool count, const bool any)
{
	struct walker w;
	*h = hit_none(r);
	if (!start(&w, a, r, count))
		return false;
	traverse(&w, a, r, h, tally, count, any);
	if (count)
		settle(&w, a, r, h);
	else if (!any)
		settle_fast(&w, a, r, h);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	return r->any ? walk_as(a, r, h, tally, count, true) : walk_as(a, r, h, tally, count, false);
}
WALK_TWICE(walk)

/* A ray in flight: one of several that take a step in turn, so that they wait for memory together. */
struct flight {
	struct walker walker;
	struct slabs slabs;
	uint64_t *top;
	uint32_t ref, ray; /* ray: its number in the tile */
	uint64_t stack[STACK];
};

/* What is asked for: rays, and where hits and tallies go. order: the numbers of the rays as they are shot. */
struct batch {
	const struct ray *rays;
	const uint32_t *order;
	size_t count;
	struct hit *hits;
	struct tally *tallies;
};

/* Rays that are fetched together, and those of them in flight. first: number in the batch of the first. */
struct tile {
	const struct batch *batch;
	size_t first, count;
	struct ray ray[TILE];
	struct hit hit[TILE];
	struct tally tally[TILE];
	struct flight flight[FLIGHTS];
};

static inline void prefetch_ref(const struct bvh8 *b, uint32_t ref)
{
	const char *p = b->units + (size_t)(ref >> 4) * BVH8_UNIT;
	if (ref == END)
		return;
	__builtin_prefetch(p);
	__builtin_prefetch(p + 64);
	__builtin_prefetch(p + 128);
	__builtin_prefetch(p + 192);
}

/* One node, or one leaf. */
static inline void step(struct flight *f, const struct accel *a, struct tile *t)
{
	const struct bvh8 *b = a->impl;
	const struct ray *r = &t->ray[f->ray];
	struct tally *tally = &t->tally[f->ray];
	struct walker *w = &f->walker;
	const bool count = true;
	if (!(f->ref & 15)) {
		const struct bvh8_node *n = bvh8_node(b, f->ref);
		WIDE in;
		uint32_t mask = test_boxes(&f->slabs, n, w->limit, &in);
		COUNT(inner_step, 1);
		COUNT(boxes, n->children);
		if (mask) {
			f->ref = r->any ? choose_any(n, mask, &f->top) : choose_nearest(n, mask, &in, &f->top);
			prefetch_ref(b, f->ref);
			return;
		}
	} else if (r->any ? visit_leaf(w, f->ref, a, r, &t->hit[f->ray], tally, true, true)
	                  : visit_leaf(w, f->ref, a, r, &t->hit[f->ray], tally, true, false)) {
		f->ref = END;
		return;
	}
	uint64_t most = key_of(w->limit, UINT32_MAX), key;
	do
		key = *--f->top;
	while (!r->any && key > most);
	f->ref = (uint32_t)key;
	prefetch_ref(b, f->ref);
}

/* Ask for where the ray's results go, and for the ray that has its place in the next tile. */
static inline void prefetch_ray(const struct tile *t, size_t i)
{
	const struct batch *b = t->batch;
	size_t here = b->order[t->first + i], next = t->first + TILE + i;
	__builtin_prefetch(&b->hits[here], 1);
	__builtin_prefetch(&b->tallies[here], 1);
	if (next < b->count) {
		const char *p = (const char *)&b->rays[b->order[next]];
		__builtin_prefetch(p);
		__builtin_prefetch(p + sizeof(struct ray) - 1);
	}
}

/* Send the next rays of the tile on their way, from number 'next' on, until one does; returns the number after it. */
static size_t launch(struct flight *f, const struct accel *a, struct tile *t, size_t next)
{
	const struct bvh8 *b = a->impl;
	f->ref = END;
	while (f->ref == END && next < t->count) {
		prefetch_ray(t, next);
		t->hit[next] = hit_none(&t->ray[next]);
		t->tally[next] = (struct tally){ 0 };
		if (start(&f->walker, a, &t->ray[next], true)) {
			f->slabs = slabs_of(&f->walker);
			f->ray = (uint32_t)next;
			f->top = f->stack;
			*f->top++ = END;
			f->ref = b->root;
		}
		next++;
	}
	return next;
}

static void land(struct flight *f, const struct accel *a, struct tile *t)
{
	struct hit *h = &t->hit[f->ray];
	settle(&f->walker, a, &t->ray[f->ray], h);
	t->tally[f->ray].hits = h->id != NO_PRIMITIVE;
}

static void walk_tile(const struct accel *a, struct tile *t)
{
	size_t next = 0;
	int flying = 0;
	uint8_t fly[FLIGHTS];
	for (uint8_t i = 0; i < FLIGHTS; i++) {
		next = launch(&t->flight[i], a, t, next);
		fly[flying] = i;
		flying += t->flight[i].ref != END;
	}
	while (flying > 0)
		for (int i = flying - 1; i >= 0; i--) {
			struct flight *f = &t->flight[fly[i]];
			step(f, a, t);
			if (__builtin_expect(f->ref != END, 1))
				continue;
			land(f, a, t);
			next = launch(f, a, t, next);
			if (f->ref == END)
				fly[i] = fly[--flying];
		}
}

static void shoot_all(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	for (size_t i = 0; i < count; i++) {
		n[i] = (struct tally){ 0 };
		shoot_counted(a, &r[i], &h[i], &n[i]);
	}
}

static void shoot_in_order(const struct accel *a, const struct ray *r, const uint32_t *order, size_t count, struct hit *h, struct tally *n)
{
	const struct batch batch = { r, order, count, h, n };
	struct tile t;
	t.batch = &batch;
	for (t.first = 0; t.first < count; t.first += t.count) {
		t.count = count - t.first < TILE ? count - t.first : TILE;
		for (size_t i = 0; i < t.count; i++)
			t.ray[i] = r[order[t.first + i]];
		walk_tile(a, &t);
		for (size_t i = 0; i < t.count; i++) {
			size_t k = order[t.first + i];
			h[k] = t.hit[i];
			n[k] = t.tally[i];
		}
	}
}

#define NAME_OF(x) NAME_AS(x)
#define NAME_AS(x) #x
const struct bvh8_kernel BVH8_KERNEL = { NAME_OF(BVH8_KERNEL), shoot, shoot_counted, shoot_all, shoot_in_order };
