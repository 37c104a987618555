/* Reading and writing NFF: what is tolerated, what is refused and how, and that nothing is lost on the way. */
#include "tests/check.h"

#include "base/rng.h"
#include "io/nff.h"

#include <dirent.h>
#include <string.h>

static int read_text(struct scene *s, const char *text, bool strict, struct nff_skipped *skipped, struct err *e)
{
	return nff_read(s, "t.nff", text, strlen(text), strict, skipped, e);
}

static struct scene must_read(const char *text)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct nff_skipped skipped;
	if (read_text(&s, text, true, &skipped, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

/* Write, read, write: the same bytes, for every family and both modes. */
static void written_scenes_read_back(void **state)
{
	(void)state;
	for (const struct spd_family *const *f = spd_families; *f; f++)
		for (int i = 0; i < 4; i++) {
			struct err e = { 0 };
			struct scene made = { 0 }, read = { 0 };
			struct text first = { 0 }, second = { 0 };
			struct nff_skipped skipped;
			struct spd_options o;
			int digits = i & 1 ? 17 : 6;
			key_defaults(spd_keys, &o);
			o.size = !(*f)->default_size ? SPD_DEFAULT_SIZE : (*f)->least_size > 1 ? (*f)->least_size : 1;
			o.tessellate = i & 2;
			o.count = 100;
			assert_int_equal(spd_generate(&made, *f, &o, &e), 0);
			assert_int_equal(nff_write(&made, digits, &first, &e), 0);
			if (nff_read(&read, "t.nff", first.bytes, first.size, true, &skipped, &e) != 0)
				fail_msg("%s", e.text);
			assert_int_equal(nff_write(&read, digits, &second, &e), 0);
			assert_int_equal(first.size, second.size);
			assert_memory_equal(first.bytes, second.bytes, first.size);
			assert_int_equal(read.material_count, made.material_count);
			if (digits == 17) {
				assert_int_equal(read.point_count, made.point_count);
				assert_memory_equal(read.points, made.points, made.point_count * sizeof *made.points);
			}
			scene_free(&made);
			scene_free(&read);
			text_free(&first);
			text_free(&second);
		}
}

static void white_space_and_comments_are_free(void **state)
{
	(void)state;
	struct scene s = must_read("\xef\xbb\xbf# head\r\nv from 1 2 3 up 0 0 1 at 4 5 6\n\fangle 45 #x\nb 0 .5 1. l 1 2 3 l 1 2 3 .1 .2 .3\n"
	                           "f 1 1 1 1 0 1e5 0 0 s 0 0 0\n+1 c 0 0 0 1\n0 0 1 1 p 3 -0 0 0\t1 0 0 0 1e-16 1\ns 1 2 3 -2");
	assert_true(s.view.given && s.view.at.z == 6 && s.view.up.z == 1 && s.view.width == 512);
	assert_int_equal(s.light_count, 2);
	assert_true(!s.lights[0].colored && s.lights[1].colored && s.lights[1].color.b == 0.3);
	assert_int_equal(s.object_count, 4);
	assert_true(s.background.g == 0.5 && s.background.b == 1);
	assert_true(s.objects[3].radius[0] == -2);
	scene_free(&s);
}

static void long_keywords_and_any_order(void **state)
{
	(void)state;
	struct scene s = must_read("sphere 0 0 0 1\nsurface 1 1 1 1 0 1 0 1\npatch 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n"
	                           "polygon 3 0 0 0 1 0 0 0 1 0 cone 0 0 0 0 0 0 1 2 background 1 1 1 light 0 0 9 viewpoint at 1 1 1");
	assert_int_equal(s.object_count, 4);
	assert_true(s.objects[0].material == NO_MATERIAL && s.objects[1].material == 0);
	assert_true(s.view.given && s.view.at.x == 1 && s.light_count == 1);
	scene_free(&s);
	s = must_read("");
	assert_int_equal(s.object_count, 0);
	scene_free(&s);
	s = must_read("b 1 0 0 v angle 10 b 0 1 0 v angle 20"); /* the last one counts */
	assert_true(s.background.g == 1 && s.view.angle == 20);
	scene_free(&s);
}

/* A short decimal is what strtod says it is. */
static void numbers_are_rounded_correctly(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 20000; i++) {
		char text[64];
		uint64_t key = rng_key(7, 7, i);
		int digits = 1 + (int)(20 * rng_uniform(key, 0)), exponent = (int)(60 * rng_uniform(key, 1)) - 30;
		snprintf(text, sizeof text, "s %.*ge%d 0 0 1", digits, 10 * rng_uniform(key, 2) - 5, exponent);
		if (strchr(text, 'e') != strrchr(text, 'e'))
			continue;
		struct scene s = must_read(text);
		double want = strtod(text + 2, NULL);
		assert_memory_equal(&s.points[0].x, &want, sizeof want);
		scene_free(&s);
	}
}

static void oddities_are_skipped_and_counted(void **state)
{
	(void)state;
	static const char *const odd[] = { "f 1 1 1 1 0 1 0 1\nzz 1 2 3\ns 0 0 0 1", "p 2 0 0 0 1 1 1\n\ns 0 0 0 1", "s 0 0 0 0 s 0 0 0 1" };
	static const uint32_t lines[] = { 2, 1, 1 };
	for (int i = 0; i < 3; i++) {
		struct err e = { 0 };
		struct scene s = { 0 }, t = { 0 };
		struct nff_skipped skipped;
		assert_int_equal(read_text(&s, odd[i], false, &skipped, &e), 0);
		assert_int_equal(s.object_count, 1);
		assert_int_equal(skipped.records, 1);
		assert_int_equal(skipped.first_line, lines[i]);
		assert_int_equal(read_text(&t, odd[i], true, &skipped, &e), -1);
		scene_free(&s);
		scene_free(&t);
	}
}

/* Every tests/bad/NAME.nff[.gz] says what NAME.nff[.gz].expect says. */
static void bad_files_say_why(void **state)
{
	(void)state;
	int seen = 0;
	DIR *folder = opendir("tests/bad");
	assert_non_null(folder);
	for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
		char path[512], expect[600], want[1024] = "";
		if (!strstr(entry->d_name, ".nff") || strstr(entry->d_name, ".expect"))
			continue;
		snprintf(path, sizeof path, "tests/bad/%s", entry->d_name);
		snprintf(expect, sizeof expect, "%s.expect", path);
		FILE *f = fopen(expect, "r");
		assert_non_null(f);
		assert_non_null(fgets(want, sizeof want, f));
		fclose(f);
		want[strcspn(want, "\n")] = '\0';
		struct err e = { 0 };
		struct text text = { 0 };
		struct scene s = { 0 };
		struct nff_skipped skipped;
		int status = text_read_file(&text, path, 1 << 20, &e);
		if (status == 0)
			status = nff_read(&s, path, text.bytes, text.size, true, &skipped, &e);
		assert_int_equal(status, -1);
		assert_int_equal(e.code, STATUS_INPUT);
		assert_string_equal(e.text, want);
		text_free(&text);
		scene_free(&s);
		seen++;
	}
	closedir(folder);
	assert_true(seen >= 12);
}

