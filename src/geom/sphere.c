#include "geom/sphere.h"

#include <stdlib.h>

static const double pi = 3.14159265358979323846;

struct box sphere_bounds(const struct sphere *s)
{
	struct vec r = vec(s->radius, s->radius, s->radius);
	return (struct box){ vec_sub(s->center, r), vec_add(s->center, r) };
}

double sphere_area(const struct sphere *s)
{
	return 4 * pi * s->radius * s->radius;
}

bool sphere_touches(const struct sphere *s, const struct box *b)
{
	double near = 0, far = 0;
	for (int i = 0; i < 3; i++) {
		double below = b->lo.a[i] - s->center.a[i], above = s->center.a[i] - b->hi.a[i];
		double gap = fmax(0, fmax(below, above)), reach = fmax(-below, -above);
		near += gap * gap;
		far += reach * reach;
	}
	double r2 = s->radius * s->radius;
	return near <= r2 && r2 <= far;
}

/* A rectangle about the circle's centre: x0 <= x <= x1, y0 <= y <= y1. */
struct rectangle {
	double x0, x1, y0, y1;
};

/* Angle of the circle of radius 'rho' about the origin that lies in the rectangle's part of the quadrant x, y >= 0. Every
 * side bounds the polar angle from one end. */
static double quadrant_angle(double rho, double x0, double x1, double y0, double y1)
{
	x0 = fmax(x0, 0);
	y0 = fmax(y0, 0);
	if (x1 <= x0 || y1 <= y0)
		return 0;
	double from = fmax(rho > x1 ? acos(x1 / rho) : 0, rho > y0 ? asin(y0 / rho) : pi / 2);
	double to = fmin(rho > y1 ? asin(y1 / rho) : pi / 2, rho > x0 ? acos(x0 / rho) : 0);
	return fmax(0, to - from);
}

static double inside_angle(double rho, const struct rectangle *w)
{
	return quadrant_angle(rho, w->x0, w->x1, w->y0, w->y1) + quadrant_angle(rho, -w->x1, -w->x0, w->y0, w->y1) +
	       quadrant_angle(rho, w->x0, w->x1, -w->y1, -w->y0) + quadrant_angle(rho, -w->x1, -w->x0, -w->y1, -w->y0);
}

/* The z interval [mid - half, mid + half] under z = mid - half cos(theta), which takes the square roots off the ends. */
struct piece {
	const struct rectangle *rectangle;
	double radius, mid, half;
};

/* Gauss-Legendre with 12 points over theta in [from, to]. */
static double rule(const struct piece *p, double from, double to)
{
	static const double node[6] = { 0.1252334085114689, 0.3678314989981802, 0.5873179542866175,
		                        0.7699026741943047, 0.9041172563704749, 0.9815606342467192 };
	static const double weight[6] = { 0.2491470458134028, 0.2334925365383548, 0.2031674267230659,
		                          0.1600783285433462, 0.1069393259953184, 0.0471753363865118 };
	double middle = (from + to) / 2, reach = (to - from) / 2, sum = 0;
	for (int i = 0; i < 12; i++) {
		double theta = middle + (i % 2 ? reach : -reach) * node[i / 2];
		double z = p->mid - p->half * cos(theta);
		double rho = sqrt(fmax(0, (p->radius - z) * (p->radius + z)));
		sum += weight[i / 2] * inside_angle(rho, p->rectangle) * p->half * sin(theta);
	}
	return sum * reach;
}

/* Halve until both halves together say the same as the whole to 'error'. */
static double integrate(const struct piece *p, double from, double to, double whole, double error, int most)
{
	double middle = (from + to) / 2, low = rule(p, from, middle), high = rule(p, middle, to);
	if (fabs(low + high - whole) <= error || most == 0)
		return low + high;
	return integrate(p, from, middle, low, error / 2, most - 1) + integrate(p, middle, to, high, error / 2, most - 1);
}

static int compare_heights(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Heights strictly between z0 and z1 at which the circle touches a side or passes a corner, and z0, z1 themselves; sorted. */
static int list_heights(double r, double z0, double z1, const struct rectangle *w, double *height)
{
	const double x[3] = { 0, w->x0, w->x1 }, y[3] = { 0, w->y0, w->y1 };
	int n = 0;
	height[n++] = z0;
	height[n++] = z1;
	for (int i = 0; i < 9; i++) {
		double square = r * r - x[i / 3] * x[i / 3] - y[i % 3] * y[i % 3];
		if (square < 0)
			continue;
		double z = sqrt(square);
		if (z > z0 && z < z1)
			height[n++] = z;
		if (-z > z0 && -z < z1)
			height[n++] = -z;
	}
	qsort(height, (size_t)n, sizeof *height, compare_heights);
	return n;
}

double sphere_area_inside(const struct sphere *s, const struct box *b)
{
	struct vec lo = vec_sub(b->lo, s->center), hi = vec_sub(b->hi, s->center);
	double r = s->radius;
	if (lo.x <= -r && lo.y <= -r && lo.z <= -r && hi.x >= r && hi.y >= r && hi.z >= r)
		return sphere_area(s);
	double z0 = fmax(lo.z, -r), z1 = fmin(hi.z, r);
	if (z0 >= z1 || !sphere_touches(s, b))
		return 0;
	const struct rectangle w = { lo.x, hi.x, lo.y, hi.y };
	double height[20], sum = 0;
	int n = list_heights(r, z0, z1, &w, height);
	for (int i = 1; i < n; i++) {
		const struct piece p = { &w, r, (height[i - 1] + height[i]) / 2, (height[i] - height[i - 1]) / 2 };
		sum += integrate(&p, 0, pi, rule(&p, 0, pi), 1e-11 * r, 20);
	}
	return r * sum;
}
