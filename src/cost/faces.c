/* Leaves sorted by their lower and by their upper planes along an axis meet where the planes are equal; there, a grid of buckets over
 * the plane finds the faces that overlap. */
#include "cost/faces.h"

#include <stdlib.h>
#include <string.h>

enum { BUCKETS_MOST = 1024 };

/* A leaf's face in a plane. */
struct side {
	double plane;
	uint32_t leaf;
};

struct search {
	struct cell *leaves;
	size_t count, room;
	struct side *low, *high;  /* [count] by the plane that bounds the leaf below, above */
	uint32_t *first, *entries; /* of a plane's buckets */
	size_t first_room, entry_room;
	shared_face_fn *fn;
	void *ctx;
	struct err *err;
	int axis, u, v;
	/* The buckets at hand. */
	struct box over;
	int buckets; /* along u and along v */
};

static int grow(void **array, size_t *room, size_t want, size_t size, struct err *e)
{
	if (want <= *room)
		return 0;
	want = want > 2 * *room ? want : 2 * *room;
	void *grown = realloc(*array, want * size);
	if (!grown)
		return err_memory(e, "faces");
	*array = grown;
	*room = want;
	return 0;
}

static int add_leaf(void *ctx, const struct cell *c)
{
	struct search *s = ctx;
	void *array = s->leaves;
	if (!c->leaf)
		return 0;
	int status = grow(&array, &s->room, s->count + 1, sizeof *s->leaves, s->err);
	s->leaves = array;
	if (status == 0)
		s->leaves[s->count++] = *c;
	return status;
}

static int compare_sides(const void *p, const void *q)
{
	const struct side *a = p, *b = q;
	if (a->plane != b->plane)
		return a->plane < b->plane ? -1 : 1;
	return (a->leaf > b->leaf) - (a->leaf < b->leaf);
}

static void sort_sides(struct search *s)
{
	for (size_t i = 0; i < s->count; i++) {
		s->low[i] = (struct side){ s->leaves[i].bounds.lo.a[s->axis], (uint32_t)i };
		s->high[i] = (struct side){ s->leaves[i].bounds.hi.a[s->axis], (uint32_t)i };
	}
	qsort(s->low, s->count, sizeof *s->low, compare_sides);
	qsort(s->high, s->count, sizeof *s->high, compare_sides);
}

static int bucket_of(const struct search *s, int axis, double x)
{
	double at = (x - s->over.lo.a[axis]) / (s->over.hi.a[axis] - s->over.lo.a[axis]) * s->buckets;
	return at < 0 ? 0 : at >= s->buckets ? s->buckets - 1 : (int)at;
}

/* The buckets that a leaf's face touches: [0] along u, [1] along v. */
struct bucket_range {
	int from[2], upto[2];
};

static struct bucket_range range_of(const struct search *s, const struct box *b)
{
	return (struct bucket_range){ { bucket_of(s, s->u, b->lo.a[s->u]), bucket_of(s, s->v, b->lo.a[s->v]) },
		                      { bucket_of(s, s->u, b->hi.a[s->u]), bucket_of(s, s->v, b->hi.a[s->v]) } };
}

/* Put the leaves above a plane into buckets. */
static int fill_buckets(struct search *s, const struct side *above, size_t count)
{
	s->over = box_empty();
	for (size_t i = 0; i < count; i++)
		box_join(&s->over, &s->leaves[above[i].leaf].bounds);
	double side = floor(sqrt((double)count));
	s->buckets = side > BUCKETS_MOST ? BUCKETS_MOST : (int)side;
	size_t buckets = (size_t)s->buckets * (size_t)s->buckets;
	void *first = s->first, *entries = s->entries;
	int status = grow(&first, &s->first_room, buckets + 1, sizeof *s->first, s->err);
	s->first = first;
	if (status != 0)
		return -1;
	memset(s->first, 0, (buckets + 1) * sizeof *s->first);
	for (int pass = 0; pass < 2; pass++) {
		for (size_t i = count; i-- > 0;) {
			struct bucket_range r = range_of(s, &s->leaves[above[i].leaf].bounds);
			for (int v = r.from[1]; v <= r.upto[1]; v++)
				for (int u = r.from[0]; u <= r.upto[0]; u++) {
					uint32_t *end = &s->first[(size_t)v * (size_t)s->buckets + (size_t)u];
					if (pass == 0)
						++*end;
					else
						s->entries[--*end] = above[i].leaf;
				}
		}
		if (pass == 1)
			break;
		for (size_t b = 1; b <= buckets; b++)
			s->first[b] += s->first[b - 1];
		status = grow(&entries, &s->entry_room, s->first[buckets] + 1, sizeof *s->entries, s->err);
		s->entries = entries;
		if (status != 0)
			return -1;
	}
	return 0;
}

