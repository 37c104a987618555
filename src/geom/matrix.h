/* Affine maps for row vectors: p' = p M, the translation in row 3. Sums run from left to right, so that the scenes built with them
 * come out the same bit for bit everywhere. */
#ifndef GEOM_MATRIX_H
#define GEOM_MATRIX_H

#include "geom/vec.h"

struct matrix {
	double m[4][4];
};

struct matrix matrix_identity(void);
struct matrix matrix_scale(double x, double y, double z);
struct matrix matrix_translation(double x, double y, double z);

/* About a coordinate axis (0 x, 1 y, 2 z), radians, right-handed. */
struct matrix matrix_rotation(int axis, double angle);

/* About a unit vector. */
struct matrix matrix_axis_rotation(struct vec axis, double angle);

/* First a, then b. */
struct matrix matrix_multiply(const struct matrix *a, const struct matrix *b);

struct vec matrix_direction(struct vec v, const struct matrix *m);
struct vec matrix_point(struct vec v, const struct matrix *m);

/* A normal: by the inverse transpose of the linear part, not made unit. m must be invertible. */
struct vec matrix_normal(struct vec n, const struct matrix *m);

#endif
