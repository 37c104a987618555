/* Reading NFF.
 *
 * A file is a row of records; each starts with a keyword, then its numbers, all separated by any white space; '#' starts a
 * comment that ends with the line.
 *
 *   v                        the view: from, at, up (x y z), angle, hither, resolution (w h), in any order, some may be missing
 *   b r g b                  background
 *   l x y z [r g b]          light
 *   f r g b kd ks shine t ior [more, ignored]   material of what follows
 *   s x y z r                sphere
 *   c x y z r x y z r        cone: base, apex
 *   p n, then n x y z        polygon
 *   pp n, then n x y z nx ny nz   patch
 *
 * viewpoint, background, light, surface, sphere, cone, polygon and patch are the same keywords spelled out. Of several views or
 * backgrounds the last one counts. Numbers are decimal; nan, infinity and hexadecimal are none. Where the reader is not strict it
 * skips, and counts, unknown keywords with the rest of their line, polygons of fewer than three corners and spheres of no size. */
#include "io/nff_token.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int read_view(struct nff_reader *r)
{
	static const char *const words[] = { "from", "at", "up", "angle", "hither", "resolution" };
	static const int counts[] = { 3, 3, 3, 1, 1, 2 };
	double x[6][3] = { { 0, 0, 1 }, { 0, 0, 0 }, { 0, 1, 0 }, { 45 }, { 0 }, { 512, 512 } };
	for (;;) {
		int k = 0;
		if (nff_next(r) != 0)
			return -1;
		while (k < 6 && strcmp(r->token, words[k]) != 0)
			k++;
		if (k == 6)
			break;
		if (nff_read_numbers(r, words[k], x[k], counts[k]) != 0)
			return -1;
	}
	nff_put_back(r);
	for (int i = 0; i < 2; i++)
		if (!(x[5][i] >= 1 && x[5][i] <= 1e6 && x[5][i] == floor(x[5][i])))
			return nff_refuse(r, r->record, "resolution: %g is not a whole number from 1 to 1000000", x[5][i]);
	scene_set_view(r->scene, vec(x[0][0], x[0][1], x[0][2]), vec(x[1][0], x[1][1], x[1][2]), vec(x[2][0], x[2][1], x[2][2]),
	               x[3][0], x[4][0], (int)x[5][0], (int)x[5][1]);
	return 0;
}

static int read_background(struct nff_reader *r)
{
	double x[3];
	if (nff_read_numbers(r, "a background", x, 3) != 0)
		return -1;
	scene_set_background(r->scene, x[0], x[1], x[2]);
	return 0;
}

static int read_light(struct nff_reader *r)
{
	struct vec at;
	double x[3];
	if (nff_read_vec(r, "a light", &at) != 0)
		return -1;
	int n = nff_read_more(r, x, 3);
	if (n < 0)
		return -1;
	if (n == 3)
		scene_add_colored_light(r->scene, at, (struct color){ x[0], x[1], x[2] });
	else if (n == 0)
		scene_add_light(r->scene, at);
	else
		return nff_refuse(r, r->record, "a light has 3 or 6 numbers, not %d", 3 + n);
	return 0;
}

static int read_material(struct nff_reader *r)
{
	double x[8], ignored;
	int n;
	if (nff_read_numbers(r, "a material", x, 8) != 0)
		return -1;
	while ((n = nff_read_more(r, &ignored, 1)) == 1)
		if (r->strict)
			return nff_refuse(r, r->record, "a material has 8 numbers");
	scene_add_material(r->scene, (struct material){ { x[0], x[1], x[2] }, x[3], x[4], x[5], x[6], x[7] });
	return n;
}

static int read_sphere(struct nff_reader *r)
{
	double x[4];
	if (nff_read_numbers(r, "a sphere", x, 4) != 0)
		return -1;
	if (x[3] == 0) {
		if (r->strict)
			return nff_refuse(r, r->record, "a sphere of radius 0");
		nff_note_skipped(r);
		return 0;
	}
	scene_add_sphere(r->scene, vec(x[0], x[1], x[2]), x[3]);
	return 0;
}

