/* Objects: what all have in common, combinations, and the table of shapes. */
#include "io/pov_reader.h"

#include <string.h>

/* read NULL: a combination. */
static const struct shape {
	uint32_t word;
	enum pov_kind kind;
	pov_shape_read *read;
} shapes[] = {
	{ WORD_sphere, POV_SPHERE, pov_read_sphere },
	{ WORD_box, POV_BOX, pov_read_box },
	{ WORD_cylinder, POV_CYLINDER, pov_read_cylinder },
	{ WORD_cone, POV_CONE, pov_read_cone },
	{ WORD_torus, POV_TORUS, pov_read_torus },
	{ WORD_plane, POV_PLANE, pov_read_plane },
	{ WORD_disc, POV_DISC, pov_read_disc },
	{ WORD_triangle, POV_MESH, pov_read_triangle },
	{ WORD_smooth_triangle, POV_MESH, pov_read_smooth_triangle },
	{ WORD_polygon, POV_POLYGON, pov_read_polygon },
	{ WORD_mesh, POV_MESH, pov_read_mesh },
	{ WORD_mesh2, POV_MESH, pov_read_mesh2 },
	{ WORD_prism, POV_PRISM, pov_read_prism },
	{ WORD_lathe, POV_LATHE, pov_read_lathe },
	{ WORD_sor, POV_SOR, pov_read_sor },
	{ WORD_sphere_sweep, POV_SPHERE_SWEEP, pov_read_sphere_sweep },
	{ WORD_superellipsoid, POV_SUPERELLIPSOID, pov_read_superellipsoid },
	{ WORD_blob, POV_BLOB, pov_read_blob },
	{ WORD_quadric, POV_QUADRIC, pov_read_quadric },
	{ WORD_poly, POV_POLY, pov_read_poly },
	{ WORD_cubic, POV_POLY, pov_read_cubic },
	{ WORD_quartic, POV_POLY, pov_read_quartic },
	{ WORD_height_field, POV_HEIGHT_FIELD, pov_read_height_field },
	{ WORD_bicubic_patch, POV_BICUBIC_PATCH, pov_read_bicubic },
	{ WORD_text, POV_TEXT, pov_read_text },
	{ WORD_isosurface, POV_ISOSURFACE, pov_read_isosurface },
	{ WORD_parametric, POV_PARAMETRIC, pov_read_parametric },
	{ WORD_julia_fractal, POV_UNKNOWN, pov_read_julia },
	{ WORD_ovus, POV_UNKNOWN, pov_read_ovus },
	{ WORD_union, POV_UNION, NULL },
	{ WORD_composite, POV_UNION, NULL },
	{ WORD_merge, POV_MERGE, NULL },
	{ WORD_intersection, POV_INTERSECTION, NULL },
	{ WORD_difference, POV_DIFFERENCE, NULL },
	{ WORD_light_group, POV_UNION, NULL },
};

static const struct shape *find_shape(uint32_t word)
{
	for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
		if (shapes[i].word == word)
			return &shapes[i];
	return NULL;
}

/* An identifier, or an element of an array of objects. */
static bool names_object(struct pov *p, const struct pov_token *t)
{
	const struct pov_binding *b = t->kind == TOKEN_NAME && t->name >= WORD_COUNT ? scope_find(&p->scope, t->name) : NULL;
	const struct pov_value *v = b ? b->refers : NULL;
	while (v && v->type == TYPE_ARRAY && v->array->count > 0)
		v = &v->array->all[0];
	return v && v->type == TYPE_OBJECT;
}

bool pov_is_object(struct pov *p, const struct pov_token *t)
{
	if (t->kind != TOKEN_NAME)
		return false;
	if (t->name >= WORD_COUNT)
		return names_object(p, t);
	return t->name == WORD_object || t->name == WORD_light_source || (t->name >= WORD_sphere && t->name <= WORD_light_group && find_shape(t->name));
}

void pov_make_unknown(struct pov_solid *s, const char *reason)
{
	s->kind = POV_UNKNOWN;
	memset(&s->shape, 0, sizeof s->shape);
	s->shape.unknown = reason;
}

static void move_list(struct pov_lamp *l, const struct matrix *m)
{
	for (; l; l = l->next)
		l->at = matrix_point(l->at, m);
}

void pov_object_move(struct pov_object *o, const struct matrix *m)
{
	if (o->solid)
		pov_solid_move(o->solid, m);
	move_list(o->lamps, m);
}

