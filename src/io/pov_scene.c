/* A scene from its first to its last statement. */
#include "io/pov_reader.h"

#include <stdlib.h>
#include <string.h>

static const char *const standard_directories[] = { "/usr/share/povray-3.7/include" };

struct pov_options pov_defaults(void)
{
	return (struct pov_options){ .directories = standard_directories, .directory_count = 1, .width = 800, .height = 600,
		                     .budget = { .tokens = 250000000, .rounds = 10000000, .objects = 10000000, .bytes = 4000000000u,
		                                 .depth = 200 },
		                     .mesh = pov_mesh_defaults() };
}

/* SPD's files for POV-Ray 1 tell the background by a first sphere around everything. */
static bool is_backdrop(const struct pov *p, const struct pov_solid *s, const struct scene *scene)
{
	if (p->solid_count > 0 || s->kind != POV_SPHERE || s->shape.sphere.radius != 9000 || s->material == NO_MATERIAL)
		return false;
	return vec_length(s->shape.sphere.center) == 0 && scene->materials[s->material].kd == 0;
}

static void add_object(struct pov *p, const struct pov_object *o)
{
	if (!o || p->failed)
		return;
	for (const struct pov_lamp *l = o->lamps; l; l = l->next)
		scene_add_colored_light(p->scene, l->at, (struct color){ l->color[0], l->color[1], l->color[2] });
	if (!o->solid)
		return;
	if (is_backdrop(p, o->solid, p->scene)) {
		struct color c = p->scene->materials[o->solid->material].color;
		scene_set_background(p->scene, c.r, c.g, c.b);
		return;
	}
	struct pov_solid **all = pov_grow(p, p->solids, p->solid_count, &p->solid_room, sizeof *all);
	if (!all)
		return;
	p->solids = all;
	all[p->solid_count++] = o->solid;
}

/* background { color } */
static void read_background(struct pov *p)
{
	pov_expect(p, '{');
	while (!pov_stopped(p) && pov_peek(p)->kind != '}') {
		struct pov_value v = pov_expression(p);
		if (v.type != TYPE_NUMBER)
			pov_refuse(p, "%s as a colour", value_type_name(v.type));
		else
			scene_set_background(p->scene, value_component(&v, 0), value_component(&v, 1), value_component(&v, 2));
		pov_accept(p, ',');
	}
	pov_expect(p, '}');
}

static void read_camera(struct pov *p)
{
	p->view = pov_camera_read(p);
	p->view_given = true;
}

static bool is_passed_over(uint32_t word)
{
	return word == WORD_global_settings || word == WORD_atmosphere || word == WORD_photons || word == WORD_radiosity || pov_is_look(word);
}

/* A statement this reader does not know, with its block. */
static void ignore(struct pov *p, const struct pov_token *t)
{
	const struct pov_token *next = pov_peek_operator(p);
	if (p->options->strict || next->kind != '{') {
		char text[128];
		pov_refuse(p, "%s where a statement should be", pov_token_text(p, t, text, sizeof text));
		return;
	}
	p->summary->ignored++;
	pov_note(p, "'%.60s' is not known", p->names.text[t->name]);
	pov_skip_block(p);
}

static void read_statement(struct pov *p, const struct pov_token *t)
{
	uint32_t word = t->kind == TOKEN_NAME ? t->name : 0;
	if (word && pov_is_object(p, t)) {
		add_object(p, pov_object(p));
	} else if (!word) {
		pov_unexpected(p, t, "a statement");
	} else {
		pov_take(p);
		if (word == WORD_camera)
			read_camera(p);
		else if (word == WORD_background)
			read_background(p);
		else if (word == WORD_default)
			pov_set_default(p);
		else if (is_passed_over(word))
			pov_skip_block(p);
		else if (word == WORD_max_trace_level || word == WORD_max_intersections)
			pov_float(p);
		else
			ignore(p, t);
	}
}

void pov_statements(struct pov *p)
{
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		if (t->kind == TOKEN_END || p->failed)
			return;
		read_statement(p, t);
	}
}

