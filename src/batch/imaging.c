#include "batch/imaging.h"

#include "cost/cost.h"

static enum root_kind root_of(const struct structure_spec *spec)
{
	const struct key *k = key_find(spec->ops->keys, "root");
	return k ? (enum root_kind)*(const int *)(const void *)(spec->options + k->offset) : ROOT_BOX;
}

static int make_reference(struct reference *r, enum root_kind root, const struct imaging *m, const struct imaging_run *run,
                          const struct primitives *p, struct err *e)
{
	struct structure_spec spec = { .ops = accel_find("octree") };
	struct accel a;
	struct prediction predicted;
	key_defaults(spec.ops->keys, spec.options);
	const struct key *k = key_find(spec.ops->keys, "root");
	*(int *)(void *)(spec.options + k->offset) = root;
	if (accel_build(&a, spec.ops, spec.options, p, e) != 0)
		return -1;
	int status = cost_predict(&predicted, &a, LAW_RAYS, run->measure->alpha, run->measure->beta, e);
	if (status == 0)
		status = replay_cost(&r->cost, NULL, &m->pilot, &a, run->measure->alpha, run->measure->beta, e);
	accel_free(&a);
	r->exact = predicted.predicted_exact;
	r->known = status == 0;
	return status;
}

int imaging_predict(struct imaging *m, const struct imaging_run *run, const struct accel *a, const struct structure_spec *spec,
                    double exact, struct estimate *replay, struct replay_counts *counts, struct estimate *calibrated, struct err *e)
{
	const struct measure_spec *measure = run->measure;
	enum root_kind root = root_of(spec);
	struct reference *r = &m->references[root];
	if (!m->known && pilot_make(&m->pilot, run->setting, a, &measure->image, measure->pilot_width, measure->pilot_height,
	                            run->threads, run->stop, e) != 0) {
		pilot_free(&m->pilot);
		return -1;
	}
	m->known = true;
	if (!r->known && make_reference(r, root, m, run, a->primitives, e) != 0)
		return -1;
	double scale = exact / r->exact;
	*calibrated = (struct estimate){ scale * r->cost.mean, scale * r->cost.low, scale * r->cost.high };
	return replay_cost(replay, counts, &m->pilot, a, measure->alpha, measure->beta, e);
}

void imaging_free(struct imaging *m)
{
	pilot_free(&m->pilot);
}