static struct pov_object *copy_object(struct pov *p, const struct pov_object *from)
{
	struct pov_object *o = pov_alloc(p, 1, sizeof *o);
	if (!o)
		return NULL;
	if (from->solid && !(o->solid = pov_solid_copy(&p->mem, from->solid)))
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
	struct pov_lamp **last = &o->lamps;
	for (const struct pov_lamp *l = from->lamps; l && !p->failed; l = l->next) {
		if ((*last = pov_alloc(p, 1, sizeof *l)) == NULL)
			break;
		**last = *l;
		(*last)->next = NULL;
		last = &(*last)->next;
	}
	return o;
}

static void add_lamps(struct pov_object *o, struct pov_lamp *lamps)
{
	struct pov_lamp **last = &o->lamps;
	while (*last)
		last = &(*last)->next;
	*last = lamps;
}

/* Objects in braces, added to a list of clips or bounds; 'word' stands for what the other list holds. */
static void read_limits(struct pov *p, struct pov_solid **list, const struct pov_solid *other, uint32_t word)
{
	struct pov_solid **last = list;
	while (*last)
		last = &(*last)->next;
	if (!pov_expect(p, '{'))
		return;
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		if (t->kind == '}' || pov_stopped(p))
			break;
		if (is_word(t, word)) {
			pov_take(p);
			for (const struct pov_solid *o = other; o && (*last = pov_solid_copy(&p->mem, o)) != NULL; o = o->next)
				last = &(*last)->next;
		} else if (pov_is_object(p, t)) {
			struct pov_object *o = pov_object(p);
			if (o && o->solid) {
				*last = o->solid;
				last = &(*last)->next;
			}
		} else if (is_word(t, WORD_no)) {
			pov_take(p);
		} else {
			pov_unexpected(p, t, "an object");
		}
	}
	pov_expect(p, '}');
}

static bool is_switch(uint32_t word)
{
	return (word >= WORD_no_shadow && word <= WORD_split_union) || word == WORD_uv_mapping || word == WORD_smooth || word == WORD_global_lights;
}

/* One modifier, peeked as t; false: it is none, and nothing was taken. */
static bool read_modifier(struct pov *p, const struct pov_token *t, struct pov_object *o, struct pov_look *look)
{
	struct pov_solid *s = o->solid;
	if (pov_is_transform(p, t)) {
		struct matrix m = pov_transform(p);
		pov_object_move(o, &m);
		return true;
	}
	if (t->kind != TOKEN_NAME)
		return false;
	if (t->name >= WORD_COUNT) {
		const struct pov_binding *b = scope_find(&p->scope, t->name);
		if (b && b->refers->type != TYPE_LOOK)
			return false;
		if (!b && p->options->strict)
			return false;
		/* An undeclared name here is taken for a texture's, unless it starts a block. */
		pov_take(p);
		if (b)
			pov_look_add(look, b->refers->look);
		else
			pov_note(p, "'%.60s' is not declared", p->names.text[t->name]);
		p->summary->ignored += !b;
		return true;
	}
	if (pov_is_look(t->name) || t->name == WORD_photons || t->name == WORD_radiosity) {
		pov_take(p);
		pov_look_read(p, t->name, look);
	} else if (pov_is_color_word(t->name)) {
		struct pov_value v = pov_color(p);
		struct pov_look own = { .given = LOOK_COLOR, .material = NO_MATERIAL };
		memcpy(own.color, v.a, sizeof own.color);
		pov_look_add(look, &own);
	} else if (t->name == WORD_clipped_by || t->name == WORD_bounded_by) {
		struct pov_solid *none = NULL;
		bool clip = t->name == WORD_clipped_by;
		pov_take(p);
		struct pov_solid **list = !s ? &none : clip ? &s->clip : &s->bound;
		read_limits(p, list, !s ? NULL : clip ? s->bound : s->clip, clip ? WORD_bounded_by : WORD_clipped_by);
	} else if (t->name == WORD_inverse) {
		pov_take(p);
		if (s)
			s->inverse = !s->inverse;
	} else if (t->name == WORD_open) {
		pov_take(p);
		if (pov_flag(p) && s)
			s->open = true;
	} else if (is_switch(t->name)) {
		pov_take(p);
		pov_flag(p);
	} else {
		return false;
	}
	return true;
}

