/* Random rays, each a pure function of (seed, ray number): no trigonometry, so that every machine with IEEE doubles makes the same
 * ones. */
#ifndef TRACE_RAYS_H
#define TRACE_RAYS_H

#include "trace/shoot.h"

/* Where rays start. Read-only once made. */
struct ray_source {
	const struct accel *accel; /* borrowed */
	enum workload workload;
	uint64_t seed;
	bool segments;
	double root_area, sides;   /* sides counted of every primitive: 2, 1 or 0 */
	double *upto;              /* area of primitives 0 .. i */
	uint32_t *guide;           /* first primitive with upto > k / count of the area; where the search starts */
	struct arena mem;          /* owned */
};

/* 0, or -1 and *e (memory). */
int ray_source_open(struct ray_source *s, const struct accel *a, enum workload w, uint64_t seed, struct err *e);
void ray_source_close(struct ray_source *s);

/* Ray number 'index' of the workload; all but segments and interior rays: start uniform by area over the root's inner side and the primitives' sides, direction by the cosine law
 * about the normal there (Santalo 1976; Aronov et al. 2002, section 3). */
struct ray ray_source_draw(const struct ray_source *s, uint64_t index);

/* Rays first .. first + n - 1 into rays[n]. */
void ray_source_draw_many(const struct ray_source *s, uint64_t first, size_t n, struct ray *rays);

#endif
