/* What several runs have measured, row beside row. */
#ifndef REPORT_MEASURED_H
#define REPORT_MEASURED_H

#include "report/table.h"

/* A row and what names it: scene, structure, options, workload, rays, seed as "name=value ...", without what does not apply. A key would
 * not do: it changes with the program's format and with the content of a scene, and that is what a comparison is to find. */
struct named_row {
	const char *name;
	size_t nth; /* of the rows of this name */
	size_t row, time; /* in counts and in times; time: SIZE_MAX where there is none */
};

/* One output folder. Zero-initialise; measured_free closes. */
struct measured {
	struct table counts, times; /* times: empty where there is no times.csv */
	struct named_row *rows;     /* by name and nth; counts.rows of them, in the mem of counts */
};

/* Read FOLDER/counts.csv and times.csv. 0, or -1 and *e. */
int measured_read(struct measured *m, const char *folder, struct err *e);
void measured_free(struct measured *m);

/* Fill the rows of n records; they are named by columns that all records have. 0, or -1 and *e (memory). */
int measured_name(struct measured *all, size_t n, struct err *e);

/* The row of the same combination, or NULL. */
const struct named_row *measured_find(const struct measured *m, const struct named_row *row);

/* A field of counts.csv or times.csv; "" where there is none. */
const char *measured_text(const struct measured *m, const struct named_row *row, const char *column);

/* Whether a column is one of times.csv: of times and bytes, which no two runs have in common. */
bool measured_is_time(const struct measured *m, const char *column);

/* Whether either file has the column. */
bool measured_has(const struct measured *m, const char *column);

#endif
