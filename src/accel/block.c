#include "accel/block.h"

static double longest_edge(const struct triangle *t)
{
	double a = vec_length(vec_sub(t->v[1], t->v[0])), b = vec_length(vec_sub(t->v[2], t->v[0])),
	       c = vec_length(vec_sub(t->v[2], t->v[1]));
	return fmax(a, fmax(b, c));
}

void block_fill(struct block *b, float *edge, const struct primitive *all, const uint32_t *ids, uint32_t n, struct vec center)
{
	double longest = 0;
	for (uint32_t i = 0; i < block_count(n) * LANES; i++) {
		uint32_t id = ids[i < n ? i : n - 1];
		const struct primitive *p = &all[id];
		b[i / LANES].id[i % LANES] = id;
		if (p->kind != PRIMITIVE_TRIANGLE) {
			longest = INFINITY;
			continue;
		}
		const struct triangle *t = &p->triangle;
		struct vec corner = vec_sub(t->v[0], center), e1 = vec_sub(t->v[1], t->v[0]), e2 = vec_sub(t->v[2], t->v[0]);
		for (int axis = 0; axis < 3; axis++) {
			b[i / LANES].corner[axis][i % LANES] = (float)corner.a[axis];
			b[i / LANES].edge1[axis][i % LANES] = (float)e1.a[axis];
			b[i / LANES].edge2[axis][i % LANES] = (float)e2.a[axis];
		}
		longest = fmax(longest, longest_edge(t));
	}
	/* Outside this range products could leave that of floats. */
	*edge = longest > 1e-12 && longest < 1e12 ? (float)longest * (1 + 0x1p-20f) : INFINITY;
}
