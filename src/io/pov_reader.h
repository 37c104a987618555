/* The reader of POV-Ray's language from inside: its state, and what its chapters offer each other.
 *
 * A reader walks over tokens. Sources lie on a stack: the scene, files it includes, macros it calls; their tokens flow into whatever
 * is being read. Directives are run when they are met where an operand, a modifier or a statement is looked for.
 * Errors: the first one is kept and the reader stops, that is, from then on every token is TOKEN_END, so that all loops end and nobody
 * has to pass errors on. While 'quiet' is set (colours in blocks that are passed over), errors set 'doubt' instead. */
#ifndef IO_POV_READER_H
#define IO_POV_READER_H

#include "io/pov.h"
#include "io/pov_scope.h"

enum { SOURCES_MOST = 256, NESTED_MOST = 256 };

struct pov_source {
	const struct pov_file *file;
	const struct pov_token *at, *end;
	uint32_t macro;  /* name of the macro, 0: a file */
	size_t branches; /* open ones when it began */
	struct pov_binding *bindings;
};

/* An open if, switch or loop. */
struct pov_branch {
	uint32_t word;
	const struct pov_token *start, *body; /* the directive; behind the head of a for */
	uint32_t variable;                    /* of for */
	double last, step;
};

/* A file that exists only while the scene is read, or a file read by #read. */
struct pov_stream {
	const char *name;
	struct text text;     /* what #write wrote */
	struct pov_file file; /* what #read reads */
	size_t at;
	bool reads;
	struct pov_stream *next;
};

/* A font file that was read. */
struct pov_font {
	const char *name;
	const unsigned char *bytes;
	size_t size;
	const struct pov_font *next;
};

struct pov {
	struct arena mem;
	struct scene *scene;
	const struct pov_options *options;
	struct pov_summary *summary;
	struct err *err;
	const char *folder; /* of the scene, with '/' or empty */
	struct pov_names names;
	struct pov_scope scope;
	struct pov_file *files;      /* every file cut into tokens so far */
	struct pov_stream *streams;  /* written or read ones, by name */
	struct pov_source sources[SOURCES_MOST], *source;
	struct pov_branch *branches;
	size_t branch_count, branch_room;
	const struct pov_token *seen; /* the token last looked at, and its file: where errors are */
	const struct pov_file *seen_file;
	size_t tokens_cut, tokens_taken, rounds, objects;
	int nested;
	bool failed, doubt, relations;
	bool blanks;       /* within a vector whose components are parted by blanks only */
	bool blank_vector; /* the operand last read was such a vector */
	int quiet;
	struct pov_value pending; /* an operand already read, TYPE_NONE: there is none */
	double version;
	uint32_t *streams_random; /* states of rand, by index */
	size_t random_count, random_room;
	struct pov_look look; /* #default's */
	const struct pov_font *fonts;
	struct pov_solid **solids;
	size_t solid_count, solid_room;
	bool view_given;
	struct pov_view view;
};

/* pov_source.c: tokens */

/* The next token where an operand, a modifier or a statement may stand: directives before it are run, macros expanded. */
const struct pov_token *pov_peek(struct pov *p);
/* The next token where an operator or separator may stand: only ends of branches and of macros are passed over. */
const struct pov_token *pov_peek_operator(struct pov *p);
/* pov_peek, and step over it. */
const struct pov_token *pov_take(struct pov *p);
/* Step over the next token if it is this punctuation, as an operator; whether it was. */
bool pov_accept(struct pov *p, int kind);
/* The same, refusing anything else. */
bool pov_expect(struct pov *p, int kind);
/* Step over the next token if it is this word, as an operand. */
bool pov_accept_word(struct pov *p, uint32_t word);
/* Whether a token is this word. */
static inline bool is_word(const struct pov_token *t, uint32_t word)
{
	return t->kind == TOKEN_NAME && t->name == word;
}
/* Optional separators: any number of commas and semicolons before the next operand. */
void pov_skip_separators(struct pov *p);
/* Push a range of tokens of a file; macro: its name, or 0 for a file. */
void pov_push(struct pov *p, const struct pov_file *f, size_t first, size_t end, uint32_t macro);
/* Whether the value at hand is in vain: an error came, or in quiet reading a doubt. */
static inline bool pov_stopped(const struct pov *p)
{
	return p->failed || p->doubt;
}
/* Refuse the scene at the token last seen. */
__attribute__((format(printf, 2, 3)))
void pov_refuse(struct pov *p, const char *fmt, ...);
/* The same for budgets and memory, in quiet reading too. */
__attribute__((format(printf, 3, 4)))
void pov_stop(struct pov *p, int code, const char *fmt, ...);
/* "unexpected 'x', not WHAT". */
void pov_unexpected(struct pov *p, const struct pov_token *t, const char *wanted);
/* The spelling of a token, for messages, into out[size]; returns out. */
const char *pov_token_text(const struct pov *p, const struct pov_token *t, char *out, size_t size);
/* Note the first of what is missing, unknown or ignored. */
__attribute__((format(printf, 2, 3)))
void pov_note(struct pov *p, const char *fmt, ...);
/* Deeper into nested constructs; false (and stopped) where it is too deep. Undo with p->nested--. */
bool pov_enter(struct pov *p);
/* count * size bytes of the reader's arena; NULL where memory or its budget is out (and stopped). */
void *pov_alloc(struct pov *p, size_t count, size_t size);
/* Room for one more of 'count' elements of an array that doubles; the array, or NULL (and stopped). */
void *pov_grow(struct pov *p, void *array, size_t count, size_t *room, size_t size);

