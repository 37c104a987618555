#include "io/aff.h"

#include "io/aff_move.h"
#include "io/include.h"
#include "io/nff_token.h"

#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 16, INCLUDES_MOST = 1000 };
static const size_t included_bytes_most = (size_t)1 << 30;

/* A transform whose brace is open: what came before it. */
struct open_brace {
	struct matrix matrix;
	size_t objects, lights;
	long line;
	bool moves;
};

/* What all files of a scene share. */
struct aff {
	const struct read_options *options;
	int depth, includes;
	int braces, floor; /* open transforms in all files; those that were open where the file at hand begins */
	size_t bytes_left;           /* that may still be included */
	struct open_brace open[DEEPEST];
};

static int read_word(struct nff_reader *r, const char *what)
{
	if (nff_next(r) != 0)
		return -1;
	return *r->token ? 0 : nff_refuse(r, r->line, "the file ends within %s", what);
}

static int expect(struct nff_reader *r, const char *what, const char *word)
{
	if (read_word(r, what) != 0)
		return -1;
	return strcmp(r->token, word) == 0 ? 0 : nff_refuse(r, r->line, "%s: '%s' where '%s' should be", what, r->token, word);
}

/* A record that only says how things move or look: n numbers of it are passed over. */
static int skip_numbers(struct nff_reader *r, int n)
{
	double x[4];
	if (r->strict)
		return nff_refuse(r, r->record, "'%s' is not part of a scene that stands still", r->token);
	nff_note_skipped(r);
	return nff_read_numbers(r, "a skipped record", x, n);
}

static int read_animation(struct nff_reader *r)
{
	return skip_numbers(r, 3);
}

static int read_detail(struct nff_reader *r)
{
	return skip_numbers(r, 1);
}

static int read_key_frames(struct nff_reader *r)
{
	if (skip_numbers(r, 0) != 0 || read_word(r, "key frames") != 0 || expect(r, "key frames", "{") != 0)
		return -1;
	do
		if (read_word(r, "key frames") != 0)
			return -1;
	while (strcmp(r->token, "}") != 0);
	return 0;
}

static int read_material(struct nff_reader *r)
{
	double x[12];
	if (nff_read_numbers(r, "a material", x, 12) != 0)
		return -1;
	double ks = fmax(x[6], fmax(x[7], x[8]));
	scene_add_material(r->scene, (struct material){ .color = { x[3], x[4], x[5] }, .kd = 1, .ks = ks, .shine = x[9],
	                                                .transmit = x[10], .ior = x[11] });
	return 0;
}

static int read_named_light(struct nff_reader *r)
{
	double x[6];
	if (read_word(r, "a light") != 0 || nff_read_numbers(r, "a light", x, 3) != 0)
		return -1;
	int n = nff_read_more(r, x + 3, 3);
	if (n == 3)
		scene_add_colored_light(r->scene, vec(x[0], x[1], x[2]), (struct color){ x[3], x[4], x[5] });
	else if (n == 0)
		scene_add_light(r->scene, vec(x[0], x[1], x[2]));
	return n < 0 ? -1 : n % 3 == 0 ? 0 : nff_refuse(r, r->record, "a light has 3 or 6 numbers, not %d", 3 + n);
}

/* Three corners of 'numbers' numbers each, the first three a point, the next a normal where there are more than five. */
static int read_three(struct nff_reader *r, const char *what, int numbers, bool wanted)
{
	struct vec corner[3], normal[3];
	double x[8];
	for (int i = 0; i < 3; i++) {
		if (nff_read_numbers(r, what, x, numbers) != 0)
			return -1;
		corner[i] = vec(x[0], x[1], x[2]);
		normal[i] = vec(x[3], x[4], x[5]);
	}
	if (wanted && numbers > 5)
		scene_add_patch(r->scene, corner, normal, 3);
	else if (wanted)
		scene_add_polygon(r->scene, corner, 3);
	return 0;
}

static int read_textured(struct nff_reader *r)
{
	return read_word(r, "a textured triangle") != 0 ? -1 : read_three(r, "a textured triangle", 5, true);
}

static int read_textured_patch(struct nff_reader *r)
{
	return read_word(r, "a textured triangle") != 0 ? -1 : read_three(r, "a textured triangle", 8, true);
}

