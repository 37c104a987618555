/* Parameters of triangles, meshes and polygons. */
#include "io/pov_reader.h"

#include <string.h>

/* A triangle mesh that grows. */
struct mesh {
	struct vec *points;
	uint32_t *corners, *materials;
	size_t count, point_room, corner_room, material_room;
	bool has_materials;
};

struct vec *pov_points(struct pov *p, size_t count, int dimensions)
{
	struct vec *all = NULL;
	size_t room = 0;
	for (size_t i = 0; i < count; i++) {
		if ((all = pov_grow(p, all, i, &room, sizeof *all)) == NULL)
			return NULL;
		all[i] = vec(0, 0, 0);
		if (dimensions == 2)
			pov_vector2(p, &all[i].x, &all[i].y);
		else
			all[i] = pov_vector(p);
		if (pov_stopped(p))
			return NULL;
		pov_accept(p, ',');
		if (i + 1 < count && pov_peek(p)->kind == ',')
			pov_skip_separators(p);
	}
	return all ? all : pov_alloc(p, 1, sizeof *all);
}

static void read_corners(struct pov *p, struct vec *points, bool smooth)
{
	for (int i = 0; i < 3; i++) {
		points[i] = pov_vector(p);
		pov_accept(p, ',');
		if (smooth) {
			pov_vector(p);
			pov_accept(p, ',');
		}
	}
}

static void read_one(struct pov *p, struct pov_solid *s, bool smooth)
{
	struct vec *points = pov_alloc(p, 3, sizeof *points);
	uint32_t *corners = pov_alloc(p, 3, sizeof *corners);
	if (!points || !corners)
		return;
	read_corners(p, points, smooth);
	for (uint32_t i = 0; i < 3; i++)
		corners[i] = i;
	s->shape.mesh = (struct pov_triangles){ .points = points, .point_count = 3, .corners = corners, .count = 1 };
}

void pov_read_triangle(struct pov *p, struct pov_solid *s)
{
	read_one(p, s, false);
}

void pov_read_smooth_triangle(struct pov *p, struct pov_solid *s)
{
	read_one(p, s, true);
}

static bool grow_mesh(struct pov *p, struct mesh *m)
{
	m->points = pov_grow(p, m->points, 3 * m->count + 2, &m->point_room, sizeof *m->points);
	m->corners = pov_grow(p, m->corners, 3 * m->count + 2, &m->corner_room, sizeof *m->corners);
	m->materials = pov_grow(p, m->materials, m->count, &m->material_room, sizeof *m->materials);
	return m->points && m->corners && m->materials;
}

/* What may stand behind the corners of a triangle in a mesh: its texture, positions in it. */
static uint32_t read_triangle_look(struct pov *p)
{
	struct pov_look look = { .material = NO_MATERIAL };
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (t->kind == '}' || pov_stopped(p))
			break;
		pov_take(p);
		if (word == WORD_uv_vectors) {
			for (int i = 0; i < 3; i++) {
				pov_vector(p);
				pov_accept(p, ',');
			}
		} else if (word == WORD_texture_list) {
			pov_look_read(p, WORD_texture, &look);
		} else if (pov_is_look(word)) {
			pov_look_read(p, word, &look);
		} else {
			pov_unexpected(p, t, "'}'");
		}
	}
	return pov_material(p, &look);
}

void pov_read_mesh(struct pov *p, struct pov_solid *s)
{
	struct mesh m = { 0 };
	struct vec inside = vec(0, 0, 0);
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		if (is_word(t, WORD_inside_vector)) {
			pov_take(p);
			inside = pov_vector(p);
			continue;
		}
		if ((!is_word(t, WORD_triangle) && !is_word(t, WORD_smooth_triangle)) || pov_stopped(p))
			break;
		pov_take(p);
		pov_expect(p, '{');
		if (!grow_mesh(p, &m))
			return;
		read_corners(p, &m.points[3 * m.count], t->name == WORD_smooth_triangle);
		for (size_t i = 3 * m.count; i < 3 * m.count + 3; i++)
			m.corners[i] = (uint32_t)i;
		m.materials[m.count] = read_triangle_look(p);
		m.has_materials |= m.materials[m.count] != NO_MATERIAL;
		m.count++;
		pov_expect(p, '}');
		if (3 * m.count > UINT32_MAX - 3)
			pov_stop(p, STATUS_INPUT, "a mesh of more than %u triangles", UINT32_MAX / 3);
	}
	s->shape.mesh = (struct pov_triangles){ .points = m.points, .point_count = 3 * m.count, .corners = m.corners, .count = m.count,
		                                .materials = m.has_materials ? m.materials : NULL, .inside = inside };
}

static struct vec *read_list(struct pov *p, size_t *count)
{
	pov_expect(p, '{');
	*count = pov_count(p, "the count of a list");
	pov_accept(p, ',');
	struct vec *all = pov_points(p, *count, 3);
	pov_skip_separators(p);
	pov_expect(p, '}');
	return all;
}

