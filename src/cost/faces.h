/* Which leaves lie side by side: every piece of a face that two of them share, found from the cells alone. */
#ifndef COST_FACES_H
#define COST_FACES_H

#include "accel/accel.h"

/* 'upper' lies above 'lower' along 'axis'; piece: what their faces have in common, flat. */
struct shared_face {
	const struct cell *lower, *upper;
	int axis;
	struct box piece;
};

/* Return 0 to go on, anything else to stop. */
typedef int shared_face_fn(void *ctx, const struct shared_face *f);

/* Every shared piece once, in an order that the cells determine. Planes are the same when they are the same double. What fn stopped
 * with; else 0, or -1 and *e (memory). */
int faces_visit(const struct accel *a, shared_face_fn *fn, void *ctx, struct err *e);

#endif