static int read_animated(struct nff_reader *r)
{
	size_t n;
	double time;
	if (nff_read_count(r, "an animated triangle", 19, &n) != 0)
		return -1;
	for (size_t i = 0; i < n; i++)
		if (nff_read_numbers(r, "an animated triangle", &time, 1) != 0 || read_three(r, "an animated triangle", 6, i == 0) != 0)
			return -1;
	return 0;
}

/* The arrays of a mesh. */
struct mesh {
	struct arena mem;
	struct vec *vertices, *normals;
	size_t vertex_count, normal_count, texture_count;
};

static int read_array(struct nff_reader *r, struct mesh *m, const char *what, struct vec **array, size_t *count)
{
	if (nff_read_count(r, what, 3, count) != 0)
		return -1;
	*array = NEW(&m->mem, struct vec, *count);
	if (!*array)
		return err_memory(r->err, r->name);
	for (size_t i = 0; i < *count; i++)
		if (nff_read_vec(r, what, &(*array)[i]) != 0)
			return -1;
	return 0;
}

static int read_texture_points(struct nff_reader *r, struct mesh *m)
{
	double uv[2];
	if (nff_read_count(r, "texturecoords", 2, &m->texture_count) != 0 || read_word(r, "texturecoords") != 0)
		return -1;
	for (size_t i = 0; i < m->texture_count; i++)
		if (nff_read_numbers(r, "texturecoords", uv, 2) != 0)
			return -1;
	return 0;
}

/* Three numbers below 'count'. */
static int read_triple(struct nff_reader *r, size_t count, size_t *index)
{
	for (int i = 0; i < 3; i++) {
		double x;
		if (nff_read_numbers(r, "a mesh", &x, 1) != 0)
			return -1;
		if (!(x >= 0 && x < (double)count && x == floor(x)))
			return nff_refuse(r, r->line, "a mesh has no element %g: it has %zu", x, count);
		index[i] = (size_t)x;
	}
	return 0;
}

static int read_triangles(struct nff_reader *r, const struct mesh *m)
{
	size_t n, v[3], k[3];
	int numbers = 3 + (m->normal_count ? 3 : 0) + (m->texture_count ? 3 : 0);
	if (nff_read_count(r, "a mesh", numbers, &n) != 0)
		return -1;
	for (size_t i = 0; i < n; i++) {
		if (read_triple(r, m->vertex_count, v) != 0)
			return -1;
		const struct vec corner[3] = { m->vertices[v[0]], m->vertices[v[1]], m->vertices[v[2]] };
		if (m->normal_count) {
			if (read_triple(r, m->normal_count, k) != 0)
				return -1;
			scene_add_patch(r->scene, corner, (const struct vec[3]){ m->normals[k[0]], m->normals[k[1]], m->normals[k[2]] }, 3);
		} else {
			scene_add_polygon(r->scene, corner, 3);
		}
		if (m->texture_count && read_triple(r, m->texture_count, k) != 0)
			return -1;
	}
	return 0;
}

static int read_mesh(struct nff_reader *r)
{
	struct mesh m = { 0 };
	int status;
	do {
		status = read_word(r, "a mesh");
		if (status == 0 && strcmp(r->token, "vertices") == 0)
			status = read_array(r, &m, "vertices", &m.vertices, &m.vertex_count);
		else if (status == 0 && strcmp(r->token, "normals") == 0)
			status = read_array(r, &m, "normals", &m.normals, &m.normal_count);
		else if (status == 0 && strcmp(r->token, "texturecoords") == 0)
			status = read_texture_points(r, &m);
		else if (status == 0 && strcmp(r->token, "triangles") == 0) {
			status = read_triangles(r, &m);
			break;
		} else if (status == 0)
			status = nff_refuse(r, r->line, "a mesh has vertices, normals, texturecoords and triangles, not '%s'", r->token);
	} while (status == 0);
	arena_free(&m.mem);
	return status;
}

static int open_transform(struct nff_reader *r, const struct matrix *m)
{
	struct aff *a = r->dialect;
	if (expect(r, "a transform", "{") != 0)
		return -1;
	if (a->braces == DEEPEST)
		return nff_refuse(r, r->line, "transforms more than %d deep", DEEPEST);
	a->open[a->braces++] = (struct open_brace){ .matrix = m ? *m : matrix_identity(), .objects = r->scene->object_count,
		                                    .lights = r->scene->light_count, .line = r->record, .moves = m };
	return 0;
}

