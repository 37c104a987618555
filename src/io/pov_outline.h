/* Loops in the plane, inside by the even-odd rule: polygons, prisms, letters, the profiles of turned shapes. */
#ifndef IO_POV_OUTLINE_H
#define IO_POV_OUTLINE_H

#include "base/arena.h"
#include "io/pov_solid.h"
#include "io/pov_tree.h"

/* Loop l has the points at[first[l] .. first[l + 1]), its last one joined to its first. Arrays of an arena; zero-initialise to
 * open. lost: memory ran out, nothing more is added. */
struct pov_outline {
	struct arena *mem;
	double (*at)[2];
	size_t *first; /* loops + 1 */
	size_t loops, count, room, loop_room;
	struct pov_tree tree; /* over the edges, by pov_outline_index; before that edges are tried one by one */
	size_t *after;        /* the end of the edge that starts at a point; by pov_outline_index */
	bool lost;
};

/* The outline is complete and will be asked often. Sets 'lost' when memory is out. */
void pov_outline_index(struct pov_outline *o);

/* One more point of the loop at hand, unless it is where the last one is. */
void pov_outline_add(struct pov_outline *o, double x, double y);

/* The loop at hand is complete: a last point equal to the first is dropped, and the whole loop if fewer than three are left. */
void pov_outline_close(struct pov_outline *o);

/* Distance to the outline, negative inside. */
double pov_outline_distance(const struct pov_outline *o, double x, double y);
bool pov_outline_inside(const struct pov_outline *o, double x, double y);

/* Whether the inside is at the left of the edge from point i of a loop to the next. */
bool pov_outline_inside_left(const struct pov_outline *o, size_t i, size_t next);

/* The point after i in its loop l. */
static inline size_t pov_outline_next(const struct pov_outline *o, size_t l, size_t i)
{
	return i + 1 < o->first[l + 1] ? i + 1 : o->first[l];
}

/* The inside as counter-clockwise triangles. Loops that neither cross nor touch give triangles whose corners are the outline's
 * points; others are cut at every height where something happens. 0, or -1 when memory is out. */
typedef void pov_fill_fn(void *context, const double a[2], const double b[2], const double c[2]);
int pov_outline_fill(const struct pov_outline *o, struct arena *scratch, pov_fill_fn *triangle, void *context);

/* Add the curve of a spline as POV-Ray's prism, lathe and sor read points (x, y of each): 'pieces' straight pieces a segment (1 where it
 * is linear). loops: several closed ones, each as the spline's kind tells; else one open curve, which is left unclosed. */
void pov_outline_spline(struct pov_outline *o, enum pov_spline kind, const struct vec *points, size_t n, int pieces, bool loops);

#endif
