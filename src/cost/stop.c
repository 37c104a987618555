#include "cost/stop.h"

#include "cost/cost.h"
#include "cost/model.h"

#include <string.h>

/* A kind of structure whose option 'key' ends subdivision. */
struct limit {
	const struct key *key;
	bool doubles;
	int patience;
};

static bool find_limit(struct limit *l, const struct accel_ops *ops)
{
	l->key = key_find(ops->keys, "max_depth");
	l->doubles = !l->key;
	if (!l->key)
		l->key = key_find(ops->keys, "resolution");
	l->patience = l->doubles ? 2 : 9; /* nine planes: three steps of an octree */
	return l->key != NULL;
}

static int64_t *at(const struct limit *l, unsigned char *options)
{
	return (int64_t *)(void *)(options + l->key->offset);
}

static int measure(double *cost, const struct accel *a, enum stop stop, struct err *e)
{
	struct model m;
	struct prediction p;
	if (stop == STOP_MODEL) {
		if (model_make(&m, a, e) != 0)
			return -1;
		*cost = m.cost;
		return 0;
	}
	if (cost_predict(&p, a, LAW_RAYS, 1, 1, e) != 0)
		return -1;
	struct flops f = flops_of(a, isnan(p.tests_one) ? p.tests : p.tests_one, p.leaves, p.inner, p.boxes);
	*cost = f.scene + f.traversal;
	return 0;
}

/* The value of the limit with the least cost. */
static int search(int64_t *best, const struct limit *l, enum stop stop, const struct accel_ops *ops, unsigned char *options,
                  const struct primitives *p, struct err *e)
{
	int64_t most = *at(l, options), worse = 0;
	double least = INFINITY;
	*best = most;
	for (int64_t i = l->doubles; i <= most && worse < l->patience; i = l->doubles ? 2 * i : i + 1) {
		struct accel a;
		double cost;
		*at(l, options) = i;
		if (accel_build(&a, ops, options, p, e) != 0)
			return -1;
		int status = measure(&cost, &a, stop, e);
		accel_free(&a);
		if (status != 0)
			return -1;
		worse = cost < least ? 0 : worse + 1;
		*best = cost < least ? i : *best;
		least = fmin(least, cost);
	}
	return 0;
}

int stop_build(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, int threads,
               int64_t *reached, struct err *e)
{
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	const struct key *k = key_find(ops->keys, "stop");
	struct limit l;
	memcpy(options, opt, ops->opt_size);
	enum stop stop = k && accel_applies(ops, opt, "stop") ? (enum stop)*(const int *)(const void *)(options + k->offset) : STOP_NONE;
	if (reached)
		*reached = -1;
	if (stop != STOP_NONE && find_limit(&l, ops)) {
		int64_t best;
		if (search(&best, &l, stop, ops, options, p, e) != 0)
			return -1;
		*at(&l, options) = best;
		if (reached)
			*reached = best;
	}
	return accel_build_on(a, ops, options, p, threads, e);
}
