#include "report/table.h"

#include "batch/csv.h"
#include "io/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIELD_MOST = 4096 };
static const size_t bytes_most = (size_t)1 << 30;

static size_t count_fields(const char *line)
{
	char field[FIELD_MOST];
	size_t n = 0;
	while (csv_field(line, (int)n, field, sizeof field))
		n++;
	return n;
}

static const char *copy_field(struct table *t, const char *line, size_t i)
{
	char field[FIELD_MOST];
	csv_field(line, (int)i, field, sizeof field);
	return arena_text(&t->mem, field, strlen(field));
}

static int fill_cells(struct table *t, const char *path, const char *text, struct err *e)
{
	long number = 1;
	const char *line = strchr(text, '\n') + 1;
	for (size_t row = 0; row < t->rows; row++, line = strchr(line, '\n') + 1) {
		if (count_fields(line) != t->columns)
			return err_at(e, STATUS_INPUT, path, ++number, "%zu fields are needed, as in the head", t->columns);
		for (size_t i = 0; i < t->columns; i++)
			if (!(t->cells[row * t->columns + i] = copy_field(t, line, i)))
				return err_memory(e, path);
		number++;
	}
	return 0;
}

static int parse(struct table *t, const char *path, const char *text, struct err *e)
{
	if (!strchr(text, '\n'))
		return err_at(e, STATUS_INPUT, path, 1, "no head: not a table");
	t->columns = count_fields(text);
	for (const char *p = strchr(text, '\n') + 1; strchr(p, '\n'); p = strchr(p, '\n') + 1)
		t->rows++;
	t->names = NEW(&t->mem, const char *, t->columns);
	t->cells = NEW(&t->mem, const char *, t->rows * t->columns);
	if (!t->names || !t->cells)
		return err_memory(e, path);
	for (size_t i = 0; i < t->columns; i++)
		if (!(t->names[i] = copy_field(t, text, i)))
			return err_memory(e, path);
	return fill_cells(t, path, text, e);
}

int table_read(struct table *t, const char *path, struct err *e)
{
	struct text text = { 0 };
	int status = text_read_file(&text, path, bytes_most, e);
	if (status == 0)
		status = parse(t, path, text.bytes ? text.bytes : "", e);
	text_free(&text);
	if (status != 0)
		table_free(t);
	return status;
}

void table_free(struct table *t)
{
	arena_free(&t->mem);
	*t = (struct table){ 0 };
}

const char *table_text(const struct table *t, size_t row, const char *column)
{
	for (size_t i = 0; i < t->columns; i++)
		if (strcmp(t->names[i], column) == 0)
			return t->cells[row * t->columns + i];
	return "";
}

double table_number(const struct table *t, size_t row, const char *column)
{
	const char *text = table_text(t, row, column);
	return *text ? strtod(text, NULL) : NAN;
}

bool table_is(const struct table *t, size_t row, const char *column, const char *text)
{
	return strcmp(table_text(t, row, column), text) == 0;
}
