/* Job files: what they expand to, what is refused and with which words. */
#include "tests/check.h"

#include "batch/csv.h"
#include "batch/job.h"
#include "batch/row.h"
#include "batch/yaml.h"

#include <dirent.h>
#include <string.h>
#include <unistd.h>

/* A job file of this text; returns the status, fills *job and *e. */
static int read_job(struct job *job, const char *text, const char *const *settings, size_t count, struct err *e)
{
	char path[] = "/tmp/raycost-test-XXXXXX";
	int fd = mkstemp(path);
	assert_true(fd >= 0);
	assert_int_equal(write(fd, text, strlen(text)), (ssize_t)strlen(text));
	close(fd);
	int status = job_read(job, path, &(struct job_options){ .settings = settings, .setting_count = count }, e);
	unlink(path);
	return status;
}

static const char head[] = "name: t\nvars: {size: [1, 2], k: 3, text: tetra}\n";

static void lists_are_swept_last_key_fastest(void **state)
{
	(void)state;
	struct job job;
	struct err e = { 0 };
	char text[1000], variant[200];
	static const char *const want[] = {
		"octree balanced=false max_objects=2 root=cube max_depth=3 overlap=exact criterion=objects",
		"octree balanced=false max_objects=2 root=box max_depth=3 overlap=exact criterion=objects",
		"octree balanced=false max_objects=5 root=cube max_depth=3 overlap=exact criterion=objects",
		"octree balanced=false max_objects=5 root=box max_depth=3 overlap=exact criterion=objects",
		"octree balanced=true max_objects=2 root=cube max_depth=3 overlap=exact criterion=objects",
		"octree balanced=true max_objects=2 root=box max_depth=3 overlap=exact criterion=objects",
		"octree balanced=true max_objects=5 root=cube max_depth=3 overlap=exact criterion=objects",
		"octree balanced=true max_objects=5 root=box max_depth=3 overlap=exact criterion=objects",
		"list root=box",
	};
	snprintf(text, sizeof text, "%sseed: 9\nscenes: [{spd: \"${text}\", size: ${size}}, {spd: balls, tessellate: [false, true]}]\n"
	         "structures:\n  - octree: {balanced: [false, true], max_objects: [2, 5], root: [cube, box], max_depth: ${k}}\n"
	         "  - list\nmeasure: [{rays: [invariant, lines], count: [10, 20]}, {rays: invariant, sides: one, alpha: 0.5}]\n", head);
	if (read_job(&job, text, NULL, 0, &e) != 0)
		fail_msg("%s", e.text);
	assert_string_equal(job.name, "t");
	assert_int_equal(job.seed, 9);
	assert_int_equal(job.scene_count, 4);
	assert_string_equal(job.scenes[0].name, "tetra-1");
	assert_string_equal(job.scenes[1].name, "tetra-2");
	assert_string_equal(job.scenes[2].name, "balls-4");
	assert_string_equal(job.scenes[3].name, "balls-4-tessellate");
	assert_int_equal(job.structure_count, 9);
	for (size_t i = 0; i < 9; i++) {
		structure_print(&job.structures[i], variant, sizeof variant);
		assert_string_equal(variant, want[i]);
	}
	assert_int_equal(job.measure_count, 5);
	assert_true(job.measures[2].rays == RAYS_LINES && job.measures[2].count == 10 && job.measures[3].count == 20);
	assert_true(job.measures[4].sides == SIDES_ONE && job.measures[4].alpha == 0.5 && job.measures[4].beta == 1);
	job_free(&job);
}

