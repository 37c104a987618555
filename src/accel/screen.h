/* A float test in SIMD lanes that throws out, eight at a time, the triangles a ray certainly misses; what remains takes the exact test of
 * geom/hit.h, so that hits are the same, bit for bit, as without it.
 *
 * Of every triangle are kept, as floats, corner 0 relative to the root's centre, the two edges from it, and the length E of its longest
 * edge. With S the distance between the ray's origin and the root's farthest point, every product of the Moeller-Trumbore test is off by
 * less than 72 roundings of S E (its t: of S E^2); the test below allows 128. A sphere has E = infinity: it is never thrown out; nor is
 * anything where floats could overflow. */
#ifndef ACCEL_SCREEN_H
#define ACCEL_SCREEN_H

#include "accel/accel.h"
#include "accel/axes.h"
#include "geom/hit.h"

#include <string.h>

enum { SCREEN_LANES = 8 };

typedef float quad __attribute__((vector_size(16)));
typedef float lanes __attribute__((vector_size(4 * SCREEN_LANES)));
typedef int8_t lane_bytes __attribute__((vector_size(SCREEN_LANES)));
typedef int32_t lane_mask __attribute__((vector_size(4 * SCREEN_LANES)));

/* One primitive. */
struct screen {
	float corner[3], edge;
	float edge1[3], unused1;
	float edge2[3], unused2;
};

/* A ray made ready for screens. */
struct screen_ray {
	float o[3], d[3]; /* o relative to the root's centre */
	float reach;      /* S */
};

/* The screens of all primitives, by id, in the structure's memory; NULL when memory is out. center: of the root. */
const struct screen *screens_make(struct arena *mem, const struct primitives *p, struct vec center);

INLINED lanes spread(float x)
{
	return (lanes){ x, x, x, x, x, x, x, x };
}

/* center, diagonal: of the root. */
INLINED struct screen_ray screen_ray(const struct ray *r, struct vec center, double diagonal)
{
	struct vec o = vec_sub(r->o, center);
	double reach = fabs(o.x) + fabs(o.y) + fabs(o.z) + diagonal;
	struct screen_ray s = { .reach = reach < 1e12 ? (float)reach : INFINITY };
	for (int i = 0; i < 3; i++) {
		s.o[i] = (float)o.a[i];
		s.d[i] = (float)r->d.a[i];
	}
	return s;
}

/* What lies at 'offset' of two screens, side by side. */
INLINED lanes screen_pair(const struct screen *s, const struct screen *t, size_t offset)
{
	quad low, high;
	memcpy(&low, (const char *)s + offset, sizeof low);
	memcpy(&high, (const char *)t + offset, sizeof high);
	return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/* Eight screens turned into lanes: each of the four numbers at 'offset' becomes a row. */
INLINED void screen_rows(const struct screen *const *s, size_t offset, lanes *row)
{
	lanes a = screen_pair(s[0], s[4], offset), b = screen_pair(s[1], s[5], offset);
	lanes c = screen_pair(s[2], s[6], offset), d = screen_pair(s[3], s[7], offset);
	lanes ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13), cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
	row[0] = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
	row[1] = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
	ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
	cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
	row[2] = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
	row[3] = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
}

/* All ones in the lanes whose triangle the ray misses for certain, or hits for certain beyond t = limit. */
INLINED lane_mask screen_misses(const struct screen *const *s, const struct screen_ray *r, float limit)
{
	lanes c[4], e1[4], e2[4];
	lanes d[3] = { spread(r->d[0]), spread(r->d[1]), spread(r->d[2]) };
	screen_rows(s, offsetof(struct screen, corner), c);
	screen_rows(s, offsetof(struct screen, edge1), e1);
	screen_rows(s, offsetof(struct screen, edge2), e2);
	lanes px = d[1] * e2[2] - d[2] * e2[1], py = d[2] * e2[0] - d[0] * e2[2], pz = d[0] * e2[1] - d[1] * e2[0];
	lanes wx = spread(r->o[0]) - c[0], wy = spread(r->o[1]) - c[1], wz = spread(r->o[2]) - c[2];
	lanes det = e1[0] * px + e1[1] * py + e1[2] * pz;
	lanes u = wx * px + wy * py + wz * pz;
	lanes qx = wy * e1[2] - wz * e1[1], qy = wz * e1[0] - wx * e1[2], qz = wx * e1[1] - wy * e1[0];
	lanes v = d[0] * qx + d[1] * qy + d[2] * qz;
	lanes t = e2[0] * qx + e2[1] * qy + e2[2] * qz;
	lane_mask sign = (lane_mask)det & (lane_mask)spread(-0.0f);
	det = (lanes)((lane_mask)det ^ sign);
	u = (lanes)((lane_mask)u ^ sign);
	v = (lanes)((lane_mask)v ^ sign);
	t = (lanes)((lane_mask)t ^ sign);
	lanes margin = spread(0x1p-17f * r->reach) * c[3], far = spread(0x1p-17f * (r->reach + limit)) * c[3] * c[3];
	return (u < -margin) | (v < -margin) | (u + v > det + margin) | (t < -margin * c[3]) | (t > det * spread(limit) + far);
}

/* The screens of up to eight ids; the last one stands in for those that are missing. n > 0. */
INLINED void screen_gather(const struct screen **s, const struct screen *all, const uint32_t *ids, uint32_t n)
{
	for (uint32_t k = 0; k < SCREEN_LANES; k++)
		s[k] = &all[ids[k < n ? k : n - 1]];
}

/* Of ids[0 .. n) those that need the exact test, from out on; returns how many. n > 0; beyond eight only the first eight count, and s are
 * their screens. Hits certainly beyond t = limit may be left out, and so is the triangle the ray starts on, which is no hit; a start
 * sphere may be one. out has room for one more than are found. */
INLINED uint32_t screen_candidates(const struct screen *const *s, const uint32_t *ids, uint32_t n, const struct ray *r,
                                   const struct screen_ray *sr, double limit, uint32_t *out)
{
	uint32_t last = (n < SCREEN_LANES ? n : SCREEN_LANES) - 1, found = 0;
	lane_bytes misses = __builtin_convertvector(screen_misses(s, sr, (float)limit), lane_bytes);
	uint64_t left; /* a bit in the byte of every lane that needs the exact test */
	memcpy(&left, &misses, sizeof left);
	left = ~left & 0x0101010101010101 & UINT64_MAX >> 8 * (SCREEN_LANES - 1 - last);
	/* Without a branch up to one: no processor can guess whether there is one. */
	do {
		uint32_t k = left ? (uint32_t)__builtin_ctzll(left) / 8 : 0;
		out[found] = ids[k];
		found += (left != 0) & ((ids[k] != r->from) | (s[k]->edge == INFINITY));
		left &= left - 1;
	} while (left);
	return found;
}

/* Improve *h by the list ids[0 .. n). Hits certainly beyond t = limit may be left out. */
INLINED void screen_test(const struct screen *screens, const struct primitive *all, const uint32_t *ids, uint32_t n,
                         const struct ray *r, const struct screen_ray *sr, double limit, struct hit *h)
{
	for (uint32_t i = 0; i < n; i += SCREEN_LANES) {
		const struct screen *s[SCREEN_LANES];
		uint32_t out[SCREEN_LANES + 1];
		screen_gather(s, screens, ids + i, n - i);
		uint32_t found = screen_candidates(s, ids + i, n - i, r, sr, h->t < limit ? h->t : limit, out);
		for (uint32_t k = 0; k < found; k++)
			primitive_hit(&all[out[k]], out[k], r, h);
	}
}

#endif
