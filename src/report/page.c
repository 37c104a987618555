#include "report/page.h"

#include "report/claims.h"
#include "report/figures.h"
#include "report/grids.h"
#include "report/interiors.h"
#include "report/ladder.h"
#include "report/rows.h"
#include "report/subramanian.h"
#include "report/volumes.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char head[] =
	"<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
	"<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>%s</title>\n<style>\n"
	"body { font: 16px/1.5 system-ui, sans-serif; color: #1b2733; background: #f6f8fa; margin: 0 auto; padding: 1rem; max-width: 1240px }\n"
	"h1 { font-size: 1.6rem; margin: .5rem 0 } h2 { font-size: 1.2rem; margin: 2rem 0 .5rem }\n"
	".figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%%, 520px), 1fr)); gap: 1rem }\n"
	"figure { margin: 0; padding: .8rem; background: #fff; border: 1px solid #d8dee4; border-radius: 6px; overflow-x: auto }\n"
	"figure svg { width: 100%%; height: auto; min-width: 420px; display: block }\n"
	"figcaption { font-size: .9rem; color: #44525f } figcaption b { display: block; color: #1b2733 }\n"
	".wide { overflow: auto; max-height: 40rem; background: #fff; border: 1px solid #d8dee4; border-radius: 6px }\n"
	"table { border-collapse: collapse; font-size: .85rem } td, th { padding: .25rem .6rem; text-align: left; vertical-align: top }\n"
	"th { position: sticky; top: 0; background: #e7ecf1; cursor: pointer; white-space: nowrap } td.n { text-align: right }\n"
	"tr:nth-child(even) td { background: #f6f8fa } .claims td { min-width: 9rem } .claims { width: 100%% }\n"
	"@media (max-width: 640px) { .claims td { min-width: 0 } .claims th { white-space: normal } figure svg { min-width: 0 } }\n"
	"</style>\n</head>\n<body>\n<h1>%s</h1>\n";

static const char tail[] =
	"<script>\n"
	"for (const table of document.querySelectorAll('table'))\n"
	"  table.querySelectorAll('th').forEach((th, i) => {\n"
	"    th.tabIndex = 0;\n"
	"    const sort = () => {\n"
	"      const up = th.dataset.up !== '1';\n"
	"      th.dataset.up = up ? '1' : '';\n"
	"      const value = row => { const x = row.cells[i].textContent; return x === '' || isNaN(x) ? x : +x; };\n"
	"      const order = (a, b) => { const p = value(a), q = value(b);\n"
	"        const d = typeof p === 'number' && typeof q === 'number' ? p - q : String(p).localeCompare(String(q));\n"
	"        return up ? d : -d; };\n"
	"      const body = table.tBodies[0];\n"
	"      [...body.rows].sort(order).forEach(row => body.append(row));\n"
	"    };\n"
	"    th.addEventListener('click', sort);\n"
	"    th.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });\n"
	"  });\n"
	"</script>\n</body>\n</html>\n";

static void add_escaped(struct text *out, const char *s)
{
	for (; *s; s++) {
		const char *entity = *s == '<' ? "&lt;" : *s == '>' ? "&gt;" : *s == '&' ? "&amp;" : *s == '"' ? "&quot;" : NULL;
		text_add(out, entity ? entity : s, entity ? strlen(entity) : 1);
	}
}

/* An SVG file's <svg> element, with its names made the figure's own: a page holds many. */
static void add_svg(struct text *page, const char *svg, const char *figure)
{
	static const char *const marks[] = { "id=\"", "id='", "href=\"#", "href='#", "url(#" };
	const char *p = strstr(svg, "<svg");
	while (p && *p) {
		size_t i = 0;
		while (i < sizeof marks / sizeof *marks && strncmp(p, marks[i], strlen(marks[i])) != 0)
			i++;
		if (i == sizeof marks / sizeof *marks) {
			text_add(page, p++, 1);
			continue;
		}
		text_print(page, "%s%s-", marks[i], figure);
		p += strlen(marks[i]);
	}
}

static int add_figure(struct text *page, const struct figure *f, const struct plot *plot, const char *folder, bool *drawn, struct err *e)
{
	char path[4200];
	struct text svg = { 0 };
	if (plot_draw(plot, folder, drawn, e) != 0)
		return -1;
	if (!*drawn)
		return 0;
	snprintf(path, sizeof path, "%s/plots/%s.svg", folder, f->name);
	if (text_read_file(&svg, path, (size_t)1 << 28, e) != 0)
		return -1;
	text_print(page, "<figure id=\"%s\">", f->name);
	add_svg(page, svg.bytes, f->name);
	text_print(page, "<figcaption><b>%s</b>%s <a href=\"plots/%s.gp\">script</a>, <a href=\"plots/%s.dat\">data</a></figcaption></figure>\n",
	           f->title, f->caption, f->name, f->name);
	text_free(&svg);
	return 0;
}

