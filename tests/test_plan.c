/* Shards: who does which row, and what becomes of the parts. */
#include "tests/check.h"

#include "base/rng.h"
#include "batch/merge.h"
#include "batch/plan.h"
#include "batch/record.h"
#include "batch/run.h"

#include <inttypes.h>
#include <string.h>
#include <unistd.h>

enum { ROWS = 500 };

static uint64_t busiest(const uint32_t *assigned, const uint64_t *costs, size_t count, uint32_t shards)
{
	uint64_t most = 0;
	for (uint32_t s = 0; s < shards; s++) {
		uint64_t load = 0;
		for (size_t i = 0; i < count; i++)
			load += assigned[i] == s ? costs[i] : 0;
		most = load > most ? load : most;
	}
	return most;
}

/* Whatever the order in which the rows are listed, a key goes to the same shard, and no shard waits: the busiest has at most the mean
 * and a share of one row (Graham 1966). */
static void rows_go_by_key(void **state)
{
	(void)state;
	static const uint32_t shards[] = { 1, 2, 3, 16, 499, 1000 };
	uint64_t costs[ROWS], keys[ROWS], costs_back[ROWS], keys_back[ROWS], all = 0, most = 0;
	uint32_t there[ROWS], back[ROWS];
	struct err e = { 0 };
	for (size_t i = 0; i < ROWS; i++) {
		keys[i] = keys_back[ROWS - 1 - i] = rng_mix(i);
		costs[i] = costs_back[ROWS - 1 - i] = 1 + rng_mix(~i) % (i % 3 ? 1000 : 3); /* with many ties */
		all += costs[i];
		most = costs[i] > most ? costs[i] : most;
	}
	for (size_t n = 0; n < sizeof shards / sizeof *shards; n++) {
		assert_int_equal(plan_assign(there, costs, keys, ROWS, shards[n], &e), 0);
		assert_int_equal(plan_assign(back, costs_back, keys_back, ROWS, shards[n], &e), 0);
		for (size_t i = 0; i < ROWS; i++) {
			assert_true(there[i] < shards[n]);
			assert_int_equal(there[i], back[ROWS - 1 - i]);
		}
		double bound = (double)all / shards[n] + (double)most * (1 - 1.0 / shards[n]) + ROWS;
		assert_true((double)busiest(there, costs, ROWS, shards[n]) <= bound);
	}
}

/* Never worse than 4/3 - 1/(3 N) of the best there is (Graham 1969), found by trying all. */
static void longest_first_is_near_the_best(void **state)
{
	(void)state;
	enum { FEW = 8, SHARDS = 3, ALL = 6561 };
	struct err e = { 0 };
	for (uint64_t turn = 0; turn < 40; turn++) {
		uint64_t costs[FEW], keys[FEW], best = UINT64_MAX;
		uint32_t assigned[FEW];
		for (uint64_t i = 0; i < FEW; i++) {
			keys[i] = i;
			costs[i] = 1000 * (1 + rng_mix(turn * FEW + i) % 50);
		}
		for (uint32_t code = 0; code < ALL; code++) {
			uint32_t rest = code;
			for (size_t i = 0; i < FEW; i++, rest /= SHARDS)
				assigned[i] = rest % SHARDS;
			uint64_t load = busiest(assigned, costs, FEW, SHARDS);
			best = load < best ? load : best;
		}
		assert_int_equal(plan_assign(assigned, costs, keys, FEW, SHARDS, &e), 0);
		assert_true((double)busiest(assigned, costs, FEW, SHARDS) <= (4.0 / 3 - 1.0 / 9) * (double)best + FEW);
	}
}

static const char job_text[] =
	"name: plan\nseed: 5\nscenes: [{spd: tetra, size: [1, 2]}, {spd: balls, size: 1}]\n"
	"structures: [octree: {max_objects: [2, 5], max_depth: 3}, list]\n"
	"measure: [{rays: invariant, count: 500}, {rays: lines, count: 500}]\n";

static void run_shard(const struct job *job, const char *folder, uint32_t shard, uint32_t shards)
{
	const struct run_options o = { .folder = folder, .version = "test", .threads = 1, .shard = shard, .shards = shards };
	struct run_result result;
	struct text table = { 0 };
	struct err e = { 0 };
	if (run_job(job, &o, &result, &table, &e) != 0)
		fail_msg("%s", e.text);
	text_free(&table);
}