static void experiments_keep_to_themselves(void **state)
{
	(void)state;
	struct job job;
	struct err e = { 0 };
	static const char text[] =
		"name: t\nseed: 7\nexperiments:\n"
		"  - scenes: [{spd: tetra, size: [2, 3]}]\n    structures: [{octree: {max_objects: [2, 5]}}]\n"
		"    measure: [{render: {width: 8, height: [4, 8], preset: spd}}]\n"
		"  - scenes: [{spd: tetra, size: 3}]\n    structures: [{octree: {criterion: random, runs: 3}}, list]\n"
		"    measure: [{rays: invariant, count: [10, 20, 30], sides: ext}]\n";
	if (read_job(&job, text, NULL, 0, &e) != 0)
		fail_msg("%s", e.text);
	assert_int_equal(job.experiment_count, 2);
	assert_int_equal(job_rows(&job), 2 * 2 * 2 + 1 * 4 * 3);
	assert_int_equal(job.experiments[1].scene_first, 2);
	assert_int_equal(job.experiments[1].structure_count, 4);
	char variant[200];
	for (size_t i = 0; i < 3; i++) {
		char want[200];
		structure_print(&job.structures[2 + i], variant, sizeof variant);
		snprintf(want, sizeof want, "octree balanced=false root=box max_depth=8 overlap=exact criterion=random root_level=0 run=%zu "
		         "seed=7", i + 1);
		assert_string_equal(variant, want);
	}
	measure_print(&job.measures[1], variant, sizeof variant);
	assert_string_equal(variant, "render preset=spd width=8 height=8 sampling=corners shadows=all ray_depth=5 weight=0 "
	                             "pilot_width=32 pilot_height=32 alpha=1 beta=1");
	job_free(&job);
}

static void settings_override_variables(void **state)
{
	(void)state;
	char text[1000];
	snprintf(text, sizeof text, "%sscenes: [{spd: tetra, size: ${size}}]\nstructures: [list]\nmeasure: [{rays: invariant}]\n", head);
	static const char *const good[] = { "size=4,5,6" };
	struct job job;
	struct err e = { 0 };
	assert_int_equal(read_job(&job, text, good, 1, &e), 0);
	assert_int_equal(job.scene_count, 3);
	assert_int_equal(job.scenes[2].spd.size, 6);
	job_free(&job);
	/* What a shell or a maker of paths might stumble over is data here, and not a number. */
	static const char *const bad[] = { "size=1,2; rm x", "size=$(id)", "size=", "size", "depth=3", "size=../../x", "size=1e99", "size=,1" };
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		struct err fault = { 0 };
		assert_int_equal(read_job(&job, text, &bad[i], 1, &fault), -1);
		assert_int_equal(fault.code, STATUS_INPUT);
		assert_true(strlen(fault.text) > 0);
		job_free(&job);
	}
}

static void too_many_rows_must_be_meant(void **state)
{
	(void)state;
	struct job job;
	struct err e = { 0 };
	char text[4000] = "name: t\nscenes: [{spd: soup, count: 10, seed: [", *p = text + strlen(text);
	for (int i = 0; i < 60; i++)
		p += sprintf(p, "%d,", i);
	p += sprintf(p, "60]}]\nstructures:\n  - octree: {max_objects: [1,2,3,4,5,6,7,8,9,10], max_depth: [1,2,3,4,5,6,7,8,9,10],"
	             " balanced: [false, true]}\nmeasure: [{rays: invariant, count: [1,2,3,4,5,6,7,8,9,10]}]\n");
	assert_int_equal(read_job(&job, text, NULL, 0, &e), -1);
	assert_non_null(strstr(e.text, "--many"));
	job_free(&job);
}

/* Every tests/bad/NAME.yaml is refused with the words of NAME.yaml.expect. */
static void bad_jobs_say_why(void **state)
{
	(void)state;
	int seen = 0;
	DIR *folder = opendir("tests/bad");
	assert_non_null(folder);
	for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
		char path[512], expect[600], want[4096] = "";
		size_t length = strlen(entry->d_name);
		if (length < 5 || strcmp(entry->d_name + length - 5, ".yaml") != 0)
			continue;
		snprintf(path, sizeof path, "tests/bad/%s", entry->d_name);
		snprintf(expect, sizeof expect, "%s.expect", path);
		FILE *f = fopen(expect, "r");
		assert_non_null(f);
		size_t n = fread(want, 1, sizeof want - 1, f);
		fclose(f);
		assert_true(n > 0);
		want[n - 1] = '\0'; /* the last newline */
		struct job job;
		struct err e = { 0 };
		assert_int_equal(job_read(&job, path, &(struct job_options){ 0 }, &e), -1);
		assert_int_equal(e.code, STATUS_INPUT);
		assert_string_equal(e.text, want);
		job_free(&job);
		seen++;
	}
	closedir(folder);
	assert_true(seen >= 20);
}

