/* Solids of POV-Ray's scene language, as the border between reading the language and making surfaces of it.
 *
 * The reader builds a tree of nodes in one arena: shapes with their parameters and combinations of nodes. A node is made in four
 * steps: pov_solid_new; fill 'shape' (or 'child'); pov_solid_seal, which checks the parameters and prepares what the field
 * needs; from then on transforms by pov_solid_move, flags, clips and material, in the order they are read. Copies share what
 * is sealed. Sealed nodes answer inside, extent and trace at any time; pov_mesh turns finished objects into primitives of a scene.
 * Everything is in POV-Ray's own numbers: to mirror a scene, move its top-level solids by a reflection. */
#ifndef IO_POV_SOLID_H
#define IO_POV_SOLID_H

#include "base/arena.h"
#include "base/err.h"
#include "geom/box.h"
#include "geom/matrix.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum pov_kind {
	POV_SPHERE, POV_BOX, POV_CYLINDER, POV_CONE, POV_TORUS, POV_PLANE, POV_DISC, POV_POLYGON, POV_MESH, POV_PRISM, POV_LATHE,
	POV_SOR, POV_SPHERE_SWEEP, POV_SUPERELLIPSOID, POV_BLOB, POV_QUADRIC, POV_POLY, POV_HEIGHT_FIELD, POV_BICUBIC_PATCH,
	POV_TEXT, POV_ISOSURFACE, POV_PARAMETRIC,
	POV_UNKNOWN, /* a shape that cannot be meshed, named in 'shape.unknown': julia_fractal, a missing font or image, a noise function */
	POV_UNION, POV_MERGE, POV_INTERSECTION, POV_DIFFERENCE,
	POV_KINDS
};

/* The kind's word in the language, "sphere". */
const char *pov_kind_name(enum pov_kind kind);

enum pov_spline { POV_LINEAR, POV_QUADRATIC, POV_CUBIC, POV_BEZIER, POV_B_SPLINE };

/* A function of the scene: value of its arguments. It may be called at any time while the solid lives. */
struct pov_function {
	double (*value)(void *context, const double *arguments);
	void *context;
};

/* Any opposite corners. */
struct pov_box {
	struct vec corner[2];
};

struct pov_sphere {
	struct vec center;
	double radius;
};

/* Cylinder and cone (a cylinder has equal radii). */
struct pov_cone {
	struct vec end[2];
	double radius[2];
};

/* About the y axis. */
struct pov_torus {
	double major, minor;
};

/* Normal of any length, the distance along the unit normal. */
struct pov_plane {
	struct vec normal;
	double distance;
};

struct pov_disc {
	struct vec center, normal;
	double radius, hole;
};

/* The points as written: loops that close where their first point comes again. */
struct pov_polygon {
	const struct vec *points;
	size_t count;
};

/* triangle, smooth_triangle, mesh and mesh2. corners: three indices of points a triangle, in range (seal checks).
 * materials: one a triangle, NO_MATERIAL where it has none; or NULL. inside: inside_vector, zero where there is none. */
struct pov_triangles {
	const struct vec *points;
	const uint32_t *corners, *materials;
	size_t point_count, count;
	struct vec inside;
};

/* prism: x, z in x, y of the points; lathe, sor: radius, height in x, y; z unused. conic, low, high: of prism only.
 * spline: of prism and lathe. */
struct pov_profile {
	enum pov_spline spline;
	bool conic;
	double low, high;
	const struct vec *points;
	size_t count;
};

/* POV_LINEAR, POV_CUBIC or POV_B_SPLINE. */
struct pov_sphere_sweep {
	enum pov_spline spline;
	const struct pov_sphere *spheres;
	size_t count;
};

/* As written: <e, n>. */
struct pov_superellipsoid {
	double east, north;
};

/* One component; a sphere has both ends equal. place: its own transforms, before those of the blob. */
struct pov_component {
	struct vec end[2];
	double radius, strength;
	struct matrix place;
};