static uint32_t *read_texture_list(struct pov *p, size_t *count)
{
	uint32_t *all = NULL;
	size_t room = 0, n = 0;
	pov_expect(p, '{');
	if (pov_peek(p)->kind == TOKEN_NUMBER)
		pov_count(p, "the count of a list");
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		struct pov_look look = { .material = NO_MATERIAL };
		if (t->kind != TOKEN_NAME || pov_stopped(p))
			break;
		pov_take(p);
		if (pov_is_look(t->name))
			pov_look_read(p, t->name, &look);
		else if (t->name >= WORD_COUNT && scope_find(&p->scope, t->name) && scope_find(&p->scope, t->name)->refers->type == TYPE_LOOK)
			pov_look_add(&look, scope_find(&p->scope, t->name)->refers->look);
		if ((all = pov_grow(p, all, n, &room, sizeof *all)) == NULL)
			return NULL;
		all[n++] = pov_material(p, &look);
	}
	pov_expect(p, '}');
	*count = n;
	return all;
}

/* Three plain indices <a, b, c> straight from the tokens, as most faces are written. */
static bool read_plain_face(struct pov *p, uint32_t *corner)
{
	struct pov_source *s = p->source;
	const struct pov_token *t = s->at;
	static const int kinds[] = { '<', TOKEN_NUMBER, ',', TOKEN_NUMBER, ',', TOKEN_NUMBER, '>' };
	if (s->end - t < 9)
		return false;
	for (int i = 0; i < 7; i++)
		if (t[i].kind != kinds[i])
			return false;
	for (int i = 0; i < 3; i++) {
		double x = t[1 + 2 * i].number;
		if (!(x < (double)UINT32_MAX))
			return false;
		corner[i] = (uint32_t)x;
	}
	if (t[7].kind != ',' && t[7].kind != '<' && t[7].kind != '}')
		return false;
	s->at += 7;
	p->tokens_taken += 7;
	return true;
}

static void read_face(struct pov *p, uint32_t *corner)
{
	if (read_plain_face(p, corner))
		return;
	struct vec v = pov_vector(p);
	for (int i = 0; i < 3; i++) {
		if (!(v.a[i] >= 0 && v.a[i] < (double)UINT32_MAX)) {
			pov_refuse(p, "no index of a point: %g", v.a[i]);
			return;
		}
		corner[i] = (uint32_t)v.a[i];
	}
}

/* Faces, each with up to three numbers of textures where there are some. */
static void read_faces(struct pov *p, struct mesh *m, const uint32_t *textures, size_t texture_count)
{
	pov_expect(p, '{');
	size_t count = pov_count(p, "the count of a list");
	pov_accept(p, ',');
	for (m->count = 0; m->count < count && !pov_stopped(p); m->count++) {
		m->corners = pov_grow(p, m->corners, 3 * m->count + 2, &m->corner_room, sizeof *m->corners);
		m->materials = pov_grow(p, m->materials, m->count, &m->material_room, sizeof *m->materials);
		if (!m->corners || !m->materials)
			return;
		read_face(p, &m->corners[3 * m->count]);
		m->materials[m->count] = NO_MATERIAL;
		pov_accept(p, ',');
		for (int i = 0; texture_count > 0 && i < 3 && !pov_stopped(p); i++) {
			const struct pov_token *t = pov_peek(p);
			if (t->kind == '<' || t->kind == '}')
				break;
			double k = pov_float(p);
			if (i == 0 && k >= 0 && k < (double)texture_count)
				m->materials[m->count] = textures[(size_t)k];
			pov_accept(p, ',');
		}
	}
	pov_skip_separators(p);
	pov_expect(p, '}');
	m->has_materials = texture_count > 0;
}

void pov_read_mesh2(struct pov *p, struct pov_solid *s)
{
	struct mesh m = { 0 };
	uint32_t *textures = NULL;
	size_t points = 0, texture_count = 0, ignored;
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (!(word >= WORD_vertex_vectors && word <= WORD_inside_vector) || pov_stopped(p))
			break;
		pov_take(p);
		if (word == WORD_vertex_vectors)
			m.points = read_list(p, &points);
		else if (word == WORD_face_indices)
			read_faces(p, &m, textures, texture_count);
		else if (word == WORD_texture_list)
			textures = read_texture_list(p, &texture_count);
		else if (word == WORD_inside_vector)
			s->shape.mesh.inside = pov_vector(p);
		else if (word == WORD_normal_vectors)
			read_list(p, &ignored);
		else
			pov_skip_block(p);
	}
	struct pov_triangles *mesh = &s->shape.mesh;
	*mesh = (struct pov_triangles){ .points = m.points, .point_count = points, .corners = m.corners, .count = m.count,
		                        .materials = m.has_materials ? m.materials : NULL, .inside = mesh->inside };
}

void pov_read_polygon(struct pov *p, struct pov_solid *s)
{
	size_t count = pov_count(p, "the points of a polygon");
	pov_accept(p, ',');
	s->shape.polygon.points = pov_points(p, count, 3);
	s->shape.polygon.count = count;
}
