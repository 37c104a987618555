/* Built-in functions of variables, arrays and objects. '(' was taken, ')' is left. */
#include "io/pov_reader.h"

static const struct pov_array *next_array(struct pov *p)
{
	struct pov_value v = pov_expression(p);
	if (v.type == TYPE_ARRAY)
		return v.array;
	pov_refuse(p, "%s where an array should be", value_type_name(v.type));
	return NULL;
}

static struct pov_object *next_object(struct pov *p)
{
	struct pov_value v = pov_value_read(p);
	if (v.type == TYPE_OBJECT)
		return (struct pov_object *)v.object;
	pov_refuse(p, "%s where an object should be", value_type_name(v.type));
	return NULL;
}

static struct pov_value call_defined(struct pov *p)
{
	uint32_t name;
	const struct pov_token *t = pov_peek_operator(p);
	if (t->kind == TOKEN_NAME && t->name < WORD_COUNT) {
		pov_take(p);
		return value_number(1);
	}
	p->quiet++;
	const struct pov_value *v = pov_variable(p, &name);
	p->quiet--;
	p->doubt = p->doubt && p->quiet;
	return value_number(v && v->type != TYPE_NONE);
}

static struct pov_value call_trace(struct pov *p)
{
	struct pov_object *o = next_object(p);
	struct vec at = vec(0, 0, 0), normal = vec(0, 0, 0);
	uint32_t name = 0;
	pov_accept(p, ',');
	struct vec from = pov_vector(p);
	pov_accept(p, ',');
	struct vec toward = pov_vector(p);
	struct pov_value *variable = NULL;
	if (pov_accept(p, ','))
		variable = pov_variable(p, &name);
	if (pov_stopped(p) || !o)
		return value_number(0);
	if (!o->solid || vec_length(toward) == 0 || !pov_solid_trace(&p->mem, o->solid, from, toward, &at, &normal))
		at = normal = vec(0, 0, 0);
	struct pov_value v = value_vector(normal);
	if (variable)
		*variable = v;
	else if (name)
		pov_declare(p, name, &v);
	return value_vector(at);
}

static struct pov_value call_inside(struct pov *p)
{
	const struct pov_object *o = next_object(p);
	pov_accept(p, ',');
	struct vec at = pov_vector(p);
	return value_number(!pov_stopped(p) && o && o->solid && pov_solid_inside(o->solid, at));
}

static struct pov_value call_extent(struct pov *p, uint32_t word)
{
	const struct pov_object *o = next_object(p);
	if (pov_stopped(p) || !o || !o->solid)
		return value_vector(vec(0, 0, 0));
	struct box b = pov_solid_extent(o->solid);
	return value_vector(word == WORD_min_extent ? b.lo : b.hi);
}

struct pov_value pov_call_object(struct pov *p, uint32_t word)
{
	const struct pov_array *a;
	switch (word) {
	case WORD_defined: return call_defined(p);
	case WORD_trace: return call_trace(p);
	case WORD_inside: return call_inside(p);
	case WORD_min_extent: case WORD_max_extent: return call_extent(p, word);
	case WORD_dimensions: return (a = next_array(p)) ? value_number(a->dimensions) : value_number(0);
	default:
		a = next_array(p);
		pov_accept(p, ',');
		long k = pov_integer(p, "a dimension", 1, a ? a->dimensions : 1);
		return value_number(a && !pov_stopped(p) ? (double)a->size[k - 1] : 0);
	}
}