static void yaml_has_limits(void **state)
{
	(void)state;
	struct arena mem = { 0 };
	struct err deep = { 0 }, many = { 0 };
	size_t n = 300000;
	char *text = malloc(n + 16);
	assert_non_null(text);
	memset(text, '[', 100000);
	assert_null(yaml_parse("deep", text, 100000, &mem, &deep));
	assert_non_null(strstr(deep.text, "32 deep"));
	memset(text, ',', n);
	for (size_t i = 1; i < n; i += 2)
		text[i] = '1';
	text[0] = '[';
	text[n] = ']';
	assert_null(yaml_parse("many", text, n + 1, &mem, &many));
	assert_non_null(strstr(many.text, "100000 values"));
	free(text);
	arena_free(&mem);
}

static void csv_fields_come_back(void **state)
{
	(void)state;
	static const char *const fields[] = { "plain", "", "a,b", "say \"no\"", "\"", "x" };
	struct text line = { 0 };
	char field[64];
	for (int i = 0; i < 6; i++)
		csv_add(&line, fields[i], i == 0);
	text_add(&line, "\nnext,line\n", 11);
	assert_non_null(strstr(line.bytes, "plain,,\"a,b\",\"say \"\"no\"\"\",\"\"\"\",x\n"));
	for (int i = 0; i < 6; i++) {
		assert_true(csv_field(line.bytes, i, field, sizeof field));
		assert_string_equal(field, fields[i]);
	}
	assert_false(csv_field(line.bytes, 6, field, sizeof field));
	text_free(&line);
}

static void columns_are_unique_and_explained(void **state)
{
	(void)state;
	static const char *const promised[] = {
		"scene", "family", "size", "triangles", "spheres", "structure", "balanced", "max_objects", "root", "max_depth", "overlap",
		"workload", "rays", "seed", "status", "nodes", "leaves", "empty_leaves", "references", "depth", "root_area", "object_area",
		"predicted", "predicted_two_sided", "predicted_exact", "predicted_leaves", "predicted_tests", "predicted_inner_step",
		"predicted_inner_start", "actual", "actual_se", "actual_leaves", "actual_tests", "actual_inner_step", "actual_inner_start",
		"actual_hits", "ratio", "ratio_exact", "z_exact", "overhead_predicted", "overhead_actual",
	};
	for (size_t i = 0; i < sizeof promised / sizeof *promised; i++)
		assert_true(row_column(promised[i]) >= 0);
	for (int i = 0; row_columns[i].name; i++) {
		assert_int_equal(row_column(row_columns[i].name), i);
		assert_true(strlen(row_columns[i].text) > 5);
	}
	/* Every option of every structure and every image has its column, but for those a job expands. */
	for (const struct accel_ops *const *ops = accel_all; *ops; ops++)
		for (const struct key *k = (*ops)->keys; k->name; k++)
			assert_true(row_column(k->name) >= 0 || strcmp(k->name, "runs") == 0);
	for (const struct key *k = measure_image_keys; k->name; k++)
		assert_true(row_column(k->name) >= 0 || strcmp(k->name, "preset") == 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(lists_are_swept_last_key_fastest),
		cmocka_unit_test(experiments_keep_to_themselves),
		cmocka_unit_test(settings_override_variables),
		cmocka_unit_test(too_many_rows_must_be_meant),
		cmocka_unit_test(bad_jobs_say_why),
		cmocka_unit_test(yaml_has_limits),
		cmocka_unit_test(csv_fields_come_back),
		cmocka_unit_test(columns_are_unique_and_explained),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
