/* Transforms. */
#include "io/pov_reader.h"

static const double degree = 3.14159265358979323846 / 180;

struct matrix pov_rotation(struct vec degrees)
{
	struct matrix m = matrix_identity();
	for (int axis = 0; axis < 3; axis++) {
		if (degrees.a[axis] == 0)
			continue;
		struct matrix r = matrix_rotation(axis, degrees.a[axis] * degree);
		m = matrix_multiply(&m, &r);
	}
	return m;
}

bool pov_invert(const struct matrix *m, struct matrix *out)
{
	struct vec r[3], c[3], shift = vec(m->m[3][0], m->m[3][1], m->m[3][2]);
	for (int i = 0; i < 3; i++)
		r[i] = vec(m->m[i][0], m->m[i][1], m->m[i][2]);
	for (int i = 0; i < 3; i++)
		c[i] = vec_cross(r[(i + 1) % 3], r[(i + 2) % 3]);
	double det = vec_dot(r[0], c[0]);
	if (!(fabs(det) > 0) || !isfinite(det))
		return false;
	*out = matrix_identity();
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			out->m[j][i] = c[i].a[j] / det;
	shift = matrix_direction(shift, out);
	for (int j = 0; j < 3; j++)
		out->m[3][j] = -shift.a[j];
	return true;
}

/* Three plain numbers without brackets, as POV-Ray 1 has them. */
static bool read_plain(struct pov *p, struct vec *v)
{
	const struct pov_source *s = p->source;
	const struct pov_token *t = pov_peek(p);
	if (t != s->at || s != p->source)
		return false;
	for (int i = 0; i < 3; i++) {
		bool minus = t < s->end && t->kind == '-' && t->spaced && !t[1].spaced;
		t += minus;
		if (t >= s->end || t->kind != TOKEN_NUMBER)
			return false;
		v->a[i] = minus ? -t->number : t->number;
		t++;
	}
	p->source->at = t;
	return true;
}

static struct vec read_vector(struct pov *p)
{
	struct vec v;
	return read_plain(p, &v) ? v : pov_vector(p);
}

/* By 0 is by 1, as POV-Ray takes it. */
static struct matrix read_scale(struct pov *p)
{
	struct vec v = read_vector(p);
	for (int i = 0; i < 3; i++)
		v.a[i] = v.a[i] == 0 ? 1 : v.a[i];
	return matrix_scale(v.x, v.y, v.z);
}

static struct matrix read_matrix(struct pov *p)
{
	struct matrix m = matrix_identity();
	bool relations = p->relations;
	p->relations = false;
	pov_expect(p, '<');
	for (int i = 0; i < 12 && !pov_stopped(p); i++) {
		m.m[i / 3][i % 3] = pov_float(p);
		pov_accept(p, ',');
	}
	pov_expect(p, '>');
	p->relations = relations;
	return m;
}

static const struct matrix *find_transform(struct pov *p, const struct pov_token *t)
{
	const struct pov_binding *b = t->kind == TOKEN_NAME && t->name >= WORD_COUNT ? scope_find(&p->scope, t->name) : NULL;
	return b && b->refers->type == TYPE_TRANSFORM ? b->refers->matrix : NULL;
}

bool pov_is_transform(struct pov *p, const struct pov_token *t)
{
	if (t->kind != TOKEN_NAME)
		return false;
	return t->name == WORD_translate || t->name == WORD_scale || t->name == WORD_rotate || t->name == WORD_matrix ||
	       t->name == WORD_transform || find_transform(p, t);
}

struct matrix pov_transform(struct pov *p)
{
	const struct pov_token *t = pov_take(p);
	const struct matrix *named = find_transform(p, t);
	struct vec v;
	if (named)
		return *named;
	switch (t->name) {
	case WORD_translate: v = read_vector(p); return matrix_translation(v.x, v.y, v.z);
	case WORD_rotate: return pov_rotation(read_vector(p));
	case WORD_scale: return read_scale(p);
	case WORD_matrix: return read_matrix(p);
	default: return pov_transform_block(p);
	}
}

/* An identifier, or an element of an array, whose value is a transform. */
static struct matrix read_named(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	if (v.type == TYPE_TRANSFORM)
		return *v.matrix;
	pov_refuse(p, "%s where a transform should be", value_type_name(v.type));
	return matrix_identity();
}

struct matrix pov_transform_block(struct pov *p)
{
	struct matrix m = matrix_identity(), inverse;
	const struct pov_token *t = pov_peek(p);
	bool inverts = false;
	if (t->kind != '{')
		return read_named(p);
	pov_expect(p, '{');
	if (!pov_enter(p))
		return m;
	for (;;) {
		pov_skip_separators(p);
		t = pov_peek(p);
		struct matrix next;
		if (t->kind == '}' || pov_stopped(p))
			break;
		if (pov_is_transform(p, t)) {
			next = pov_transform(p);
		} else if (is_word(t, WORD_inverse)) {
			pov_take(p);
			inverts = true;
			continue;
		} else {
			next = read_named(p);
		}
		m = matrix_multiply(&m, &next);
	}
	pov_expect(p, '}');
	p->nested--;
	if (inverts && !pov_invert(&m, &inverse)) {
		pov_refuse(p, "a transform without an inverse");
		return m;
	}
	return inverts ? inverse : m;
}