/* Meshing adds the objects under the materials they have; what has none gets the scene's default, the last one. */
static int mesh(struct pov *p)
{
	struct pov_mesh_options o = p->options->mesh;
	struct pov_look look = p->look;
	if (p->view_given) {
		pov_camera_set(p, &p->view);
		o.eye = p->scene->view.from;
		o.eye_given = p->scene->view.given;
	}
	look.material = NO_MATERIAL;
	uint32_t last = pov_material(p, &look);
	if (last + 1 != p->scene->material_count && p->scene->material_count > 0)
		scene_add_material(p->scene, p->scene->materials[last]);
	return pov_mesh(p->scene, p->solids, p->solid_count, &o, &p->summary->tally, p->err);
}

static void close_reader(struct pov *p)
{
	for (struct pov_file *f = p->files; f; f = f->next)
		free(f->tokens);
	for (struct pov_stream *s = p->streams; s; s = s->next) {
		free(s->file.tokens);
		text_free(&s->text);
	}
	arena_free(&p->mem);
}

/* The scene's own file as the first source. */
static int open_scene(struct pov *p, const char *name, const char *text, size_t n)
{
	const char *slash = strrchr(name, '/');
	struct pov_file *f = NEW(&p->mem, struct pov_file, 1);
	char *folder = arena_text(&p->mem, name, slash ? (size_t)(slash - name) + 1 : 0), *path = arena_text(&p->mem, name, strlen(name));
	p->scope.mem = &p->mem;
	if (!f || !folder || !path || pov_names_open(&p->names, &p->mem) != 0)
		return -1;
	f->name = path;
	f->folder = p->folder = folder;
	p->files = f;
	if (pov_lex(f, text, n, &p->names) != 0)
		return -1;
	p->tokens_cut = f->count;
	p->source = p->sources;
	*p->source = (struct pov_source){ .file = f, .at = f->tokens, .end = f->tokens + f->count };
	p->version = 3.7;
	p->look = (struct pov_look){ .given = LOOK_COLOR | LOOK_AMBIENT | LOOK_DIFFUSE, .ambient = 0.1, .diffuse = 0.6, .material = NO_MATERIAL };
	return 0;
}

int pov_read(struct scene *s, const char *name, const char *text, size_t n, const struct pov_options *o, struct pov_summary *summary,
             struct err *e)
{
	struct pov *p = calloc(1, sizeof *p);
	*summary = (struct pov_summary){ 0 };
	if (!p)
		return err_memory(e, name);
	*p = (struct pov){ .scene = s, .options = o, .summary = summary, .err = e };
	int status = open_scene(p, name, text, n) == 0 ? 0 : err_memory(e, name);
	if (status == 0) {
		pov_statements(p);
		status = p->failed ? -1 : mesh(p);
	}
	if (status == 0 && o->strict && summary->tally.skipped > 0)
		status = err_at(e, STATUS_INPUT, name, 0, "%zu objects cannot be meshed (%s first)", summary->tally.skipped,
		                summary->tally.reasons[0].reason);
	close_reader(p);
	free(p);
	return status == 0 ? scene_complete(s, name, e) : status;
}

void pov_summary_print(const struct pov_summary *s, struct text *out)
{
	const struct pov_tally *t = &s->tally;
	text_print(out, "pov: objects %zu, skipped %zu", t->objects, t->skipped);
	for (int i = 0; i < POV_REASONS && t->reasons[i].reason; i++)
		text_print(out, "%s%s %zu", i ? ", " : " (", t->reasons[i].reason, t->reasons[i].count);
	text_print(out, "%s, approximated %zu", t->reasons[0].reason ? ")" : "", t->approximated);
	if (t->planes)
		text_print(out, ", planes %zu", t->planes);
	if (t->domes)
		text_print(out, ", domes %zu", t->domes);
	if (s->unknown)
		text_print(out, ", unknown functions %zu", s->unknown);
	if (s->ignored)
		text_print(out, ", ignored words %zu", s->ignored);
	if (*s->camera)
		text_print(out, ", camera %s as perspective", s->camera);
	text_print(out, ", missing includes %zu, triangles %zu, spheres %zu", s->missing, t->triangles, t->spheres);
	if (*s->reason)
		text_print(out, " (first: %s)", s->reason);
}
