/* The surface of a resolved solid as triangles. */
#ifndef IO_POV_SURFACE_H
#define IO_POV_SURFACE_H

#include "io/pov_cut.h"

/* How surfaces are made. region: finite box at which planes end; close: one within it, for unbounded surfaces that are marched
 * through. size: of the scene, to which n, the segments of a full circle, belongs; smaller shapes get fewer, to the part 'least'.
 * unbounded: counts shapes cut off at the region. eye: NULL, or where large spheres are looked at from: they are made finer there.
 * plain: materials of single triangles of meshes do not count. even: set while what is drawn is to be cut. scratch: for working
 * space. */
struct pov_surface {
	struct box region, close;
	double size, least;
	int n;
	size_t unbounded;
	const struct vec *eye;
	bool plain, even;
	struct arena *scratch;
};

/* Add the surface of the term, within the region where it is unbounded, to 'out'. turned: what it bounds is the outside. */
void pov_surface(struct pov_surface *s, struct pov_term *t, bool turned, struct pov_facets *out);

#endif
