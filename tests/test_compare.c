/* Comparisons: what fails, what does not, and how sure a median is. */
#include "tests/check.h"

#include "base/rng.h"
#include "report/compare.h"
#include "report/history.h"

#include <string.h>
#include <unistd.h>

/* The ranks that tables of the sign test give for 95 %. */
static void intervals_of_the_median_are_those_of_the_tables(void **state)
{
	(void)state;
	static const size_t ranks[][2] = { { 6, 1 }, { 8, 1 }, { 9, 2 }, { 12, 3 }, { 20, 6 }, { 50, 18 }, { 100, 40 } };
	double values[2000], median, low, high;
	for (size_t r = 0; r < sizeof ranks / sizeof *ranks; r++) {
		size_t n = ranks[r][0], k = ranks[r][1];
		for (size_t i = 0; i < n; i++)
			values[i] = (double)(n - i);
		compare_median(values, n, &median, &low, &high);
		assert_near(median, ((double)n + 1) / 2, 0);
		assert_near(low, (double)k, 0);
		assert_near(high, (double)(n + 1 - k), 0);
	}
	values[0] = 3;
	compare_median(values, 1, &median, &low, &high);
	assert_true(median == 3 && low == -INFINITY && high == INFINITY);
	/* Both ways of finding the rank agree where one takes over from the other. */
	for (size_t n = 999; n <= 1000; n++) {
		for (size_t i = 0; i < n; i++)
			values[i] = (double)i;
		compare_median(values, n, &median, &low, &high);
		assert_near(low, 468, 1.5);
	}
}

/* Of many samples of a skewed distribution some 95 % of the intervals hold its median, ln 2. */
static void intervals_hold_the_median(void **state)
{
	(void)state;
	enum { SAMPLES = 4000, SIZE = 25 };
	int inside = 0;
	for (uint64_t s = 0; s < SAMPLES; s++) {
		double values[SIZE], median, low, high;
		for (uint64_t i = 0; i < SIZE; i++)
			values[i] = -log(1 - rng_uniform(rng_key(1, 2, s), i));
		compare_median(values, SIZE, &median, &low, &high);
		inside += low <= log(2) && log(2) <= high;
	}
	/* Exactly: 1 - 2 P(B(25, 1/2) <= 7) = 0.95671; four standard errors of the share. */
	assert_near((double)inside / SAMPLES, 0.95671, 4 * sqrt(0.95671 * 0.04329 / SAMPLES));
}

static void write_file(const char *folder, const char *name, const char *text)
{
	char path[300];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	FILE *f = fopen(path, "w");
	assert_non_null(f);
	fputs(text, f);
	fclose(f);
}

/* Records of ten rows, rates times a factor, one value changed, one row less. */
static void make_record(const char *folder, double rate, const char *cost_of_third, int rows)
{
	struct text counts = { 0 }, times = { 0 };
	text_print(&counts, "key,scene,structure,workload,rays,status,actual\n");
	text_print(&times, "key,rays_per_second,seconds_build\n");
	for (int i = 0; i < rows; i++) {
		text_print(&counts, "%s%d,s%d,list,invariant,100,ok,%s\n", folder, i, i, i == 3 ? cost_of_third : "2.5");
		text_print(&times, "%s%d,1,1\n", folder, i); /* an earlier try */
		text_print(&times, "%s%d,%g,%g\n", folder, i, 1e6 * rate * (1 + 0.01 * i), 1 / rate);
	}
	write_file(folder, "counts.csv", counts.bytes);
	write_file(folder, "times.csv", times.bytes);
	text_free(&counts);
	text_free(&times);
}

struct folders {
	char base[40], now[40];
};

static int open_folders(void **state)
{
	static struct folders f;
	strcpy(f.base, "/tmp/raycost-test-XXXXXX");
	strcpy(f.now, "/tmp/raycost-test-XXXXXX");
	*state = &f;
	return mkdtemp(f.base) && mkdtemp(f.now) ? 0 : -1;
}

static int close_folders(void **state)
{
	const struct folders *f = *state;
	char command[200];
	snprintf(command, sizeof command, "rm -rf %s %s", f->base, f->now);
	return system(command);
}

/* Compare under up to two rules; returns the faults. */
static size_t count_faults(const struct folders *f, const char *rule, const char *other, bool lenient, const char *says)
{
	struct measured both[2] = { 0 };
	struct compare_options o = { .lenient = lenient };
	struct compare_result result;
	struct text out = { 0 };
	struct err e = { 0 };
	const char *const rules[] = { rule, other };
	for (int i = 0; i < 2 && rules[i]; i++)
		assert_true(compare_parse_rule(&o.rules[o.rule_count++], rules[i]));
	if (measured_read(&both[0], f->base, &e) != 0 || measured_read(&both[1], f->now, &e) != 0 || measured_name(both, 2, &e) != 0 ||
	    compare_print(&out, &both[0], &both[1], &o, &result, &e) != 0)
		fail_msg("%s", e.text);
	assert_non_null(strstr(out.bytes, says));
	text_free(&out);
	measured_free(&both[0]);
	measured_free(&both[1]);
	return result.faults;
}

