/* Solids into a scene: what is a sphere stays one, all else becomes triangles. */
#include "io/pov_place.h"
#include "io/pov_surface.h"

#include <stdlib.h>

/* How much larger than the rest a sky is; half the side of a scene where nothing is finite, about the origin; by how much of the scene
 * what is marched through may go beyond it; and a side for scenes of one point. */
static const double dome_ratio = 20, alone = 10, close_by = 0.5, narrowest = 1e-3;

struct mesher {
	struct scene *scene;
	const struct pov_mesh_options *options;
	struct pov_tally *tally;
	struct err *err;
	struct pov_term **terms;
	size_t count;
	struct pov_surface surface;
};

struct pov_mesh_options pov_mesh_defaults(void)
{
	return (struct pov_mesh_options){ .resolution = 32, .extent = 0.5, .planes = true, .most_triangles = 100000000 };
}

/* Call 'each' for all terms whose surface stands by itself: the parts of unions at the top. */
typedef int each_fn(struct mesher *m, struct pov_term *t, void *context);

static int for_each(struct mesher *m, struct pov_term *t, each_fn *each, void *context)
{
	int status = 0;
	if (t->kind != TERM_UNION || t->exact || t->inverse)
		return each(m, t, context);
	for (struct pov_term *c = t->child; status == 0 && c; c = c->next)
		status = for_each(m, c, each, context);
	return status;
}

static int for_all(struct mesher *m, each_fn *each, void *context)
{
	int status = 0;
	for (size_t i = 0; status == 0 && i < m->count; i++)
		status = for_each(m, m->terms[i], each, context);
	return status;
}

/* A sphere about the eye may be the sky. */
static bool is_dome(const struct mesher *m, const struct pov_term *t)
{
	if (m->options->keep_domes || !m->options->eye_given || t->kind != TERM_LEAF || t->shape->kind != POV_SPHERE)
		return false;
	return pov_shape_of(t->shape)->field(t->shape, matrix_point(m->options->eye, &t->back)) < 0;
}

struct domes {
	struct pov_term **all;
	size_t count, room;
	struct box rest;
};

static int sort_out(struct mesher *m, struct pov_term *t, void *context)
{
	struct domes *d = context;
	if (!is_dome(m, t)) {
		/* Planes end at the region: they do not make it. */
		struct box own = t->half_count ? t->extent : box_common(&t->extent, &t->bound);
		if (t->kind != TERM_EMPTY && !box_is_empty(&own) && box_is_finite(&own))
			box_join(&d->rest, &own);
		return 0;
	}
	if (d->count == d->room) {
		d->room = d->room ? 2 * d->room : 16;
		struct pov_term **grown = realloc(d->all, d->room * sizeof *grown);
		if (!grown)
			return err_memory(m->err, "sky spheres");
		d->all = grown;
	}
	d->all[d->count++] = t;
	return 0;
}

/* Smallest first; in order where equal, for then the sort does not matter. */
static int compare_size(const void *a, const void *b)
{
	double x = box_longest(&(*(struct pov_term *const *)a)->extent), y = box_longest(&(*(struct pov_term *const *)b)->extent);
	return (x > y) - (x < y);
}

/* Find the box of all that is finite, and drop the domes about it. */
static int find_rest(struct mesher *m, struct box *rest)
{
	struct domes d = { .rest = box_empty() };
	int status = for_all(m, sort_out, &d);
	bool open = false;
	if (d.count)
		qsort(d.all, d.count, sizeof *d.all, compare_size);
	for (size_t i = 0; i < d.count; i++) {
		open = open || (!box_is_empty(&d.rest) && box_longest(&d.all[i]->extent) > dome_ratio * box_longest(&d.rest));
		if (!open) {
			box_join(&d.rest, &d.all[i]->extent);
			continue;
		}
		*d.all[i] = (struct pov_term){ .kind = TERM_EMPTY, .next = d.all[i]->next };
		m->tally->domes++;
	}
	free(d.all);
	*rest = d.rest;
	return status;
}

