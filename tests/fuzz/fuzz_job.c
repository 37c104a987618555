/* Job files: refused with a reason, or rows that all have their key and their line. */
#include "tests/fuzz/fuzz.h"

#include "batch/csv.h"
#include "batch/row.h"

#include <string.h>

enum { ROWS_MOST = 100 };

static void print_rows(const struct job *job)
{
	for (size_t i = 0; i < job->experiment_count && i < ROWS_MOST; i++) {
		const struct experiment *x = &job->experiments[i];
		struct text line = { 0 };
		struct row row;
		char field[4096];
		if (!x->scene_count || !x->structure_count || !x->measure_count)
			continue;
		const struct scene_spec *scene = &job->scenes[x->scene_first + x->scene_count - 1];
		row_identify(&row, job, scene, &job->structures[x->structure_first], &job->measures[x->measure_first], NULL, 0);
		row.status = "failed";
		row_print(&row, &line);
		MUST(strchr(line.bytes, '\n') == line.bytes + line.size - 1);
		MUST(csv_field(line.bytes, row_column("scene"), field, sizeof field) && strcmp(field, scene->name) == 0);
		MUST(!strchr(scene->name, '/') && !strchr(job->name, '/') && job->name[0] != '.');
		text_free(&line);
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct job job;
	struct err e = { 0 };
	if (job_parse(&job, "tests/fuzz/job.yaml", (const char *)data, n, &(struct job_options){ 0 }, &e) == 0) {
		MUST(job_rows(&job) > 0 && job_rows(&job) <= JOB_ROWS_MOST);
		print_rows(&job);
	} else {
		MUST(e.code == STATUS_INPUT || e.code == STATUS_ENVIRONMENT);
		MUST(*e.text);
	}
	job_free(&job);
	return 0;
}
