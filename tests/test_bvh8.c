/* The hierarchy of eight children a node: all instruction sets, single rays and batches find what the list finds. */
#include "tests/oracle.h"

#include "accel/bvh8.h"
#include "base/rng.h"

static void any_instructions_find_what_the_list_finds(void **state)
{
	(void)state;
	for (int s = 0; s < SCENES; s++) {
		struct primitives p = make_spd(scenes[s].family, scenes[s].size, scenes[s].tessellate);
		struct oracle oracle = oracle_make(&p, 20000);
		for (int kernel = BVH8_BEST; kernel <= BVH8_PORTABLE; kernel++) {
			char what[120];
			struct bvh8_options o = { .kernel = kernel };
			struct accel a = build("bvh8", &o, &p);
			snprintf(what, sizeof what, "%s %d: bvh8, kernel %d", scenes[s].family, scenes[s].size, kernel);
			compare_hits(&a, &oracle, 5e-4, what);
			accel_free(&a);
		}
		oracle_free(&oracle);
		primitives_free(&p);
	}
}

/* Enough rays for bvh8 to sort them and to have several in flight; some of them for any hit, some through everything. */
static void order_does_not_matter(void **state)
{
	(void)state;
	enum { COUNT = 20000 };
	struct primitives p = make_spd("teapot", 70, true);
	struct bvh8_options o = { 0 };
	struct accel a = build("bvh8", &o, &p);
	struct err e = { 0 };
	struct ray_source source;
	struct ray *rays = malloc(COUNT * sizeof *rays);
	struct hit *hits = malloc(COUNT * sizeof *hits);
	struct hit *uncounted = malloc(COUNT * sizeof *uncounted);
	struct tally *tallies = malloc(COUNT * sizeof *tallies);
	assert_int_equal(ray_source_open(&source, &a, WORKLOAD_INVARIANT, 11, &e), 0);
	for (size_t i = 0; i < COUNT; i++) {
		rays[i] = ray_source_draw(&source, i);
		rays[i].any = i % 3 == 1;
		rays[i].through = i % 5 == 2;
	}
	assert_true(a.mem.held > BVH8_SORTED_BYTES);
	uint32_t *order = bvh8_order(&a, rays, COUNT);
	assert_non_null(order);
	free(order);
	a.ops->shoot_many(&a, rays, COUNT, hits, tallies);
	accel_hit_many(&a, rays, COUNT, uncounted);
	for (size_t i = 0; i < COUNT; i++) {
		struct hit h;
		struct tally n = { 0 };
		a.ops->shoot_counted(&a, &rays[i], &h, &n);
		if (h.id != hits[i].id || h.t != hits[i].t || memcmp(&n, &tallies[i], sizeof n) != 0)
			fail_msg("ray %zu: %u at %.17g alone, %u at %.17g among many", i, h.id, h.t, hits[i].id, hits[i].t);
		a.ops->shoot(&a, &rays[i], &h);
		if (h.id != uncounted[i].id || !same_time(h.t, uncounted[i].t, 5e-4, &a))
			fail_msg("ray %zu, uncounted: %u at %.17g alone, %u at %.17g among many", i, h.id, h.t, uncounted[i].id, uncounted[i].t);
	}
	ray_source_close(&source);
	free(rays);
	free(hits);
	free(uncounted);
	free(tallies);
	accel_free(&a);
	primitives_free(&p);
}

/* A solid box among specks that fill far larger boxes: rays towards it that any hit ends go straight there. */
static void any_hit_is_sought_where_it_is_likely(void **state)
{
	(void)state;
	enum { SPECKS = 10, RAYS = 2000 };
	struct scene s = { 0 };
	for (int i = 0; i < SPECKS * SPECKS * SPECKS; i++) {
		struct vec at = vec(i % SPECKS, i / SPECKS % SPECKS, i / SPECKS / SPECKS);
		add_box(&s, at, vec_add(at, vec(0.05, 0.05, 0.05)));
	}
	add_box(&s, vec(4.2, 4.2, 4.2), vec(4.9, 4.9, 4.9));
	struct primitives p = make_primitives(&s);
	_Alignas(16) unsigned char o[ACCEL_OPT_MOST];
	key_defaults(accel_find("bvh8")->keys, o);
	struct accel a = build("bvh8", o, &p);
	struct tally n = { 0 };
	for (uint64_t i = 0; i < RAYS; i++) {
		uint64_t key = rng_key(8, 1, i);
		struct vec from = vec(9 * rng_uniform(key, 0), 9 * rng_uniform(key, 1), -1);
		struct vec to = vec(4.2 + 0.7 * rng_uniform(key, 2), 4.2 + 0.7 * rng_uniform(key, 3), 4.5);
		struct ray r = { .o = from, .d = vec_unit(vec_sub(to, from)), .t_max = INFINITY, .slack = a.slack, .from = NO_PRIMITIVE, .any = true };
		struct hit h;
		assert_true(a.ops->shoot_counted(&a, &r, &h, &n));
	}
	assert_int_equal(n.leaves, RAYS);
	assert_true(n.inner_step <= RAYS * (uint64_t)a.depth);
	accel_free(&a);
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(any_instructions_find_what_the_list_finds),
		cmocka_unit_test(order_does_not_matter),
		cmocka_unit_test(any_hit_is_sought_where_it_is_likely),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