static void set_region(struct mesher *m, struct box rest)
{
	struct pov_surface *s = &m->surface;
	s->size = box_is_empty(&rest) ? 0 : box_diagonal(&rest);
	if (box_is_empty(&rest))
		rest = (struct box){ vec(-alone, -alone, -alone), vec(alone, alone, alone) };
	if (m->options->eye_given)
		box_extend(&rest, m->options->eye);
	double side = fmax(box_longest(&rest), narrowest);
	s->region = box_enlarge(&rest, m->options->extent * side);
	s->close = box_enlarge(&rest, fmin(close_by, m->options->extent) * side);
	if (!(s->size > 0))
		s->size = box_diagonal(&s->region);
}

/* The object last added has its material from the term, where that is not the scene's last. */
static void set_material(struct scene *scene, uint32_t material)
{
	if (!scene->lost && material != NO_MATERIAL)
		scene->objects[scene->object_count - 1].material = material;
}

/* A sphere moved, turned and scaled evenly. */
static bool add_sphere(struct mesher *m, const struct pov_term *t)
{
	double least, most;
	if (t->kind != TERM_LEAF || t->shape->kind != POV_SPHERE)
		return false;
	pov_place_stretch(&t->place, &least, &most);
	if (most - least > 1e-6 * most)
		return false;
	const struct pov_sphere *s = &t->shape->shape.sphere;
	scene_add_sphere(m->scene, matrix_point(s->center, &t->place), s->radius * cbrt(fabs(pov_place_determinant(&t->place))));
	set_material(m->scene, t->material);
	m->tally->spheres++;
	return true;
}

static int add_surface(struct mesher *m, struct pov_term *t, void *context)
{
	struct pov_facets list = { .most = m->options->most_triangles - m->tally->triangles };
	struct arena scratch = { 0 };
	size_t before = m->surface.unbounded;
	(void)context;
	if (t->kind == TERM_EMPTY || add_sphere(m, t))
		return 0;
	bool plane = t->kind == TERM_LEAF && !box_is_finite(&t->extent);
	m->surface.scratch = &scratch;
	if (!plane || m->options->planes)
		pov_surface(&m->surface, t, false, &list);
	m->tally->planes += plane && !m->options->planes ? 1 : m->surface.unbounded - before;
	arena_free(&scratch);
	for (size_t i = 0; i < list.count; i++) {
		scene_add_polygon(m->scene, list.all[i].v, 3);
		set_material(m->scene, list.all[i].material);
	}
	m->tally->triangles += list.count;
	int status = list.lost ? err_memory(m->err, "triangles") : 0;
	if (list.full)
		status = err_at(m->err, STATUS_INPUT, NULL, 0, "more than %zu triangles, the budget", m->options->most_triangles);
	pov_facets_free(&list);
	return status;
}

static void count_cuts(const struct pov_term *t, struct pov_tally *tally)
{
	tally->approximated += t->cut;
	for (const struct pov_term *c = t->child; c; c = c->next)
		count_cuts(c, tally);
}

/* Small shapes get three quarters of the segments of large ones, and fewer where there are thousands of them. */
static double least_part(size_t shapes)
{
	double part = shapes > 2000 ? sqrt(2000 / (double)shapes) : 1;
	return 0.75 * fmax(part, 1 / 3.0);
}

int pov_mesh(struct scene *scene, struct pov_solid *const *solids, size_t count, const struct pov_mesh_options *options,
             struct pov_tally *tally, struct err *e)
{
	struct arena mem = { 0 };
	struct mesher m = { .scene = scene, .options = options, .tally = tally, .err = e, .terms = NEW(&mem, struct pov_term *, count),
		            .surface = { .n = options->resolution, .eye = options->eye_given ? &options->eye : NULL } };
	struct box rest;
	int status = m.terms ? 0 : err_memory(e, "solids");
	*tally = (struct pov_tally){ 0 };
	for (; status == 0 && m.count < count; m.count++)
		if (!(m.terms[m.count] = pov_term_resolve(&mem, solids[m.count], options, tally)))
			status = err_memory(e, "solids");
	if (status == 0)
		status = find_rest(&m, &rest);
	if (status == 0) {
		set_region(&m, rest);
		m.surface.least = least_part(tally->objects);
		status = for_all(&m, add_surface, NULL);
	}
	for (size_t i = 0; status == 0 && i < m.count; i++)
		count_cuts(m.terms[i], tally);
	arena_free(&mem);
	return status == 0 ? scene_complete(scene, "scene", e) : status;
}