/* pov_file.c: files */

/* The tokens of an included file, found as the language and its users expect, or NULL: there is none (or stopped). */
const struct pov_file *pov_open(struct pov *p, const char *name);
/* The bytes of a file named in the scene, found the same way; false: there is none. Close *t with text_free. */
bool pov_load(struct pov *p, const char *name, struct text *t);
/* A stream by its name, or NULL. */
struct pov_stream *pov_stream_find(struct pov *p, const char *name);

/* pov_directive.c, pov_branch.c, pov_macro.c, pov_stream.c: directives */

void pov_directive(struct pov *p, const struct pov_token *t);
/* default { texture { ... } }, with '#' or without it. */
void pov_set_default(struct pov *p);
/* Those that open, part and close branches. */
void pov_branch(struct pov *p, const struct pov_token *t);
void pov_macro_define(struct pov *p, const struct pov_token *t);
void pov_macro_call(struct pov *p, const struct pov_macro *m);
void pov_stream_directive(struct pov *p, uint32_t word);
/* The variable behind a name and its subscripts, to be read or assigned: NULL where the name is unknown or a subscript does not
 * fit (and refused, but for unknown names). *name: the name. */
struct pov_value *pov_variable(struct pov *p, uint32_t *name);
/* As #declare: assign to the visible variable of this name, or make a global one. value is copied. */
void pov_declare(struct pov *p, uint32_t name, const struct pov_value *value);
/* As #local, in a frame: a source by its number; nothing if that is left already. */
void pov_declare_local(struct pov *p, uint32_t name, uint32_t frame, const struct pov_value *value);

/* pov_expression.c, pov_color.c, pov_call.c, pov_call_string.c, pov_call_object.c: values */

/* A value of any kind: an expression, or a block such as sphere{...} or texture{...}. */
struct pov_value pov_value_read(struct pov *p);
/* An expression; relations are allowed where p->relations says so. */
struct pov_value pov_expression(struct pov *p);
/* An operand with its signs, subscripts and components. */
struct pov_value pov_operand(struct pov *p);
double pov_float(struct pov *p);
/* A vector of three; a float fills it. */
struct vec pov_vector(struct pov *p);
/* A vector of two. */
void pov_vector2(struct pov *p, double *u, double *v);
/* An integer from low to high; what: for messages. */
long pov_integer(struct pov *p, const char *what, double low, double high);
/* A string expression; NULL when refused. */
const struct pov_string *pov_text(struct pov *p);
/* The same with escapes left as they are and '\' turned to '/'. */
const struct pov_string *pov_file_name(struct pov *p);
/* An expression in parentheses, relations allowed. */
double pov_condition(struct pov *p);
/* A switch without or with a boolean behind it. */
bool pov_flag(struct pov *p);
/* Whether a word starts a colour, and the colour it starts (color, rgb, red, ...). */
bool pov_is_color_word(uint32_t word);
struct pov_value pov_color(struct pov *p);
/* Whether a word is a built-in function, and its value: the word was taken, '(' comes next. */
bool pov_is_call(uint32_t word);
struct pov_value pov_call(struct pov *p, uint32_t word);
struct pov_value pov_call_string(struct pov *p, uint32_t word);
struct pov_value pov_call_object(struct pov *p, uint32_t word);
/* A function of floats by its word; arguments[count]. false: the word is none of these. */
bool pov_math(uint32_t word, const double *arguments, int count, double *out);
/* How many arguments it takes, -1: any number from one; -2: it is none of these. */
int pov_math_arguments(uint32_t word);
double pov_random(struct pov *p, double stream);
double pov_seed(struct pov *p, double seed);
/* A string of printf's; NULL when memory is out. */
__attribute__((format(printf, 2, 3)))
const struct pov_string *pov_format(struct pov *p, const char *fmt, ...);

