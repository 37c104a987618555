/* The uniform grid's inside: grid_build.c makes it, grid.c lists its cells and walks it. */
#ifndef ACCEL_GRID_H
#define ACCEL_GRID_H

#include "accel/accel.h"
#include "accel/root.h"

/* How many cells lie along each axis (n primitives, sides s, longest side l, volume V):
 *   GIVEN          resolution, resolution_y and resolution_z; 0: as many as along x
 *   WOO            3 n^(1/3) s / l
 *   HOMOGENEOUS    (density n)^(1/3) along each
 *   HETEROGENEOUS  s (density n / V)^(1/3): cells near to cubes */
enum grid_setting { GRID_GIVEN, GRID_WOO, GRID_HOMOGENEOUS, GRID_HETEROGENEOUS };

struct grid_options {
	int64_t resolution, resolution_y, resolution_z;
	double density; /* cells a primitive */
	int setting, root, mailbox, stop;
};

enum { GRID_SIDE_MOST = 4096, GRID_CELLS_MOST = 1 << 28 };

struct grid {
	int32_t n[3];
	double *plane[3];    /* [n + 1]; the first and the last are the root's sides */
	struct vec per_step; /* cells a unit */
	uint32_t *first;     /* [cells + 1]; cell (x, y, z) is number (z n[1] + y) n[0] + x */
	uint32_t *ids;       /* of cell c: first[c] up to first[c + 1], ascending */
};

/* 0, or -1 and *e: memory, too many cells or references. */
int grid_build(struct accel *a, const void *opt, struct err *e);

#endif
