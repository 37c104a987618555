/* Looks: pigments, finishes, textures and their like are passed over by their braces, with directives and macros run; on the way
 * the first colour and the numbers of the finish are kept. */
#include "io/pov_reader.h"

#include <string.h>

bool pov_is_look(uint32_t word)
{
	return (word >= WORD_texture && word <= WORD_warp) || word == WORD_fog || word == WORD_rainbow || word == WORD_sky_sphere;
}

void pov_look_add(struct pov_look *look, const struct pov_look *from)
{
	unsigned added = from->given & ~look->given;
	if (added)
		look->material = NO_MATERIAL;
	if (added & LOOK_COLOR)
		memcpy(look->color, from->color, sizeof look->color);
	look->ambient = added & LOOK_AMBIENT ? from->ambient : look->ambient;
	look->diffuse = added & LOOK_DIFFUSE ? from->diffuse : look->diffuse;
	look->shine = added & LOOK_SHINE ? from->shine : look->shine;
	look->reflection = added & LOOK_REFLECTION ? from->reflection : look->reflection;
	look->ior = added & LOOK_IOR ? from->ior : look->ior;
	if (look->given == 0)
		look->material = from->material;
	look->given |= added;
}

/* An expression that may fail; false: it did, or is no number. */
static bool try_value(struct pov *p, struct pov_value *v)
{
	bool relations = p->relations, doubt = p->doubt;
	p->quiet++;
	p->doubt = p->relations = false;
	const struct pov_token *t = pov_peek(p);
	*v = t->kind == TOKEN_NAME && pov_is_color_word(t->name) ? pov_color(p) : pov_operand(p);
	bool good = !pov_stopped(p) && v->type == TYPE_NUMBER;
	p->quiet--;
	p->doubt = doubt;
	p->relations = relations;
	p->pending = (struct pov_value){ 0 };
	return good;
}

static double grey(const struct pov_value *v)
{
	return v->count < 3 ? v->a[0] : 0.297 * v->a[0] + 0.589 * v->a[1] + 0.114 * v->a[2];
}

/* A number of a finish, the first one given. reflection { 0.1, 0.9 } too. */
static void read_number(struct pov *p, struct pov_look *own, unsigned field, double *to, bool inverse)
{
	struct pov_value v;
	pov_accept_word(p, WORD_albedo);
	if (pov_peek(p)->kind == '{')
		pov_take(p);
	if (!try_value(p, &v) || own->given & field)
		return;
	*to = inverse ? 1 / (grey(&v) > 1e-6 ? grey(&v) : 1e-6) : grey(&v);
	own->given |= field;
}

/* Words of finish and interior; false: it is none. */
static bool read_finish(struct pov *p, uint32_t word, struct pov_look *own)
{
	switch (word) {
	case WORD_ambient: read_number(p, own, LOOK_AMBIENT, &own->ambient, false); return true;
	case WORD_diffuse: read_number(p, own, LOOK_DIFFUSE, &own->diffuse, false); return true;
	case WORD_phong_size: read_number(p, own, LOOK_SHINE, &own->shine, false); return true;
	case WORD_roughness: read_number(p, own, LOOK_SHINE, &own->shine, true); return true;
	case WORD_ior: read_number(p, own, LOOK_IOR, &own->ior, false); return true;
	default: return false;
	}
}

static void keep_color(struct pov_look *own, const struct pov_value *v)
{
	if (own->given & LOOK_COLOR)
		return;
	for (int i = 0; i < 5; i++)
		own->color[i] = v->count == 1 && i > 2 ? 0 : value_component(v, i);
	own->given |= LOOK_COLOR;
}

/* Whether numbers of a colour may stand in such a block. */
static bool holds_color(uint32_t word)
{
	return word == WORD_texture || word == WORD_pigment || word == WORD_color_map || word == WORD_colour_map || word == WORD_pigment_map ||
	       word == WORD_texture_map || word == WORD_material || word == WORD_image_map;
}

static void read_block(struct pov *p, uint32_t word, struct pov_look *own, struct pov_look *named);

static void read_name(struct pov *p, const struct pov_token *t, uint32_t word, struct pov_look *own, struct pov_look *named)
{
	const struct pov_binding *b = scope_find(&p->scope, t->name);
	if (!b)
		return;
	const struct pov_value *v = b->refers;
	if (v->type == TYPE_LOOK)
		pov_look_add(named, v->look);
	else if (v->type == TYPE_NUMBER && v->count >= 3 && holds_color(word))
		keep_color(own, v);
}