static int add_figures(struct text *page, const struct table *t, const char *folder, struct text *said, struct err *e)
{
	bool missing = false;
	int status = 0;
	text_print(page, "<h2>Figures</h2>\n<div class=\"figures\">\n");
	for (const struct figure *f = figures; status == 0 && f->name; f++) {
		struct plot plot = { .name = f->name };
		bool drawn = true;
		if (f->fill(&plot, t, folder))
			status = add_figure(page, f, &plot, folder, &drawn, e);
		missing |= !drawn;
		plot_free(&plot);
	}
	text_print(page, "</div>\n");
	if (missing)
		text_print(said, "gnuplot is missing: the scripts are in %s/plots, but nothing is drawn\n", folder);
	return status;
}

static void add_claims(struct text *page, const struct table *t)
{
	bool any = false;
	for (const struct claim *c = claims; c->place; c++) {
		struct text measured = { 0 };
		c->measure(&measured, t);
		if (measured.size && !any)
			text_print(page, "<h2>What the paper said, what we measured</h2>\n<div class=\"wide\"><table class=\"claims\"><thead><tr><th>place"
			           "</th><th>Aronov et al. 2002</th><th>here</th></tr></thead><tbody>\n");
		if (measured.size)
			text_print(page, "<tr><td>%s</td><td>%s</td><td>%s</td></tr>\n", c->place, c->said, measured.bytes);
		any |= measured.size > 0;
		page->lost |= measured.lost;
		text_free(&measured);
	}
	if (any)
		text_print(page, "</tbody></table></div>\n");
}

static void add_rows(struct text *page, const struct table *t)
{
	static const char *const shown[] = { "scene", "triangles", "structure", "builder", "traversal", "optimise", "criterion", "balanced", "max_objects", "root", "run", "workload",
		"rays", "status", "nodes", "leaves", "predicted", "predicted_exact", "predicted_volumes", "sah", "epo", "dq", "lcv", "replay", "calibrated", "actual", "actual_se", "ratio",
		"ratio_exact", "ratio_volumes", "ratio_replay", "ratio_calibrated", "z_exact", "overhead_predicted", "overhead_actual" };
	text_print(page, "<h2>Every row</h2>\n<p>A click on a head sorts. All columns are in <a href=\"counts.csv\">counts.csv</a>.</p>\n"
	                 "<div class=\"wide\"><table><thead><tr>");
	for (size_t c = 0; c < sizeof shown / sizeof *shown; c++)
		text_print(page, "<th>%s</th>", shown[c]);
	text_print(page, "</tr></thead><tbody>\n");
	for (size_t i = 0; i < t->rows; i++) {
		text_print(page, "<tr>");
		for (size_t c = 0; c < sizeof shown / sizeof *shown; c++) {
			const char *field = table_text(t, i, shown[c]);
			double x = table_number(t, i, shown[c]);
			bool whole = strspn(field, "0123456789") == strlen(field);
			text_print(page, x == x && *field && strchr("0123456789-.", *field) ? "<td class=\"n\">" : "<td>");
			if (*field && strchr("0123456789-", *field) && !whole)
				text_print(page, "%.5g", x);
			else
				add_escaped(page, field);
			text_print(page, "</td>");
		}
		text_print(page, "</tr>\n");
	}
	text_print(page, "</tbody></table></div>\n");
}

int report_write(const char *folder, struct text *said, struct err *e)
{
	char path[4200];
	struct table t = { 0 }, times = { 0 };
	struct text page = { 0 };
	snprintf(path, sizeof path, "%s/counts.csv", folder);
	int status = table_read(&t, path, e);
	snprintf(path, sizeof path, "%s/times.csv", folder);
	if (status == 0 && access(path, R_OK) == 0)
		status = table_read(&times, path, e);
	if (status == 0)
		status = rows_prepare(&t, e);
	if (status == 0) {
		const char *job = t.rows ? table_text(&t, 0, "job") : "no rows";
		text_print(&page, head, job, job);
		text_print(&page, "<p>%zu rows: what a ray was predicted to cost in each structure, and what it cost.</p>\n", t.rows);
		add_claims(&page, &t);
		subramanian_print(&page, &t, &times);
		grids_print(&page, &t);
		interiors_print(&page, &t, &times);
		volumes_add(&page, &t);
		status = ladder_add(&page, &t, folder, e);
	}
	if (status == 0) {
		status = add_figures(&page, &t, folder, said, e);
		add_rows(&page, &t);
		text_add(&page, tail, sizeof tail - 1);
	}
	snprintf(path, sizeof path, "%s/report.html", folder);
	if (status == 0)
		status = page.lost ? err_memory(e, "report") : text_write_file(&page, path, e);
	if (status == 0)
		text_print(said, "%s\n", path);
	text_free(&page);
	table_free(&t);
	table_free(&times);
	return status;
}
