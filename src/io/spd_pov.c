#include "io/spd_pov.h"

#include "io/nff.h"
#include "io/spd_split.h"
#include "spd/notes.h"

#include <stdio.h>
#include <string.h>

const char spd_pov_image_name[] = "hf000.tga";

static const double degrees = 180 / 3.141592653589793;

struct writer {
	const struct scene *scene;
	struct text *out;
	int version;
	size_t materials; /* written so far */
	char texture[7];  /* name of the one at hand */
	struct arena scratch;
};

/* Vectors have commas from version 2 on, and so has the end of a line in a list of points. */
static void print_vec(const struct writer *w, struct vec p)
{
	text_print(w->out, w->version == 1 ? "<%g %g %g>" : "<%g, %g, %g>", p.x, p.y, p.z);
}

static void print_named(const struct writer *w, const char *name, struct vec p)
{
	text_print(w->out, "%s", name);
	print_vec(w, p);
}

static const char *comma(const struct writer *w)
{
	return w->version == 1 ? "" : ",";
}

static void print_color(const struct writer *w, const char *before, double r, double g, double b)
{
	text_print(w->out, "%scolor red %g green %g blue %g", before, r, g, b);
}

static void write_background(const struct writer *w, const struct color *c)
{
	if (w->version == 1) {
		text_print(w->out, "// POV-Ray 1.0 scene file\n// background color:\nobject {\n    sphere { <0 0 0> 9000  texture {");
		print_color(w, " ambient 1 diffuse 0 ", c->r, c->g, c->b);
		text_print(w->out, " } }\n} // object - background\n\n");
	} else {
		text_print(w->out, "// POV-Ray %d scene file\nbackground {", w->version);
		print_color(w, " ", c->r, c->g, c->b);
		text_print(w->out, " }\n\n");
	}
}

static void write_camera(const struct writer *w, const struct view *v)
{
	double height = 2 * tan(v->angle / 2 / degrees), width = height * v->width / v->height;
	struct vec direction = vec_unit(vec_sub(v->at, v->from));
	/* By way of the left, which decides the signs of zeros. */
	struct vec left = vec_unit(vec_cross(v->up, direction)), up = vec_unit(vec_cross(direction, left));
	print_named(w, "camera {\n    location ", v->from);
	print_named(w, "\n    direction ", direction);
	print_named(w, "\n    right     ", vec_scale(left, -width));
	print_named(w, "\n    up        ", vec_scale(up, height));
	text_print(w->out, "\n} // camera\n\n");
}

static void write_lights(const struct writer *w)
{
	double strength = 1 / sqrt((double)w->scene->light_count);
	for (size_t i = 0; i < w->scene->light_count; i++) {
		print_named(w, w->version == 1 ? "object {\n    light_source {\n        " : "light_source {\n    ", w->scene->lights[i].at);
		print_color(w, " ", strength, strength, strength);
		text_print(w->out, w->version == 1 ? "\n    } // light\n} // object\n\n" : "\n} // light\n\n");
	}
}

/* The lines of a finish, each behind 'indent'. */
static void print_finish(const struct writer *w, const char *indent, const struct material *m, const struct spd_finish *f)
{
	const char *wide = w->version == 1 ? " " : "  ";
	text_print(w->out, "%sambient %g\n%sdiffuse %g\n", indent, f->ambient, indent, m->kd);
	if (f->highlight != 0)
		text_print(w->out, "%sphong %g%sphong_size %g\n", indent, f->highlight, wide, m->shine);
	if (m->ks != 0)
		text_print(w->out, "%sreflection %g\n", indent, m->ks);
	if (m->transmit != 0)
		text_print(w->out, "%srefraction 1.0 ior %g\n", indent, m->ior);
}

static void write_material(struct writer *w, const struct material *m, const struct spd_finish *f)
{
	char name[32];
	snprintf(name, sizeof name, "txt%03zu", w->materials);
	name[6] = '\0';
	memcpy(w->texture, name, sizeof w->texture);
	text_print(w->out, "#declare %s = texture {\n%s", name, w->version == 1 ? "" : "    pigment {\n    ");
	print_color(w, "    ", m->color.r, m->color.g, m->color.b);
	if (m->transmit > 0)
		text_print(w->out, " %s %g", w->version == 1 ? "alpha" : "filter", m->transmit);
	text_print(w->out, "\n");
	if (w->version == 1) {
		print_finish(w, "    ", m, f);
	} else {
		text_print(w->out, "    } // pigment\n    // normal { bumps, ripples, etc. }\n    finish {\n");
		print_finish(w, "        ", m, f);
		text_print(w->out, "    } // finish\n");
	}
	text_print(w->out, "} // texture %s\n\n", name);
}

