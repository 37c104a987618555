/* Control data of the teapot; z is up. */
#ifndef SPD_TEAPOT_PATCHES_H
#define SPD_TEAPOT_PATCHES_H

enum { TEAPOT_POINTS = 290, TEAPOT_PATCHES = 32 };

extern const double teapot_points[TEAPOT_POINTS][3];

/* Sixteen point numbers each, row by row; patches 28 to 31 are the bottom. */
extern const unsigned short teapot_patches[TEAPOT_PATCHES][16];

#endif