static int read_transform(struct nff_reader *r)
{
	double x[10];
	if (nff_read_numbers(r, "a transform", x, 10) != 0)
		return -1;
	struct vec axis = vec_unit(vec(x[3], x[4], x[5]));
	if (x[0] == 0 || x[1] == 0 || x[2] == 0)
		return nff_refuse(r, r->record, "a transform that scales by 0");
	if (vec_length(axis) == 0 && x[6] != 0)
		return nff_refuse(r, r->record, "a turn about no axis");
	struct matrix scale = matrix_scale(x[0], x[1], x[2]), move = matrix_translation(x[7], x[8], x[9]);
	struct matrix turn = x[6] != 0 ? matrix_axis_rotation(axis, x[6] * 3.141592653589793 / 180) : matrix_identity();
	struct matrix both = matrix_multiply(&scale, &turn), m = matrix_multiply(&both, &move);
	return open_transform(r, &m);
}

static int read_animated_transform(struct nff_reader *r)
{
	return skip_numbers(r, 0) != 0 || read_word(r, "a transform") != 0 ? -1 : open_transform(r, NULL);
}

static int close_transform(struct nff_reader *r)
{
	struct aff *a = r->dialect;
	if (a->braces == a->floor)
		return nff_refuse(r, r->record, "'}' without '{'");
	const struct open_brace *o = &a->open[--a->braces];
	int resolution = a->options->resolution ? (int)a->options->resolution : SPD_RESOLUTION;
	return o->moves ? aff_move(r->scene, o->objects, o->lights, &o->matrix, resolution, r->name, r->err) : 0;
}

static int read_include(struct nff_reader *r)
{
	struct aff *a = r->dialect;
	char path[1024], named[NFF_TOKEN_MOST];
	struct text text = { 0 };
	if (read_word(r, "an include") != 0)
		return -1;
	memcpy(named, r->token, sizeof named);
	if (a->depth == DEEPEST || a->includes++ == INCLUDES_MOST)
		return nff_refuse(r, r->record, "files include files more than %d deep, or %d times in all", DEEPEST, INCLUDES_MOST);
	int braces = a->braces, floor = a->floor;
	int status = include_read(r->name, r->record, named, a->options->include, a->bytes_left, path, sizeof path, &text, r->err);
	a->bytes_left -= status == 0 ? text.size : 0;
	struct nff_reader inner = *r;
	inner.name = path;
	inner.at = text.bytes;
	inner.end = text.bytes + text.size;
	inner.line = 1;
	a->depth++;
	a->floor = braces;
	if (status == 0)
		status = nff_read_records(&inner);
	a->depth--;
	a->floor = floor;
	if (status == 0 && a->braces != braces)
		status = nff_refuse(r, r->record, "%s has more '{' than '}'", named);
	text_free(&text);
	return status;
}

static const struct nff_record records[] = {
	{ "fm", NULL, read_material },    { "la", NULL, read_named_light }, { "tt", NULL, read_textured },
	{ "ttp", NULL, read_textured_patch }, { "tpa", NULL, read_animated }, { "m", NULL, read_mesh },
	{ "xs", NULL, read_transform },   { "x", NULL, read_animated_transform }, { "}", NULL, close_transform },
	{ "i", NULL, read_include },      { "a", NULL, read_animation },    { "am", NULL, read_animation },
	{ "d", NULL, read_detail },       { "k", NULL, read_key_frames },   { 0 }
};

int aff_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
             struct nff_skipped *skipped, struct err *e)
{
	struct aff a = { .options = o, .bytes_left = included_bytes_most };
	struct nff_reader r = { .scene = s, .name = name, .at = text, .end = text + n, .line = 1, .strict = o->strict, .percent = true,
		                .skipped = skipped, .err = e, .more = records, .dialect = &a };
	*skipped = (struct nff_skipped){ 0 };
	if (nff_read_records(&r) != 0)
		return -1;
	return a.braces ? nff_refuse(&r, a.open[a.braces - 1].line, "a transform whose '}' is missing") : 0;
}
