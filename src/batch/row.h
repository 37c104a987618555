/* One row of the record, and the one table of its columns: what writes, reads and documents them. */
#ifndef BATCH_ROW_H
#define BATCH_ROW_H

#include "batch/job.h"
#include "cost/cost.h"
#include "cost/model.h"
#include "io/text.h"
#include "trace/replay.h"

/* Everything a row says. Texts are borrowed; NULL, ROW_NONE and NAN mean "not applicable" and print as nothing. */
#define ROW_NONE UINT64_MAX

struct row {
	const char *job, *scene, *family, *structure, *workload, *status, *message;
	uint64_t key, size, triangles, spheres, rays, missed, seed;
	uint64_t nodes, leaves, empty_leaves, references, depth, stopped_at;
	double alpha, beta, root_area, object_area;
	struct prediction predicted;
	struct estimate replay, calibrated;
	struct replay_counts replayed;
	struct actual actual;
	struct class_tally classes[RAY_CLASSES];
	uint64_t class_counts[RAY_CLASSES][5]; /* rays, hits, leaves, tests, inner */
	double ratio_replay, ratio_calibrated, ratio_volumes, lcv;
	double actual_low, actual_high;
	struct model model;
	struct flops flops_exact, flops_actual;
	double flops_exact_sum, flops_replay_sum, flops_actual_sum;
	struct mean tests_made; /* only where there is a mailbox */
	struct mean barycentric; /* only where they are counted */
	double ratio, ratio_exact, z_exact, z_leaves, z_tests, z_tests_made, z_inner_step, z_inner_start, z_inner, z_boxes;
	double overhead_predicted, overhead_actual;
	const struct structure_spec *spec;    /* for the columns that are options */
	const struct measure_spec *measure;
};

enum column_type { COLUMN_TEXT, COLUMN_COUNT, COLUMN_REAL, COLUMN_KEY, COLUMN_OPTION, COLUMN_MEASURE };

struct column {
	const char *name;
	enum column_type type;
	size_t offset; /* in struct row; options of structure and measure: unused */
	const char *text;
};

/* Ends with a NULL name. */
extern const struct column row_columns[];

/* Number of the column called 'name', or -1. */
int row_column(const char *name);

/* Identify the combination: everything that does not have to be computed. p may be NULL: the scene could not be had; then the key
 * follows from the scene's name. text_hash: of the scene's text, of which images depend more than rays do. */
void row_identify(struct row *r, const struct job *job, const struct scene_spec *scene, const struct structure_spec *structure,
                  const struct measure_spec *measure, const struct primitives *p, uint64_t text_hash);

/* Predictions and measured counts are in place: fill in what was built, and what follows from them. */
void row_complete(struct row *r, const struct accel *a, const struct measure_spec *measure);

/* The row, or the head, as a line of CSV with its newline. */
void row_print(const struct row *r, struct text *line);
void row_print_head(struct text *line);

/* "octree balanced=false max_objects=2 ...", into out[size]. */
void structure_print(const struct structure_spec *s, char *out, size_t size);

#endif
