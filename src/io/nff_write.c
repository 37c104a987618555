#include "io/nff.h"

#include "io/number.h"

#include <stdlib.h>
#include <string.h>

struct writer {
	struct text *out;
	int digits;
};

/* 'before', then n numbers with blanks between. */
static void write_numbers(const struct writer *w, const char *before, const double *x, int n)
{
	number_write_row(w->out, before, x, n, " ", w->digits);
}

static void write_line(const struct writer *w, const char *before, const double *x, int n)
{
	write_numbers(w, before, x, n);
	text_add(w->out, "\n", 1);
}

static void write_head(const struct writer *w, const struct scene *s)
{
	if (s->background_given)
		write_line(w, "b ", &s->background.r, 3);
	const struct view *v = &s->view;
	if (v->given) {
		text_print(w->out, "v\n");
		write_line(w, "from ", v->from.a, 3);
		write_line(w, "at ", v->at.a, 3);
		write_line(w, "up ", v->up.a, 3);
		write_line(w, "angle ", &v->angle, 1);
		write_line(w, "hither ", &v->hither, 1);
		text_print(w->out, "resolution %d %d\n", v->width, v->height);
	}
	for (size_t i = 0; i < s->light_count; i++) {
		const struct light *l = &s->lights[i];
		const double x[6] = { l->at.x, l->at.y, l->at.z, l->color.r, l->color.g, l->color.b };
		write_line(w, "l ", x, l->colored ? 6 : 3);
	}
}

static void write_material(const struct writer *w, const struct material *m)
{
	const double x[8] = { m->color.r, m->color.g, m->color.b, m->kd, m->ks, m->shine, m->transmit, m->ior };
	write_line(w, "f ", x, 8);
}

size_t nff_clean_corners(const struct vec *corners, size_t n, struct vec *kept)
{
	memcpy(kept, corners, n * sizeof *kept);
	for (size_t i = 0; i < n;) {
		if (n > 1 && vec_length(vec_sub(kept[i], kept[(i + 1) % n])) < 1e-6) {
			memmove(&kept[i], &kept[i + 1], (n - i - 1) * sizeof *kept);
			n--;
		} else {
			i++;
		}
	}
	return n;
}

static int write_polygon(const struct writer *w, const struct vec *corners, size_t n)
{
	struct vec few[16], *kept = n <= 16 ? few : malloc(n * sizeof *kept);
	if (!kept)
		return -1;
	if (w->digits <= 6)
		n = nff_clean_corners(corners, n, kept);
	else
		memcpy(kept, corners, n * sizeof *kept);
	if (n >= 3)
		text_print(w->out, "p %zu\n", n);
	for (size_t i = 0; n >= 3 && i < n; i++)
		write_line(w, "", kept[i].a, 3);
	if (kept != few)
		free(kept);
	return 0;
}

static int write_object(const struct writer *w, const struct scene *s, const struct object *o)
{
	const struct vec *p = &s->points[o->first];
	switch (o->kind) {
	case OBJECT_SPHERE:
		write_numbers(w, "s ", p->a, 3);
		write_line(w, " ", &o->radius[0], 1);
		return 0;
	case OBJECT_CONE:
		write_numbers(w, "c ", p[0].a, 3);
		write_numbers(w, " ", &o->radius[0], 1);
		write_numbers(w, " ", p[1].a, 3);
		write_line(w, " ", &o->radius[1], 1);
		return 0;
	case OBJECT_POLYGON:
		return write_polygon(w, p, o->count);
	case OBJECT_PATCH:
		text_print(w->out, "pp %u\n", o->count);
		for (uint32_t i = 0; i < o->count; i++) {
			write_numbers(w, "", p[i].a, 3);
			write_line(w, " ", p[o->count + i].a, 3);
		}
		return 0;
	}
	return 0;
}

int nff_write(const struct scene *s, int digits, struct text *out, struct err *e)
{
	const struct writer w = { out, digits };
	size_t materials = 0;
	write_head(&w, s);
	for (size_t i = 0; i < s->object_count; i++) {
		const struct object *o = &s->objects[i];
		while (o->material != NO_MATERIAL && materials <= o->material)
			write_material(&w, &s->materials[materials++]);
		if (write_object(&w, s, o) != 0)
			return err_memory(e, "NFF");
	}
	while (materials < s->material_count)
		write_material(&w, &s->materials[materials++]);
	return out->lost ? err_memory(e, "NFF") : 0;
}
