/* The closed form: J_i is a five-fold integral of z / r^3. Along z it is 1/r at z = 0 less 1/r at z = h; 1/r integrates over x and y to
 *   G(u,v,w) = u ln(v + r) + v ln(u + r) - w atan(uv / wr),                                          r^2 = u^2 + v^2 + w^2,
 * and G over the face, since all depends on the differences u = x - a, v = y - b only, to
 *   H(u,v,w) = (v^2 - w^2)/2 u ln(u + r) + (u^2 - w^2)/2 v ln(v + r) - (u^2 + v^2 - 2 w^2) r/6 - u v w atan(uv / wr),
 * to be summed over the ends of x, a, y and b with the sign of the number of upper ends. Sixteen numbers of size 1 that sum up to the
 * area of a face lose its digits; over small faces G is summed up instead (Gauss and Legendre, three points a side). */
#include "geom/interior.h"

#include <stdbool.h>

static const double pi = 3.14159265358979323846;

/* Shorter than that of the scene's longest side, faces are small: there both ways agree to 1e-6. */
static const double small = 1e-4;

/* factor * ln(u + r), where rest = r^2 - u^2; 0 where the factor is, whatever the logarithm. */
static double times_log(double factor, double u, double rest, double r)
{
	if (factor == 0)
		return 0;
	return factor * log(u > 0 ? u + r : rest / (r - u));
}

static double integral_plane(double u, double v, double w)
{
	double uu = u * u, vv = v * v, ww = w * w, r = sqrt(uu + vv + ww);
	return times_log(u, v, uu + ww, r) + times_log(v, u, vv + ww, r) - (w > 0 ? w * atan2(u * v, w * r) : 0);
}

static double integral_planes(double u, double v, double w)
{
	double uu = u * u, vv = v * v, ww = w * w, r = sqrt(uu + vv + ww);
	return times_log((vv - ww) / 2 * u, u, vv + ww, r) + times_log((uu - ww) / 2 * v, v, uu + ww, r) - (uu + vv - 2 * ww) * r / 6 -
	       (w > 0 ? u * v * w * atan2(u * v, w * r) : 0);
}

/* Two faces that face each other across an axis, lengths in units of the scene's longest side: their ends, from the scene's lower ones,
 * and the scene's sides, on the other axes. */
struct faces {
	double end[2][2], side[2];
};

/* The sum of H over all ends, at distance w. */
static double sum_ends(const struct faces *f, double w)
{
	double sum = 0;
	for (int k = 0; k < 16; k++) {
		double u = (k & 1 ? f->side[0] : 0) - f->end[0][k >> 1 & 1], v = (k & 4 ? f->side[1] : 0) - f->end[1][k >> 3 & 1];
		double term = integral_planes(u, v, w);
		sum += ((k ^ k >> 1 ^ k >> 2 ^ k >> 3) & 1) ? -term : term;
	}
	return sum;
}

/* The same, G integrated over a small face. */
static double sum_points(const struct faces *f, double w)
{
	static const double at[3] = { 0.11270166537925831, 0.5, 0.88729833462074169 }, weight[3] = { 5 / 18.0, 8 / 18.0, 5 / 18.0 };
	double sum = 0, length[2] = { f->end[0][1] - f->end[0][0], f->end[1][1] - f->end[1][0] };
	for (int k = 0; k < 9; k++) {
		double a = f->end[0][0] + at[k % 3] * length[0], b = f->end[1][0] + at[k / 3] * length[1], inner = 0;
		for (int c = 0; c < 4; c++) {
			double term = integral_plane((c & 1 ? f->side[0] : 0) - a, (c & 2 ? f->side[1] : 0) - b, w);
			inner += c == 1 || c == 2 ? -term : term;
		}
		sum += weight[k % 3] * weight[k / 3] * inner;
	}
	return sum * length[0] * length[1];
}

/* J / V(scene) of the node's lower and upper face across an axis. */
static void measure_faces(const struct box *scene, const struct box *node, int axis, double through[2])
{
	struct vec size = vec_sub(scene->hi, scene->lo);
	double unit = fmax(size.x, fmax(size.y, size.z)), scale = unit * unit * unit / (4 * pi * box_volume(scene));
	double thickness[2] = { (node->lo.a[axis] - scene->lo.a[axis]) / unit, (scene->hi.a[axis] - node->hi.a[axis]) / unit };
	struct faces f;
	bool is_small = true;
	through[0] = through[1] = 0;
	if (thickness[0] <= 0 && thickness[1] <= 0)
		return;
	for (int i = 0; i < 2; i++) {
		int across = (axis + 1 + i) % 3;
		f.end[i][0] = (node->lo.a[across] - scene->lo.a[across]) / unit;
		f.end[i][1] = (node->hi.a[across] - scene->lo.a[across]) / unit;
		f.side[i] = size.a[across] / unit;
		is_small &= f.end[i][1] - f.end[i][0] < small;
	}
	double (*sum)(const struct faces *, double) = is_small ? sum_points : sum_ends, near = sum(&f, 0);
	for (int i = 0; i < 2; i++)
		through[i] = thickness[i] > 0 ? (near - sum(&f, thickness[i])) * scale : 0;
}

struct interior_parts interior_measure(const struct box *scene, const struct box *node)
{
	struct interior_parts p;
	for (int axis = 0; axis < 3; axis++)
		measure_faces(scene, node, axis, &p.through[2 * axis]);
	p.all = box_volume(node) / box_volume(scene);
	for (int f = 0; f < 6; f++)
		p.all += p.through[f];
	return p;
}