static struct text read_counts(const char *folder)
{
	char path[300];
	struct text t = { 0 };
	struct err e = { 0 };
	snprintf(path, sizeof path, "%s/counts.csv", folder);
	if (text_read_file(&t, path, 1 << 20, &e) != 0)
		fail_msg("%s", e.text);
	return t;
}

static void replace_first(const char *folder, const char *old, const char *new)
{
	char path[300];
	struct text t = read_counts(folder);
	char *at = strstr(t.bytes, old);
	struct err e = { 0 };
	assert_non_null(at);
	assert_int_equal(strlen(old), strlen(new));
	memcpy(at, new, strlen(new));
	snprintf(path, sizeof path, "%s/counts.csv", folder);
	assert_int_equal(text_write_file(&t, path, &e), 0);
	text_free(&t);
}

static void shards_come_together(void **state)
{
	(void)state;
	char folder[] = "/tmp/raycost-test-XXXXXX", whole[100], parts[100], shard[200], command[300];
	struct job job;
	struct plan plan = { 0 };
	struct merge_result result;
	struct text missing = { 0 }, want, got;
	struct err e = { 0 }, differ = { 0 }, none = { 0 };
	assert_non_null(mkdtemp(folder));
	snprintf(whole, sizeof whole, "%s/whole", folder);
	snprintf(parts, sizeof parts, "%s/parts", folder);
	assert_int_equal(job_parse(&job, "plan.yaml", job_text, strlen(job_text), &(struct job_options){ 0 }, &e), 0);
	assert_int_equal(merge_shards(whole, &result, &missing, &none), -1);
	assert_non_null(strstr(none.text, "no shards"));
	run_shard(&job, whole, 0, 0);
	want = read_counts(whole);

	/* The plan has the record's keys in the record's order. */
	assert_int_equal(plan_make(&plan, &job, 3, NULL, &e), 0);
	assert_int_equal(plan.count, 18);
	const char *line = line_next(want.bytes);
	for (size_t i = 0; i < plan.count; i++, line = line_next(line)) {
		char key[20];
		snprintf(key, sizeof key, "%016" PRIx64, plan.keys[i]);
		assert_int_equal(strncmp(line, key, KEY_LENGTH), 0);
	}

	/* Two of three shards: the keys of the third are missing, exactly. */
	run_shard(&job, parts, 0, 3);
	run_shard(&job, parts, 2, 3);
	assert_int_equal(merge_shards(parts, &result, &missing, &e), 0);
	size_t of_third = 0;
	for (size_t i = 0; i < plan.count; i++) {
		char key[20];
		snprintf(key, sizeof key, "%016" PRIx64 "\n", plan.keys[i]);
		assert_int_equal(strstr(missing.bytes, key) != NULL, plan.shards[i] == 1);
		of_third += plan.shards[i] == 1;
	}
	assert_int_equal(result.missing, of_third);
	run_shard(&job, parts, 1, 3);
	run_shard(&job, parts, 0, 2); /* rows twice: equal ones fold */
	text_free(&missing);
	assert_int_equal(merge_shards(parts, &result, &missing, &e), 0);
	assert_int_equal(result.missing + result.failed, 0);
	got = read_counts(parts);
	assert_string_equal(got.bytes, want.bytes);

	/* A row that is not what the other shard says it is. */
	snprintf(shard, sizeof shard, "%s/shards/0-of-2", parts);
	replace_first(shard, ",500,", ",501,");
	assert_int_equal(merge_shards(parts, &result, &missing, &differ), -1);
	assert_int_equal(differ.code, STATUS_INPUT);
	assert_non_null(strstr(differ.text, "0-of-2"));
	assert_non_null(strstr(differ.text, "differ in the row of key"));

	text_free(&got);
	text_free(&want);
	text_free(&missing);
	plan_free(&plan);
	job_free(&job);
	snprintf(command, sizeof command, "rm -rf %s", folder);
	assert_int_equal(system(command), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(rows_go_by_key),
		cmocka_unit_test(longest_first_is_near_the_best),
		cmocka_unit_test(shards_come_together),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
