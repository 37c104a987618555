#include "report/compare.h"

#include "batch/csv.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Findings that people are shown; a CSV report has all. */
enum { SHOWN_MOST = 50 };

struct comparison {
	struct text *out;
	struct measured *base, *now;
	const struct compare_options *options;
	struct compare_result *result;
	size_t shown;
};

bool compare_parse_rule(struct compare_rule *rule, const char *text)
{
	const char *colon = strchr(text, ':');
	char *end;
	if (!colon || colon == text || (size_t)(colon - text) >= sizeof rule->column || !strchr("0123456789.", colon[1]) || !colon[1])
		return false;
	snprintf(rule->column, sizeof rule->column, "%.*s", (int)(colon - text), text);
	rule->threshold = strtod(colon + 1, &end);
	rule->relative = *end == '%';
	if (rule->relative) {
		rule->threshold /= 100;
		end++;
	}
	return *end == '\0' && end > colon + 1 && isfinite(rule->threshold);
}

/* One line of the report; 'head' for the line under which others stand. */
static void print_line(struct comparison *c, const char *const *cells, int count, bool head)
{
	struct text *out = c->out;
	for (int i = 0; i < count; i++) {
		if (c->options->format == COMPARE_CSV)
			csv_add(out, cells[i], i == 0);
		else if (c->options->format == COMPARE_MARKDOWN)
			text_print(out, "| %s ", cells[i]);
		else
			text_print(out, i == 0 ? "%-8s" : i + 1 < count ? "  %-14s" : "  %s", cells[i]);
	}
	text_print(out, c->options->format == COMPARE_MARKDOWN ? "|\n" : "\n");
	if (head && c->options->format == COMPARE_MARKDOWN) {
		for (int i = 0; i < count; i++)
			text_print(out, "|---");
		text_print(out, "|\n");
	}
}

/* "fail" or "ok", the column, both values, the change, the row. */
static void print_finding(struct comparison *c, bool fails, const char *column, const char *old, const char *new, const char *change,
                          const char *row)
{
	const char *const cells[] = { fails ? "fail" : "ok", column, old, new, change, row };
	c->result->faults += fails;
	if (c->options->format == COMPARE_CSV || c->shown++ < SHOWN_MOST)
		print_line(c, cells, 6, false);
}

static bool parse_number(const char *text, double *x)
{
	char *end;
	*x = strtod(text, &end);
	return *text && *end == '\0';
}

/* Whether the change is within the rule; describes it. */
static bool is_within(const struct compare_rule *rule, const char *old, const char *new, char *change, size_t size)
{
	double x, y;
	*change = '\0';
	if (strcmp(old, new) == 0)
		return true;
	if (!parse_number(old, &x) || !parse_number(new, &y))
		return false;
	snprintf(change, size, x != 0 ? "%+.3g%%" : "%+.3g", x != 0 ? 100 * (y - x) / fabs(x) : y);
	return rule && fabs(y - x) <= rule->threshold * (rule->relative ? fabs(x) : 1);
}

static void compare_field(struct comparison *c, const struct named_row *old, const struct named_row *new, const char *column,
                          const struct compare_rule *rule)
{
	char change[32];
	const char *x = measured_text(c->base, old, column), *y = measured_text(c->now, new, column);
	if (!is_within(rule, x, y, change, sizeof change))
		print_finding(c, true, column, x, y, change, old->name);
}

/* Columns that say how a row was found, not what came out. */
static bool is_beside(const char *column)
{
	return strcmp(column, "key") == 0 || strcmp(column, "job") == 0 || strcmp(column, "status") == 0 || strcmp(column, "message") == 0;
}

static void compare_row(struct comparison *c, const struct named_row *old, const struct named_row *new)
{
	const struct compare_options *o = c->options;
	const char *was = measured_text(c->base, old, "status"), *is = measured_text(c->now, new, "status");
	c->result->compared++;
	if (strcmp(was, is) != 0) {
		print_finding(c, strcmp(is, "ok") != 0, "status", was, is, "", old->name);
		return;
	}
	for (int i = 0; i < o->rule_count; i++)
		if (!measured_is_time(c->now, o->rules[i].column))
			compare_field(c, old, new, o->rules[i].column, &o->rules[i]);
	for (size_t i = 0; o->rule_count == 0 && i < c->base->counts.columns; i++)
		if (!is_beside(c->base->counts.names[i]) && measured_has(c->now, c->base->counts.names[i]))
			compare_field(c, old, new, c->base->counts.names[i], NULL);
}