/* Whatever is flipped or cut: an error or a scene, never a crash. */
static void mutations_do_no_harm(void **state)
{
	(void)state;
	static const char good[] = "b 0 0 1\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 9 9\nl 1 2 3\n"
	                           "f 1 1 1 1 0 1 0 1\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\ns 0 0 0 1\nc 0 0 0 1 0 0 1 2\n"
	                           "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n";
	int refused = 0;
	for (uint64_t i = 0; i < 20000; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		struct primitives p = { 0 };
		struct nff_skipped skipped;
		uint64_t key = rng_key(3, 3, i);
		size_t n = (size_t)((double)sizeof good * rng_uniform(key, 0));
		char *text = malloc(n + 1);
		assert_non_null(text);
		memcpy(text, good, n);
		for (uint64_t k = 0; n > 0 && k < i % 4; k++)
			text[(size_t)((double)n * rng_uniform(key, 2 * k + 1))] = (char)(256 * rng_uniform(key, 2 * k + 2));
		if (nff_read(&s, "t.nff", text, n, i % 2, &skipped, &e) != 0)
			refused++;
		else
			primitives_make(&p, &s, CURVES_KEEP, 2, "t.nff", &e);
		primitives_free(&p);
		scene_free(&s);
		free(text);
	}
	assert_true(refused > 1000 && refused < 20000);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(written_scenes_read_back),
		cmocka_unit_test(white_space_and_comments_are_free),
		cmocka_unit_test(long_keywords_and_any_order),
		cmocka_unit_test(numbers_are_rounded_correctly),
		cmocka_unit_test(oddities_are_skipped_and_counted),
		cmocka_unit_test(bad_files_say_why),
		cmocka_unit_test(mutations_do_no_harm),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
