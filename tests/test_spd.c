/* Generators: the bytes of the original programs, the counts of their formulas, and what our own families promise. */
#include "tests/check.h"

#include "io/nff.h"

#include <string.h>
#include <zlib.h>

static struct text write_family(const char *family, int size, bool tessellate, int variant)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct text out = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = tessellate;
	o.variant = variant;
	if (spd_generate(&s, spd_find(family), &o, &e) != 0 || nff_write(&s, 6, &out, &e) != 0)
		fail_msg("%s", e.text);
	scene_free(&s);
	return out;
}

/* Length and CRC-32 of what the original programs (SPD 3.14) print. */
static const struct {
	const char *family;
	int size;
	bool tessellate;
	size_t length;
	unsigned long crc;
} originals[] = {
	{ "tetra", 1, false, 298, 0xf0ce5b84 },
	{ "tetra", 1, true, 298, 0xf0ce5b84 },
	{ "tetra", 2, false, 580, 0xa71f9555 },
	{ "tetra", 2, true, 580, 0xa71f9555 },
	{ "balls", 1, false, 619, 0x4cb35fae },
	{ "balls", 1, true, 189423, 0x0e9ed461 },
	{ "balls", 2, false, 3884, 0x72b93781 },
	{ "balls", 2, true, 1718097, 0x9fa1c1ba },
	{ "gears", 1, false, 19765, 0x8e4b58f6 },
	{ "gears", 1, true, 19765, 0x8e4b58f6 },
	{ "gears", 2, false, 161775, 0xc7872747 },
	{ "gears", 2, true, 161775, 0xc7872747 },
	{ "teapot", 1, false, 5097, 0xd07959cf },
	{ "teapot", 1, true, 5097, 0xd07959cf },
	{ "teapot", 2, false, 30915, 0x3e336b2f },
	{ "teapot", 2, true, 30915, 0x3e336b2f },
	{ "mount", 1, false, 627, 0x4096189c },
	{ "mount", 1, true, 73934, 0x3c4dfe0e },
	{ "mount", 2, false, 1950, 0xdf9911e5 },
	{ "mount", 2, true, 75257, 0xf9fbcc6c },
	{ "rings", 1, false, 3507, 0x5eb37422 },
	{ "rings", 1, true, 677298, 0x7d3fa9dc },
	{ "rings", 2, false, 15627, 0xe2d1b99c },
	{ "rings", 2, true, 3310248, 0xec7a4613 },
	{ "tree", 1, false, 500, 0x2ef5b75a },
	{ "tree", 1, true, 67969, 0x62952ed4 },
	{ "tree", 2, false, 960, 0x59b4c4e5 },
	{ "tree", 2, true, 157426, 0x51a1f621 },
	{ "lattice", 1, false, 1407, 0xe30b7116 },
	{ "lattice", 1, true, 186241, 0x22562bb6 },
	{ "lattice", 2, false, 5750, 0xdd140217 },
	{ "lattice", 2, true, 670724, 0x0a41b109 },
	{ "shells", 1, false, 14805, 0x749dae9f },
	{ "shells", 1, true, 6944454, 0xaccf321d },
	{ "shells", 2, false, 29404, 0xa1b3987d },
	{ "shells", 2, true, 13865154, 0x51a05c35 },
	{ "sombrero", 1, false, 155626, 0x4165ad20 },
	{ "sombrero", 1, true, 155626, 0x4165ad20 },
	{ "sombrero", 2, false, 650450, 0x403cbdd2 },
	{ "sombrero", 2, true, 650450, 0x403cbdd2 },
	{ "jacks", 1, false, 524, 0x6fcc5732 },
	{ "jacks", 1, true, 57225, 0x85cb5eeb },
	{ "jacks", 2, false, 4004, 0xdf2c5260 },
	{ "jacks", 2, true, 506823, 0x19afba92 },
	{ "nurbtst", 1, false, 254685, 0x6eabb210 },
	{ "nurbtst", 1, true, 254685, 0x6eabb210 },
	{ "sample", 1, false, 146326, 0xb423cebb },
	{ "sample", 1, true, 149670, 0x823acafd },
};

