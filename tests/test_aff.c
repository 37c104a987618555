/* The AFF dialect of NFF: meshes, textured triangles, transforms, included files, and what is skipped. */
#include "tests/check.h"

#include "base/rng.h"
#include "io/aff.h"
#include "io/nff.h"
#include "io/text.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int read_named(struct scene *s, const char *name, const char *text, bool strict, struct nff_skipped *skipped, struct err *e)
{
	const struct read_options o = { .strict = strict };
	return aff_read(s, name, text, strlen(text), &o, skipped, e);
}

static struct scene must_read(const char *text)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct nff_skipped skipped;
	if (read_named(&s, "t.aff", text, true, &skipped, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

static void must_refuse(const char *text, const char *why)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct nff_skipped skipped;
	assert_int_equal(read_named(&s, "t.aff", text, true, &skipped, &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	assert_string_equal(e.text, why);
	scene_free(&s);
}

static void assert_vec(struct vec got, double x, double y, double z)
{
	assert_near(got.x, x, 1e-12);
	assert_near(got.y, y, 1e-12);
	assert_near(got.z, z, 1e-12);
}

/* Whatever NFF says, AFF says too. */
static void nff_is_a_part(void **state)
{
	(void)state;
	for (const struct spd_family *const *f = spd_families; *f; f++) {
		struct err e = { 0 };
		struct scene made = { 0 }, read = { 0 };
		struct text first = { 0 }, second = { 0 };
		struct nff_skipped skipped;
		struct spd_options o;
		key_defaults(spd_keys, &o);
		o.size = !(*f)->default_size ? SPD_DEFAULT_SIZE : (*f)->least_size > 1 ? (*f)->least_size : 1;
		o.count = 100;
		assert_int_equal(spd_generate(&made, *f, &o, &e), 0);
		assert_int_equal(nff_write(&made, 17, &first, &e), 0);
		assert_int_equal(read_named(&read, "t.aff", first.bytes, true, &skipped, &e), 0);
		assert_int_equal(nff_write(&read, 17, &second, &e), 0);
		assert_string_equal(first.bytes, second.bytes);
		scene_free(&made);
		scene_free(&read);
		text_free(&first);
		text_free(&second);
	}
}

static void records_of_its_own(void **state)
{
	(void)state;
	struct scene s = must_read("% a comment\nfm 0 0 0 .5 .6 .7 .1 .3 .2 20 .25 1.5\nla sun 1 2 3 .5 .5 .5\nla moon 3 2 1\n"
	                           "tt wood.ppm 0 0 0 0 0 1 0 0 1 0 0 1 0 0 1\n"
	                           "ttp wood.ppm 0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 0 1\n"
	                           "tpa 2 0 0 0 0 0 0 1 2 0 0 0 0 1 0 2 0 0 0 1 1 9 9 9 0 0 1 2 9 9 0 0 1 9 2 9 0 0 1\n");
	assert_int_equal(s.light_count, 2);
	assert_true(s.lights[0].colored && s.lights[0].color.g == 0.5 && !s.lights[1].colored);
	assert_int_equal(s.material_count, 1);
	assert_true(s.materials[0].color.g == 0.6 && s.materials[0].ks == 0.3 && s.materials[0].transmit == 0.25 && s.materials[0].ior == 1.5);
	assert_int_equal(s.object_count, 3);
	assert_true(s.objects[0].kind == OBJECT_POLYGON && s.objects[1].kind == OBJECT_PATCH && s.objects[2].kind == OBJECT_PATCH);
	assert_true(s.points[s.objects[2].first + 1].x == 2); /* the first of two positions */
	scene_free(&s);
}

static void meshes(void **state)
{
	(void)state;
	struct scene s = must_read("m vertices 4 0 0 0 1 0 0 1 1 0 0 1 0 triangles 2 0 1 2 0 2 3\n"
	                           "m vertices 3 0 0 0 1 0 0 0 1 0 normals 1 0 0 1 texturecoords 3 a.ppm 0 0 1 0 0 1 triangles 1 2 1 0 0 0 0 0 1 2\n");
	assert_int_equal(s.object_count, 3);
	assert_true(s.objects[0].kind == OBJECT_POLYGON && s.objects[2].kind == OBJECT_PATCH);
	assert_vec(s.points[s.objects[1].first + 2], 0, 1, 0);
	assert_vec(s.points[s.objects[2].first], 0, 1, 0);
	assert_vec(s.points[s.objects[2].first + 4], 0, 0, 1);
	scene_free(&s);
}

/* Scale, then turn, then move; the inner transform acts first. */
static void transforms(void **state)
{
	(void)state;
	struct scene s = must_read("xs 2 2 2 0 0 1 90 10 0 0 { s 1 0 0 1 la a 1 0 0\n xs 1 1 1 0 0 0 0 0 0 3 { c 0 0 0 1 0 0 1 2 } }\n"
	                           "s 1 0 0 1\n");
	assert_int_equal(s.object_count, 3);
	assert_vec(s.points[s.objects[0].first], 10, 2, 0);
	assert_near(s.objects[0].radius[0], 2, 1e-12);
	assert_vec(s.lights[0].at, 10, 2, 0);
	assert_vec(s.points[s.objects[1].first], 10, 0, 6);
	assert_vec(s.points[s.objects[1].first + 1], 10, 0, 8);
	assert_near(s.objects[1].radius[1], 4, 1e-12);
	assert_vec(s.points[s.objects[2].first], 1, 0, 0);
	scene_free(&s);
}

/* A mirrored triangle faces the same side as its mirrored normal; an ellipsoid is a mesh whose normals point outward. */
static void transforms_keep_front_and_back(void **state)
{
	(void)state;
	struct scene s = must_read("f 1 0 0 1 0 1 0 1 f 0 1 0 1 0 1 0 1 xs -1 1 3 0 0 0 0 0 0 0 { p 3 0 0 0 1 0 0 0 1 0\n"
	                           "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 s 5 0 0 1 }\n");
	assert_int_equal(s.object_count, 2 + 12 * SPD_RESOLUTION * SPD_RESOLUTION);
	for (size_t i = 0; i < s.object_count; i++) {
		const struct vec *p = &s.points[s.objects[i].first];
		struct vec n = vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0]));
		struct vec out = i < 2 ? vec(0, 0, 1) : vec_sub(p[0], vec(-5, 0, 0));
		assert_int_equal(s.objects[i].material, 1);
		assert_true(vec_dot(n, out) > 0);
		if (s.objects[i].kind == OBJECT_PATCH)
			assert_true(vec_dot(p[3], out) > 0);
		if (i >= 2) /* on the ellipsoid of half axes 1, 1, 3 */
			assert_near(out.x * out.x + out.y * out.y + out.z * out.z / 9, 1, 1e-12);
	}
	scene_free(&s);
}