static void counts_fail_beyond_their_threshold(void **state)
{
	const struct folders *f = *state;
	make_record(f->base, 1, "2.5", 10);
	make_record(f->now, 1, "2.5", 10);
	assert_int_equal(count_faults(f, NULL, NULL, false, "10 rows compared, 0 missing, 0 new: good"), 0);
	make_record(f->now, 1, "2.55", 10);
	assert_int_equal(count_faults(f, NULL, NULL, false, "+2%"), 1);
	assert_int_equal(count_faults(f, "actual:1%", NULL, false, "s3 list invariant rays=100"), 1);
	assert_int_equal(count_faults(f, "actual:2.1%", NULL, false, "good"), 0);
	assert_int_equal(count_faults(f, "actual:0.04", NULL, false, "worse"), 1);
	assert_int_equal(count_faults(f, "actual:0.06", NULL, false, "good"), 0);
	make_record(f->now, 1, "2.45", 10); /* less is a change as well */
	assert_int_equal(count_faults(f, "actual:1%", NULL, false, "-2%"), 1);
	make_record(f->now, 1, "", 10);
	assert_int_equal(count_faults(f, "actual:50%", NULL, false, "worse"), 1);
}

static void missing_rows_fail_unless_lenient(void **state)
{
	const struct folders *f = *state;
	make_record(f->base, 1, "2.5", 10);
	make_record(f->now, 1, "2.5", 8);
	assert_int_equal(count_faults(f, NULL, NULL, false, "8 rows compared, 2 missing"), 2);
	assert_int_equal(count_faults(f, NULL, NULL, true, "8 rows compared, 2 missing"), 0);
}

static void times_fail_with_their_whole_interval(void **state)
{
	const struct folders *f = *state;
	make_record(f->base, 1, "2.5", 10);
	make_record(f->now, 0.8, "2.5", 10);
	assert_int_equal(count_faults(f, "rays_per_second:10%", "seconds_build:10%", false, "worse"), 2);
	assert_int_equal(count_faults(f, "rays_per_second:30%", "seconds_build:30%", false, "0.8..0.8, 10 rows"), 0);
	make_record(f->now, 1.5, "2.5", 10); /* better by much */
	assert_int_equal(count_faults(f, "rays_per_second:10%", "seconds_build:10%", false, "good"), 0);
	make_record(f->now, 0.5, "2.5", 5); /* too few rows to be sure */
	assert_int_equal(count_faults(f, "rays_per_second:10%", NULL, true, "-inf..inf, 5 rows"), 0);
}

static void rules_are_a_column_and_a_number(void **state)
{
	(void)state;
	struct compare_rule rule;
	assert_true(compare_parse_rule(&rule, "rays_per_second:12.5%"));
	assert_true(rule.relative && rule.threshold == 0.125 && strcmp(rule.column, "rays_per_second") == 0);
	static const char *const bad[] = { "", "actual", "actual:", ":1%", "actual:x", "actual:1%%", "actual:-1", "actual:1e999", "actual:nan" };
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
		assert_false(compare_parse_rule(&rule, bad[i]));
}

static void history_takes_the_rows_in_common(void **state)
{
	const struct folders *f = *state;
	struct measured runs[2] = { 0 };
	const char *const names[] = { "first", "second" };
	struct text out = { 0 };
	struct err e = { 0 };
	make_record(f->base, 1, "2.5", 10);
	make_record(f->now, 2, "9.5", 3);
	assert_int_equal(measured_read(&runs[0], f->base, &e), 0);
	assert_int_equal(measured_read(&runs[1], f->now, &e), 0);
	assert_int_equal(measured_name(runs, 2, &e), 0);
	assert_int_equal(history_write(&out, runs, names, 2, "rays_per_second", f->base, &e), 0);
	assert_non_null(strstr(out.bytes, "first          1010000\n"));
	assert_non_null(strstr(out.bytes, "second         2020000   +100.000%\n"));
	assert_non_null(strstr(out.bytes, "over the 3 rows that all 2 runs have"));
	assert_int_equal(history_write(&out, runs, names, 2, "nothing", f->base, &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	text_free(&out);
	measured_free(&runs[0]);
	measured_free(&runs[1]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(intervals_of_the_median_are_those_of_the_tables),
		cmocka_unit_test(intervals_hold_the_median),
		cmocka_unit_test_setup_teardown(counts_fail_beyond_their_threshold, open_folders, close_folders),
		cmocka_unit_test_setup_teardown(missing_rows_fail_unless_lenient, open_folders, close_folders),
		cmocka_unit_test_setup_teardown(times_fail_with_their_whole_interval, open_folders, close_folders),
		cmocka_unit_test(rules_are_a_column_and_a_number),
		cmocka_unit_test_setup_teardown(history_takes_the_rows_in_common, open_folders, close_folders),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
