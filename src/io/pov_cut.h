/* Lists of triangles cut by solids. */
#ifndef IO_POV_CUT_H
#define IO_POV_CUT_H

#include "io/pov_term.h"

/* How finely curved solids cut: region: of all that is meshed, for the size of what is unbounded; within:
 * beyond it nothing is wanted, and cuts may be coarse; n: segments of a full circle
 * in a scene of this size; smaller shapes get fewer, to the part 'least'.
 * flush: what lies in a plane of the term's boundary and faces the same way is inside, else outside; that, too, decides which of two
 * equal faces stays. turned: the term stands for its complement, for recursion; false. */
struct pov_cutter {
	struct box region, within;
	int n;
	double size, least;
	bool flush, turned;
};

/* Add the parts of the triangles that are inside the term to 'in', the others to 'out'; either may be NULL, where its part is not
 * wanted. except: a part of the term that is left out, or NULL (one child of a union against its siblings; those behind it are cut
 * 'flush', those before it not).
 *
 * A union or intersection is cut by one part after the other, so that only shapes ever cut. Half spaces cut exactly. Other shapes:
 * edges whose surroundings the surface may pass are halved until they are short, then cut where the field is zero. Whether an edge
 * is halved and where it is cut depends on the edge alone, so that triangles that met before still meet. (Where several shapes cut
 * in turn, an edge may be divided on one side only: no gap, but a corner on an edge.) */
void pov_cut(const struct pov_cutter *c, const struct pov_facets *list, struct pov_term *term, const struct pov_term *except,
             struct pov_facets *in, struct pov_facets *out);

/* Cut away, exactly, what is outside the box. */
void pov_cut_box(const struct pov_facets *list, const struct box *b, struct pov_facets *in);

#endif
