#include "accel/screen.h"

static double longest_edge(const struct triangle *t)
{
	double a = vec_length(vec_sub(t->v[1], t->v[0])), b = vec_length(vec_sub(t->v[2], t->v[0])),
	       c = vec_length(vec_sub(t->v[2], t->v[1]));
	return fmax(a, fmax(b, c));
}

static struct screen screen_make(const struct triangle *t, struct vec center)
{
	struct screen s = { 0 };
	struct vec corner = vec_sub(t->v[0], center), e1 = vec_sub(t->v[1], t->v[0]), e2 = vec_sub(t->v[2], t->v[0]);
	double longest = longest_edge(t);
	for (int i = 0; i < 3; i++) {
		s.corner[i] = (float)corner.a[i];
		s.edge1[i] = (float)e1.a[i];
		s.edge2[i] = (float)e2.a[i];
	}
	/* Outside this range products could leave that of floats. */
	s.edge = longest > 1e-12 && longest < 1e12 ? (float)longest * (1 + 0x1p-20f) : INFINITY;
	return s;
}

const struct screen *screens_make(struct arena *mem, const struct primitives *p, struct vec center)
{
	struct screen *all = NEW(mem, struct screen, p->count);
	for (uint32_t i = 0; all && i < p->count; i++)
		all[i] = p->all[i].kind == PRIMITIVE_TRIANGLE ? screen_make(&p->all[i].triangle, center) : (struct screen){ .edge = INFINITY };
	return all;
}
