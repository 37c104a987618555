/* Records: what comes back of counts.csv is rows, and a table has as many fields in every row as in its head. */
#include "tests/fuzz/fuzz.h"

#include "batch/csv.h"
#include "batch/record.h"
#include "report/measured.h"

#include <string.h>

static void read_rows(const char *path)
{
	struct old_rows old = { 0 };
	struct line_index index = { 0 };
	struct err e = { 0 };
	if (old_rows_read(&old, path, &e) == 0 && line_index_make(&index, &old.rows, false, &e) == 0)
		for (size_t i = 0; i < index.count; i++)
			MUST(line_index_find(&index, index.lines[i]) && strchr(index.lines[i], '\n'));
	free(index.lines);
	old_rows_free(&old);
}

static void read_table(const char *path)
{
	struct measured m = { 0 };
	struct err e = { 0 };
	if (table_read(&m.counts, path, &e) == 0 && measured_name(&m, 1, &e) == 0)
		for (size_t i = 0; i < m.counts.rows; i++)
			MUST(measured_find(&m, &m.rows[i]));
	measured_free(&m);
}

/* A field written and read again is the same, but for line ends. */
static void write_field(const uint8_t *data, size_t n)
{
	struct text line = { 0 };
	char *field = malloc(n + 1), *back = malloc(n + 2);
	MUST(field && back);
	memcpy(field, data, n);
	field[n] = '\0';
	for (char *p = field; *p; p++)
		if (*p == '\n' || *p == '\r')
			*p = ' ';
	csv_add(&line, field, true);
	csv_add(&line, field, false);
	text_add(&line, "\n", 1);
	MUST(csv_field(line.bytes, 1, back, n + 2) && strcmp(field, back) == 0 && !csv_field(line.bytes, 2, back, n + 2));
	free(field);
	free(back);
	text_free(&line);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	const char *path = fuzz_file(data, n);
	read_rows(path);
	read_table(path);
	write_field(data, n);
	return 0;
}