/* Report the piece that two leaves share, from the one bucket that holds its lower corner. */
static int report(struct search *s, const struct cell *lower, const struct cell *upper, int u, int v)
{
	struct shared_face f = { .lower = lower, .upper = upper, .axis = s->axis, .piece = lower->bounds };
	f.piece.lo.a[s->axis] = lower->bounds.hi.a[s->axis];
	for (int i = 0; i < 3; i++) {
		if (i == s->axis)
			continue;
		f.piece.lo.a[i] = fmax(lower->bounds.lo.a[i], upper->bounds.lo.a[i]);
		f.piece.hi.a[i] = fmin(lower->bounds.hi.a[i], upper->bounds.hi.a[i]);
		if (!(f.piece.lo.a[i] < f.piece.hi.a[i]))
			return 0;
	}
	if (bucket_of(s, s->u, f.piece.lo.a[s->u]) != u || bucket_of(s, s->v, f.piece.lo.a[s->v]) != v)
		return 0;
	return s->fn(s->ctx, &f);
}

static int visit_plane(struct search *s, const struct side *below, size_t below_count, const struct side *above, size_t above_count)
{
	int status = fill_buckets(s, above, above_count);
	for (size_t i = 0; status == 0 && i < below_count; i++) {
		const struct cell *lower = &s->leaves[below[i].leaf];
		struct bucket_range r = range_of(s, &lower->bounds);
		for (int v = r.from[1]; v <= r.upto[1]; v++)
			for (int u = r.from[0]; u <= r.upto[0]; u++) {
				size_t b = (size_t)v * (size_t)s->buckets + (size_t)u;
				for (uint32_t k = s->first[b]; status == 0 && k < s->first[b + 1]; k++)
					status = report(s, lower, &s->leaves[s->entries[k]], u, v);
			}
	}
	return status;
}

static int visit_axis(struct search *s)
{
	int status = 0;
	sort_sides(s);
	for (size_t i = 0, k = 0; status == 0 && i < s->count && k < s->count;) {
		double plane = s->high[i].plane;
		size_t i_end = i, k_end;
		while (i_end < s->count && s->high[i_end].plane == plane)
			i_end++;
		while (k < s->count && s->low[k].plane < plane)
			k++;
		for (k_end = k; k_end < s->count && s->low[k_end].plane == plane;)
			k_end++;
		if (k_end > k)
			status = visit_plane(s, &s->high[i], i_end - i, &s->low[k], k_end - k);
		i = i_end;
		k = k_end;
	}
	return status;
}

int faces_visit(const struct accel *a, shared_face_fn *fn, void *ctx, struct err *e)
{
	struct search s = { .fn = fn, .ctx = ctx, .err = e };
	int status = a->ops->cells(a, add_leaf, &s);
	s.low = malloc((s.count + 1) * sizeof *s.low);
	s.high = malloc((s.count + 1) * sizeof *s.high);
	if (status == 0 && (!s.low || !s.high))
		status = err_memory(e, "faces");
	for (s.axis = 0; status == 0 && s.axis < 3; s.axis++) {
		s.u = (s.axis + 1) % 3;
		s.v = (s.axis + 2) % 3;
		status = visit_axis(&s);
	}
	free(s.leaves);
	free(s.low);
	free(s.high);
	free(s.first);
	free(s.entries);
	return status;
}