/* The materials up to number 'last' that are not written yet. */
static void write_materials(struct writer *w, size_t last)
{
	const struct spd_notes *notes = w->scene->notes;
	while (w->materials <= last) {
		size_t i = w->materials++;
		const struct spd_finish none = { 0, 0 };
		write_material(w, &w->scene->materials[i], notes && i < notes->finish_count ? &notes->finishes[i] : &none);
	}
}

/* Corners i, j, k; normals may be NULL. */
static void write_triangle(const struct writer *w, const struct vec *p, const struct vec *normals, const uint32_t *k)
{
	text_print(w->out, "object {\n    %striangle {\n", normals ? "smooth_" : "");
	for (int i = 0; i < 3; i++) {
		print_named(w, "        ", p[k[i]]);
		if (normals)
			print_named(w, " ", normals[k[i]]);
		text_print(w->out, "%s\n", i < 2 ? comma(w) : "");
	}
	text_print(w->out, "    } // tri\n    texture { %s }\n} // object\n\n", w->texture);
}

static int write_polygon(struct writer *w, const struct object *o, const struct vec *p)
{
	static const uint32_t three[3] = { 0, 1, 2 };
	if (o->kind == OBJECT_PATCH) {
		write_triangle(w, p, p + o->count, three);
		return 0;
	}
	struct vec *kept = NEW(&w->scratch, struct vec, o->count);
	uint32_t *t = NEW(&w->scratch, uint32_t, 3 * (size_t)o->count);
	if (!kept || !t)
		return -1;
	size_t n = nff_clean_corners(p, o->count, kept);
	if (n >= 3 && spd_split(kept, n, t, &w->scratch) != 0)
		return -1;
	for (size_t i = 0; i + 2 < n; i++)
		write_triangle(w, kept, NULL, t + 3 * i);
	return 0;
}

/* A transform in its parts, as POV-Ray names them; each is left out where it changes nothing. */
static void print_placing(const struct writer *w, const struct matrix *m, const char *between)
{
	if (!m)
		return;
	struct vec row[3], scale, turn, move = vec(m->m[3][0], m->m[3][1], m->m[3][2]);
	for (int i = 0; i < 3; i++) {
		row[i] = vec(m->m[i][0], m->m[i][1], m->m[i][2]);
		scale.a[i] = vec_length(row[i]);
		row[i] = vec_scale(row[i], 1 / scale.a[i]);
	}
	turn = vec(atan2(row[1].z, row[2].z) * degrees, asin(-row[0].z) * degrees, atan2(row[0].y, row[0].x) * degrees);
	const struct {
		const char *name;
		struct vec value;
		bool neutral;
	} parts[3] = { { "scale", scale, vec_length(vec_sub(scale, vec(1, 1, 1))) < 1e-8 },
		       { "rotate", turn, vec_length(turn) < 1e-8 },
		       { "translate", move, vec_length(move) < 1e-8 } };
	for (int i = 0; i < 3; i++) {
		if (parts[i].neutral)
			continue;
		text_print(w->out, w->version == 1 ? " %s %g %g %g" : " %s <%g, %g, %g>", parts[i].name, parts[i].value.x, parts[i].value.y,
		           parts[i].value.z);
		text_print(w->out, "%s", between);
	}
}

static void write_sphere(const struct writer *w, struct vec center, double radius, const struct matrix *m)
{
	if (w->version == 1) {
		print_named(w, "object { sphere { ", center);
		text_print(w->out, " %g } ", radius);
	} else {
		print_named(w, "sphere { ", center);
		text_print(w->out, ", %g ", radius);
	}
	print_placing(w, m, "");
	text_print(w->out, " texture { %s } }\n\n", w->texture);
}