static void motion_is_skipped_or_refused(void **state)
{
	(void)state;
	static const char text[] = "a 0 1 30\nd 2\nam 1 1 1\nk box { transl 1 0 0 0 0 0 0 0 0 0 0 }\nx box { s 0 0 0 1 }\ns 1 1 1 1\n";
	struct err e = { 0 };
	struct scene s = { 0 };
	struct nff_skipped skipped;
	assert_int_equal(read_named(&s, "t.aff", text, false, &skipped, &e), 0);
	assert_int_equal(s.object_count, 2);
	assert_int_equal(skipped.records, 5);
	assert_int_equal(skipped.first_line, 1);
	scene_free(&s);
	must_refuse("\nd 2", "t.aff:2: 'd' is not part of a scene that stands still");
}

static void faults_say_where(void **state)
{
	(void)state;
	must_refuse("xs 1 1 1 0 0 0 0 0 0 0 { s 0 0 0 1", "t.aff:1: a transform whose '}' is missing");
	must_refuse("s 0 0 0 1\n}", "t.aff:2: '}' without '{'");
	must_refuse("xs 0 1 1 0 0 0 0 0 0 0 { }", "t.aff:1: a transform that scales by 0");
	must_refuse("xs 1 1 1 0 0 0 9 0 0 0 { }", "t.aff:1: a turn about no axis");
	must_refuse("xs 1 1 1 0 0 0 0 0 0 0 s 1 1 1 1", "t.aff:1: a transform: 's' where '{' should be");
	must_refuse("m vertices 3 0 0 0 1 0 0 0 1 0\ntriangles 1 0 1 3", "t.aff:2: a mesh has no element 3: it has 3");
	must_refuse("m vertices 1 0 0 0 triangles 1 0 0 0.5", "t.aff:1: a mesh has no element 0.5: it has 1");
	must_refuse("m vertices 900000000 0 0 0", "t.aff:1: vertices of 900000000 corners cannot fit in the rest of the file");
	must_refuse("m vertices 1 0 0 0 faces 1", "t.aff:1: a mesh has vertices, normals, texturecoords and triangles, not 'faces'");
	must_refuse("m", "t.aff:1: the file ends within a mesh");
	must_refuse("la sun 1 2 3 4", "t.aff:1: a light has 3 or 6 numbers, not 4");
	must_refuse("i nowhere.aff", "t.aff:1: nowhere.aff: no such file there, nor in the include folders");
	must_refuse("nff\nversion 2", "t.aff:1: this is WorldToolKit (Sense8) NFF, another format of the same name");
}

static void write_file(const char *folder, const char *name, const char *text)
{
	char path[256];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	FILE *f = fopen(path, "w");
	assert_non_null(f);
	fputs(text, f);
	fclose(f);
}