struct pov_blob {
	double threshold;
	const struct pov_component *components;
	size_t count;
};

/* A B C, D E F, G H I, J as written. */
struct pov_quadric {
	double coefficient[10];
};

/* poly, cubic, quartic: (order + 1)(order + 2)(order + 3) / 6 coefficients as written; order 2 to 35. */
struct pov_poly {
	int order;
	const double *coefficients;
};

/* heights[z * width + x] over the unit square, row z = 0 first; level: of water, 0 for none. Filled from an image by
 * pov_image_heights (io/pov_image.h) or from a function by pov_heights_sample. */
struct pov_height_field {
	const double *heights;
	int width, height;
	bool smooth;
	double level;
};

/* Control points row by row as written. */
struct pov_bicubic {
	struct vec points[16];
	int u_steps, v_steps;
};

/* A whole font file in memory, Unicode text, thickness along z, offset a character. The bytes and the codes are the caller's and
 * must outlive the solid. */
struct pov_text {
	const unsigned char *font;
	size_t font_size;
	const uint32_t *codes;
	size_t count;
	double thickness;
	struct vec offset;
};

/* The set value(x, y, z) < threshold within the container, a sphere or a box. accuracy, gradient: how near rays look, and the most the
 * value is said to change in a unit; gradient 0: not said. */
struct pov_isosurface {
	struct pov_function function;
	double threshold, accuracy, gradient;
	bool spherical;
	struct pov_sphere sphere;
	struct pov_box box;
};

/* Three functions of u, v over low..high, kept within the container. */
struct pov_parametric {
	struct pov_function function[3];
	double low[2], high[2];
	bool contained, spherical;
	struct pov_sphere sphere;
	struct pov_box box;
};

/* One node. After pov_solid_new: place is the identity, material NO_MATERIAL, all else zero. */
struct pov_solid {
	enum pov_kind kind;
	bool inverse;      /* 'inverse' of this node toggles it */
	bool open;         /* no caps; of cone, cylinder, prism, sor and isosurface */
	uint32_t material; /* index into the scene's, or NO_MATERIAL: the parent's */
	const char *file;  /* where it was written, for messages; may be NULL */
	long line;
	struct matrix place;     /* from the shape's own space, or the space of its children, to the parent's */
	struct pov_solid *child; /* of combinations, in order, linked by 'next' */
	struct pov_solid *clip;  /* clipped_by, linked by 'next', in the parent's space; moves along with later transforms */
	struct pov_solid *bound; /* bounded_by, the same way */
	struct pov_solid *next;
	union {
		struct pov_sphere sphere;
		struct pov_box box;
		struct pov_cone cone;
		struct pov_torus torus;
		struct pov_plane plane;
		struct pov_disc disc;
		struct pov_polygon polygon;
		struct pov_triangles mesh;
		struct pov_profile profile;
		struct pov_sphere_sweep sweep;
		struct pov_superellipsoid superellipsoid;
		struct pov_blob blob;
		struct pov_quadric quadric;
		struct pov_poly poly;
		struct pov_height_field height_field;
		struct pov_bicubic bicubic;
		struct pov_text text;
		struct pov_isosurface isosurface;
		struct pov_parametric parametric;
		const char *unknown; /* why it cannot be meshed, e.g. "julia_fractal" */
	} shape;
	const void *sealed;         /* what the field of its kind needs; shared by copies; NULL until pov_solid_seal */
	struct pov_traced *traced; /* kept by pov_solid_trace until the next move */
};

/* NULL when memory is out. */
struct pov_solid *pov_solid_new(struct arena *a, enum pov_kind kind);

/* Check the shape and prepare its field. A shape that POV-Ray or this program can make nothing of (a polygon that is not planar,
 * text without a font or without FreeType) becomes POV_UNKNOWN with the reason. Arrays the shape points to must outlive the
 * solid. 0, or -1 and *e: parameters that no scene may have (indices out of range, too few points), with file and line; memory. */
