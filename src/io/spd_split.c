#include "io/spd_split.h"

#include <string.h>

/* The polygon seen along the axis it is most perpendicular to. */
struct view_plane {
	const struct vec *corners;
	int u, v;
};

static struct view_plane choose_plane(const struct vec *corners, size_t n)
{
	struct vec normal = vec(0, 0, 0);
	for (size_t i = 0; i < n; i++)
		normal = vec_add(normal, vec_cross(corners[i], corners[(i + 1) % n]));
	double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
	if (x >= y && x >= z)
		return (struct view_plane){ corners, 1, 2 };
	return y >= z ? (struct view_plane){ corners, 0, 2 } : (struct view_plane){ corners, 0, 1 };
}

static double place(const struct view_plane *w, uint32_t corner)
{
	return w->corners[corner].a[w->u];
}

static double height(const struct view_plane *w, uint32_t corner)
{
	return w->corners[corner].a[w->v];
}

/* Positions i < j in the list of n corners between which it is cut. SPD looks for corners in the bounds of a triangle, not in the
 * triangle itself, and never at the last one. */
static void find_cut(const struct view_plane *w, const uint32_t *list, size_t n, size_t *i, size_t *j)
{
	size_t l = 0, inner = n;
	for (size_t k = 1; k < n; k++)
		if (place(w, list[k]) < place(w, list[l]))
			l = k;
	size_t a = (l + n - 1) % n, b = (l + 1) % n;
	double before = height(w, list[a]), here = height(w, list[l]), after = height(w, list[b]);
	double low = fmin(here, fmin(before, after)), high = fmax(here, fmax(before, after));
	double far = fmax(place(w, list[a]), place(w, list[b]));
	for (size_t k = 0; k + 1 < n; k++)
		if (k != a && k != l && k != b && place(w, list[k]) < far && height(w, list[k]) >= low && height(w, list[k]) <= high) {
			inner = k;
			far = place(w, list[k]);
		}
	size_t from = inner == n ? a : l, to = inner == n ? b : inner;
	*i = from < to ? from : to;
	*j = from < to ? to : from;
}

/* Cut a list of n corners in two until there are triangles: the part that holds its first corner goes before the other one. The list
 * is used up; 'triples' receives 3 (n - 2) numbers. */
static int split(const struct view_plane *w, uint32_t *list, size_t n, uint32_t *triples, struct arena *scratch)
{
	while (n > 3) {
		size_t i, j;
		find_cut(w, list, n, &i, &j);
		size_t inside = j - i + 1, outside = n - inside + 2;
		if (inside == 3) {
			memcpy(triples + 3 * (outside - 2), list + i, 3 * sizeof *list);
		} else {
			uint32_t *part = NEW(scratch, uint32_t, inside);
			if (!part)
				return -1;
			memcpy(part, list + i, inside * sizeof *list);
			if (split(w, part, inside, triples + 3 * (outside - 2), scratch) != 0)
				return -1;
		}
		memmove(list + i + 1, list + j, (n - j) * sizeof *list);
		n = outside;
	}
	memcpy(triples, list, 3 * sizeof *list);
	return 0;
}

int spd_split(const struct vec *corners, size_t n, uint32_t *triples, struct arena *scratch)
{
	struct view_plane w = choose_plane(corners, n);
	uint32_t *list = NEW(scratch, uint32_t, n);
	if (!list)
		return -1;
	for (size_t i = 0; i < n; i++)
		list[i] = (uint32_t)i;
	return split(&w, list, n, triples, scratch);
}
