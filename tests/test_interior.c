/* The chance that a ray from inside the scene meets a node: closed form, Monte Carlo, and what its approximations are worth. */
#include "tests/check.h"

#include "base/rng.h"
#include "geom/interior.h"

typedef double metric(const struct box *scene, const struct box *node);
static metric *const metrics[] = { interior_exact, interior_sah, interior_hq26, interior_fast6 };

static const struct box cube = { { { { -1, 2, 5 } } }, { { { 0, 3, 6 } } } };
static const struct box hall = { { { { 0, 0, 0 } } }, { { { 10, 10, 3 } } } };
static const struct box corridor = { { { { -2, -2, -2 } } }, { { { -1, -1.7, -1.7 } } } };
static const struct box *const scenes[] = { &cube, &hall, &corridor };

/* Part of a scene, ends as shares of its sides. */
static struct box part(const struct box *scene, const double low[3], const double high[3])
{
	struct box b;
	for (int i = 0; i < 3; i++) {
		b.lo.a[i] = scene->lo.a[i] + low[i] * (scene->hi.a[i] - scene->lo.a[i]);
		b.hi.a[i] = high[i] == 1 ? scene->hi.a[i] : scene->lo.a[i] + high[i] * (scene->hi.a[i] - scene->lo.a[i]);
	}
	return b;
}

static void the_scene_is_met(void **state)
{
	(void)state;
	for (int s = 0; s < 3; s++)
		for (int m = 0; m < 4; m++)
			assert_near(metrics[m](scenes[s], scenes[s]), 1, 1e-14);
}

/* Whether a ray from p along d (any length) meets the box. */
static bool meets(const struct box *b, struct vec p, struct vec d)
{
	double low = 0, high = INFINITY;
	for (int i = 0; i < 3; i++) {
		double t = (b->lo.a[i] - p.a[i]) / d.a[i], u = (b->hi.a[i] - p.a[i]) / d.a[i];
		low = fmax(low, fmin(t, u));
		high = fmin(high, fmax(t, u));
	}
	return low <= high;
}

static void draw(uint64_t index, const struct box *scene, struct vec *p, struct vec *d)
{
	uint64_t key = rng_key(7, 0, index), dimension = 3;
	for (int i = 0; i < 3; i++)
		p->a[i] = scene->lo.a[i] + rng_uniform(key, (uint64_t)i) * (scene->hi.a[i] - scene->lo.a[i]);
	do {
		for (int i = 0; i < 3; i++)
			d->a[i] = 2 * rng_uniform(key, dimension++) - 1;
	} while (vec_dot(*d, *d) > 1);
}

enum { NODES = 6, RAYS = 1500000 };

static void rays_meet_as_many(void **state)
{
	(void)state;
	static const double low[NODES][3] = { { 0.2, 0.3, 0.4 }, { 0, 0, 0 }, { 0, 0.5, 0.9 }, { 0.1, 0.1, 0.1 }, { 0, 0, 0.499 }, { 0.7, 0, 0.3 } };
	static const double high[NODES][3] = { { 0.5, 0.4, 0.8 }, { 0.1, 0.1, 0.1 }, { 1, 0.6, 1 }, { 0.9, 0.9, 0.9 }, { 1, 1, 0.501 }, { 1, 0.01, 0.4 } };
	for (int s = 0; s < 3; s++) {
		struct box node[NODES];
		uint32_t met[NODES] = { 0 };
		for (int n = 0; n < NODES; n++)
			node[n] = part(scenes[s], low[n], high[n]);
		for (uint64_t i = 0; i < RAYS; i++) {
			struct vec p, d;
			draw(i, scenes[s], &p, &d);
			for (int n = 0; n < NODES; n++)
				met[n] += meets(&node[n], p, d);
		}
		for (int n = 0; n < NODES; n++)
			assert_near((double)met[n] / RAYS, interior_exact(scenes[s], &node[n]), 1e-3);
	}
}

/* A small node is met by its area: p = A L / (8 V), with a length L that the place alone determines in the limit; no other digits
 * where the closed form gives way to quadrature, nor far below that. */
static void small_nodes_are_met_by_their_area(void **state)
{
	(void)state;
	static const double place[4][3] = { { 0.3, 0.6, 0.45 }, { 0, 0.4, 0.7 }, { 0, 0, 0.2 }, { 0, 0, 0 } };
	static const double edge[4] = { 1.00001e-4, 0.99999e-4, 2e-6, 1e-6 };
	for (int s = 0; s < 3; s++)
		for (int k = 0; k < 4; k++) {
			double length[4], unit = scenes[s]->hi.x - scenes[s]->lo.x;
			for (int i = 0; i < 4; i++) {
				struct box b = part(scenes[s], place[k], place[k]);
				b.hi = vec_add(b.lo, vec(edge[i] * unit, edge[i] * unit, edge[i] * unit));
				length[i] = interior_exact(scenes[s], &b) / box_area(&b);
			}
			assert_near(length[0] / length[1], 1, 2e-6);
			assert_near(length[3] / length[2], 1, 1e-4);
		}
}