int pov_solid_seal(struct arena *a, struct pov_solid *s, struct err *e);

/* Apply a transform after those before, to the node, its clips and bounds. */
void pov_solid_move(struct pov_solid *s, const struct matrix *m);

/* A deep copy of the nodes; arrays and sealed data are shared. 'next' of the copy is NULL. NULL when memory is out. */
struct pov_solid *pov_solid_copy(struct arena *a, const struct pov_solid *s);

/* POV-Ray's inside(): whether the point is in the solid and in all its clips. Shapes without an inside have none. */
bool pov_solid_inside(const struct pov_solid *s, struct vec p);

/* POV-Ray's min_extent and max_extent: a box about the solid, as tight as is simply had; infinite sides are +-1e10.
 * Clips and bounds do not count, nor what a difference takes away, as there. */
struct box pov_solid_extent(const struct pov_solid *s);

/* POV-Ray's trace(): the first point of the surface on the ray from 'from' along 'toward' (any length); normal: unit, outward (inward of
 * what is inverse), as there. Blobs and isosurfaces, alone or combined with each other, planes, boxes and spheres, are met themselves;
 * of the rest it is the surface pov_mesh makes at the default resolution. What the rays need is made at the first call and kept in the
 * arena with the node, so trace before moving on, not after changing the shape. false: a miss, *at and *normal zero;
 * memory out is a miss. */
bool pov_solid_trace(struct arena *a, struct pov_solid *s, struct vec from, struct vec toward, struct vec *at, struct vec *normal);

/* heights of a height field: f(x, y, 0) with x = i / (width - 1), y = j / (height - 1), j from the top row, z = 1. Both at least 2.
 * NULL when memory is out. */
double *pov_heights_sample(struct arena *a, struct pov_function f, int width, int height);

/* resolution: segments of a full circle of an object as large as the scene, 32 by default.
 * extent: unbounded surfaces reach as far as all finite ones and the eye, enlarged on each side by this times the largest side;
 *   0.5 by default. eye: of the camera, where eye_given.
 * planes: mesh planes and their like at top level (default), or leave them out and count them.
 * merge_exact: drop what lies inside a sibling of a merge; else a merge is a union.
 * keep_domes: keep spheres 20 times larger than the rest about the eye; else they are left out and counted.
 * most_triangles: 1e8 by default. */
struct pov_mesh_options {
	int resolution;
	double extent;
	struct vec eye;
	bool eye_given, planes, merge_exact, keep_domes;
	size_t most_triangles;
};

struct pov_mesh_options pov_mesh_defaults(void);

/* What became of the solids. skipped: leaves of each kind that could not be meshed; the shapes of POV_UNKNOWN by 'unknown' words, at
 * most a few, in order of appearance. */
enum { POV_REASONS = 16 };
struct pov_tally {
	size_t objects, triangles, spheres; /* leaves met; primitives made */
	size_t planes, domes;               /* unbounded surfaces cut to the region or left out; domes left out */
	size_t approximated;                /* leaves cut other than exactly */
	size_t skipped;                     /* leaves that could not be meshed, all reasons */
	struct { const char *reason; size_t count; } reasons[POV_REASONS]; /* those by reason; what does not fit is in 'skipped' only */
};

/* Add the surface of the solids to the scene in order: triangles as polygons of three corners, counter-clockwise seen from
 * outside, and spheres where they were only moved, turned and scaled evenly and nothing cuts them. material: each node's own,
 * else its parent's, else the scene's last. Equal input gives equal bytes. 0, or -1 and *e: a budget exceeded, memory. */
int pov_mesh(struct scene *scene, struct pov_solid *const *solids, size_t count, const struct pov_mesh_options *options,
             struct pov_tally *tally, struct err *e);

#endif
