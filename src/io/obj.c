#include "io/obj.h"

#include "io/facets.h"
#include "io/number.h"

#include <stdlib.h>

/* Corners or normals of all facets, three rows a facet, welded. */
struct welded {
	double *keys;
	uint32_t *index, *rows;
	size_t count;
};

static int weld(struct welded *w, const struct facets *f, bool normals, struct arena *mem)
{
	size_t n = 3 * f->count;
	w->keys = NEW(mem, double, 3 * n);
	w->index = NEW(mem, uint32_t, n);
	w->rows = NEW(mem, uint32_t, n);
	if (!w->keys || !w->index || !w->rows)
		return -1;
	for (size_t i = 0; i < 3 * n; i++) {
		const struct facet *facet = &f->all[i / 9];
		w->keys[i] = (normals ? facet->normal : facet->corner)[i % 9 / 3].a[i % 3];
	}
	w->count = facets_weld(w->keys, n, 3, w->index, w->rows);
	return w->count == SIZE_MAX ? -1 : 0;
}

static void write_rows(const struct welded *w, const char *word, int digits, struct text *out)
{
	for (size_t i = 0; i < w->count; i++) {
		number_write_row(out, word, &w->keys[3 * (size_t)w->rows[i]], 3, " ", digits);
		text_add(out, "\n", 1);
	}
}

static void write_faces(const struct facets *f, const struct welded *corners, const struct welded *normals, struct text *out)
{
	uint32_t material = NO_MATERIAL;
	for (size_t i = 0; i < f->count; i++) {
		const struct facet *facet = &f->all[i];
		if (facet->material != material)
			text_print(out, "usemtl m%u\n", material = facet->material);
		text_add(out, "f", 1);
		for (size_t k = 3 * i; k < 3 * i + 3; k++)
			if (facet->smooth)
				text_print(out, " %u//%u", corners->index[k] + 1, normals->index[k] + 1);
			else
				text_print(out, " %u", corners->index[k] + 1);
		text_add(out, "\n", 1);
	}
}

int obj_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e)
{
	struct facets f = { 0 };
	struct welded corners, normals;
	bool smooth = false;
	for (size_t i = 0; i < s->object_count; i++)
		facets_add(&f, s, &s->objects[i], o->resolution);
	for (size_t i = 0; i < f.count; i++)
		smooth |= f.all[i].smooth;
	int status = f.lost ? -1 : weld(&corners, &f, false, &f.mem);
	if (status == 0 && smooth)
		status = weld(&normals, &f, true, &f.mem);
	if (status == 0) {
		if (o->companion && s->material_count)
			text_print(out, "mtllib %s\n", o->companion);
		write_rows(&corners, "v ", o->digits, out);
		if (smooth)
			write_rows(&normals, "vn ", o->digits, out);
		write_faces(&f, &corners, &normals, out);
	}
	facets_free(&f);
	return status == 0 && !out->lost ? 0 : err_memory(e, "OBJ");
}

int obj_write_materials(const struct scene *s, const struct write_options *o, struct text *out, struct err *e)
{
	text_add(out, "", 0);
	for (size_t i = 0; i < s->material_count; i++) {
		const struct material *m = &s->materials[i];
		const double diffuse[3] = { m->color.r * m->kd, m->color.g * m->kd, m->color.b * m->kd }, specular[3] = { m->ks, m->ks, m->ks };
		const double opaque = 1 - m->transmit;
		text_print(out, "newmtl m%zu\n", i);
		number_write_row(out, "Kd ", diffuse, 3, " ", o->digits);
		number_write_row(out, "\nKs ", specular, 3, " ", o->digits);
		number_write_row(out, "\nNs ", &m->shine, 1, " ", o->digits);
		number_write_row(out, "\nd ", &opaque, 1, " ", o->digits);
		number_write_row(out, "\nNi ", &m->ior, 1, " ", o->digits);
		text_add(out, "\n", 1);
	}
	return out->lost ? err_memory(e, "OBJ") : 0;
}