/* pov_array.c, pov_spline.c, pov_function.c: their blocks, the word taken */

struct pov_value pov_array_read(struct pov *p);
/* The element that subscripts choose, NULL when refused; '[' comes next. */
struct pov_value *pov_element(struct pov *p, struct pov_array *a);
struct pov_value pov_spline_read(struct pov *p);
/* The spline's value at t; kind: a word, or 0 for its own. */
struct pov_value pov_spline_value(const struct pov_spline_curve *s, double t, uint32_t kind);
/* Whether a word names a kind of spline. */
bool pov_is_spline_kind(uint32_t word);
struct pov_value pov_function_read(struct pov *p);
/* F(...) of a value that is a function; '(' comes next. */
struct pov_value pov_function_call(struct pov *p, const struct pov_program *f);
/* As shapes need it; known false: it rests on noise, patterns or pigments. */
struct pov_function pov_function_of(const struct pov_program *f, bool *known);

/* pov_transform.c */

bool pov_is_transform(struct pov *p, const struct pov_token *t);
/* One transform: translate, rotate, scale, matrix, transform, or an identifier of one. */
struct matrix pov_transform(struct pov *p);
/* transform { ... }, the word taken. */
struct matrix pov_transform_block(struct pov *p);
struct matrix pov_rotation(struct vec degrees);
/* false: it has no inverse. */
bool pov_invert(const struct matrix *m, struct matrix *out);

/* pov_object.c, pov_parse_*.c: objects */

/* Whether a token starts an object: a word of one, or an identifier of one. */
bool pov_is_object(struct pov *p, const struct pov_token *t);
/* The object, word and block; never NULL unless stopped. */
struct pov_object *pov_object(struct pov *p);
void pov_object_move(struct pov_object *o, const struct matrix *m);
/* Parameters of a shape, '{' taken, into a new solid. */
typedef void pov_shape_read(struct pov *p, struct pov_solid *s);
pov_shape_read pov_read_sphere, pov_read_box, pov_read_cylinder, pov_read_cone, pov_read_torus, pov_read_plane, pov_read_disc, pov_read_triangle,
	pov_read_smooth_triangle, pov_read_polygon, pov_read_mesh, pov_read_mesh2, pov_read_prism, pov_read_lathe, pov_read_sor,
	pov_read_sphere_sweep, pov_read_superellipsoid, pov_read_blob, pov_read_quadric, pov_read_poly, pov_read_cubic, pov_read_quartic,
	pov_read_height_field, pov_read_bicubic, pov_read_text, pov_read_isosurface, pov_read_parametric, pov_read_julia,
	pov_read_ovus;
/* light_source, '{' taken, into o. */
void pov_read_light(struct pov *p, struct pov_object *o);
/* Turn a shape into one that cannot be meshed. */
void pov_make_unknown(struct pov_solid *s, const char *reason);
/* A list of points; NULL (and stopped) on errors. dimensions 2: x, y. 'count' must be believable from what is left of the file. */
struct vec *pov_points(struct pov *p, size_t count, int dimensions);
/* A count of things to follow. */
size_t pov_count(struct pov *p, const char *what);

/* pov_look.c, pov_camera.c */

/* Whether a word opens a block of a look: texture, pigment, finish, ... */
bool pov_is_look(uint32_t word);
/* Such a block, the word taken, added to *look; what it gives counts more than what an identifier in it gives. */
void pov_look_read(struct pov *p, uint32_t word, struct pov_look *look);
/* Fields of 'from' that *look does not have. */
void pov_look_add(struct pov_look *look, const struct pov_look *from);
/* The scene's material of a look, NO_MATERIAL if it gives nothing. */
uint32_t pov_material(struct pov *p, struct pov_look *look);
/* Pass over a block, the word taken. */
void pov_skip_block(struct pov *p);
/* camera { ... }, the word taken. */
struct pov_view pov_camera_read(struct pov *p);
/* The scene's view of it. */
void pov_camera_set(struct pov *p, const struct pov_view *v);

/* pov_scene.c */

/* All statements of the sources at hand. */
void pov_statements(struct pov *p);

#endif
