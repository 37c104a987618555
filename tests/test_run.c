/* A small job from its file to its record: the very bytes, pinned. */
#include "tests/check.h"

#include "batch/run.h"

#include <string.h>
#include <unistd.h>

static const char text[] =
	"name: tiny\nseed: 2002\n"
	"scenes: [{spd: tetra, size: 2}, {spd: balls, size: 1}]\n"
	"structures:\n  - octree: {balanced: [false, true], max_objects: 2, root: cube, max_depth: 5}\n  - list\n"
	"measure: [{rays: invariant, count: 2000}, {rays: lines, count: 2000, beta: 0.5}]\n";

static void read_into(struct text *t, const char *folder, const char *name)
{
	char path[300];
	struct err e = { 0 };
	snprintf(path, sizeof path, "%s/%s", folder, name);
	if (text_read_file(t, path, 1 << 20, &e) != 0)
		fail_msg("%s", e.text);
	unlink(path);
}

static void record_of_a_small_job(void **state)
{
	(void)state;
	char folder[] = "/tmp/raycost-test-XXXXXX", path[200];
	struct err e = { 0 };
	struct job job;
	struct run_result result;
	struct text table = { 0 }, counts = { 0 }, times = { 0 }, manifest = { 0 };
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/tiny.yaml", folder);
	FILE *f = fopen(path, "w");
	assert_non_null(f);
	fputs(text, f);
	fclose(f);
	if (job_read(&job, path, &(struct job_options){ 0 }, &e) != 0 ||
	    run_job(&job, &(struct run_options){ .folder = folder, .version = "test", .threads = 2 }, &result, &table, &e) != 0)
		fail_msg("%s", e.text);
	assert_int_equal(result.added, 12);
	assert_int_equal(result.failed, 0);
	read_into(&counts, folder, "counts.csv");
	read_into(&times, folder, "times.csv");
	read_into(&manifest, folder, "manifest.json");
	assert_golden("tiny.csv", counts.bytes);
	assert_non_null(strstr(manifest.bytes, "\"version\": \"test\""));
	assert_non_null(strstr(manifest.bytes, "\"status\": 0"));
	assert_non_null(strstr(table.bytes, "12 rows, 0 failed"));
	text_free(&table);
	text_free(&counts);
	text_free(&times);
	text_free(&manifest);
	job_free(&job);
	unlink(path);
	snprintf(path, sizeof path, "%s/.lock", folder);
	unlink(path);
	rmdir(folder);
}

int main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(record_of_a_small_job) };
	return cmocka_run_group_tests(tests, NULL, NULL);
}
