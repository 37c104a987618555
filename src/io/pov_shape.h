/* The shapes of POV-Ray behind one door: a family a file, a row of the table a kind. All in the shape's own space. */
#ifndef IO_POV_SHAPE_H
#define IO_POV_SHAPE_H

#include "io/pov_facets.h"
#include "io/pov_solid.h"

/* Where the triangles of a shape go: through 'place' into 'out', with 'material'; 'turn' where place mirrors or the inside is out.
 * n: segments of a full circle. region: finite box, in the shape's space, beyond which no surface is wanted (it may go beyond).
 * plain: materials of single triangles do not count. even: long and narrow facets are to be avoided, for these will be cut. scratch:
 * for working space. */
struct pov_drawing {
	struct pov_facets *out;
	const struct matrix *place;
	bool turn, plain, even;
	uint32_t material;
	int n;
	struct box region;
	struct arena *scratch;
};

/* One triangle, counter-clockwise seen from outside. */
void pov_draw(const struct pov_drawing *d, struct vec a, struct vec b, struct vec c);

/* In how many parts to draw what is 'length' long in facets 'width' wide: 1 but where they are to be even. */
int pov_draw_rows(const struct pov_drawing *d, double length, double width);

/* The quadrilateral as two triangles. */
void pov_draw_quad(const struct pov_drawing *d, struct vec a, struct vec b, struct vec c, struct vec e);

/* A line from + t toward in a shape's own space, t from 'least' to 'most', and who is told where it passes through the surface: t rises,
 * and true ends the search. room: for working space, as much as the shape asks for. */
struct pov_line {
	struct vec from, toward;
	double least, most;
	bool (*meet)(void *context, double t);
	void *context;
	double *room;
};

struct vec pov_line_point(const struct pov_line *line, double t);

/* Narrow the line to a sphere or a box; false: it misses. */
bool pov_line_clip_sphere(struct pov_line *line, const struct pov_sphere *s);
bool pov_line_clip_box(struct pov_line *line, const struct box *b);

struct pov_shape {
	const char *name;

	/* See pov_solid_seal; fills s->sealed if the kind needs it. NULL: nothing to check or prepare. 1: nothing can be made of
	 * it, for the reason in *why. */
	int (*seal)(struct arena *a, struct pov_solid *s, const char **why, struct err *e);

	/* A box about the surface; infinite sides where it is unbounded. */
	struct box (*bounds)(const struct pov_solid *s);

	/* Below 0 inside, above 0 outside, 0 on the surface. NULL: the shape has no inside. */
	double (*field)(const struct pov_solid *s, struct vec p);

	/* By how much the field may differ from that at p within distance r. NULL: slope * r. slope INFINITY: not known. */
	double (*reach)(const struct pov_solid *s, struct vec p, double r);
	double slope;

	/* The width of what is most curved in it, such as a diameter: cuts are finer than that. NULL: the longest side of its bounds. */
	double (*feature)(const struct pov_solid *s);

	/* Its surface; memory that cannot be had sets out->lost. */
	void (*mesh)(const struct pov_solid *s, const struct pov_drawing *d);

	/* A box about the inside, where it reaches further than the surface; else NULL. */
	struct box (*filled)(const struct pov_solid *s);

	/* Every place where the line passes through the surface. NULL: rays are to meet the mesh. */
	void (*cross)(const struct pov_solid *s, const struct pov_line *line);

	/* Numbers of working space that 'cross' needs; NULL: none. */
	size_t (*room)(const struct pov_solid *s);
};

const struct pov_shape *pov_shape_of(const struct pov_solid *s);

/* Whether the shape has an inside: a mesh only with an inside_vector. */
bool pov_shape_has_inside(const struct pov_solid *s);

/* The container of an isosurface or parametric surface as a solid of its own; false where there is none. */
bool pov_shape_container(const struct pov_solid *s, struct pov_solid *container);

/* A box about the surface of the placed shape. */
struct box pov_shape_placed(const struct pov_solid *s, const struct matrix *place);

double pov_shape_reach(const struct pov_solid *s, struct vec p, double r);

/* Families. */
extern const struct pov_shape pov_shape_sphere, pov_shape_cylinder, pov_shape_cone, pov_shape_torus, pov_shape_superellipsoid;
extern const struct pov_shape pov_shape_box, pov_shape_plane, pov_shape_disc, pov_shape_polygon, pov_shape_mesh, pov_shape_bicubic;
extern const struct pov_shape pov_shape_prism, pov_shape_lathe, pov_shape_sor, pov_shape_text;
extern const struct pov_shape pov_shape_sphere_sweep, pov_shape_blob, pov_shape_quadric, pov_shape_poly;
extern const struct pov_shape pov_shape_height_field, pov_shape_isosurface, pov_shape_parametric;

#endif
