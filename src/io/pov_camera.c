/* The camera. */
#include "io/pov_reader.h"

#include <stdio.h>

static const double degree = 3.14159265358979323846 / 180;

static bool is_other_camera(uint32_t word)
{
	return (word >= WORD_fisheye && word <= WORD_mesh_camera) || word == WORD_cylinder;
}

static void set_kind(struct pov *p, struct pov_view *v, uint32_t word)
{
	v->orthographic = word == WORD_orthographic;
	if (!is_other_camera(word))
		return;
	if (word == WORD_cylinder)
		pov_float(p);
	if (word == WORD_mesh_camera && pov_peek(p)->kind == '{')
		pov_skip_block(p);
	snprintf(p->summary->camera, sizeof p->summary->camera, "%s", p->names.text[word]);
}

static void read_angle(struct pov *p, struct pov_view *v)
{
	v->angle = pov_float(p);
	v->angle_given = true;
	if (pov_accept(p, ','))
		pov_float(p);
}

/* One word of a camera; false: it is none. */
static bool read_word(struct pov *p, struct pov_view *v, uint32_t word)
{
	switch (word) {
	case WORD_location: v->location = pov_vector(p); break;
	case WORD_direction: v->direction = pov_vector(p); break;
	case WORD_right: v->right = pov_vector(p); v->window_given = true; break;
	case WORD_up: v->up = pov_vector(p); v->window_given = true; break;
	case WORD_sky: v->sky = pov_vector(p); break;
	case WORD_look_at: v->look_at = pov_vector(p); v->look_at_given = true; break;
	case WORD_angle: read_angle(p, v); break;
	case WORD_focal_point: pov_vector(p); break;
	case WORD_aperture: case WORD_blur_samples: case WORD_variance: case WORD_confidence:
		pov_float(p);
		if (pov_accept(p, ','))
			pov_float(p);
		break;
	case WORD_normal: pov_skip_block(p); break;
	default:
		if (word != WORD_perspective && word != WORD_orthographic && !is_other_camera(word))
			return false;
		set_kind(p, v, word);
	}
	return true;
}

struct pov_view pov_camera_read(struct pov *p)
{
	struct pov_view v = { .location = vec(0, 0, 0), .direction = vec(0, 0, 1), .right = vec(1.33, 0, 0), .up = vec(0, 1, 0),
		              .sky = vec(0, 1, 0), .look_at = vec(0, 0, 1), .place = matrix_identity() };
	bool relations = p->relations;
	p->relations = false;
	pov_expect(p, '{');
	for (;;) {
		pov_skip_separators(p);
		const struct pov_token *t = pov_peek(p);
		const struct pov_binding *b = t->kind == TOKEN_NAME && t->name >= WORD_COUNT ? scope_find(&p->scope, t->name) : NULL;
		if (t->kind == '}' || pov_stopped(p))
			break;
		if (pov_is_transform(p, t)) {
			struct matrix m = pov_transform(p);
			v.place = matrix_multiply(&v.place, &m);
			continue;
		}
		pov_take(p);
		if (b && b->refers->type == TYPE_CAMERA)
			v = *b->refers->view;
		else if (t->kind != TOKEN_NAME || !read_word(p, &v, t->name))
			pov_unexpected(p, t, "a word of a camera");
	}
	pov_expect(p, '}');
	p->relations = relations;
	return v;
}

/* Point the camera at look_at: the window keeps its size, and its handedness. */
static void aim(const struct pov_view *v, struct vec *direction, struct vec *right, struct vec *up)
{
	double hand = vec_dot(vec_cross(*up, *direction), *right);
	struct vec d = vec_unit(vec_sub(v->look_at, v->location)), r = vec_cross(v->sky, d);
	if (vec_length(d) == 0)
		return;
	r = vec_length(r) > 1e-9 * vec_length(v->sky) ? vec_unit(r) : vec(1, 0, 0);
	struct vec u = vec_cross(d, r);
	*direction = vec_scale(d, vec_length(*direction));
	*right = vec_scale(r, hand > 0 ? vec_length(*right) : -vec_length(*right));
	*up = vec_scale(u, vec_length(*up));
}

void pov_camera_set(struct pov *p, const struct pov_view *v)
{
	struct vec direction = v->direction, right = v->right, up = v->up;
	double angle = *p->summary->camera && !(v->angle > 0 && v->angle <= 120) ? 120 : v->angle;
	if (angle != 0) {
		double length = vec_length(right) / (2 * tan(angle / 2 * degree));
		direction = vec_scale(vec_unit(direction), length);
	}
	if (v->orthographic && (v->angle_given || !v->window_given) && vec_length(direction) > 0) {
		double size = vec_length(vec_sub(v->look_at, v->location)) / vec_length(direction);
		right = vec_scale(right, size);
		up = vec_scale(up, size);
	}
	if (v->look_at_given)
		aim(v, &direction, &right, &up);
	struct vec from = matrix_point(v->location, &v->place);
	direction = matrix_direction(direction, &v->place);
	right = matrix_direction(right, &v->place);
	up = matrix_direction(up, &v->place);
	double height = vec_length(up), depth = vec_length(direction);
	if (depth == 0 || height == 0 || vec_length(right) == 0 || !isfinite(depth + height + vec_length(right) + vec_length(from)))
		return;
	scene_set_view(p->scene, from, vec_add(from, direction), up, 2 * atan(height / (2 * depth)) / degree, 0, p->options->width,
	               p->options->height);
	struct view *view = &p->scene->view;
	view->window = true;
	view->parallel = v->orthographic;
	view->direction = direction;
	view->right = right;
	view->window_up = up;
}
