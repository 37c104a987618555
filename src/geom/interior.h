/* How likely a ray that starts inside the scene meets a node of a tree: origin uniform in the volume of box 'scene', direction uniform,
 * nothing stops it (Fabianowski, Fowler, Dingliana 2009: "A cost metric for scene-interior ray origins"). 'node' is a box within
 * 'scene', whose sides have a length; results are probabilities, whatever the unit of length.
 *
 * With the slab beyond face i of the node as deep as the scene and h_i thick, a ray from outside the node meets it through the faces
 * its origin sees, hence
 *   p = V(node) / V(scene) + sum over the faces of J_i / V(scene),  J_i = integral over slab i of (solid angle of face i) / 4 pi. */
#ifndef GEOM_INTERIOR_H
#define GEOM_INTERIOR_H

#include "geom/box.h"

/* The probability itself, in closed form. Relative error below 2e-6 down to nodes of 1e-6 of the scene's longest side. */
double interior_exact(const struct box *scene, const struct box *node);

/* The same in parts: J_i / V(scene) of face 2 axis + upper; their sum with the volumes' ratio. */
struct interior_parts {
	double through[6], all;
};

struct interior_parts interior_measure(const struct box *scene, const struct box *node);

/* The probability of the lower and the upper part when a plane cuts a node of which p is known. Faces that the plane cuts
 * add up to the node's, so that this takes a third of the time of measuring both parts; errors are relative to the node's. */
void interior_cut(const struct box *scene, const struct box *node, const struct interior_parts *p, int axis, double plane, double half[2]);

/* Eq. (2), the surface area heuristic: area of the node over area of the scene; exact for origins outside. */
double interior_sah(const struct box *scene, const struct box *node);

/* Eq. (4): the planes of the node's faces cut what is around it into up to 26 boxes; the solid angle of the node seen from the centre
 * of each stands for all of it. Two triangles a face, by van Oosterom and Strackee 1983. */
double interior_hq26(const struct box *scene, const struct box *node);

/* Eq. (5): rays into slab i come through its whole surface alike, so that J_i is V(slab) A(face) / A(slab). */
double interior_fast6(const struct box *scene, const struct box *node);

/* Eq. (2) or (5) for both parts of a node while the plane between them moves along an axis: 2 products, 3 sums and 1 quotient each. */
struct interior_slide {
	double low, high;             /* the node's ends on the axis */
	double scene_low, scene_high; /* the scene's */
	double base[2], length;       /* of the lower and the upper part: what does not move; what a unit of length adds */
	double face, cross, girth;    /* of the face in the plane: weight; the scene's cross-section, area and circumference */
};

struct interior_slide interior_slide_sah(const struct box *scene, const struct box *node, int axis);
struct interior_slide interior_slide_fast6(const struct box *scene, const struct box *node, int axis);

/* V / A of a slab of thickness h, times the area of the cross-section. */
static inline double interior_depth(double h, double cross, double girth)
{
	return h * cross / (2 * cross + h * girth);
}

/* The part below the plane (upper: 0), or above it (1). */
static inline double interior_slide_to(const struct interior_slide *s, double plane, int upper)
{
	double beyond = upper ? plane - s->scene_low : s->scene_high - plane, length = upper ? s->high - plane : plane - s->low;
	return s->base[upper] + s->length * length + s->face * interior_depth(beyond, s->cross, s->girth);
}

#endif
