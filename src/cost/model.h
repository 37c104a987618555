/* The cost model of Subramanian and Fussell 1990 (TR-90-04): what a ray costs in flops, from statistics of the cells. It assumes that
 * regions are alike: that a ray's primitives in each are the mean over all leaves, and that every region stops it by the same chance. */
#ifndef COST_MODEL_H
#define COST_MODEL_H

#include "cost/flops.h"

struct model {
	double per_leaf; /* n_pr: mean length of the leaves' lists */
	double chance;   /* p: surface area of the bounding boxes of the primitives' parts in each leaf, over that of the leaves */
	/* R, the number of regions a ray examines, of at most k leaves. As printed: max(1, (1 - (1-p)^(k+1) - p (k+1) (1-p)^k) / p), which
	 * forgets the rays that pass all regions without being stopped; with them it is (1 - (1-p)^k) / p. */
	double regions, regions_truncated;
	double height;   /* mean number of planes above a leaf */
	double boxes;    /* mean number of bounding boxes above a leaf */
	double descent;  /* hierarchies: C_pr height, which the paper adds where most rays start inside; else NAN */
	struct flops flops;    /* C_sc = C_pr R n_pr; C_tr = C_r R height + C_pr boxes, in a grid C_r R; by the printed R */
	double cost;           /* their sum */
	double cost_truncated; /* the same by the truncated R */
};

/* The model of a structure. Where the children of inner cells do not fill them it is a hierarchy of bounding volumes (section 3.5,
 * after Goldsmith and Salmon 1987): R = 1 + sum over the inner cells of their children times A / A(root), the boxes a ray examines;
 * C_tr is what of it tests boxes around others, C_sc the rest; 'chance' and the truncated mean are NAN. 0, or -1 and *e (memory). */
int model_make(struct model *m, const struct accel *a, struct err *e);

#endif
