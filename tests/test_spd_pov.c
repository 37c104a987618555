/* SPD scenes for POV-Ray: the bytes of the original programs. */
#include "tests/check.h"

#include "io/spd_pov.h"
#include "io/spd_split.h"
#include "scene/triangulate.h"
#include "spd/notes.h"

#include <string.h>
#include <zlib.h>

/* A family with its notes; both to be freed. */
static void generate(struct scene *s, struct spd_notes *notes, const char *family, int size, bool tessellate)
{
	struct err e = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = tessellate;
	*s = (struct scene){ .notes = notes };
	*notes = (struct spd_notes){ 0 };
	if (spd_generate(s, spd_find(family), &o, &e) != 0)
		fail_msg("%s", e.text);
}

/* Length and CRC-32 of what the original programs (SPD 3.14) print with -r 2, 3 and 4. */
static const struct {
	const char *family;
	int size;
	bool tessellate;
	int version;
	size_t length;
	unsigned long crc;
} originals[] = {
	{ "tetra", 1, false, 1, 1094, 0x369b4276 },
	{ "tetra", 1, false, 2, 1111, 0x455501d1 },
	{ "tetra", 1, false, 3, 1111, 0x3ddc22ab },
	{ "tetra", 1, true, 1, 1094, 0x369b4276 },
	{ "tetra", 1, true, 2, 1111, 0x455501d1 },
	{ "tetra", 1, true, 3, 1111, 0x3ddc22ab },
	{ "tetra", 2, false, 1, 2564, 0x7d45db52 },
	{ "tetra", 2, false, 2, 2677, 0xa161440d },
	{ "tetra", 2, false, 3, 2677, 0xa8560cb0 },
	{ "tetra", 2, true, 1, 2564, 0x7d45db52 },
	{ "tetra", 2, true, 2, 2677, 0xa161440d },
	{ "tetra", 2, true, 3, 2677, 0xa8560cb0 },
	{ "balls", 1, false, 1, 2085, 0x2e50e692 },
	{ "balls", 1, false, 2, 2064, 0xb4159eff },
	{ "balls", 1, false, 3, 2064, 0x2ac1ad7d },
	{ "balls", 1, true, 1, 310339, 0xc9c3122e },
	{ "balls", 1, true, 2, 325518, 0x43f586f2 },
	{ "balls", 1, true, 3, 325518, 0xb908c66a },
	{ "balls", 2, false, 1, 8833, 0x376a9ea4 },
	{ "balls", 2, false, 2, 8164, 0x7f6ceab2 },
	{ "balls", 2, false, 3, 8164, 0x34313811 },
	{ "balls", 2, true, 1, 2810041, 0x72e177d1 },
	{ "balls", 2, true, 2, 2947692, 0x9d8e49ad },
	{ "balls", 2, true, 3, 2947692, 0x7023e9f0 },
	{ "gears", 1, false, 1, 98115, 0x4d420ccf },
	{ "gears", 1, false, 2, 102693, 0x6dc1dc2e },
	{ "gears", 1, false, 3, 102693, 0x606cbf6e },
	{ "gears", 1, true, 1, 98115, 0x4d420ccf },
	{ "gears", 1, true, 2, 102693, 0x6dc1dc2e },
	{ "gears", 1, true, 3, 102693, 0x606cbf6e },
	{ "gears", 2, false, 1, 784579, 0x27d2a50d },
	{ "gears", 2, false, 2, 821971, 0x445ffc0f },
	{ "gears", 2, false, 3, 821971, 0x790f01b5 },
	{ "gears", 2, true, 1, 784579, 0x27d2a50d },
	{ "gears", 2, true, 2, 821971, 0x445ffc0f },
	{ "gears", 2, true, 3, 821971, 0x790f01b5 },
	{ "teapot", 1, false, 1, 12422, 0x971c8df9 },
	{ "teapot", 1, false, 2, 13425, 0x4fde5586 },
	{ "teapot", 1, false, 3, 13425, 0x217d884f },
	{ "teapot", 1, true, 1, 12422, 0x971c8df9 },
	{ "teapot", 1, true, 2, 13425, 0x4fde5586 },
	{ "teapot", 1, true, 3, 13425, 0x217d884f },
	{ "teapot", 2, false, 1, 59308, 0x69915720 },
	{ "teapot", 2, false, 2, 62935, 0x094e55ee },
	{ "teapot", 2, false, 3, 62935, 0x8bad5cf3 },
	{ "teapot", 2, true, 1, 59308, 0x69915720 },
	{ "teapot", 2, true, 2, 62935, 0x094e55ee },
	{ "teapot", 2, true, 3, 62935, 0x8bad5cf3 },
	{ "mount", 1, false, 1, 2195, 0x1ef3f2cb },
	{ "mount", 1, false, 2, 2337, 0xa7deecce },
	{ "mount", 1, false, 3, 2337, 0x2e3edc56 },
	{ "mount", 1, true, 1, 123282, 0xc6a49a89 },
	{ "mount", 1, true, 2, 129504, 0xbc4ecc2d },
	{ "mount", 1, true, 3, 129504, 0x1d4c449a },
	{ "mount", 2, false, 1, 5894, 0x14134fdf },
	{ "mount", 2, false, 2, 6228, 0xf7b3f109 },
	{ "mount", 2, false, 3, 6228, 0xe5285267 },
	{ "mount", 2, true, 1, 126981, 0x5c054616 },
	{ "mount", 2, true, 2, 133395, 0xc9d544db },
	{ "mount", 2, true, 3, 133395, 0xa783f37e },
	{ "rings", 1, false, 1, 15551, 0x09d2b1ab },
	{ "rings", 1, false, 2, 8544, 0xc80e9c77 },
	{ "rings", 1, false, 3, 8544, 0xb6858c1e },
	{ "rings", 1, true, 1, 1118536, 0x50a8ec38 },
	{ "rings", 1, true, 2, 1174635, 0x9c60dd47 },
	{ "rings", 1, true, 3, 1174635, 0x2f6b7b11 },
	{ "rings", 2, false, 1, 72611, 0x41c2c093 },
	{ "rings", 2, false, 2, 37560, 0xd026e038 },
	{ "rings", 2, false, 3, 37560, 0x4d1c43cb },
	{ "rings", 2, true, 1, 5512942, 0xf67fdea0 },
	{ "rings", 2, true, 2, 5793681, 0xcecbf76f },
	{ "rings", 2, true, 3, 5793681, 0xc54d87ca },
	{ "tree", 1, false, 1, 2995, 0x03750455 },
	{ "tree", 1, false, 2, 2137, 0xa5b616b9 },
	{ "tree", 1, false, 3, 2137, 0x1e9fd7be },
	{ "tree", 1, true, 1, 113366, 0x41209a08 },
	{ "tree", 1, true, 2, 118836, 0xb77ce992 },
	{ "tree", 1, true, 3, 118836, 0x025036ac },
	{ "tree", 2, false, 1, 4856, 0xd39b0a5c },
	{ "tree", 2, false, 2, 2957, 0x7c7659f4 },
	{ "tree", 2, false, 3, 2957, 0xa4b05f16 },
	{ "tree", 2, true, 1, 261431, 0xe85a15bb },
	{ "tree", 2, true, 2, 274293, 0xe712b534 },
	{ "tree", 2, true, 3, 274293, 0x5333a924 },
	{ "lattice", 1, false, 1, 8460, 0x8d442020 },
	{ "lattice", 1, false, 2, 7399, 0x2d8a7e80 },
	{ "lattice", 1, false, 3, 7399, 0x2d8ec976 },
	{ "lattice", 1, true, 1, 317154, 0x47e63dad },
	{ "lattice", 1, true, 2, 335293, 0x3fb0acfc },
	{ "lattice", 1, true, 3, 335293, 0x930d5a6b },
	{ "lattice", 2, false, 1, 32584, 0x580ab667 },
	{ "lattice", 2, false, 2, 27857, 0x5611c315 },
	{ "lattice", 2, false, 3, 27857, 0x9f7c9a07 },
	{ "lattice", 2, true, 1, 1147495, 0x65f1fad6 },
	{ "lattice", 2, true, 2, 1215416, 0x89dbcfe0 },
	{ "lattice", 2, true, 3, 1215416, 0xccc9e061 },
	{ "shells", 1, false, 1, 30813, 0xd1a50893 },
	{ "shells", 1, false, 2, 27919, 0xc344ef02 },
	{ "shells", 1, false, 3, 27919, 0xcab8dc1e },
	{ "shells", 1, true, 1, 11272607, 0x75fa0e95 },
	{ "shells", 1, true, 2, 11818433, 0xf39099bb },
	{ "shells", 1, true, 3, 11818433, 0x1bdcdcf0 },
	{ "shells", 2, false, 1, 60892, 0x991ccc85 },
	{ "shells", 2, false, 2, 55118, 0xa32f20f3 },
	{ "shells", 2, false, 3, 55118, 0x1ba2f730 },
	{ "sombrero", 1, false, 1, 719, 0x7c3b607f },
	{ "sombrero", 1, false, 2, 713, 0x6b151c78 },
	{ "sombrero", 1, false, 3, 713, 0x1a601564 },
	{ "sombrero", 1, true, 1, 719, 0x7c3b607f },
	{ "sombrero", 1, true, 2, 713, 0x6b151c78 },
	{ "sombrero", 1, true, 3, 713, 0x1a601564 },
	{ "sombrero", 2, false, 1, 719, 0x7c3b607f },
	{ "sombrero", 2, false, 2, 713, 0x6b151c78 },
	{ "sombrero", 2, false, 3, 713, 0x1a601564 },
	{ "sombrero", 2, true, 1, 719, 0x7c3b607f },
	{ "sombrero", 2, true, 2, 713, 0x6b151c78 },
	{ "sombrero", 2, true, 3, 713, 0x1a601564 },
	{ "jacks", 1, false, 1, 2391, 0x825c4f68 },
	{ "jacks", 1, false, 2, 1666, 0x5f50558c },
	{ "jacks", 1, false, 3, 1666, 0xab253013 },
	{ "jacks", 1, true, 1, 94964, 0xee5e45f1 },
	{ "jacks", 1, true, 2, 99662, 0xc98dde69 },
	{ "jacks", 1, true, 3, 99662, 0x4b42f6f5 },
	{ "jacks", 2, false, 1, 19843, 0x9653d13f },
	{ "jacks", 2, false, 2, 13750, 0x1f23f966 },
	{ "jacks", 2, false, 3, 13750, 0x3834f303 },
	{ "jacks", 2, true, 1, 842930, 0x06213b2e },
	{ "jacks", 2, true, 2, 885260, 0xc31345d7 },
	{ "jacks", 2, true, 3, 885260, 0xae1ff720 },
	{ "nurbtst", 1, false, 1, 421632, 0x2d375204 },
	{ "nurbtst", 1, false, 2, 442622, 0xc12161b2 },
	{ "nurbtst", 1, false, 3, 442622, 0x1c96676b },
	{ "nurbtst", 1, true, 1, 421632, 0x2d375204 },
	{ "nurbtst", 1, true, 2, 442622, 0xc12161b2 },
	{ "nurbtst", 1, true, 3, 442622, 0x1c96676b },
	{ "sample", 1, false, 1, 242867, 0x7af99f91 },
	{ "sample", 1, false, 2, 2034, 0xf34552e5 },
	{ "sample", 1, false, 3, 2034, 0x8e7a6caf },
	{ "sample", 1, true, 1, 250745, 0x5b59e6fb },
	{ "sample", 1, true, 2, 263759, 0xd4f04bb0 },
	{ "sample", 1, true, 3, 263759, 0x90b8fa21 },
};

