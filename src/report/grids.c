#include "report/grids.h"

static bool is_grid(const struct table *t, size_t row)
{
	return table_is(t, row, "structure", "grid") && table_is(t, row, "status", "ok") &&
	       (table_is(t, row, "mailbox", "none") || table_is(t, row, "mailbox", ""));
}

static void print_row(struct text *out, const struct table *t, size_t row)
{
	static const char *const texts[] = { "scene", "setting", "density", "resolution", "leaves", "empty_leaves", "references", "workload" };
	static const char *const numbers[] = { "actual_tests", "predicted_tests", "actual_leaves", "predicted_leaves" };
	text_print(out, "<tr>");
	for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
		text_print(out, "<td%s>%s</td>", i > 1 && i < 7 ? " class=\"n\"" : "", table_text(t, row, texts[i]));
	for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
		text_print(out, "<td class=\"n\">%.4g</td>", table_number(t, row, numbers[i]));
	text_print(out, "</tr>\n");
}

void grids_print(struct text *out, const struct table *t)
{
	bool any = false;
	for (size_t i = 0; i < t->rows; i++) {
		if (!is_grid(t, i))
			continue;
		if (!any)
			text_print(out, "<h2>Uniform grids</h2>\n<p>In the terms of the literature: N<sub>V</sub> cells, N<sub>EV</sub> empty ones, "
			           "N<sub>OIV</sub> references; a ray N<sub>IT</sub> tests and N<sub>ETS</sub> cells. 'expected' is exact for random rays.</p>\n"
			           "<div class=\"wide\"><table><thead><tr><th>scene</th><th>setting</th><th>density</th><th>resolution</th>"
			           "<th>N_V</th><th>N_EV</th><th>N_OIV</th><th>rays</th><th>N_IT</th><th>expected</th><th>N_ETS</th>"
			           "<th>expected</th></tr></thead><tbody>\n");
		any = true;
		print_row(out, t, i);
	}
	if (any)
		text_print(out, "</tbody></table></div>\n");
}
