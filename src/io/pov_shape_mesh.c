/* triangle, mesh, mesh2. With an inside_vector a mesh is a solid: a point is inside where the ray along it crosses an odd number of
 * triangles. */
#include "io/pov_shape.h"
#include "io/pov_tree.h"

struct sealed {
	struct box box;
	struct pov_tree tree; /* empty without inside_vector */
};

static void corners(const struct pov_triangles *m, size_t i, struct vec *v)
{
	for (int k = 0; k < 3; k++)
		v[k] = m->points[m->corners[3 * i + (size_t)k]];
}

static int build_tree(struct arena *a, const struct pov_triangles *m, struct sealed *sealed)
{
	struct arena scratch = { 0 };
	struct box *boxes = NEW(&scratch, struct box, m->count);
	int status = boxes ? 0 : -1;
	for (size_t i = 0; status == 0 && i < m->count; i++) {
		struct vec v[3];
		corners(m, i, v);
		boxes[i] = (struct box){ v[0], v[0] };
		box_extend(&boxes[i], v[1]);
		box_extend(&boxes[i], v[2]);
	}
	if (status == 0)
		status = pov_tree_build(&sealed->tree, a, boxes, (uint32_t)m->count);
	arena_free(&scratch);
	return status;
}

static int seal_mesh(struct arena *a, struct pov_solid *s, const char **why, struct err *e)
{
	const struct pov_triangles *m = &s->shape.mesh;
	struct sealed *sealed = NEW(a, struct sealed, 1);
	*why = "mesh without triangles";
	if (!sealed)
		return err_memory(e, "mesh");
	sealed->box = box_empty();
	for (size_t i = 0; i < 3 * m->count; i++) {
		if (m->corners[i] >= m->point_count)
			return err_at(e, STATUS_INPUT, s->file, s->line, "mesh: corner %u of %zu points", m->corners[i], m->point_count);
		box_extend(&sealed->box, m->points[m->corners[i]]);
	}
	s->sealed = sealed;
	if (vec_length(m->inside) > 0 && build_tree(a, m, sealed) != 0)
		return err_memory(e, "mesh");
	return m->count ? 0 : 1;
}

static struct box mesh_bounds(const struct pov_solid *s)
{
	return ((const struct sealed *)s->sealed)->box;
}

struct probe {
	const struct pov_triangles *mesh;
	struct vec from, toward;
	bool inside;
};

/* Whether the box meets the ray, by slabs. */
static bool enter(void *context, const struct box *b)
{
	const struct probe *q = context;
	double near = 0, far = INFINITY;
	for (int i = 0; i < 3; i++) {
		double s = (b->lo.a[i] - q->from.a[i]) / q->toward.a[i], t = (b->hi.a[i] - q->from.a[i]) / q->toward.a[i];
		if (q->toward.a[i] == 0) {
			if (q->from.a[i] < b->lo.a[i] || q->from.a[i] > b->hi.a[i])
				return false;
			continue;
		}
		near = fmax(near, fmin(s, t));
		far = fmin(far, fmax(s, t));
	}
	return near <= far * (1 + 1e-12);
}

/* Volumes of the tetrahedra of the ray and each edge: computed from the lower corner to the higher, so that neighbours agree and the
 * ray passes one of them and not both. */
static double side(const struct pov_triangles *m, const struct probe *q, uint32_t a, uint32_t b)
{
	bool swap = a > b;
	struct vec p = vec_sub(m->points[swap ? b : a], q->from), r = vec_sub(m->points[swap ? a : b], q->from);
	double v = vec_dot(q->toward, vec_cross(p, r));
	return swap ? -v : v;
}

static void test(void *context, uint32_t i)
{
	struct probe *q = context;
	const struct pov_triangles *m = q->mesh;
	const uint32_t *c = m->corners + 3 * (size_t)i;
	bool s = side(m, q, c[0], c[1]) > 0, t = side(m, q, c[1], c[2]) > 0, u = side(m, q, c[2], c[0]) > 0;
	if (s != t || t != u)
		return;
	struct vec v[3];
	corners(m, i, v);
	struct vec n = vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0]));
	double along = vec_dot(n, q->toward), to = vec_dot(n, vec_sub(v[0], q->from));
	if (along != 0 && to / along > 0)
		q->inside = !q->inside;
}

static double mesh_field(const struct pov_solid *s, struct vec p)
{
	struct probe q = { &s->shape.mesh, p, s->shape.mesh.inside, false };
	pov_tree_visit(&((const struct sealed *)s->sealed)->tree, enter, test, &q);
	return q.inside ? -1 : 1;
}

static void mesh_mesh(const struct pov_solid *s, const struct pov_drawing *d)
{
	const struct pov_triangles *m = &s->shape.mesh;
	struct pov_drawing own = *d;
	for (size_t i = 0; i < m->count; i++) {
		struct vec v[3];
		corners(m, i, v);
		own.material = !d->plain && m->materials && m->materials[i] != NO_MATERIAL ? m->materials[i] : d->material;
		pov_draw(&own, v[0], v[1], v[2]);
	}
}

const struct pov_shape pov_shape_mesh = {
	.name = "mesh", .seal = seal_mesh, .bounds = mesh_bounds, .field = mesh_field, .slope = INFINITY, .mesh = mesh_mesh,
};
