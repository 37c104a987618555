#include "report/volumes.h"

#include <math.h>

/* predicted / actual over the rows of one workload, and of one structure or all. */
struct span {
	double low, high;
	size_t rows, inside;
};

static bool is_ordered(const struct table *t, size_t row, const char *workload, const char *structure)
{
	return table_is(t, row, "status", "ok") && (!structure || table_is(t, row, "structure", structure)) &&
	       table_is(t, row, "workload", workload) && !(table_is(t, row, "structure", "bvh") && !table_is(t, row, "traversal", "ordered")) &&
	       table_number(t, row, "sah") > 0;
}

static struct span span_of(const struct table *t, const char *workload, const char *structure, double (*ratio)(const struct table *, size_t),
                           double low, double high)
{
	struct span s = { INFINITY, -INFINITY, 0, 0 };
	for (size_t i = 0; i < t->rows; i++) {
		if (!is_ordered(t, i, workload, structure))
			continue;
		double x = ratio(t, i);
		s.low = fmin(s.low, x);
		s.high = fmax(s.high, x);
		s.rows++;
		s.inside += x >= low && x <= high;
	}
	return s;
}

static double exact(const struct table *t, size_t row)
{
	return table_number(t, row, "ratio_volumes");
}

static double replayed(const struct table *t, size_t row)
{
	return table_number(t, row, "ratio_replay");
}

static double sah_alone(const struct table *t, size_t row)
{
	return table_number(t, row, "sah") / table_number(t, row, "actual");
}

static double without_path(const struct table *t, size_t row)
{
	double share = table_number(t, row, "surface_share");
	return ((1 - share) * table_number(t, row, "sah") + share * table_number(t, row, "epo")) / table_number(t, row, "actual");
}

void volumes_add(struct text *page, const struct table *t)
{
	static const struct {
		const char *name, *workload, *structure;
		double (*ratio)(const struct table *, size_t);
	} lines[] = {
		{ "SAH alone, random rays", "invariant", NULL, sah_alone },
		{ "(1 - share) SAH + share EPO, random rays", "invariant", NULL, without_path },
		{ "(1 - share) SAH + share (EPO + DQ), random rays, bvh", "invariant", "bvh", exact },
		{ "the same, bvh8", "invariant", "bvh8", exact },
		{ "the same, images", "render", NULL, exact },
		{ "replay of a pilot, images", "render", NULL, replayed },
	};
	bool any = false;
	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
		struct span s = span_of(t, lines[i].workload, lines[i].structure, lines[i].ratio, 0.92, 1.03);
		if (s.rows && !any)
			text_print(page, "<h2>Cost of bounding volume hierarchies</h2>\n<p>Predicted over what a traversal costs that finds the nearest hit: 1.2 an inner "
			                 "node, 1 a primitive. bvh visits boxes in the order the ray comes into them, none in vain; bvh8 goes depth "
			                 "first.</p>\n<div class=\"wide\"><table><thead><tr><th>predictor</th><th>rows</th><th>lowest</th><th>highest</th>"
			                 "<th>within 0.92 .. 1.03</th></tr></thead><tbody>\n");
		if (s.rows)
			text_print(page, "<tr><td>%s</td><td class=\"n\">%zu</td><td class=\"n\">%.3f</td><td class=\"n\">%.3f</td><td class=\"n\">%zu</td></tr>\n",
			           lines[i].name, s.rows, s.low, s.high, s.inside);
		any |= s.rows > 0;
	}
	if (any)
		text_print(page, "</tbody></table></div>\n");
}
