/* Lights. */
#include "io/pov_reader.h"

#include <string.h>

static bool takes_number(uint32_t word)
{
	return word == WORD_radius || word == WORD_falloff || word == WORD_tightness || word == WORD_adaptive || word == WORD_fade_distance ||
	       word == WORD_fade_power;
}

static bool takes_flag(uint32_t word)
{
	return word == WORD_spotlight || word == WORD_cylinder || word == WORD_parallel || word == WORD_jitter || word == WORD_circular ||
	       word == WORD_orient || word == WORD_shadowless || word == WORD_area_illumination || word == WORD_media_attenuation ||
	       word == WORD_media_interaction;
}

static void read_area(struct pov *p)
{
	for (int i = 0; i < 2; i++) {
		pov_vector(p);
		pov_accept(p, ',');
	}
	for (int i = 0; i < 2; i++) {
		pov_float(p);
		pov_accept(p, ',');
	}
}

/* The object a light looks like, moved to the light. */
static void read_appearance(struct pov *p, struct pov_object *o, struct vec at)
{
	pov_expect(p, '{');
	pov_skip_separators(p);
	struct pov_object *seen = pov_is_object(p, pov_peek(p)) ? pov_object(p) : NULL;
	struct matrix m = matrix_translation(at.x, at.y, at.z);
	pov_expect(p, '}');
	if (seen && seen->solid && !o->solid) {
		o->solid = seen->solid;
		pov_object_move(&(struct pov_object){ .solid = o->solid }, &m);
	}
}

static void skip_projection(struct pov *p)
{
	pov_expect(p, '{');
	if (pov_is_object(p, pov_peek(p)))
		pov_object(p);
	pov_expect(p, '}');
}

void pov_read_light(struct pov *p, struct pov_object *o)
{
	struct pov_lamp *lamp = pov_alloc(p, 1, sizeof *lamp);
	const struct pov_binding *b;
	if (!lamp)
		return;
	const struct pov_token *t = pov_peek(p);
	if (t->kind == TOKEN_NAME && (b = scope_find(&p->scope, t->name)) != NULL && b->refers->type == TYPE_OBJECT) {
		const struct pov_object *named = b->refers->object;
		pov_take(p);
		if (named->lamps)
			*lamp = *named->lamps;
		if (named->solid)
			o->solid = pov_solid_copy(&p->mem, named->solid);
	} else {
		lamp->at = pov_vector(p);
		lamp->color[0] = lamp->color[1] = lamp->color[2] = 0;
	}
	lamp->next = NULL;
	o->lamps = lamp;
	for (;;) {
		pov_skip_separators(p);
		t = pov_peek(p);
		uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
		if (t->kind == '}' || pov_stopped(p))
			return;
		if (pov_is_transform(p, t)) {
			struct matrix m = pov_transform(p);
			pov_object_move(o, &m);
			continue;
		}
		if (word == WORD_looks_like || word == WORD_projected_through || takes_number(word) || takes_flag(word) || word == WORD_area_light ||
		    word == WORD_point_at || word == WORD_fade_color || word == WORD_fade_colour || word == WORD_groups || word == WORD_photons ||
		    (word >= WORD_no_shadow && word <= WORD_no_radiosity))
			pov_take(p);
		if (word == WORD_looks_like)
			read_appearance(p, o, lamp->at);
		else if (word == WORD_projected_through)
			skip_projection(p);
		else if (word == WORD_photons)
			pov_skip_block(p);
		else if (takes_number(word))
			pov_float(p);
		else if (takes_flag(word) || (word >= WORD_no_shadow && word <= WORD_no_radiosity))
			pov_flag(p);
		else if (word == WORD_area_light)
			read_area(p);
		else if (word == WORD_point_at)
			pov_vector(p);
		else if (word == WORD_fade_color || word == WORD_fade_colour)
			pov_operand(p);
		else if (word == WORD_groups)
			pov_text(p);
		else {
			struct pov_value v = pov_expression(p);
			if (v.type != TYPE_NUMBER)
				pov_refuse(p, "%s in a light", value_type_name(v.type));
			for (int i = 0; i < 3; i++)
				lamp->color[i] = value_component(&v, i);
		}
	}
}
