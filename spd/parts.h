/* Parts that rooms and what stands in them are made of, by sums, products and square roots alone, so that they come out the same bit
 * for bit everywhere. Curved ones are patches that shade smoothly. */
#ifndef SPD_PARTS_H
#define SPD_PARTS_H

#include "spd/common.h"

/* The unit vector in the xy plane after k of n equal parts of a turn from x to y, k from 0 to n. n: a power of two, at least 4. */
struct vec spd_turn(int k, int n);

/* Move every object from number 'first' on: x and y, unit and at right angles, become the axes, 'at' the origin. */
void spd_place(struct scene *s, size_t first, struct vec x, struct vec y, struct vec at);

/* The six sides of a box, seen from inside. */
void spd_add_hall(struct scene *s, struct vec lo, struct vec hi);

/* A box from a corner, which is relative to 'at', and its sides. */
void spd_add_part(struct scene *s, struct vec at, struct vec corner, struct vec size);

/* A surface of revolution about the vertical through 'at', seen from outside where its profile rises. profile[count]: radius and height;
 * 2 (count - 1) sides triangles, sides fewer for every radius 0. sides: as n of spd_turn. */
void spd_add_lathe(struct scene *s, struct vec at, const double (*profile)[2], int count, int sides);

/* Three sides of a bar along a curve in a plane: between outer[i] and inner[i], 'half' to both sides along 'across', the plane's unit
 * normal; 6 (count - 1) triangles. */
void spd_add_rib(struct scene *s, const struct vec *outer, const struct vec *inner, int count, struct vec across, double half);

/* An ellipsoid, or, rounded: a box with round edges, of these half sides: 12 n^2 triangles. */
void spd_add_blob(struct scene *s, struct vec center, struct vec half, int n, bool rounded);

#endif
