/* Two records of one job held against each other, with a verdict. */
#ifndef REPORT_COMPARE_H
#define REPORT_COMPARE_H

#include "report/measured.h"
#include "io/text.h"

enum { RULES_MOST = 32 };

/* How far a column may move. Columns of counts.csv: either way, in every row; they are deterministic, and a change is to be explained.
 * Columns of times.csv: for the worse (more; of rays_per_second, less), as the median over all rows. */
struct compare_rule {
	char column[64];
	double threshold; /* a share of the old value if relative, else an absolute difference */
	bool relative;
};

enum compare_format { COMPARE_TEXT, COMPARE_MARKDOWN, COMPARE_CSV };

struct compare_options {
	struct compare_rule rules[RULES_MOST];
	int rule_count; /* 0: every column of counts.csv must be equal */
	bool lenient;   /* rows that only one side has are no fault */
	enum compare_format format;
};

/* What came of it. */
struct compare_result {
	size_t compared, missing, added, faults; /* rows; rows missing in the new record; new rows; things that fail */
};

/* "COLUMN:1%" or "COLUMN:0.5" into *rule; false if it is neither. */
bool compare_parse_rule(struct compare_rule *rule, const char *text);

/* The median of values[n], which are sorted here, and an interval that holds the true one with 95 % whatever the distribution, from
 * order statistics: (low, high) = (-INFINITY, INFINITY) below six values. */
void compare_median(double *values, size_t n, double *median, double *low, double *high);

/* Append the report. 0, or -1 and *e: a rule's column is in neither record, memory. */
int compare_print(struct text *out, struct measured *base, struct measured *now, const struct compare_options *o,
                  struct compare_result *result, struct err *e);

#endif