static void sliding_and_cutting_are_the_same(void **state)
{
	(void)state;
	static const double low[3] = { 0.1, 0.2, 0 }, high[3] = { 0.9, 0.4, 1 };
	for (int s = 0; s < 3; s++)
		for (int k = 0; k < 3 * 9; k++) {
			int axis = k / 9;
			struct box node = part(scenes[s], low, high), half[2] = { node, node };
			struct interior_slide sah = interior_slide_sah(scenes[s], &node, axis), fast = interior_slide_fast6(scenes[s], &node, axis);
			double plane = node.lo.a[axis] + (k % 9 + 1) / 10.0 * (node.hi.a[axis] - node.lo.a[axis]);
			half[0].hi.a[axis] = half[1].lo.a[axis] = plane;
			struct interior_parts parts = interior_measure(scenes[s], &node);
			double cut[2];
			interior_cut(scenes[s], &node, &parts, axis, plane, cut);
			for (int i = 0; i < 2; i++) {
				assert_near(interior_slide_to(&sah, plane, i), interior_sah(scenes[s], &half[i]), 1e-14);
				assert_near(interior_slide_to(&fast, plane, i), interior_fast6(scenes[s], &half[i]), 1e-14);
				assert_near(cut[i], interior_exact(scenes[s], &half[i]), 1e-14);
			}
		}
}

/* Nodes of any place and shape, and such as cuts across random axes make. */
static struct box random_node(const struct box *scene, uint64_t index)
{
	uint64_t key = rng_key(9, 1, index), d = 0;
	double low[3] = { 0, 0, 0 }, high[3] = { 1, 1, 1 };
	if (index % 2 == 0) {
		for (int i = 0; i < 3; i++) {
			double a = rng_uniform(key, d++), b = rng_uniform(key, d++);
			low[i] = fmin(a, b);
			high[i] = fmax(a, b);
		}
		return part(scene, low, high);
	}
	for (int cuts = 1 + (int)(12 * rng_uniform(key, d++)); cuts > 0; cuts--) {
		int axis = (int)(3 * rng_uniform(key, d++));
		double at = low[axis] + (0.2 + 0.6 * rng_uniform(key, d++)) * (high[axis] - low[axis]);
		*(rng_uniform(key, d++) < 0.5 ? &low[axis] : &high[axis]) = at;
	}
	return part(scene, low, high);
}

/* What eq. (2), (4) and (5) come to, over the exact value: mean, extremes, standard deviation of the logarithm. */
struct quality {
	double mean[2], extreme[2], spread[2]; /* no less, no more than */
};

static void approximations_err_as_known(void **state)
{
	(void)state;
	static const struct quality known[3] = {
		{ { 1.28, 1.34 }, { 0.94, 3.04 }, { 0.17, 0.21 } },
		{ { 0.80, 0.90 }, { 0.27, 1.20 }, { 0.14, 0.26 } },
		{ { 0.98, 1.00 }, { 0.82, 1.67 }, { 0.07, 0.11 } },
	};
	for (int s = 0; s < 3; s++)
		for (int m = 0; m < 3; m++) {
			double sum = 0, least = INFINITY, most = 0, logs = 0, squares = 0;
			for (uint64_t i = 0; i < 600; i++) {
				struct box b = random_node(scenes[s], i);
				double ratio = metrics[m + 1](scenes[s], &b) / interior_exact(scenes[s], &b);
				sum += ratio;
				logs += log(ratio);
				squares += log(ratio) * log(ratio);
				least = fmin(least, ratio);
				most = fmax(most, ratio);
			}
			double mean = sum / 600, spread = sqrt(squares / 600 - logs / 600 * logs / 600);
			const struct quality *k = &known[m];
			if (mean < k->mean[0] || mean > k->mean[1] || least < k->extreme[0] || most > k->extreme[1] || spread < k->spread[0] ||
			    spread > k->spread[1])
				fail_msg("scene %d, eq. %d: mean %.3f, %.3f to %.3f, spread %.3f", s, m == 0 ? 2 : m + 3, mean, least, most, spread);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(the_scene_is_met),
		cmocka_unit_test(rays_meet_as_many),
		cmocka_unit_test(small_nodes_are_met_by_their_area),
		cmocka_unit_test(sliding_and_cutting_are_the_same),
		cmocka_unit_test(approximations_err_as_known),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