static void seal(struct pov *p, struct pov_solid *s)
{
	struct err e = { 0 };
	if (p->failed || pov_solid_seal(&p->mem, s, &e) == 0)
		return;
	if (p->quiet) {
		p->doubt = true;
		return;
	}
	/* Its text has the place already. */
	pov_stop(p, e.code, "%s", "");
	*p->err = e;
}

static void add_child(struct pov *p, struct pov_object *o, struct pov_solid ***last, struct pov_object *child)
{
	if (!child || p->failed)
		return;
	add_lamps(o, child->lamps);
	if (!child->solid)
		return;
	**last = child->solid;
	*last = &child->solid->next;
}

/* Modifiers and, of combinations, children, to the closing brace. */
static void read_body(struct pov *p, struct pov_object *o, bool combines, struct pov_look *look)
{
	struct pov_solid **last = combines && o->solid ? &o->solid->child : NULL;
	while (last && *last)
		last = &(*last)->next;
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		if (t->kind == '}' || pov_stopped(p))
			break;
		if (last && pov_is_object(p, t)) {
			add_child(p, o, &last, pov_object(p));
		} else if (!read_modifier(p, t, o, look)) {
			pov_unexpected(p, t, combines ? "an object or a modifier" : "a modifier");
			break;
		}
	}
	pov_expect(p, '}');
}

static void count_object(struct pov *p)
{
	if (++p->objects > p->options->budget.objects)
		pov_stop(p, STATUS_INPUT, "more objects than the budget of %zu", p->options->budget.objects);
}

/* object { what modifiers }, or a name alone. */
static struct pov_object *read_reference(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	if (v.type == TYPE_OBJECT)
		return copy_object(p, v.object);
	pov_refuse(p, "%s where an object should be", value_type_name(v.type));
	return NULL;
}

static struct pov_solid *make_solid(struct pov *p, enum pov_kind kind, const struct pov_token *t)
{
	struct pov_solid *s = p->failed ? NULL : pov_solid_new(&p->mem, kind);
	if (!s) {
		pov_stop(p, STATUS_ENVIRONMENT, "out of memory");
		return NULL;
	}
	s->file = p->source->file->name;
	s->line = t->line;
	return s;
}

/* The object that a block starts with: parameters of the shape, an identifier, or nothing for combinations. */
static struct pov_object *read_start(struct pov *p, const struct pov_token *t, const struct shape *shape)
{
	if (t->name == WORD_object)
		return pov_is_object(p, pov_peek(p)) ? pov_object(p) : read_reference(p);
	if (shape && shape->read && names_object(p, pov_peek(p)))
		return read_reference(p);
	struct pov_object *o = pov_alloc(p, 1, sizeof *o);
	if (!o || !shape)
		return o;
	o->solid = make_solid(p, shape->kind, t);
	if (shape->read && o->solid) {
		shape->read(p, o->solid);
		if (!pov_stopped(p))
			seal(p, o->solid);
	}
	return o;
}

static void give_material(struct pov *p, struct pov_object *o, struct pov_look *look)
{
	if (o->solid && look->given)
		o->solid->material = pov_material(p, look);
}

static struct pov_object *read_block(struct pov *p, const struct pov_token *t)
{
	const struct shape *shape = find_shape(t->name);
	struct pov_look look = { .material = NO_MATERIAL };
	struct pov_object *o = NULL;
	pov_expect(p, '{');
	if (t->name == WORD_light_source) {
		if ((o = pov_alloc(p, 1, sizeof *o)) != NULL)
			pov_read_light(p, o);
		pov_expect(p, '}');
		return o;
	}
	/* An empty object { } has no surface. */
	if (t->name == WORD_object && pov_peek(p)->kind == '}')
		o = pov_alloc(p, 1, sizeof *o);
	else
		o = read_start(p, t, shape);
	if (!o || pov_stopped(p))
		return o;
	read_body(p, o, shape && !shape->read, &look);
	give_material(p, o, &look);
	if (shape && !shape->read && o->solid && !pov_stopped(p))
		seal(p, o->solid);
	return o;
}

struct pov_object *pov_object(struct pov *p)
{
	const struct pov_token *t = pov_peek(p);
	bool relations = p->relations, blanks = p->blanks;
	struct pov_object *o = NULL;
	count_object(p);
	if (!pov_enter(p))
		return NULL;
	p->relations = p->blanks = false;
	if (t->name >= WORD_COUNT) {
		o = read_reference(p);
	} else {
		pov_take(p);
		o = read_block(p, t);
	}
	p->relations = relations;
	p->blanks = blanks;
	p->nested--;
	return o;
}