static void bytes_of_the_originals(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof originals / sizeof *originals; i++) {
		struct err e = { 0 };
		struct scene s;
		struct spd_notes notes;
		struct text out = { 0 };
		generate(&s, &notes, originals[i].family, originals[i].size, originals[i].tessellate);
		assert_int_equal(spd_pov_write(&s, originals[i].version, &out, &e), 0);
		if (out.size != originals[i].length || crc32(0, (const Bytef *)out.bytes, (uInt)out.size) != originals[i].crc)
			fail_msg("%s -s %d %s for POV-Ray %d is not what the original prints", originals[i].family, originals[i].size,
			         originals[i].tessellate ? "-t" : "-c", originals[i].version);
		scene_free(&s);
		spd_notes_free(&notes);
		text_free(&out);
	}
}

static void height_fields_of_the_originals(void **state)
{
	(void)state;
	static const struct {
		size_t length;
		unsigned long crc;
	} images[2] = { { 3090, 0x2e2cfbe7 }, { 12306, 0xe91cac71 } };
	for (int size = 1; size <= 2; size++) {
		struct scene s;
		struct spd_notes notes;
		struct text out = { 0 };
		generate(&s, &notes, "sombrero", size, size == 2);
		spd_pov_image(&s, &out);
		assert_int_equal(out.size, images[size - 1].length);
		assert_int_equal(crc32(0, (const Bytef *)out.bytes, (uInt)out.size), images[size - 1].crc);
		text_free(&out);
		scene_free(&s);
		spd_notes_free(&notes);
	}
}

