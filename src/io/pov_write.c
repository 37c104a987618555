#include "io/pov_write.h"

#include "io/facets.h"
#include "io/number.h"

struct writer {
	const struct scene *scene;
	const struct write_options *options;
	struct text *out;
};

/* 'before', then <x, y, z>. */
static void write_vec(const struct writer *w, const char *before, const double *x)
{
	text_print(w->out, "%s<", before);
	number_write_row(w->out, "", x, 3, ", ", w->options->digits);
	text_add(w->out, ">", 1);
}

static void write_number(const struct writer *w, const char *before, double x)
{
	number_write_row(w->out, before, &x, 1, "", w->options->digits);
}

static void write_camera(const struct writer *w, const struct view *v)
{
	double height = 2 * tan(v->angle * (3.141592653589793 / 360)), width = height * v->width / v->height;
	struct vec direction = vec_unit(vec_sub(v->at, v->from)), right = vec_unit(vec_cross(direction, v->up));
	struct vec up = vec_scale(vec_cross(right, direction), height);
	right = vec_scale(right, width);
	write_vec(w, "camera {\n\tlocation ", v->from.a);
	write_vec(w, "\n\tdirection ", direction.a);
	write_vec(w, "\n\tright ", right.a);
	write_vec(w, "\n\tup ", up.a);
	text_print(w->out, "\n}\n");
}

static void write_lights(const struct writer *w)
{
	const struct scene *s = w->scene;
	double strength = 0.5 / sqrt((double)s->light_count);
	for (size_t i = 0; i < s->light_count; i++) {
		const struct light *l = &s->lights[i];
		const double color[3] = { l->color.r, l->color.g, l->color.b }, plain[3] = { strength, strength, strength };
		write_vec(w, "light_source { ", l->at.a);
		write_vec(w, ", color rgb ", l->colored ? color : plain);
		text_print(w->out, " }\n");
	}
}

static void write_materials(const struct writer *w)
{
	for (size_t i = 0; i < w->scene->material_count; i++) {
		const struct material *m = &w->scene->materials[i];
		const double color[3] = { m->color.r, m->color.g, m->color.b };
		text_print(w->out, "#declare m%zu = material {\n\ttexture {\n", i);
		write_vec(w, "\t\tpigment { color rgb ", color);
		if (m->transmit != 0)
			write_number(w, " transmit ", m->transmit);
		write_number(w, " }\n\t\tfinish { ambient 0 diffuse ", m->kd);
		if (m->ks != 0) {
			write_number(w, " phong ", m->ks);
			write_number(w, " phong_size ", m->shine);
			write_number(w, " reflection ", m->ks);
		}
		text_print(w->out, " }\n\t}\n");
		if (m->ior != 0)
			write_number(w, "\tinterior { ior ", m->ior);
		text_print(w->out, "%s}\n", m->ior != 0 ? " }\n" : "");
	}
}

static void write_material_name(const struct writer *w, uint32_t material)
{
	if (material != NO_MATERIAL)
		text_print(w->out, " material { m%u }", material);
	text_print(w->out, " }\n");
}

static void write_curve(const struct writer *w, const struct object *o)
{
	const struct vec *p = &w->scene->points[o->first];
	write_vec(w, o->kind == OBJECT_SPHERE ? "sphere { " : "cone { ", p[0].a);
	write_number(w, ", ", fabs(o->radius[0]));
	if (o->kind == OBJECT_CONE) {
		write_vec(w, ", ", p[1].a);
		write_number(w, ", ", fabs(o->radius[1]));
		text_print(w->out, " open");
	}
	write_material_name(w, o->material);
}

/* The rows of a list of vectors: columns first .. first + 2 of the keys. */
static void write_list(const struct writer *w, const char *name, const double *keys, int width, int first, const uint32_t *rows, size_t n)
{
	text_print(w->out, "\t%s { %zu", name, n);
	for (size_t i = 0; i < n; i++)
		write_vec(w, i % 4 ? ", " : ",\n\t\t", &keys[rows[i] * (size_t)width + (size_t)first]);
	text_print(w->out, " }\n");
}

static int write_mesh(const struct writer *w, struct facets *f)
{
	size_t n = 3 * f->count;
	int width = f->all[0].smooth ? 6 : 3;
	double *keys = NEW(&f->mem, double, (size_t)width * n);
	uint32_t *index = NEW(&f->mem, uint32_t, n), *rows = NEW(&f->mem, uint32_t, n);
	if (!keys || !index || !rows)
		return -1;
	for (size_t i = 0; i < n; i++)
		for (int k = 0; k < width; k++)
			keys[i * (size_t)width + (size_t)k] = (k < 3 ? f->all[i / 3].corner : f->all[i / 3].normal)[i % 3].a[k % 3];
	size_t count = facets_weld(keys, n, width, index, rows);
	if (count == SIZE_MAX)
		return -1;
	text_print(w->out, "mesh2 {\n");
	write_list(w, "vertex_vectors", keys, width, 0, rows, count);
	if (width == 6)
		write_list(w, "normal_vectors", keys, width, 3, rows, count);
	text_print(w->out, "\tface_indices { %zu", f->count);
	for (size_t i = 0; i < n; i += 3)
		text_print(w->out, "%s<%u, %u, %u>", i % 24 ? ", " : ",\n\t\t", index[i], index[i + 1], index[i + 2]);
	text_print(w->out, " }\n");
	write_material_name(w, f->all[0].material);
	return 0;
}

/* The objects from number 'first' on that go into one mesh; returns the number of the next one. */
static size_t gather(const struct writer *w, size_t first, struct facets *f)
{
	const struct scene *s = w->scene;
	size_t i = first;
	do
		facets_add(f, s, &s->objects[i++], w->options->resolution);
	while (i < s->object_count && s->objects[i].kind == s->objects[first].kind && s->objects[i].material == s->objects[first].material);
	return i;
}

int pov_write(const struct scene *s, const struct write_options *o, struct text *out, struct err *e)
{
	const struct writer w = { s, o, out };
	int status = 0;
	text_print(out, "#version 3.7;\nglobal_settings { assumed_gamma srgb }\n");
	if (s->background_given) {
		write_vec(&w, "background { color rgb ", (const double[3]){ s->background.r, s->background.g, s->background.b });
		text_print(out, " }\n");
	}
	if (s->view.given)
		write_camera(&w, &s->view);
	write_lights(&w);
	write_materials(&w);
	for (size_t i = 0; status == 0 && i < s->object_count;) {
		if (s->objects[i].kind == OBJECT_SPHERE || s->objects[i].kind == OBJECT_CONE) {
			write_curve(&w, &s->objects[i++]);
			continue;
		}
		struct facets f = { 0 };
		i = gather(&w, i, &f);
		status = f.lost ? -1 : f.count ? write_mesh(&w, &f) : 0;
		facets_free(&f);
	}
	return status == 0 && !out->lost ? 0 : err_memory(e, "POV-Ray");
}
