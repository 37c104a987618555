#include "batch/imaging.h"

#include "cost/image.h"
#include "trace/flux_count.h"

#include <string.h>

/* The pilot's flux over the root of a, counted where it is not at hand; NULL and *e when memory is out. */
static const struct flux *flux_over(struct imaging *m, const struct accel *a, struct err *e)
{
	struct flux *f = m->fluxes;
	while (f->voxels && memcmp(&f->root, &a->root, sizeof f->root) != 0 && f + 1 < m->fluxes + IMAGING_ROOTS)
		f++;
	if (f->voxels && memcmp(&f->root, &a->root, sizeof f->root) == 0)
		return f;
	flux_close(f);
	if (flux_open(f, &a->root, e) != 0)
		return NULL;
	flux_count(f, m->pilot.image.segments, m->pilot.image.segment_count, a->slack);
	return f;
}

int imaging_predict(struct imaging *m, const struct imaging_run *run, const struct accel *a, struct estimate *replay,
                    struct replay_counts *counts, struct estimate *calibrated, struct err *e)
{
	const struct measure_spec *measure = run->measure;
	if (!m->known && pilot_make(&m->pilot, run->setting, a, &measure->image, measure->pilot_width, measure->pilot_height,
	                            run->threads, run->stop, e) != 0) {
		pilot_free(&m->pilot);
		return -1;
	}
	m->known = true;
	const struct flux *flux = flux_over(m, a, e);
	if (!flux || cost_predict_image(calibrated, flux, a, measure->alpha, measure->beta, e) != 0)
		return -1;
	return replay_cost(replay, counts, &m->pilot, a, measure->alpha, measure->beta, e);
}

void imaging_free(struct imaging *m)
{
	pilot_free(&m->pilot);
	for (int i = 0; i < IMAGING_ROOTS; i++)
		flux_close(&m->fluxes[i]);
}
