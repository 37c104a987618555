/* What a mailbox spares. */
#ifndef COST_MAILBOX_H
#define COST_MAILBOX_H

#include "accel/accel.h"

/* Measure (divided by pi) of the tests that a one-deep mailbox spares: those of a primitive that the leaf before listed too. Over
 * every shared piece of a face, twice its area that no surface covers (a ray crosses it either way, in the open) times the number of
 * primitives that both leaves list. lines: nothing stops the rays, all of the area counts. Leaves must fill the root.
 * 0, or -1 and *e (memory). */
int mailbox_measure_spared(double *spared, const struct accel *a, bool lines, struct err *e);

#endif