/* Asking for notes changes nothing in the scene. */
static void notes_leave_the_scene_alone(void **state)
{
	(void)state;
	static const char *const families[] = { "jacks", "sample", "sombrero", "rings" };
	for (int i = 0; i < 4; i++) {
		struct err e = { 0 };
		struct scene s, plain = { 0 };
		struct spd_notes notes;
		struct spd_options o;
		key_defaults(spd_keys, &o);
		generate(&s, &notes, families[i], SPD_DEFAULT_SIZE, false);
		assert_int_equal(spd_generate(&plain, spd_find(families[i]), &o, &e), 0);
		assert_int_equal(s.object_count, plain.object_count);
		assert_int_equal(s.point_count, plain.point_count);
		assert_memory_equal(s.points, plain.points, s.point_count * sizeof *s.points);
		assert_true(notes.finish_count > 0 && notes.finish_count <= s.material_count);
		scene_free(&s);
		scene_free(&plain);
		spd_notes_free(&notes);
	}
}

static double area_of(const struct vec *p, const uint32_t *triples, size_t n)
{
	double sum = 0;
	for (size_t i = 0; i < n; i++) {
		const uint32_t *t = triples + 3 * i;
		sum += vec_length(vec_cross(vec_sub(p[t[1]], p[t[0]]), vec_sub(p[t[2]], p[t[0]]))) / 2;
	}
	return sum;
}