static int compare_doubles(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

void compare_median(double *values, size_t n, double *median, double *low, double *high)
{
	/* The k smallest lie below the median with a probability that the binomial distribution of n and 1/2 tells. */
	size_t k = 0;
	double below = ldexp(1, -(int)(n < 1000 ? n : 1000)), term = below;
	if (n < 1000) {
		while (below <= 0.025) {
			k++;
			term *= (double)(n - k + 1) / (double)k;
			below += term;
		}
	} else {
		k = (size_t)((double)n / 2 - 0.98 * sqrt((double)n));
	}
	qsort(values, n, sizeof *values, compare_doubles);
	*median = n == 0 ? NAN : n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
	*low = k > 0 ? values[k - 1] : -INFINITY;
	*high = k > 0 ? values[n - k] : INFINITY;
}

/* The median ratio new / old over all rows. Times that go to and fro give a wide interval, and no verdict. */
static int compare_times(struct comparison *c, const struct compare_rule *rule, struct err *e)
{
	const struct measured *base = c->base, *now = c->now;
	double *ratios = malloc((base->counts.rows + 1) * sizeof *ratios), median, low, high;
	bool less_is_worse = strcmp(rule->column, "rays_per_second") == 0;
	char limit[32], measured[64], row[64];
	size_t n = 0;
	if (!ratios)
		return err_memory(e, "compare");
	for (size_t i = 0; i < base->counts.rows; i++) {
		const struct named_row *old = &base->rows[i], *new = measured_find(now, old);
		double x, y;
		if (new && parse_number(measured_text(base, old, rule->column), &x) && parse_number(measured_text(now, new, rule->column), &y) &&
		    x > 0 && y > 0)
			ratios[n++] = y / x;
	}
	compare_median(ratios, n, &median, &low, &high);
	free(ratios);
	double limit_ratio = less_is_worse ? 1 - rule->threshold : 1 + rule->threshold;
	snprintf(limit, sizeof limit, "%s %.4g", less_is_worse ? ">=" : "<=", limit_ratio);
	snprintf(measured, sizeof measured, "%.4g", median);
	snprintf(row, sizeof row, "95 %% interval %.4g..%.4g, %zu rows", low, high, n);
	print_finding(c, less_is_worse ? high < limit_ratio : low > limit_ratio, rule->column, limit, measured, "median ratio", row);
	return 0;
}

static int check_rules(const struct comparison *c, struct err *e)
{
	for (int i = 0; i < c->options->rule_count; i++) {
		const struct compare_rule *rule = &c->options->rules[i];
		if (!measured_has(c->base, rule->column) || !measured_has(c->now, rule->column))
			return err_at(e, STATUS_INPUT, NULL, 0, "no column '%s' in both records", rule->column);
		if (measured_is_time(c->now, rule->column) && !rule->relative)
			return err_at(e, STATUS_INPUT, NULL, 0, "%s: the threshold of a time is a percentage", rule->column);
	}
	return 0;
}

int compare_print(struct text *out, struct measured *base, struct measured *now, const struct compare_options *o,
                  struct compare_result *result, struct err *e)
{
	struct comparison c = { out, base, now, o, result, 0 };
	static const char *const head[] = { "verdict", "column", "old", "new", "change", "row" };
	*result = (struct compare_result){ 0 };
	if (check_rules(&c, e) != 0)
		return -1;
	print_line(&c, head, 6, true);
	for (int i = 0; i < o->rule_count; i++)
		if (measured_is_time(now, o->rules[i].column) && compare_times(&c, &o->rules[i], e) != 0)
			return -1;
	for (size_t i = 0; i < base->counts.rows; i++) {
		const struct named_row *new = measured_find(now, &base->rows[i]);
		result->missing += !new;
		if (new)
			compare_row(&c, &base->rows[i], new);
		else
			print_finding(&c, !o->lenient, "", "there", "missing", "", base->rows[i].name);
	}
	for (size_t i = 0; i < now->counts.rows; i++)
		if (!measured_find(base, &now->rows[i])) {
			result->added++;
			print_finding(&c, false, "", "missing", "there", "", now->rows[i].name);
		}
	if (o->format == COMPARE_CSV)
		return 0;
	if (c.shown > SHOWN_MOST)
		text_print(out, "%sand %zu more\n", o->format == COMPARE_MARKDOWN ? "\n" : "", c.shown - SHOWN_MOST);
	text_print(out, "%s%zu rows compared, %zu missing, %zu new: %s\n", o->format == COMPARE_MARKDOWN ? "\n" : "", result->compared,
	           result->missing, result->added, result->faults ? "worse" : "good");
	return 0;
}