static void bytes_of_the_originals(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof originals / sizeof *originals; i++) {
		struct text t = write_family(originals[i].family, originals[i].size, originals[i].tessellate, SPD_CURRENT);
		if (t.size != originals[i].length || crc32(0, (const Bytef *)t.bytes, (uInt)t.size) != originals[i].crc)
			fail_msg("%s -s %d %s is not what the original prints", originals[i].family, originals[i].size,
			         originals[i].tessellate ? "-t" : "-c");
		text_free(&t);
	}
}

static int64_t power(int64_t base, int exponent)
{
	return exponent ? base * power(base, exponent - 1) : 1;
}

/* Objects of a kind, and triangles if every polygon is cut into its corners less two. */
static void count_objects(const char *family, int size, bool tessellate, int64_t *count, int64_t *triangles)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = tessellate;
	if (spd_generate(&s, spd_find(family), &o, &e) != 0)
		fail_msg("%s", e.text);
	memset(count, 0, 4 * sizeof *count);
	*triangles = 0;
	for (size_t i = 0; i < s.object_count; i++) {
		enum object_kind kind = s.objects[i].kind;
		count[kind]++;
		*triangles += kind == OBJECT_POLYGON || kind == OBJECT_PATCH ? s.objects[i].count - 2 : 0;
	}
	scene_free(&s);
}

static void counts_of_the_formulas(void **state)
{
	(void)state;
	for (int s = 1; s <= 4; s++) {
		int64_t n[4], t, rings = (int64_t)s * (s + 1) * (2 * s + 1) / 6;
		count_objects("tetra", s, false, n, &t);
		assert_int_equal(t, power(4, s));
		count_objects("balls", s, false, n, &t);
		assert_int_equal(n[OBJECT_SPHERE], (power(9, s + 1) - 1) / 8);
		count_objects("gears", s, false, n, &t);
		assert_int_equal(n[OBJECT_POLYGON], 146 * power(s, 3) + 1);
		assert_int_equal(t, 572 * power(s, 3) + 2);
		count_objects("teapot", s, false, n, &t);
		assert_int_equal(n[OBJECT_PATCH], 64 * s * s - 8 * s);
		assert_int_equal(n[OBJECT_POLYGON], s * s);
		count_objects("mount", s, true, n, &t);
		assert_int_equal(t, 2 * power(4, s) + 432);
		count_objects("rings", s, false, n, &t);
		assert_int_equal(n[OBJECT_CONE], 30 * rings);
		assert_int_equal(n[OBJECT_SPHERE], 30 * rings);
		count_objects("tree", s, true, n, &t);
		assert_int_equal(t, (power(2, s + 1) - 1) * 132 + 2);
		count_objects("lattice", s, true, n, &t);
		assert_int_equal(t, 108 * power(s + 1, 3) + 72 * s * power(s + 1, 2));
		count_objects("shells", s, false, n, &t);
		assert_int_equal(n[OBJECT_SPHERE], 180 * power(2, s) + 1);
		count_objects("sombrero", s, false, n, &t);
		assert_int_equal(t, 2 * power(32 * power(2, s - 1) - 1, 2));
		count_objects("jacks", s < 4 ? s : 1, true, n, &t);
		assert_int_equal(t, (power(8, s < 4 ? s : 1) - 1) / 7 * 336);
		count_objects("sphere", s, false, n, &t);
		assert_int_equal(t, 8 * power(4, s));
	}
	int64_t n[4], t;
	count_objects("sphere", 0, false, n, &t);
	assert_int_equal(t, 8);
	count_objects("nurbtst", -1, false, n, &t);
	assert_int_equal(t, 1500);
}

/* The old programs place other balls from size 3 on, and only there. */
static void old_balls_differ_from_size_3_on(void **state)
{
	(void)state;
	for (int size = 1; size <= 3; size++) {
		struct text now = write_family("balls", size, false, SPD_CURRENT), old = write_family("balls", size, false, SPD_PRE2021);
		int differing = 0;
		char *p = now.bytes, *q = old.bytes;
		while (*p) {
			size_t n = strcspn(p, "\n"), m = strcspn(q, "\n");
			differing += n != m || memcmp(p, q, n) != 0;
			p += n + 1;
			q += m + 1;
		}
		assert_int_equal(differing, size < 3 ? 0 : 9);
		text_free(&now);
		text_free(&old);
	}
}