/* Turns z toward d: about x, then about y. A direction along y gets no second turn. */
static struct vec find_turn(struct vec d)
{
	double shadow = sqrt(d.x * d.x + d.z * d.z);
	if (shadow < 1e-9)
		return vec(-asin(d.y) * degrees, 0, 0);
	double turn = acos(d.z / shadow) * degrees;
	return vec(-asin(d.y) * degrees, d.x < 0 ? -turn : turn, 0);
}

/* Version 1 has neither cylinders nor cones: an infinite one between two planes, along z, put where it belongs. */
static void write_quadric(const struct writer *w, const struct vec *ends, const double *radii, const struct matrix *m)
{
	bool swap = radii[1] < radii[0];
	struct vec from = ends[swap], to = ends[!swap], axis = vec_sub(to, from);
	double small = radii[swap], large = radii[!swap], length = vec_length(axis);
	if (small == large)
		text_print(w->out, "object {\n    quadric { <1 1 0> <0 0 0> <0 0 0> -1 } // cylinder\n");
	else
		text_print(w->out, "object {\n    quadric{ <1 1 -1> <0 0 0> <0 0 0> 0 } // cone\n");
	text_print(w->out, "    clipped_by {\n        intersection {\n");
	if (small == large)
		text_print(w->out, "            plane { <0 0 -1> 0 }\n            plane { <0 0  1> 1 }\n");
	else
		text_print(w->out, "            plane { <0 0 -1> %g}\n            plane { <0 0  1> %g}\n", -small, large);
	text_print(w->out, "        } // intersection\n    } // clip\n");
	if (small == large)
		text_print(w->out, "    scale <%g %g 1>\n    scale <1 1 %g>\n", small, small, length);
	else
		text_print(w->out, "    translate <0 0 %g>\n    scale <1 1 %g>\n", -small, length / (large - small));
	print_named(w, "    rotate ", find_turn(vec_unit(axis)));
	print_named(w, "\n    translate ", from);
	text_print(w->out, "\n");
	print_placing(w, m, "");
	text_print(w->out, "    texture { %s }\n} // object\n\n", w->texture);
}

static void write_cone(const struct writer *w, const struct vec *ends, const double *radii, const struct matrix *m)
{
	if (w->version == 1) {
		write_quadric(w, ends, radii, m);
		return;
	}
	print_named(w, "cone {\n    ", ends[1]);
	text_print(w->out, ", %g,\n", radii[1]);
	print_named(w, "    ", ends[0]);
	text_print(w->out, ", %g open\n", radii[0]);
	print_placing(w, m, "    ");
	text_print(w->out, "%stexture { %s }\n}\n\n", m ? "" : "    ", w->texture);
}

/* Whether an object is the sphere at the apex of the tapering cone before it: version 1 puts it at the base instead. */
static bool is_misplaced(const struct writer *w, const struct object *o, const struct object *before, const struct vec *points)
{
	return w->version == 1 && before && before->kind == OBJECT_CONE && o->kind == OBJECT_SPHERE && before->radius[1] < before->radius[0] &&
	       o->radius[0] == before->radius[1] && vec_length(vec_sub(points[o->first], points[before->first + 1])) == 0;
}

/* One object whose points start at 'points'; before: the one in front of it, or NULL; m: how it is moved, or NULL. */
static int write_object(struct writer *w, const struct object *o, const struct object *before, const struct vec *points,
                        const struct matrix *m)
{
	switch (o->kind) {
	case OBJECT_SPHERE:
		if (is_misplaced(w, o, before, points))
			write_sphere(w, points[before->first], before->radius[0], m);
		else
			write_sphere(w, points[o->first], o->radius[0], m);
		return 0;
	case OBJECT_CONE:
		write_cone(w, points + o->first, o->radius, m);
		return 0;
	case OBJECT_POLYGON:
	case OBJECT_PATCH:
		return write_polygon(w, o, points + o->first);
	}
	return 0;
}

static void write_torus(const struct writer *w, const struct spd_shape *t)
{
	struct vec n = vec_unit(t->normal);
	text_print(w->out, "torus {\n    %g, %g\n", t->radius[0], t->radius[1]);
	print_named(w, "    rotate ", vec(asin(n.z) * degrees, 0, -atan2(n.x, n.y) * degrees));
	if (vec_length(t->center) > 0)
		print_named(w, "\n    translate ", t->center);
	text_print(w->out, "\n    texture { %s }\n} // torus\n\n", w->texture);
}

