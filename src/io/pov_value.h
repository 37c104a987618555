/* Values of POV-Ray's scene language. */
#ifndef IO_POV_VALUE_H
#define IO_POV_VALUE_H

#include "geom/matrix.h"
#include "io/pov_lex.h"
#include "io/pov_solid.h"

enum pov_type {
	TYPE_NONE, /* declared, but without a value */
	TYPE_NUMBER, /* a float, vector or colour */
	TYPE_STRING, TYPE_ARRAY, TYPE_SPLINE, TYPE_FUNCTION, TYPE_OBJECT, TYPE_TRANSFORM, TYPE_LOOK, TYPE_CAMERA, TYPE_STREAM,
	TYPE_MACRO
};

/* A light, its place moved along with the objects it belongs to. */
struct pov_lamp {
	struct vec at;
	double color[3];
	struct pov_lamp *next;
};

/* What an object statement gives: a solid (NULL: lights only) and the lights in it. */
struct pov_object {
	struct pov_solid *solid;
	struct pov_lamp *lamps;
};

/* What is kept of pigments, textures, finishes, interiors and materials; 'given' tells which fields are. */
enum { LOOK_COLOR = 1, LOOK_AMBIENT = 2, LOOK_DIFFUSE = 4, LOOK_SHINE = 8, LOOK_REFLECTION = 16, LOOK_IOR = 32 };
struct pov_look {
	unsigned given;
	double color[5]; /* red green blue filter transmit */
	double ambient, diffuse, shine, reflection, ior;
	uint32_t material; /* index of the scene's material made of exactly this, or NO_MATERIAL */
};

/* A camera as written (pov-subset section 11); 'given' says what was. */
struct pov_view {
	struct vec location, direction, right, up, sky, look_at;
	double angle;
	bool angle_given, look_at_given, window_given, orthographic;
	struct matrix place;
};

/* A macro: tokens first to end of its file. */
struct pov_macro {
	const struct pov_file *file;
	size_t first, end;
	uint32_t name;
	const uint32_t *parameters;
	size_t count;
};

/* Values by their size in every dimension, the last running fastest. */
enum { DIMENSIONS_MOST = 5 };
struct pov_array {
	int dimensions;
	size_t size[DIMENSIONS_MOST], count;
	struct pov_value *all;
};

struct pov_knot {
	double t;
	double value[5];
};

/* Knots sorted by t. kind: a word, WORD_linear_spline and so on. count: components of the values. */
struct pov_spline_curve {
	uint32_t kind;
	size_t knots;
	int count;
	struct pov_knot *knot;
};

struct pov_stream;
struct pov_program;

/* Small values are held in place; the rest is in the reader's arena and shared by copies, never changed once made (arrays are
 * copied when assigned). */
struct pov_value {
	enum pov_type type;
	uint8_t count; /* TYPE_NUMBER: components, 1 to 5 */
	bool color;    /* TYPE_NUMBER: of five, and written as a colour */
	union {
		double a[5];
		const struct pov_string *string;
		struct pov_array *array;
		const struct pov_spline_curve *spline;
		const struct pov_program *program;
		const struct pov_object *object;
		const struct matrix *matrix;
		const struct pov_look *look;
		const struct pov_view *view;
		const struct pov_macro *macro;
		struct pov_stream *stream;
	};
};

static inline struct pov_value value_number(double x)
{
	return (struct pov_value){ .type = TYPE_NUMBER, .count = 1, .a = { x } };
}

static inline struct pov_value value_vector(struct vec v)
{
	return (struct pov_value){ .type = TYPE_NUMBER, .count = 3, .a = { v.x, v.y, v.z } };
}

/* Component i: a float has the same everywhere, a vector zeros beyond its length. */
static inline double value_component(const struct pov_value *v, int i)
{
	return v->count == 1 ? v->a[0] : i < v->count ? v->a[i] : 0;
}

/* As a vector of three: a float fills all, a longer one is cut. */
static inline struct vec value_vec(const struct pov_value *v)
{
	return vec(value_component(v, 0), value_component(v, 1), value_component(v, 2));
}

/* What the language calls it, for messages. */
const char *value_type_name(enum pov_type type);

/* The operators. op: the kind of the token. Numbers by component, floats spread, shorter vectors filled with zeros;
 * '=' and TOKEN_NE also compare strings, equal within 1e-10. false: the operands do not fit. */
bool value_operate(int op, const struct pov_value *a, const struct pov_value *b, struct pov_value *out);

/* Whether it counts as true: |x| >= 1e-10. */
static inline bool value_true(double x)
{
	return x >= 1e-10 || x <= -1e-10;
}

/* a op b of numbers; op: a character, or TOKEN_LE, TOKEN_GE, TOKEN_NE. Relations and logic give 0 or 1. */
double number_operate(uint32_t op, double a, double b);

/* A copy for an assignment: arrays in depth, the rest shared. nesting of arrays at most 100. false: memory out, or too deep. */
bool value_copy(struct arena *mem, const struct pov_value *from, struct pov_value *to);

/* A new array of undefined values; NULL: memory out. size[dimensions] >= 1, their product is 'count'. */
struct pov_array *array_new(struct arena *mem, int dimensions, const size_t *size, size_t count);

#endif