/* Every edge of the sphere belongs to two triangles, once in each direction; its area approaches 4 pi from below. */
static void spheres_are_closed(void **state)
{
	(void)state;
	double before = 0;
	for (int size = 0; size <= 4; size++) {
		struct primitives p = make_spd("sphere", size, false);
		for (uint32_t i = 0; i < p.count && size <= 2; i++)
			for (int k = 0; k < 3; k++) {
				const struct vec *a = &p.all[i].triangle.v[k], *b = &p.all[i].triangle.v[(k + 1) % 3];
				int same = 0, opposite = 0;
				for (uint32_t j = 0; j < 3 * p.count; j++) {
					const struct vec *c = &p.all[j / 3].triangle.v[j % 3], *d = &p.all[j / 3].triangle.v[(j + 1) % 3];
					same += memcmp(a, c, sizeof *a) == 0 && memcmp(b, d, sizeof *b) == 0;
					opposite += memcmp(a, d, sizeof *a) == 0 && memcmp(b, c, sizeof *b) == 0;
				}
				assert_int_equal(same, 1);
				assert_int_equal(opposite, 1);
			}
		for (uint32_t i = 0; i < p.count; i++) {
			const struct vec *v = p.all[i].triangle.v;
			assert_true(vec_dot(vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0])), v[0]) > 0);
		}
		assert_true(p.area > before && p.area < 4 * 3.14159265358979);
		before = p.area;
		primitives_free(&p);
	}
	assert_near(before, 4 * 3.14159265358979, 0.08);
}

static void soups_are_unit_right_triangles(void **state)
{
	(void)state;
	struct primitives p = make_spd("soup", SPD_DEFAULT_SIZE, false);
	double mean[3] = { 0 };
	assert_int_equal(p.count, 10000);
	for (uint32_t i = 0; i < p.count; i++) {
		const struct vec *v = p.all[i].triangle.v;
		struct vec x = vec_sub(v[1], v[0]), y = vec_sub(v[2], v[0]), n = vec_cross(x, y);
		assert_near(vec_length(x), 1, 1e-12);
		assert_near(vec_length(y), 1, 1e-12);
		assert_near(vec_dot(x, y), 0, 1e-12);
		for (int k = 0; k < 3; k++) {
			assert_true(v[0].a[k] >= 0 && v[0].a[k] < 20);
			mean[k] += n.a[k] * n.a[k];
		}
	}
	/* Uniform turns: the normal's squares are 1/3 on average, with a variance of 4/45. */
	for (int k = 0; k < 3; k++)
		assert_near(mean[k] / p.count, 1.0 / 3, 4 * sqrt(4.0 / 45 / p.count));
	struct primitives again = make_spd("soup", SPD_DEFAULT_SIZE, false);
	assert_true(again.hash == p.hash);
	primitives_free(&again);
	primitives_free(&p);
}

static void soups_of_scenes_keep_their_surface(void **state)
{
	(void)state;
	static const char *const families[] = { "gears", "teapot", "mount", "sample" };
	for (int i = 0; i < 4; i++) {
		struct err e = { 0 };
		struct scene made = { 0 }, soup = { 0 };
		struct primitives p = { 0 }, q = { 0 };
		struct spd_options o;
		key_defaults(spd_keys, &o);
		o.size = 1;
		assert_int_equal(spd_generate(&made, spd_find(families[i]), &o, &e), 0);
		assert_int_equal(spd_soup(&soup, &made, 3, &e), 0);
		for (size_t k = 0; k < soup.object_count; k++)
			assert_true(soup.objects[k].kind == OBJECT_POLYGON && soup.objects[k].count == 3);
		assert_int_equal(primitives_make(&p, &made, CURVES_TESSELLATE, 3, "made", &e), 0);
		assert_int_equal(primitives_make(&q, &soup, CURVES_KEEP, 3, "soup", &e), 0);
		assert_true(p.hash == q.hash);
		primitives_free(&p);
		primitives_free(&q);
		scene_free(&made);
		scene_free(&soup);
	}
}