static void write_disc(const struct writer *w, const struct spd_shape *d)
{
	struct vec n = vec_unit(d->normal);
	if (w->version > 1) {
		print_named(w, "disc { ", d->center);
		print_named(w, " ", n);
		text_print(w->out, " %g texture { %s } }\n\n", d->radius[0], w->texture);
		return;
	}
	/* The turn about y divides by the length of the normal's shadow, 0 for one along y. */
	double shadow = sqrt(n.x * n.x + n.z * n.z);
	text_print(w->out, "object {\n    plane { <0 0 1> 1 }\n    clipped_by {\n        object { sphere { <0 0 0> %g } }\n    } // clip\n",
	           d->radius[0]);
	text_print(w->out, "    rotate <%g %g 0>\n", -asin(n.y) * degrees, shadow > 0 ? acos(n.z / shadow) * degrees : -(double)NAN);
	print_named(w, "    translate ", d->center);
	text_print(w->out, "\n    texture { %s }} // object - disc\n\n", w->texture);
}

static void write_heights(const struct writer *w)
{
	text_print(w->out, "object {\n    height_field { tga \"%s\" }", spd_pov_image_name);
	print_named(w, "    scale ", vec(8, 6, 8));
	print_named(w, "\n    translate ", vec(-4, -3, -4));
	text_print(w->out, "\n    texture { %s }} // object - Height Field\n\n", w->texture);
}

/* Whether this version says it otherwise than by the objects it stands for. */
static bool is_shape(const struct writer *w, const struct spd_shape *shape)
{
	return shape->kind != SPD_TORUS || w->version > 1;
}

static int write_shape(struct writer *w, const struct spd_shape *shape)
{
	int status = 0;
	switch (shape->kind) {
	case SPD_TORUS:
		write_torus(w, shape);
		break;
	case SPD_DISC:
		write_disc(w, shape);
		break;
	case SPD_HEIGHTS:
		write_heights(w);
		break;
	case SPD_PLACED:
		for (size_t i = 0; status == 0 && i < shape->count; i++)
			status = write_object(w, &shape->objects[i], i ? &shape->objects[i - 1] : NULL, shape->points, &shape->matrix);
		break;
	}
	return status;
}

int spd_pov_write(const struct scene *s, int version, struct text *out, struct err *e)
{
	struct writer w = { .scene = s, .out = out, .version = version };
	int status = 0;
	const struct spd_shape *shape = s->notes ? s->notes->shapes : NULL, *end = shape ? shape + s->notes->shape_count : NULL;
	write_background(&w, &s->background);
	write_camera(&w, &s->view);
	write_lights(&w);
	for (size_t i = 0; status == 0 && i < s->object_count;) {
		const struct object *o = &s->objects[i];
		if (o->material != NO_MATERIAL)
			write_materials(&w, o->material);
		while (shape < end && (shape->first < i || !is_shape(&w, shape)))
			shape++;
		if (shape < end && shape->first == i) {
			status = write_shape(&w, shape);
			i += shape->count;
		} else {
			status = write_object(&w, o, i ? o - 1 : NULL, s->points, NULL);
			i++;
		}
	}
	if (s->material_count)
		write_materials(&w, s->material_count - 1);
	arena_free(&w.scratch);
	return status == 0 && !out->lost ? 0 : err_memory(e, "POV-Ray");
}

void spd_pov_image(const struct scene *s, struct text *out)
{
	for (size_t i = 0; s->notes && i < s->notes->shape_count; i++) {
		const struct spd_shape *h = &s->notes->shapes[i];
		if (h->kind != SPD_HEIGHTS)
			continue;
		const unsigned char head[18] = { [2] = 2, [12] = (unsigned char)h->n, [13] = (unsigned char)(h->n >> 8),
			                         [14] = (unsigned char)h->n, [15] = (unsigned char)(h->n >> 8), [16] = 24, [17] = 0x20 };
		text_add(out, (const char *)head, sizeof head);
		for (int k = 0; k < h->n * h->n; k++) {
			double y = 128 * (double)h->heights[k];
			y = (y < -128 ? -128 : y > 127 ? 127 : y) + 128;
			const unsigned char pixel[3] = { 0, (unsigned char)((y - floor(y)) * 256), (unsigned char)y };
			text_add(out, (const char *)pixel, sizeof pixel);
		}
	}
}