/* reflection 0.3, or reflection { 0.1, 0.9 fresnel }: the first number. */
static void read_reflection(struct pov *p, struct pov_look *own)
{
	bool block = pov_peek(p)->kind == '{';
	read_number(p, own, LOOK_REFLECTION, &own->reflection, false);
	for (int depth = block; depth > 0;) {
		const struct pov_token *t = pov_take(p);
		depth = t->kind == TOKEN_END ? 0 : depth + (t->kind == '{') - (t->kind == '}');
	}
}

/* One word in a block that was opened by 'word'; t: peeked. */
static void read_word(struct pov *p, const struct pov_token *t, uint32_t word, struct pov_look *own, struct pov_look *named)
{
	bool finish = word == WORD_finish || word == WORD_texture || word == WORD_interior || word == WORD_material;
	struct pov_value v;
	if (pov_is_color_word(t->name) && holds_color(word)) {
		if (try_value(p, &v))
			keep_color(own, &v);
		return;
	}
	pov_take(p);
	if (t->name >= WORD_COUNT) {
		read_name(p, t, word, own, named);
	} else if (pov_is_look(t->name) && pov_peek_operator(p)->kind == '{') {
		bool map = holds_color(t->name) && t->name != WORD_texture && t->name != WORD_pigment && t->name != WORD_material;
		read_block(p, map && !holds_color(word) ? WORD_NONE : t->name, own, named);
	} else if (finish && t->name == WORD_reflection) {
		read_reflection(p, own);
	} else if (finish) {
		read_finish(p, t->name, own);
	}
}

static void read_block(struct pov *p, uint32_t word, struct pov_look *own, struct pov_look *named)
{
	if (!pov_expect(p, '{') || !pov_enter(p))
		return;
	while (!p->failed) {
		const struct pov_token *t = pov_peek(p);
		if (t->kind == TOKEN_NAME) {
			read_word(p, t, word, own, named);
		} else if (t->kind == '{') {
			read_block(p, WORD_NONE, own, named);
		} else if (t->kind == TOKEN_END) {
			int quiet = p->quiet;
			p->quiet = 0;
			pov_unexpected(p, t, "'}'");
			p->quiet = quiet;
		} else if (pov_take(p)->kind == '}') {
			break;
		}
	}
	p->nested--;
}

void pov_look_read(struct pov *p, uint32_t word, struct pov_look *look)
{
	struct pov_look own = { .material = NO_MATERIAL }, named = { .material = NO_MATERIAL };
	bool relations = p->relations;
	p->relations = false;
	if (pov_peek(p)->kind == '{')
		read_block(p, word, &own, &named);
	else if (pov_peek(p)->kind == TOKEN_NAME && pov_peek(p)->name >= WORD_COUNT)
		read_name(p, pov_take(p), word, &own, &named);
	p->relations = relations;
	pov_look_add(&own, &named);
	pov_look_add(look, &own);
}

void pov_skip_block(struct pov *p)
{
	struct pov_look none = { 0 };
	read_block(p, WORD_NONE, &none, &none);
}

uint32_t pov_material(struct pov *p, struct pov_look *look)
{
	struct pov_look all = *look;
	if (!look->given)
		return NO_MATERIAL;
	if (look->material != NO_MATERIAL)
		return look->material;
	pov_look_add(&all, &p->look);
	double *c = all.color, clear = c[3] > c[4] ? c[3] : c[4];
	struct material m = { .color = { c[0], c[1], c[2] }, .kd = all.diffuse, .ks = all.given & LOOK_REFLECTION ? all.reflection : 0,
		              .shine = all.given & LOOK_SHINE ? all.shine : 40,
		              .transmit = clear > 0 ? (clear < 1 ? clear : 1) : 0, .ior = all.given & LOOK_IOR ? all.ior : 1 };
	/* The same look comes again and again, mostly soon. */
	size_t count = p->scene->material_count;
	for (size_t i = count; i > 0 && count - i < 64; i--)
		if (memcmp(&p->scene->materials[i - 1], &m, sizeof m) == 0)
			return look->material = (uint32_t)(i - 1);
	scene_add_material(p->scene, m);
	look->material = (uint32_t)(p->scene->material_count - 1);
	return look->material;
}
