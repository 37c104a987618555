#include "geom/clip.h"

/* Keep what has distance[i] <= 0, given the signed distances of the corners. */
static void cut(struct polygon *p, const double *distance)
{
	struct polygon kept = { 0 };
	for (int i = 0; i < p->count; i++) {
		int j = i + 1 < p->count ? i + 1 : 0;
		double di = distance[i], dj = distance[j];
		if (di <= 0 && kept.count < POLYGON_MOST)
			kept.corner[kept.count++] = p->corner[i];
		if ((di < 0 && dj > 0) || (di > 0 && dj < 0)) {
			/* From the inner end always, so that both sides of a plane get the same point. */
			struct vec in = di < 0 ? p->corner[i] : p->corner[j], out = di < 0 ? p->corner[j] : p->corner[i];
			double a = di < 0 ? di : dj, b = di < 0 ? dj : di;
			if (kept.count < POLYGON_MOST)
				kept.corner[kept.count++] = vec_add(in, vec_scale(vec_sub(out, in), a / (a - b)));
		}
	}
	*p = kept;
}

void polygon_cut_axis(struct polygon *p, int axis, double sign, double plane)
{
	double distance[POLYGON_MOST];
	int beyond = 0;
	for (int i = 0; i < p->count; i++) {
		distance[i] = sign * (p->corner[i].a[axis] - plane);
		beyond += distance[i] > 0;
	}
	if (beyond == p->count)
		p->count = 0;
	else if (beyond)
		cut(p, distance);
}

void polygon_cut(struct polygon *p, struct vec normal, double offset)
{
	double distance[POLYGON_MOST];
	for (int i = 0; i < p->count; i++)
		distance[i] = vec_dot(normal, p->corner[i]) - offset;
	cut(p, distance);
}

void polygon_cut_box(struct polygon *p, const struct box *b)
{
	for (int axis = 0; axis < 3 && p->count; axis++) {
		polygon_cut_axis(p, axis, 1, b->hi.a[axis]);
		polygon_cut_axis(p, axis, -1, b->lo.a[axis]);
	}
}

struct vec polygon_area_vector(const struct polygon *p)
{
	struct vec sum = vec(0, 0, 0);
	for (int i = 2; i < p->count; i++)
		sum = vec_add(sum, vec_cross(vec_sub(p->corner[i - 1], p->corner[0]), vec_sub(p->corner[i], p->corner[0])));
	return vec_scale(sum, 0.5);
}
