/* Lists of primitives packed for testing four at a time. A float test in SIMD lanes throws out what the ray certainly misses; what
 * remains takes the exact test of geom/hit.h, so that hits are the same, bit for bit, as without it.
 *
 * Every lane holds corner 0 relative to the root's centre and the two edges from it, as floats. With S the distance between ray
 * origin and root's farthest point, and E the longest edge of the list, every product of the Moeller-Trumbore test is off by less
 * than 72 roundings of S E (its t: of S E^2); the test below allows 128. A list that holds a sphere has E = infinity: nothing is
 * thrown out; so it is where floats could overflow. */
#ifndef ACCEL_BLOCK_H
#define ACCEL_BLOCK_H

#include "accel/accel.h"
#include "geom/hit.h"

#include <string.h>

enum { LANES = 4 };

typedef float lanes __attribute__((vector_size(4 * LANES)));
typedef int32_t lane_mask __attribute__((vector_size(4 * LANES)));

struct block {
	lanes corner[3], edge1[3], edge2[3];
	uint32_t id[LANES];
};

/* A ray made ready for blocks. */
struct block_ray {
	lanes o[3], d[3]; /* o relative to the root's centre */
	float reach;      /* S */
};

/* Number of blocks for n primitives. */
static inline uint32_t block_count(uint32_t n)
{
	return (n + LANES - 1) / LANES;
}

/* Fill block_count(n) blocks and *edge with E. center: of the root. Spare lanes repeat the last primitive. */
void block_fill(struct block *b, float *edge, const struct primitive *all, const uint32_t *ids, uint32_t n, struct vec center);

static inline lanes spread(float x)
{
	return (lanes){ x, x, x, x };
}

/* center, diagonal: of the root. */
static inline struct block_ray block_ray(const struct ray *r, struct vec center, double diagonal)
{
	struct vec o = vec_sub(r->o, center);
	double reach = fabs(o.x) + fabs(o.y) + fabs(o.z) + diagonal;
	struct block_ray b = { .reach = reach < 1e12 ? (float)reach : INFINITY };
	for (int i = 0; i < 3; i++) {
		b.o[i] = spread((float)o.a[i]);
		b.d[i] = spread((float)r->d.a[i]);
	}
	return b;
}

/* All ones in the lanes whose triangle the ray misses for certain, or hits for certain beyond t = limit. */
static inline lane_mask block_misses(const struct block *b, const struct block_ray *r, float edge, float limit)
{
	const lanes *d = r->d, *e1 = b->edge1, *e2 = b->edge2;
	lanes px = d[1] * e2[2] - d[2] * e2[1], py = d[2] * e2[0] - d[0] * e2[2], pz = d[0] * e2[1] - d[1] * e2[0];
	lanes wx = r->o[0] - b->corner[0], wy = r->o[1] - b->corner[1], wz = r->o[2] - b->corner[2];
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
	float margin = 0x1p-17f * r->reach * edge, far = 0x1p-17f * (r->reach + limit) * edge * edge;
	lanes m = spread(margin);
	return (u < -m) | (v < -m) | (u + v > det + m) | (t < spread(-margin * edge)) | (t > det * spread(limit) + spread(far));
}

/* The ids in 'count' blocks that need the exact test, into ids[count * LANES]; returns how many. Hits certainly beyond t = limit may
 * be left out, and so is the triangle the ray starts on, which is no hit; a start sphere may be one. */
static inline uint32_t block_candidates(const struct block *b, uint32_t count, float edge, const struct ray *r,
                                        const struct block_ray *br, double limit, uint32_t *ids)
{
	uint32_t n = 0, from = edge == INFINITY ? NO_PRIMITIVE : r->from;
	for (const struct block *end = b + count; b < end; b++) {
		lane_mask misses = block_misses(b, br, edge, (float)limit);
		uint64_t half[2];
		memcpy(half, &misses, sizeof half);
		if ((half[0] & half[1]) == UINT64_MAX)
			continue;
		for (int k = 0; k < LANES; k++) {
			ids[n] = b->id[k];
			n += misses[k] == 0 && b->id[k] != from;
		}
	}
	return n;
}

/* Improve *h by the list of n primitives. Hits certainly beyond t = limit may be left out. */
static inline void block_test(const struct block *b, float edge, const struct primitive *all, uint32_t n, const struct ray *r,
                              const struct block_ray *br, double limit, struct hit *h)
{
	enum { PIECE = 8 };
	for (uint32_t left = block_count(n); left > 0;) {
		uint32_t ids[PIECE * LANES], count = left < PIECE ? left : PIECE;
		uint32_t found = block_candidates(b, count, edge, r, br, h->t < limit ? h->t : limit, ids);
		for (uint32_t i = 0; i < found; i++)
			primitive_hit(&all[ids[i]], ids[i], r, h);
		b += count;
		left -= count;
	}
}

#endif