void interior_cut(const struct box *scene, const struct box *node, const struct interior_parts *p, int axis, double plane, double half[2])
{
	struct box lower = *node, upper = *node, cut = *node;
	lower.hi.a[axis] = upper.lo.a[axis] = cut.lo.a[axis] = cut.hi.a[axis] = plane;
	double through[2], all = box_volume(scene);
	measure_faces(scene, &cut, axis, through);
	half[0] = box_volume(&lower) / all + p->through[2 * axis] + through[1];
	half[1] = box_volume(&upper) / all + p->through[2 * axis + 1] + through[0];
	for (int k = 1; k < 3; k++) {
		int side = (axis + k) % 3;
		measure_faces(scene, &lower, side, through);
		half[0] += through[0] + through[1];
		half[1] += p->through[2 * side] - through[0] + p->through[2 * side + 1] - through[1];
	}
}

double interior_exact(const struct box *scene, const struct box *node)
{
	return interior_measure(scene, node).all;
}

double interior_sah(const struct box *scene, const struct box *node)
{
	return box_area(node) / box_area(scene);
}

/* Solid angle of a triangle seen from the origin. */
static double solid_angle(struct vec a, struct vec b, struct vec c)
{
	double la = vec_length(a), lb = vec_length(b), lc = vec_length(c);
	return 2 * atan2(fabs(vec_dot(a, vec_cross(b, c))), la * lb * lc + vec_dot(a, b) * lc + vec_dot(b, c) * la + vec_dot(c, a) * lb);
}

/* Solid angle of face f of a box. */
static double solid_angle_face(const struct box *b, int f, struct vec from)
{
	int axis = f / 2, i = (axis + 1) % 3, j = (axis + 2) % 3;
	struct vec corner[4];
	for (int k = 0; k < 4; k++) {
		corner[k].a[axis] = f % 2 ? b->hi.a[axis] : b->lo.a[axis];
		corner[k].a[i] = k == 1 || k == 2 ? b->hi.a[i] : b->lo.a[i];
		corner[k].a[j] = k >= 2 ? b->hi.a[j] : b->lo.a[j];
		corner[k] = vec_sub(corner[k], from);
	}
	return solid_angle(corner[0], corner[1], corner[2]) + solid_angle(corner[0], corner[2], corner[3]);
}

double interior_hq26(const struct box *scene, const struct box *node)
{
	double sum = box_volume(node);
	for (int region = 0; region < 27; region++) {
		const int where[3] = { region % 3, region / 3 % 3, region / 9 }; /* below the node, beside it, above it */
		struct box b;
		for (int i = 0; i < 3; i++) {
			const double ends[4] = { scene->lo.a[i], node->lo.a[i], node->hi.a[i], scene->hi.a[i] };
			b.lo.a[i] = ends[where[i]];
			b.hi.a[i] = ends[where[i] + 1];
		}
		double part = box_volume(&b), angle = 0;
		struct vec centre = vec_scale(vec_add(b.lo, b.hi), 0.5);
		for (int i = 0; i < 3 && part > 0; i++)
			angle += where[i] == 1 ? 0 : solid_angle_face(node, 2 * i + (where[i] == 2), centre);
		sum += part * angle / (4 * pi);
	}
	return sum / box_volume(scene);
}

/* Area and circumference of a box cut across an axis. */
static void measure_cut(const struct box *b, int axis, double *area, double *circumference)
{
	int i = (axis + 1) % 3, j = (axis + 2) % 3;
	double p = b->hi.a[i] - b->lo.a[i], q = b->hi.a[j] - b->lo.a[j];
	*area = p * q;
	*circumference = 2 * (p + q);
}

/* V / A of both slabs beyond the node along an axis, times the area of the cross-section. */
static void measure_depths(const struct box *scene, const struct box *node, int axis, double depth[2])
{
	double cross, girth;
	measure_cut(scene, axis, &cross, &girth);
	depth[0] = interior_depth(node->lo.a[axis] - scene->lo.a[axis], cross, girth);
	depth[1] = interior_depth(scene->hi.a[axis] - node->hi.a[axis], cross, girth);
}

double interior_fast6(const struct box *scene, const struct box *node)
{
	double sum = box_volume(node);
	for (int axis = 0; axis < 3; axis++) {
		double depth[2], face, around;
		measure_depths(scene, node, axis, depth);
		measure_cut(node, axis, &face, &around);
		sum += face * (depth[0] + depth[1]);
	}
	return sum / box_volume(scene);
}

static struct interior_slide slide_open(const struct box *scene, const struct box *node, int axis)
{
	struct interior_slide s = { .low = node->lo.a[axis], .high = node->hi.a[axis], .scene_low = scene->lo.a[axis],
		                    .scene_high = scene->hi.a[axis] };
	measure_cut(scene, axis, &s.cross, &s.girth);
	return s;
}

struct interior_slide interior_slide_sah(const struct box *scene, const struct box *node, int axis)
{
	struct interior_slide s = slide_open(scene, node, axis);
	double face, around, all = box_area(scene);
	measure_cut(node, axis, &face, &around);
	s.base[0] = s.base[1] = 2 * face / all;
	s.length = around / all;
	return s;
}

struct interior_slide interior_slide_fast6(const struct box *scene, const struct box *node, int axis)
{
	struct interior_slide s = slide_open(scene, node, axis);
	double face, around, depth[2], all = box_volume(scene);
	measure_cut(node, axis, &face, &around);
	measure_depths(scene, node, axis, depth);
	s.face = face / all;
	s.base[0] = s.face * depth[0];
	s.base[1] = s.face * depth[1];
	s.length = s.face;
	for (int k = 1; k < 3; k++) {
		int side = (axis + k) % 3, across = (axis + 3 - k) % 3;
		measure_depths(scene, node, side, depth);
		s.length += (node->hi.a[across] - node->lo.a[across]) * (depth[0] + depth[1]) / all;
	}
	return s;
}