/* The concave faces of a gear are covered once, by triangles turned like the face. */
static void gears_are_cut_without_overlap(void **state)
{
	(void)state;
	struct scene s;
	struct spd_notes notes;
	struct arena scratch = { 0 };
	int faces = 0;
	generate(&s, &notes, "gears", 1, false);
	for (size_t i = 0; i < s.object_count; i++) {
		const struct object *o = &s.objects[i];
		const struct vec *p = &s.points[o->first];
		if (o->count < 100)
			continue;
		uint32_t *spd = NEW(&scratch, uint32_t, 3 * o->count), *own = NEW(&scratch, uint32_t, 3 * o->count);
		assert_int_equal(spd_split(p, o->count, spd, &scratch), 0);
		assert_int_equal(triangulate_polygon(p, o->count, own, &scratch), 0);
		assert_near(area_of(p, spd, o->count - 2), area_of(p, own, o->count - 2), 1e-12);
		faces++;
	}
	assert_int_equal(faces, 2);
	arena_free(&scratch);
	scene_free(&s);
	spd_notes_free(&notes);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(bytes_of_the_originals),
		cmocka_unit_test(height_fields_of_the_originals),
		cmocka_unit_test(notes_leave_the_scene_alone),
		cmocka_unit_test(gears_are_cut_without_overlap),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