/* Triangles grow with what the size counts: chairs, arches, bays, trees. */
static void rooms_have_their_counts(void **state)
{
	(void)state;
	static const struct { const char *family; int size; int64_t base, each, parts; } rooms[] = {
		{ "room", 6, 398, 72, 6 },           { "room", 2, 398, 72, 2 },
		{ "atrium", 9, -5336, 2920, 24 },    { "atrium", 4, -5336, 2920, 12 },
		{ "nave", 8, -44, 10392, 8 },        { "nave", 2, -44, 10392, 2 },
		{ "forest", 80, 137280, 432, 80 },   { "forest", 3, 137280, 432, 3 },
		{ "conference", 20, 23952, 12562, 20 }, { "conference", 1, 23952, 12562, 1 },
	};
	for (size_t i = 0; i < sizeof rooms / sizeof *rooms; i++) {
		int64_t n[4], t;
		count_objects(rooms[i].family, rooms[i].size, false, n, &t);
		assert_int_equal(t, rooms[i].base + rooms[i].each * rooms[i].parts);
	}
}

static bool holds(const struct box *b, struct vec p)
{
	bool inside = true;
	for (int i = 0; i < 3; i++)
		inside &= p.a[i] > b->lo.a[i] && p.a[i] < b->hi.a[i];
	return inside;
}

/* Rays start inside them, and some are mirrored; nothing is without area; curved parts face where their normals do. */
static void rooms_are_seen_from_inside(void **state)
{
	(void)state;
	static const char *const families[] = { "room", "atrium", "nave", "forest", "conference" };
	for (int i = 0; i < 5; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		struct primitives p = { 0 };
		struct spd_options o;
		bool shines = false;
		key_defaults(spd_keys, &o);
		assert_int_equal(spd_generate(&s, spd_find(families[i]), &o, &e), 0);
		assert_int_equal(primitives_make(&p, &s, CURVES_KEEP, 3, families[i], &e), 0);
		assert_int_equal(p.skipped, 0);
		assert_true(s.view.given && holds(&p.bounds, s.view.from));
		assert_true(s.light_count == 1 && holds(&p.bounds, s.lights[0].at));
		for (size_t m = 0; m < s.material_count; m++)
			shines |= s.materials[m].ks > 0;
		assert_true(shines);
		for (size_t k = 0; k < s.object_count; k++) {
			const struct vec *v = &s.points[s.objects[k].first], *n = v + s.objects[k].count;
			for (uint32_t c = 0; s.objects[k].kind == OBJECT_PATCH && c < s.objects[k].count; c++)
				assert_true(vec_dot(vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0])), n[c]) > 0);
		}
		primitives_free(&p);
		scene_free(&s);
	}
}

static void sizes_out_of_range_are_refused(void **state)
{
	(void)state;
	for (const struct spd_family *const *f = spd_families; *f; f++) {
		struct spd_options o;
		key_defaults(spd_keys, &o);
		for (int i = 0; i < 2 && (*f)->default_size; i++) {
			struct err e = { 0 };
			struct scene s = { 0 };
			o.size = i ? (*f)->most_size + 1 : (*f)->least_size ? (*f)->least_size - 1 : -2;
			assert_int_equal(spd_generate(&s, *f, &o, &e), -1);
			assert_int_equal(e.code, STATUS_INPUT);
			assert_non_null(strstr(e.text, (*f)->name));
			scene_free(&s);
		}
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(bytes_of_the_originals),
		cmocka_unit_test(counts_of_the_formulas),
		cmocka_unit_test(old_balls_differ_from_size_3_on),
		cmocka_unit_test(spheres_are_closed),
		cmocka_unit_test(soups_are_unit_right_triangles),
		cmocka_unit_test(soups_of_scenes_keep_their_surface),
		cmocka_unit_test(rooms_have_their_counts),
		cmocka_unit_test(rooms_are_seen_from_inside),
		cmocka_unit_test(sizes_out_of_range_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
