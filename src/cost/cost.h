/* Predicted cost of shooting a ray: cells in, numbers out. No ray is looked at. */
#ifndef COST_COST_H
#define COST_COST_H

#include "accel/accel.h"

/* The law the rays follow. RAYS: starts on the inner side of the root and on both sides of every primitive, uniform by area,
 * cosine law, ended by the first hit. LINES: starts on the root only, nothing stops them. ONE_SIDED: RAYS from the front sides only;
 * no exact form is known in areas alone, since it matters what lies behind. EXT: ONE_SIDED where the primitives are triangles that
 * bound disjoint solids (not touching over a face either), so that no ray runs inside one. INTERIOR: starts uniform in the volume of
 * the root, directions uniform, nothing stops them; no form for hierarchies, nor for what crossing faces costs. NONE: no law with a
 * formula. */
enum law { LAW_RAYS, LAW_LINES, LAW_ONE_SIDED, LAW_EXT, LAW_INTERIOR, LAW_NONE };

/* Expected counts per ray; costs are alpha * leaves + beta * tests. NAN: no formula. */
struct prediction {
	double predicted;           /* E, eq. (3) of Aronov et al. 2002 as printed: one-sided area, surface term dropped */
	double predicted_two_sided; /* E2: the same with the two-sided area */
	double predicted_exact;     /* E*: the expected cost, exactly */
	double predicted_one;       /* E* as printed: eq. (2), one-sided area both in the surface term and below */
	double leaves, tests;       /* expected counts, exactly */
	double tests_one;           /* expected tests with a one-deep mailbox, exactly; a full one makes as many or fewer. NAN where the
	                             * structure has no mailbox, where boxes cut space away, and for one-sided rays */
	double inner_step, inner_start; /* NAN where boxes are tested, for then a ray may meet many before its first leaf */
	double inner;               /* inner nodes in all, as the structure's rays travel */
	double inner_top_down;      /* inner nodes of a recursive front-to-back traversal */
	double inner_restart;       /* inner nodes where every leaf is found from the root; NAN with boxes */
	double boxes;               /* inner nodes that hold a box */
	double area_inside;         /* sum of the surface inside the cells; equals the primitives' area */
	double area_leaves;         /* sum of the leaves' surface areas */
	/* Bounding volume hierarchies only (cost/bvh.h): the expected cost of the nodes met up to the first hit, and its parts. */
	double volumes, sah, epo, dq, surface_share;
};

/* Everything NAN. */
static inline struct prediction prediction_unknown(void)
{
	return (struct prediction){ NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN };
}

/* 0, or -1 and *e: memory; EXT over what bounds no solids. */
int cost_predict(struct prediction *p, const struct accel *a, enum law law, double alpha, double beta, struct err *e);

#endif