/* Beside the file that names it, then in the folders; a loop ends; nothing outside is read. */
static void included_files(void **state)
{
	(void)state;
	char folder[] = "/tmp/raycost-aff-XXXXXX", name[64], other[64];
	assert_non_null(mkdtemp(folder));
	snprintf(name, sizeof name, "%s/main.aff", folder);
	snprintf(other, sizeof other, "%s/other", folder);
	assert_int_equal(mkdir(other, 0700), 0);
	write_file(folder, "part.aff", "s 1 0 0 1\ni deep.aff\n");
	write_file(other, "deep.aff", "s 2 0 0 1\n");
	write_file(folder, "loop.aff", "s 0 0 0 1\ni loop.aff\n");
	write_file(folder, "open.aff", "xs 1 1 1 0 0 0 0 0 0 0 {\n");
	write_file(folder, "close.aff", "} xs 1 1 1 0 0 0 0 0 0 0 {\n");
	write_file(folder, "bad.aff", "\ns 1 2\n");
	static const struct {
		const char *text, *why; /* why: behind the folder; NULL: it is read */
	} cases[] = {
		{ "i part.aff\ns 3 0 0 1\n", NULL },
		{ "xs 1 1 1 0 0 0 0 1 0 0 { i part.aff }\ns 3 0 0 1\n", NULL },
		{ "i loop.aff", "/loop.aff:2: files include files more than 16 deep, or 1000 times in all" },
		{ "i open.aff", "/main.aff:1: open.aff has more '{' than '}'" },
		{ "xs 1 1 1 0 0 0 0 0 0 0 { i close.aff }", "/close.aff:1: '}' without '{'" },
		{ "i bad.aff", "/bad.aff:3: the file ends within a sphere" },
		{ "i /etc/passwd", "/main.aff:1: /etc/passwd: no such file there, nor in the include folders" },
		{ "i ../../etc/passwd", "/main.aff:1: ../../etc/passwd: no such file there, nor in the include folders" },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		struct nff_skipped skipped;
		const struct read_options o = { .strict = true, .include = other };
		int status = aff_read(&s, name, cases[i].text, strlen(cases[i].text), &o, &skipped, &e);
		assert_int_equal(status, cases[i].why ? -1 : 0);
		if (cases[i].why)
			assert_string_equal(e.text + strlen(folder), cases[i].why);
		else
			for (int k = 0; k < 3; k++)
				assert_vec(s.points[s.objects[k].first], k + 1 + (k < 2 ? (double)i : 0), 0, 0);
		scene_free(&s);
	}
	static const char *const files[] = { "part.aff", "other/deep.aff", "loop.aff", "open.aff", "close.aff", "bad.aff" };
	for (int i = 0; i < 6; i++) {
		char path[256];
		snprintf(path, sizeof path, "%s/%s", folder, files[i]);
		unlink(path);
	}
	rmdir(other);
	rmdir(folder);
}

/* Whatever is flipped or cut: an error or a scene, never a crash. */
static void mutations_do_no_harm(void **state)
{
	(void)state;
	static const char good[] = "fm 0 0 0 1 1 1 0 0 0 1 0 1\nla a 1 2 3\nxs 2 2 1 0 0 1 45 1 0 0 {\ns 0 0 0 1\nm vertices 3 0 0 0 1 0 0 0 1 0\n"
	                           "normals 1 0 0 1\ntriangles 1 0 1 2 0 0 0\n}\ntt a.ppm 0 0 0 0 0 1 0 0 0 1 0 1 0 1 1\nk b { transl }\nx b { d 1 }\n";
	int refused = 0;
	for (uint64_t i = 0; i < 10000; i++) {
		char text[sizeof good];
		struct err e = { 0 };
		struct scene s = { 0 };
		struct nff_skipped skipped;
		uint64_t key = rng_key(5, 5, i);
		size_t n = sizeof good - 1;
		memcpy(text, good, sizeof good);
		for (uint64_t k = 0; k < 1 + i % 3; k++)
			text[(size_t)((double)n * rng_uniform(key, 2 * k + 1))] = (char)(32 + 96 * rng_uniform(key, 2 * k + 2));
		text[i % 5 ? n : (size_t)((double)n * rng_uniform(key, 0))] = '\0';
		refused += read_named(&s, "t.aff", text, i % 2, &skipped, &e) != 0;
		scene_free(&s);
	}
	assert_true(refused > 1000 && refused < 10000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nff_is_a_part),
		cmocka_unit_test(records_of_its_own),
		cmocka_unit_test(meshes),
		cmocka_unit_test(transforms),
		cmocka_unit_test(transforms_keep_front_and_back),
		cmocka_unit_test(motion_is_skipped_or_refused),
		cmocka_unit_test(faults_say_where),
		cmocka_unit_test(included_files),
		cmocka_unit_test(mutations_do_no_harm),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