static int read_cone(struct nff_reader *r)
{
	double x[8];
	if (nff_read_numbers(r, "a cone", x, 8) != 0)
		return -1;
	if (x[3] * x[7] < 0)
		return nff_refuse(r, r->record, "a cone with radii %g and %g of different sign", x[3], x[7]);
	struct vec base = vec(x[0], x[1], x[2]), apex = vec(x[4], x[5], x[6]);
	if (vec_length(vec_sub(apex, base)) == 0)
		return nff_refuse(r, r->record, "a cone whose base is its apex");
	if (x[3] == 0 && x[7] == 0)
		return nff_refuse(r, r->record, "a cone with both radii 0");
	scene_add_cone(r->scene, base, x[3], apex, x[7]);
	return 0;
}

/* A polygon or patch; 'numbers' a corner. */
static int read_corners(struct nff_reader *r, const char *what, int numbers)
{
	size_t n;
	if (nff_read_count(r, what, numbers, &n) != 0)
		return -1;
	struct vec few[2 * 16], *p = n <= 16 ? few : malloc(2 * n * sizeof *p);
	if (!p)
		return err_memory(r->err, r->name);
	int status = 0;
	for (size_t i = 0; status == 0 && i < n; i++) {
		status = nff_read_vec(r, what, &p[i]);
		if (status == 0 && numbers == 6)
			status = nff_read_vec(r, what, &p[n + i]);
	}
	if (status == 0 && n < 3) {
		if (r->strict)
			status = nff_refuse(r, r->record, "%s of %zu corners", what, n);
		nff_note_skipped(r);
	} else if (status == 0 && numbers == 6) {
		scene_add_patch(r->scene, p, p + n, n);
	} else if (status == 0) {
		scene_add_polygon(r->scene, p, n);
	}
	if (p != few)
		free(p);
	return status;
}

static int read_polygon(struct nff_reader *r)
{
	return read_corners(r, "a polygon", 3);
}

static int read_patch(struct nff_reader *r)
{
	return read_corners(r, "a patch", 6);
}

static const struct nff_record records[] = {
	{ "v", "viewpoint", read_view },  { "b", "background", read_background }, { "l", "light", read_light },
	{ "f", "surface", read_material }, { "s", "sphere", read_sphere },        { "c", "cone", read_cone },
	{ "p", "polygon", read_polygon }, { "pp", "patch", read_patch },          { 0 }
};

static const struct nff_record *find_record(const struct nff_record *table, const char *word)
{
	for (const struct nff_record *k = table; k && k->word; k++)
		if (strcmp(word, k->word) == 0 || (k->spelled && strcmp(word, k->spelled) == 0))
			return k;
	return NULL;
}

static int read_record(struct nff_reader *r)
{
	r->record = r->line;
	const struct nff_record *k = find_record(records, r->token);
	if (!k)
		k = find_record(r->more, r->token);
	if (k)
		return k->read(r);
	double x;
	if (nff_number(r->token, &x))
		return nff_refuse(r, r->record, "the number '%s' where a keyword should be", r->token);
	if (r->strict)
		return nff_refuse(r, r->record, "unknown keyword '%s'; known are v b l f s c p pp", r->token);
	nff_note_skipped(r);
	nff_skip_line(r);
	return 0;
}

int nff_read_records(struct nff_reader *r)
{
	if (r->end - r->at >= 3 && memcmp(r->at, "\xef\xbb\xbf", 3) == 0)
		r->at += 3;
	for (bool first = true;; first = false) {
		if (nff_next(r) != 0)
			return -1;
		if (!*r->token)
			return scene_complete(r->scene, r->name, r->err);
		if (first && strcmp(r->token, "nff") == 0)
			return nff_refuse(r, r->line, "this is WorldToolKit (Sense8) NFF, another format of the same name");
		if (read_record(r) != 0)
			return -1;
		if (r->scene->lost)
			return scene_complete(r->scene, r->name, r->err);
	}
}

int nff_read(struct scene *s, const char *name, const char *text, size_t n, bool strict, struct nff_skipped *skipped,
             struct err *e)
{
	struct nff_reader r = { .scene = s, .name = name, .at = text, .end = text + n, .line = 1, .strict = strict,
		                .skipped = skipped, .err = e };
	*skipped = (struct nff_skipped){ 0 };
	return nff_read_records(&r);
}

bool nff_is(const char *text, size_t n)
{
	struct err e = { 0 };
	struct nff_skipped skipped = { 0 };
	struct nff_reader r = { .at = text, .end = text + n, .line = 1, .skipped = &skipped, .err = &e };
	return nff_next(&r) == 0 && (find_record(records, r.token) || strcmp(r.token, "nff") == 0);
}
