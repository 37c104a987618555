/* Solids resolved for meshing: every shape with its whole transform, combinations reduced to unions and intersections with
 * inversions, boxes known. */
#ifndef IO_POV_TERM_H
#define IO_POV_TERM_H

#include "io/pov_shape.h"
#include "io/pov_tree.h"

/* TERM_EMPTY: no point at all, what remains of shapes that cannot be meshed. TERM_CLIP: the first child, its surface kept only inside the
 * others, without caps. */
enum pov_term_kind { TERM_EMPTY, TERM_LEAF, TERM_UNION, TERM_MEET, TERM_CLIP };

/* dot(normal, p) <= offset, the normal of any length. */
struct pov_half {
	struct vec normal;
	double offset;
};

struct pov_term {
	enum pov_term_kind kind;
	bool inverse; /* the complement of all the rest says; boxes are those of the set before */
	bool exact;   /* a union whose inner surfaces are to be left out */
	bool clipped; /* a TERM_CLIP is somewhere in it */
	bool cut;     /* set when something was cut by it other than exactly */
	struct box box, extent; /* of the set; of its surface */
	struct box bound;       /* where the surface may be at most (bounded_by) */

	/* Leaves. halves: planes and boxes, as half spaces. feature: width of what is
	 * most curved in it. squeeze: the most 'back' stretches. full: the shape has no inside and an odd number of complements is about it,
	 * in which nothing is inside it, either: the set is all of space. */
	const struct pov_solid *shape;
	struct matrix place, back;
	double feature, squeeze;
	uint32_t material;
	const struct pov_half *halves;
	int half_count;
	bool full;

	/* Combinations. children in order, also as an array with a tree over their boxes where there are many. */
	struct pov_term *child, *next;
	struct pov_term **children;
	uint32_t child_count, index; /* index: of the part among its siblings, rising */
	struct pov_tree tree;
};

/* The term of a solid, in an arena. Shapes that cannot be meshed are counted in *tally and dropped: from a union alone, from what a
 * difference takes away, but with the whole intersection where they are an operand. NULL when memory is out. */
struct pov_term *pov_term_resolve(struct arena *a, const struct pov_solid *s, const struct pov_mesh_options *options,
                                  struct pov_tally *tally);

/* The box of the set, inversion included. */
struct box pov_term_box(const struct pov_term *t);

/* Set box and extent from the parts'; a union of many gets its tree. 0, or -1 when memory is out. */
int pov_term_meet_box(struct arena *a, struct pov_term *t);
int pov_term_union_box(struct arena *a, struct pov_term *t);
int pov_term_clip_box(struct arena *a, struct pov_term *t);

/* Of a leaf, at a point of the scene; inversion not included. */
double pov_term_field(const struct pov_term *t, struct vec p);
/* The way the field rises at a point, unit, from differences over h to both sides. */
struct vec pov_term_slope(const struct pov_term *t, struct vec at, double h);

#endif
