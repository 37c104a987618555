/* What the generators share: the sky, materials as SPD describes them, curves as the options want them. */
#ifndef SPD_COMMON_H
#define SPD_COMMON_H

#include "geom/matrix.h"
#include "scene/tessellate.h"
#include "spd/notes.h"
#include "spd/spd.h"

#define SPD_PI 3.141592653589793

/* A material. angle: half angle of the highlight in degrees, from which the Phong power follows. */
struct spd_material {
	struct color color;
	double kd, ks, angle, transmit, ior;
};

void spd_add_material(struct scene *s, struct spd_material m);

/* The blue of most SPD skies. */
void spd_set_sky(struct scene *s);

/* View at 512 x 512. */
void spd_set_view(struct scene *s, struct vec from, struct vec at, struct vec up, double angle, double hither);

/* A sphere or cone, tessellated if the options say so. */
void spd_add_sphere(struct scene *s, const struct spd_options *o, struct vec center, double radius);
void spd_add_cone(struct scene *s, const struct spd_options *o, struct vec base, double base_radius, struct vec apex,
                  double apex_radius);

/* A polygon of four corners. */
void spd_add_quad(struct scene *s, struct vec a, struct vec b, struct vec c, struct vec d);

/* The six sides of a box, each four corners in order. Bits 0, 1, 2 of a corner's number say whether x, y, z are those of hi. */
void spd_add_sides(struct scene *s, struct vec lo, struct vec hi, const int side[6][4]);

/* The six sides of a box, seen from outside. */
void spd_add_box(struct scene *s, struct vec lo, struct vec hi);

/* A polygon, or a patch with normals, of three corners. */
void spd_add_triangle(struct scene *s, struct vec a, struct vec b, struct vec c);

/* Move every object from number 'first' on: points by m, normals by its inverse transpose and not made unit again, radii by the
 * length of m's first row. */
void spd_transform(struct scene *s, size_t first, const struct matrix *m);

#endif
