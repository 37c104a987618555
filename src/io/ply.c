#include "io/ply.h"

#include "io/facets.h"
#include "io/number.h"

static void write_head(size_t vertices, size_t faces, bool smooth, struct text *out)
{
	static const char *const names[6] = { "x", "y", "z", "nx", "ny", "nz" };
	text_print(out, "ply\nformat ascii 1.0\nelement vertex %zu\n", vertices);
	for (int i = 0; i < (smooth ? 6 : 3); i++)
		text_print(out, "property double %s\n", names[i]);
	text_print(out, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", faces);
}

static int write_facets(struct facets *f, bool smooth, int digits, struct text *out)
{
	size_t n = 3 * f->count;
	int width = smooth ? 6 : 3;
	double *keys = NEW(&f->mem, double, (size_t)width * n);
	uint32_t *index = NEW(&f->mem, uint32_t, n), *rows = NEW(&f->mem, uint32_t, n);
	if (!keys || !index || !rows)
		return -1;
	for (size_t i = 0; i < n; i++)
		for (int k = 0; k < width; k++) {
			const struct facet *facet = &f->all[i / 3];
			keys[i * (size_t)width + (size_t)k] = (k < 3 ? facet->corner : facet->normal)[i % 3].a[k % 3];
		}
	size_t count = facets_weld(keys, n, width, index, rows);
	if (count == SIZE_MAX)
		return -1;
	write_head(count, f->count, smooth, out);
	for (size_t i = 0; i < count; i++) {
		number_write_row(out, "", &keys[rows[i] * (size_t)width], width, " ", digits);
		text_add(out, "\n", 1);
	}
	for (size_t i = 0; i < n; i += 3)
		text_print(out, "3 %u %u %u\n", index[i], index[i + 1], index[i + 2]);
	return 0;
}

int ply_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e)
{
	struct facets f = { 0 };
	bool smooth = false;
	for (size_t i = 0; i < s->object_count; i++)
		facets_add(&f, s, &s->objects[i], o->resolution);
	for (size_t i = 0; i < f.count; i++)
		smooth |= f.all[i].smooth;
	int status = f.lost ? -1 : write_facets(&f, smooth, o->digits, out);
	facets_free(&f);
	return status == 0 && !out->lost ? 0 : err_memory(e, "PLY");
}
