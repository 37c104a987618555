#include "trace/camera.h"

static const double degree = 3.14159265358979323846 / 180;

/* A view of the whole box. */
static struct view view_whole(const struct box *b)
{
	struct vec center = vec_scale(vec_add(b->lo, b->hi), 0.5), toward = vec_unit(vec(1, -2, 1));
	double radius = vec_length(vec_sub(b->hi, b->lo)) / 2, angle = 45;
	double distance = radius / sin(angle / 2 * degree);
	return (struct view){ .from = vec_add(center, vec_scale(toward, distance)), .at = center, .up = vec(0, 0, 1), .angle = angle };
}

/* A unit vector that is not along d. */
static struct vec pick_up(struct vec d)
{
	return fabs(d.z) < 0.9 * vec_length(d) ? vec(0, 0, 1) : vec(0, 1, 0);
}

static struct camera camera_window(const struct view *v)
{
	struct vec aside = vec_scale(vec_sub(v->window_up, v->right), 0.5), down = vec_scale(v->window_up, -1);
	if (v->parallel)
		return (struct camera){ .from = vec_add(v->from, aside), .right = v->right, .down = down, .toward = vec_unit(v->direction),
			                .parallel = true };
	return (struct camera){ .from = v->from, .corner = vec_add(v->direction, aside), .right = v->right, .down = down };
}

struct camera camera_make(const struct view *v, const struct box *bounds, double width, double height)
{
	struct view view = v->given ? *v : view_whole(bounds);
	if (view.window)
		return camera_window(&view);
	struct vec toward = vec_unit(vec_sub(view.at, view.from));
	if (vec_length(toward) == 0)
		toward = vec(0, 0, -1);
	struct vec right = vec_cross(toward, view.up);
	if (!(vec_length(right) > 1e-9 * vec_length(view.up)))
		right = vec_cross(toward, pick_up(toward));
	right = vec_unit(right);
	struct vec up = vec_cross(right, toward);
	double half = tan(view.angle / 2 * degree), aside = half * width / height;
	return (struct camera){
		.from = view.from,
		.corner = vec_add(toward, vec_sub(vec_scale(up, half), vec_scale(right, aside))),
		.right = vec_scale(right, 2 * aside),
		.down = vec_scale(up, -2 * half),
	};
}

struct vec camera_origin(const struct camera *c, double x, double y)
{
	return c->parallel ? vec_add(c->from, vec_add(vec_scale(c->right, x), vec_scale(c->down, y))) : c->from;
}

struct vec camera_direction(const struct camera *c, double x, double y)
{
	if (c->parallel)
		return c->toward;
	return vec_unit(vec_add(c->corner, vec_add(vec_scale(c->right, x), vec_scale(c->down, y))));
}
