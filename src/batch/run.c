#include "batch/run.h"

#include "base/progress.h"
#include "base/rng.h"
#include "batch/load.h"
#include "batch/manifest.h"
#include "batch/record.h"
#include "batch/row.h"
#include "batch/summary.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

struct run {
	const struct job *job;
	const struct run_options *options;
	struct record record;
	struct progress progress;
	struct err *err;
};

/* A scene at hand, and the structure built over it last. */
struct bench {
	const struct scene_spec *scene;
	struct primitives primitives;
	bool loaded;
	struct err fault; /* why not */
};

/* A structure built for the measures of one row after the other. */
struct built {
	const struct structure_spec *structure;
	struct accel accel;
	bool tried, ok;
	double seconds;
	struct err fault;
};

static int stopped(const struct run *r)
{
	int n = r->options->stop ? *r->options->stop : 0;
	return n ? err_at(r->err, 128 + n, NULL, 0, "stopped by signal %d; the same command goes on from here", n) : 0;
}

static int write_times(struct run *r, const struct row *row, const struct built *built, double predict, double shoot)
{
	char field[128];
	struct text line = { 0 };
	struct rusage usage;
	getrusage(RUSAGE_SELF, &usage);
	structure_print(row->spec, field, sizeof field);
	text_print(&line, "%016" PRIx64 ",%s,%s,%s,%.6f,%.6f,%.6f,%.0f,%zu,%ld\n", row->key, row->job, row->scene, field,
	           built->seconds, predict, shoot, shoot > 0 ? (double)row->rays / shoot : 0, built->accel.mem.held,
	           usage.ru_maxrss * 1024);
	int status = line.lost ? err_memory(r->err, "times") : record_time(&r->record, line.bytes, r->err);
	text_free(&line);
	return status;
}

static int write_row(struct run *r, const struct row *row, bool failed)
{
	struct text line = { 0 };
	row_print(row, &line);
	int status = line.lost ? err_memory(r->err, "row") : record_add(&r->record, line.bytes, failed, r->err);
	text_free(&line);
	return status;
}

static int write_failure(struct run *r, struct row *row, const struct err *why)
{
	row->status = "failed";
	row->message = why->text;
	return write_row(r, row, true);
}

static enum workload workload_of(const struct measure_spec *m)
{
	if (m->rays == RAYS_LINES)
		return WORKLOAD_LINES;
	return m->sides == SIDES_ONE ? WORKLOAD_ONE_SIDED : WORKLOAD_INVARIANT;
}

/* Predict and shoot one combination whose structure stands. */
static int measure_row(struct run *r, struct row *row, const struct built *built, const struct measure_spec *m)
{
	struct prediction predicted;
	struct actual actual;
	struct err fault = { 0 };
	/* Every scene has its own random numbers, so that deviations in one say nothing about another; its variants share them, so
	 * that they differ by structure only. */
	uint64_t seed = rng_mix((uint64_t)r->job->seed ^ built->accel.primitives->hash);
	double start = clock_seconds(), middle;
	enum law law = m->rays == RAYS_LINES ? LAW_LINES : LAW_RAYS;
	int status = cost_predict(&predicted, &built->accel, law, m->alpha, m->beta, &fault);
	middle = clock_seconds();
	if (status == 0)
		status = shoot_rays(&actual, &built->accel, workload_of(m), (uint64_t)m->count, seed, m->alpha, m->beta,
		                    r->options->threads, r->options->stop, &fault);
	if (stopped(r) != 0)
		return -1;
	if (status != 0)
		return write_failure(r, row, &fault);
	row_complete(row, &built->accel, &predicted, &actual, m);
	if (write_row(r, row, false) != 0)
		return -1;
	return write_times(r, row, built, middle - start, clock_seconds() - middle);
}

static int do_row(struct run *r, const struct bench *bench, struct built *built, const struct measure_spec *m)
{
	struct row row;
	char key[20];
	row_identify(&row, r->job, bench->scene, built->structure, m, bench->loaded ? &bench->primitives : NULL);
	snprintf(key, sizeof key, "%016" PRIx64, row.key);
	const char *old = record_find(&r->record, key);
	if (old)
		return record_keep(&r->record, old, r->err);
	if (!bench->loaded)
		return write_failure(r, &row, &bench->fault);
	if (!built->tried) {
		double start = clock_seconds();
		built->tried = true;
		built->ok = accel_build(&built->accel, built->structure->ops, built->structure->options, &bench->primitives,
		                        &built->fault) == 0;
		built->seconds = clock_seconds() - start;
	}
	if (!built->ok)
		return write_failure(r, &row, &built->fault);
	return measure_row(r, &row, built, m);
}

static int do_structure(struct run *r, const struct bench *bench, const struct structure_spec *structure)
{
	const struct job *job = r->job;
	struct built built = { .structure = structure };
	int status = 0;
	for (size_t i = 0; status == 0 && i < job->measure_count; i++) {
		progress_show(&r->progress, r->record.kept + r->record.added,
		              job->scene_count * job->structure_count * job->measure_count, bench->scene->name);
		status = stopped(r) != 0 ? -1 : do_row(r, bench, &built, &job->measures[i]);
	}
	if (built.ok)
		accel_free(&built.accel);
	return status;
}

/* Keep the scene's text as scenes/NAME.nff.gz, unless it is there. */
static int save_scene(struct run *r, const struct scene_spec *scene, const struct text *text)
{
	char path[4096];
	snprintf(path, sizeof path, "%s/scenes", r->record.folder);
	if (mkdir(path, 0777) != 0 && errno != EEXIST)
		return err_at(r->err, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	snprintf(path, sizeof path, "%s/scenes/%s.nff.gz", r->record.folder, scene->name);
	return access(path, F_OK) == 0 && !r->options->fresh ? 0 : text_write_file(text, path, r->err);
}

static int do_scene(struct run *r, const struct scene_spec *scene)
{
	struct bench bench = { .scene = scene };
	struct text text = { 0 };
	int status = 0;
	bench.loaded = load_scene(&bench.primitives, &text, scene, &bench.fault) == 0;
	if (bench.loaded && r->job->save_scenes)
		status = save_scene(r, scene, &text);
	text_free(&text);
	for (size_t i = 0; status == 0 && i < r->job->structure_count; i++)
		status = do_structure(r, &bench, &r->job->structures[i]);
	if (bench.loaded)
		primitives_free(&bench.primitives);
	return status;
}

int run_job(const struct job *job, const struct run_options *o, struct run_result *result, struct text *table, struct err *e)
{
	struct run r = { .job = job, .options = o, .err = e };
	struct manifest manifest;
	*result = (struct run_result){ 0 };
	if (o->folder)
		snprintf(result->folder, sizeof result->folder, "%s", o->folder);
	else
		snprintf(result->folder, sizeof result->folder, "out/%s", job->name);
	manifest_start(&manifest, job, o);
	progress_open(&r.progress);
	int status = record_open(&r.record, result->folder, o->fresh, e);
	bool locked = status == 0;
	for (size_t i = 0; status == 0 && i < job->scene_count; i++)
		status = do_scene(&r, &job->scenes[i]);
	if (status == 0)
		status = record_finish(&r.record, e);
	progress_close(&r.progress);
	result->kept = r.record.kept;
	result->added = r.record.added;
	result->failed = r.record.failed;
	if (locked && manifest_write(&manifest, result, status == 0 ? (result->failed ? STATUS_PARTIAL : STATUS_DONE) : e->code, e) != 0)
		status = -1;
	if (status == 0)
		summary_print(table, job, r.record.done.bytes, result->folder);
	record_close(&r.record);
	return status;
}
