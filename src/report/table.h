/* counts.csv as a report sees it: rows and named columns, texts and numbers. */
#ifndef REPORT_TABLE_H
#define REPORT_TABLE_H

#include "base/arena.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise; table_free closes. */
struct table {
	struct arena mem;
	const char **cells; /* [rows][columns] */
	const char **names; /* of the columns */
	size_t rows, columns;
	/* Filled by rows_prepare (rows.h): how many random rays an ordinary row has, and the rows with fewer. */
	double ordinary_rays;
	size_t *few, few_count;
};

/* Read a CSV file with a head. 0, or -1 and *e: cannot be read, no head, a line with another number of fields. */
int table_read(struct table *t, const char *path, struct err *e);
void table_free(struct table *t);

/* The text of a field; "" where it is empty or there is no such column. */
const char *table_text(const struct table *t, size_t row, const char *column);

/* Its number; NAN where it is none. */
double table_number(const struct table *t, size_t row, const char *column);

bool table_is(const struct table *t, size_t row, const char *column, const char *text);

#endif
