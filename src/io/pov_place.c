#include "io/pov_place.h"

#include "io/pov_facets.h"

static struct vec row(const struct matrix *m, int i)
{
	return vec(m->m[i][0], m->m[i][1], m->m[i][2]);
}

double pov_place_determinant(const struct matrix *m)
{
	return vec_dot(row(m, 0), vec_cross(row(m, 1), row(m, 2)));
}

bool pov_place_invert(const struct matrix *m, struct matrix *inverse)
{
	double det = pov_place_determinant(m);
	struct matrix r = matrix_identity();
	bool finite = det != 0;
	for (int i = 0; finite && i < 3; i++) {
		/* Rows of the linear part, crossed in turn, are the columns of the inverse. */
		struct vec c = vec_cross(row(m, (i + 1) % 3), row(m, (i + 2) % 3));
		for (int j = 0; j < 3; j++) {
			r.m[j][i] = c.a[j] / det;
			finite = finite && isfinite(r.m[j][i]);
		}
	}
	if (!finite) {
		*inverse = matrix_identity();
		return false;
	}
	struct vec back = matrix_direction(vec(-m->m[3][0], -m->m[3][1], -m->m[3][2]), &r);
	for (int j = 0; j < 3; j++)
		r.m[3][j] = back.a[j];
	*inverse = r;
	return true;
}

/* Eigenvalues of the symmetric matrix M M^T by the trigonometric form of the cubic (Smith 1961). */
void pov_place_stretch(const struct matrix *m, double *least, double *most)
{
	struct vec r[3] = { row(m, 0), row(m, 1), row(m, 2) };
	double a = vec_dot(r[0], r[0]), b = vec_dot(r[1], r[1]), c = vec_dot(r[2], r[2]);
	double d = vec_dot(r[0], r[1]), e = vec_dot(r[1], r[2]), f = vec_dot(r[0], r[2]);
	double q = (a + b + c) / 3, off = d * d + e * e + f * f;
	double p = sqrt(((a - q) * (a - q) + (b - q) * (b - q) + (c - q) * (c - q) + 2 * off) / 6);
	if (p == 0) {
		*least = *most = sqrt(q);
		return;
	}
	double half = ((a - q) * ((b - q) * (c - q) - e * e) - d * (d * (c - q) - e * f) + f * (d * e - (b - q) * f)) / (2 * p * p * p);
	double angle = acos(fmin(1, fmax(-1, half))) / 3;
	*most = sqrt(fmax(0, q + 2 * p * cos(angle)));
	*least = sqrt(fmax(0, q + 2 * p * cos(angle + 2.0943951023931953)));
}

struct box pov_place_box(const struct box *b, const struct matrix *m)
{
	struct box out;
	if (box_is_empty(b))
		return box_empty();
	for (int j = 0; j < 3; j++) {
		out.lo.a[j] = out.hi.a[j] = m->m[3][j];
		for (int i = 0; i < 3; i++) {
			double s = m->m[i][j];
			if (s == 0)
				continue;
			out.lo.a[j] += s * (s > 0 ? b->lo.a[i] : b->hi.a[i]);
			out.hi.a[j] += s * (s > 0 ? b->hi.a[i] : b->lo.a[i]);
		}
	}
	return out;
}

void pov_place_frame(struct vec axis, struct vec *u, struct vec *v)
{
	struct vec aside = fabs(axis.x) < 0.6 ? vec(1, 0, 0) : vec(0, 1, 0);
	*u = vec_unit(vec_cross(aside, axis));
	*v = vec_cross(axis, *u);
}
