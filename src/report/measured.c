#include "report/measured.h"

#include "batch/row.h"
#include "io/text.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int measured_read(struct measured *m, const char *folder, struct err *e)
{
	char path[4200];
	snprintf(path, sizeof path, "%s/counts.csv", folder);
	if (table_read(&m->counts, path, e) != 0)
		return -1;
	snprintf(path, sizeof path, "%s/times.csv", folder);
	return access(path, F_OK) == 0 ? table_read(&m->times, path, e) : 0;
}

void measured_free(struct measured *m)
{
	table_free(&m->counts);
	table_free(&m->times);
	*m = (struct measured){ 0 };
}

static bool has_column(const struct table *t, const char *column)
{
	for (size_t i = 0; i < t->columns; i++)
		if (strcmp(t->names[i], column) == 0)
			return true;
	return false;
}

/* Columns that say what a row is of, not what came out; of random rays their number, too. */
static bool is_identity(const struct table *t, size_t row, const char *column)
{
	static const char *const named[] = { "scene", "structure", "workload", "seed", "alpha", "beta" };
	int i = row_column(column);
	if (i >= 0 && (row_columns[i].type == COLUMN_OPTION || row_columns[i].type == COLUMN_MEASURE))
		return true;
	for (size_t k = 0; k < sizeof named / sizeof *named; k++)
		if (strcmp(column, named[k]) == 0)
			return true;
	return strcmp(column, "rays") == 0 && !table_is(t, row, "workload", "render");
}

static const char *name_row(struct measured *all, size_t n, struct table *t, size_t row)
{
	struct text name = { 0 };
	for (size_t c = 0; c < t->columns; c++) {
		const char *value = t->cells[row * t->columns + c];
		bool shared = *value && is_identity(t, row, t->names[c]);
		for (size_t i = 0; shared && i < n; i++)
			shared = has_column(&all[i].counts, t->names[c]);
		if (shared && (strcmp(t->names[c], "scene") == 0 || strcmp(t->names[c], "structure") == 0 ||
		               strcmp(t->names[c], "workload") == 0))
			text_print(&name, "%s%s", name.size ? " " : "", value);
		else if (shared)
			text_print(&name, "%s%s=%s", name.size ? " " : "", t->names[c], value);
	}
	const char *copy = name.lost ? NULL : arena_text(&t->mem, name.size ? name.bytes : "", name.size);
	text_free(&name);
	return copy;
}

static int compare_rows(const void *a, const void *b)
{
	const struct named_row *x = a, *y = b;
	int order = strcmp(x->name, y->name);
	return order ? order : (x->nth > y->nth) - (x->nth < y->nth);
}

struct timed {
	const char *key;
	size_t row;
};

static int compare_timed(const void *a, const void *b)
{
	const struct timed *x = a, *y = b;
	int order = strcmp(x->key, y->key);
	return order ? order : (x->row > y->row) - (x->row < y->row);
}

/* To every row its line in times.csv, the last one of its key: a row that was done again has several. */
static int find_times(struct measured *m, struct err *e)
{
	const struct table *t = &m->times;
	struct timed *timed = malloc((t->rows + 1) * sizeof *timed);
	if (!timed)
		return err_memory(e, "times");
	for (size_t i = 0; i < t->rows; i++)
		timed[i] = (struct timed){ table_text(t, i, "key"), i };
	qsort(timed, t->rows, sizeof *timed, compare_timed);
	for (size_t i = 0; i < m->counts.rows; i++) {
		const char *key = table_text(&m->counts, m->rows[i].row, "key");
		size_t low = 0, high = t->rows;
		while (low < high) {
			size_t middle = low + (high - low) / 2;
			if (strcmp(timed[middle].key, key) <= 0)
				low = middle + 1;
			else
				high = middle;
		}
		m->rows[i].time = low > 0 && strcmp(timed[low - 1].key, key) == 0 ? timed[low - 1].row : SIZE_MAX;
	}
	free(timed);
	return 0;
}

int measured_name(struct measured *all, size_t n, struct err *e)
{
	for (size_t k = 0; k < n; k++) {
		struct measured *m = &all[k];
		m->rows = NEW(&m->counts.mem, struct named_row, m->counts.rows);
		if (!m->rows)
			return err_memory(e, "rows");
		for (size_t i = 0; i < m->counts.rows; i++) {
			m->rows[i] = (struct named_row){ .name = name_row(all, n, &m->counts, i), .nth = i, .row = i };
			if (!m->rows[i].name)
				return err_memory(e, "rows");
		}
		qsort(m->rows, m->counts.rows, sizeof *m->rows, compare_rows);
		for (size_t i = 0; i < m->counts.rows; i++)
			m->rows[i].nth = i > 0 && strcmp(m->rows[i - 1].name, m->rows[i].name) == 0 ? m->rows[i - 1].nth + 1 : 0;
		if (find_times(m, e) != 0)
			return -1;
	}
	return 0;
}

const struct named_row *measured_find(const struct measured *m, const struct named_row *row)
{
	return bsearch(row, m->rows, m->counts.rows, sizeof *m->rows, compare_rows);
}

bool measured_is_time(const struct measured *m, const char *column)
{
	return !has_column(&m->counts, column) && has_column(&m->times, column);
}

bool measured_has(const struct measured *m, const char *column)
{
	return has_column(&m->counts, column) || has_column(&m->times, column);
}

const char *measured_text(const struct measured *m, const struct named_row *row, const char *column)
{
	if (!measured_is_time(m, column))
		return table_text(&m->counts, row->row, column);
	return row->time == SIZE_MAX ? "" : table_text(&m->times, row->time, column);
}
