#include "batch/run.h"

#include "base/progress.h"
#include "base/rng.h"
#include "batch/imaging.h"
#include "batch/keep.h"
#include "batch/load.h"
#include "batch/manifest.h"
#include "batch/plan.h"
#include "batch/record.h"
#include "batch/row.h"
#include "batch/row_key.h"
#include "batch/summary.h"
#include "cost/stop.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

struct run {
	const struct job *job;
	const struct run_options *options;
	struct record record;
	struct plan plan; /* of a shard */
	size_t row, rows; /* the number of the row at hand in the plan; how many are to be done */
	struct progress progress;
	struct err *err;
};

/* A scene at hand. */
struct bench {
	const struct experiment *experiment;
	const struct scene_spec *scene;
	struct primitives primitives;
	struct scene setting;
	struct imaging *imagings; /* for every measure of the experiment */
	uint64_t text_hash;       /* of its NFF text: view, lights and materials too */
	bool loaded;
	struct err fault; /* why not loaded */
};

/* A structure built for the measures of one row after the other. */
struct built {
	const struct structure_spec *structure;
	struct accel accel;
	bool tried, ok;
	double seconds;
	int64_t stopped_at; /* -1: by its own limits */
	struct err fault;
	/* The last prediction, for the next measure may need the same. */
	bool predicted;
	enum law law;
	double alpha, beta;
	struct prediction prediction;
	bool modelled;
	struct model model;
};

/* Whether this run does a row of the plan. */
static bool is_mine(const struct run *r, size_t row)
{
	return r->options->shards == 0 || r->plan.shards[row] == r->options->shard;
}

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
	text_print(&line, "%016" PRIx64 ",%s,%s,%s,%.6f,%.6f,%.6f,%.6f,%.0f,%zu,%ld\n", row->key, row->job, row->scene, field,
	           built->seconds, predict, shoot, row->actual.walk_seconds, shoot > 0 ? (double)row->rays / shoot : 0, built->accel.mem.held,
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

static enum law law_of(const struct measure_spec *m)
{
	static const enum law laws[] = { LAW_RAYS, LAW_ONE_SIDED, LAW_EXT };
	if (m->render)
		return LAW_RAYS;
	if (m->rays == RAYS_INVARIANT)
		return laws[m->sides];
	return m->rays == RAYS_LINES ? LAW_LINES : m->rays == RAYS_INTERIOR ? LAW_INTERIOR : LAW_NONE;
}

static int predict(struct row *row, struct built *built, const struct measure_spec *m, struct err *e)
{
	enum law law = law_of(m);
	if (!built->predicted || built->law != law || built->alpha != m->alpha || built->beta != m->beta) {
		built->law = law;
		built->alpha = m->alpha;
		built->beta = m->beta;
		built->predicted = cost_predict(&built->prediction, &built->accel, law, m->alpha, m->beta, e) == 0;
	}
	if (built->predicted && !built->modelled)
		built->modelled = model_make(&built->model, &built->accel, e) == 0;
	row->predicted = built->prediction;
	row->model = built->model;
	row->stopped_at = built->stopped_at < 0 ? ROW_NONE : (uint64_t)built->stopped_at;
	return built->predicted && built->modelled ? 0 : -1;
}

/* The number of an image among those of its experiment, 0 where it is the only one. */
static size_t number_image(const struct run *r, const struct experiment *x, size_t measure)
{
	size_t images = 0;
	for (size_t i = 0; i < x->measure_count; i++)
		images += r->job->measures[x->measure_first + i].render;
	return images > 1 ? measure + 1 : 0;
}

/* Render, after the predictors have had their say. *seconds: of the rendering. Faults of the row go to *fault, others to r->err. */
static int measure_image(struct run *r, struct row *row, struct bench *bench, const struct built *built, size_t measure,
                         double *seconds, struct err *fault)
{
	const struct measure_spec *m = &r->job->measures[bench->experiment->measure_first + measure];
	struct imaging *imaging = &bench->imagings[measure];
	const struct imaging_run prepare = { m, &bench->setting, r->options->threads, r->options->stop };
	const struct render_run run = { .alpha = m->alpha, .beta = m->beta, .threads = r->options->threads, .stop = r->options->stop };
	struct rendering image;
	if (imaging_predict(imaging, &prepare, &built->accel, &row->replay, &row->replayed, &row->calibrated, fault) != 0)
		return -1;
	double start = clock_seconds();
	int status = render_scene(&image, &bench->setting, &built->accel, &m->image, &run, fault);
	*seconds = clock_seconds() - start;
	if (status == 0 && r->job->save_images && !imaging->saved)
		imaging->saved = keep_image(r->record.folder, bench->scene->name, number_image(r, bench->experiment, measure), &image,
		                            &m->image, r->err) == 0;
	row->actual = image.actual;
	memcpy(row->classes, image.classes, sizeof row->classes);
	rendering_free(&image);
	return status;
}

static int measure_rays(struct run *r, struct row *row, const struct built *built, const struct measure_spec *m, double *seconds,
                        struct err *fault)
{
	/* Every scene has its own random numbers, so that deviations in one say nothing about another; its variants share them, so
	 * that they differ by structure only. */
	uint64_t seed = rng_mix((uint64_t)r->job->seed ^ built->accel.primitives->hash);
	static const enum workload workloads[] = { WORKLOAD_INVARIANT, WORKLOAD_LINES, WORKLOAD_SEGMENTS, WORKLOAD_SEGMENTS_TWICE,
	                                           WORKLOAD_INTERIOR, WORKLOAD_INTERIOR_HITS };
	enum workload workload = m->rays == RAYS_INVARIANT && m->sides != SIDES_TWO ? WORKLOAD_ONE_SIDED : workloads[m->rays];
	double start = clock_seconds();
	int status = shoot_rays_until(&row->actual, &built->accel, workload, (uint64_t)m->count, m->error, seed, m->alpha,
	                              m->beta, r->options->threads, r->options->stop, fault);
	*seconds = clock_seconds() - start;
	return status;
}

/* Predict and measure one combination whose structure stands. */
static int measure_row(struct run *r, struct row *row, struct bench *bench, struct built *built, size_t measure)
{
	const struct measure_spec *m = &r->job->measures[bench->experiment->measure_first + measure];
	struct err fault = { 0 };
	double start = clock_seconds(), seconds = 0;
	int status = predict(row, built, m, &fault);
	if (status == 0 && m->render)
		status = measure_image(r, row, bench, built, measure, &seconds, &fault);
	else if (status == 0)
		status = measure_rays(r, row, built, m, &seconds, &fault);
	if (stopped(r) != 0 || r->err->code)
		return -1;
	if (status != 0)
		return write_failure(r, row, &fault);
	row_complete(row, &built->accel, m);
	/* Times first: a row that is there has its times, however the run ends. */
	if (write_times(r, row, built, clock_seconds() - start - seconds, seconds) != 0)
		return -1;
	return write_row(r, row, false);
}

/* A scene is drawn with the first structure of the first experiment it is in, so that neither shards nor resumed runs draw another. */
static bool is_drawn(const struct run *r, const struct bench *bench, const struct built *built)
{
	const struct scene_spec *scene = r->job->scenes;
	if (!r->job->save_drawings || built->structure != &r->job->structures[bench->experiment->structure_first])
		return false;
	while (strcmp(scene->name, bench->scene->name) != 0)
		scene++;
	return scene == bench->scene;
}

/* A structure that cannot be built is a fault of its rows. 0, or -1 and the run's error. */
static int build(struct run *r, const struct bench *bench, struct built *built)
{
	double start = clock_seconds();
	built->tried = true;
	built->ok = stop_build(&built->accel, built->structure->ops, built->structure->options, &bench->primitives,
	                       r->options->threads, &built->stopped_at, &built->fault) == 0;
	built->seconds = clock_seconds() - start;
	if (!built->ok || !is_drawn(r, bench, built))
		return 0;
	return keep_drawing(r->record.folder, bench->scene->name, &built->accel, (uint64_t)r->job->seed, r->err);
}

static int do_row(struct run *r, struct bench *bench, struct built *built, size_t measure)
{
	struct row row;
	char key[20];
	row_identify(&row, r->job, bench->scene, built->structure, &r->job->measures[bench->experiment->measure_first + measure],
	             bench->loaded ? &bench->primitives : NULL, bench->text_hash);
	snprintf(key, sizeof key, "%016" PRIx64, row.key);
	const char *old = record_find(&r->record, key);
	if (old)
		return record_keep(&r->record, old, r->err);
	if (!bench->loaded)
		return write_failure(r, &row, &bench->fault);
	if (!built->tried && build(r, bench, built) != 0)
		return -1;
	if (!built->ok)
		return write_failure(r, &row, &built->fault);
	return measure_row(r, &row, bench, built, measure);
}

static int do_structure(struct run *r, struct bench *bench, const struct structure_spec *structure)
{
	struct built built = { .structure = structure };
	int status = 0;
	for (size_t i = 0; status == 0 && i < bench->experiment->measure_count; i++, r->row++) {
		progress_show(&r->progress, r->record.kept + r->record.added, r->rows, bench->scene->name);
		if (stopped(r) != 0)
			status = -1;
		else if (is_mine(r, r->row))
			status = do_row(r, bench, &built, i);
	}
	if (built.ok)
		accel_free(&built.accel);
	return status;
}

static int do_scene(struct run *r, const struct experiment *x, const struct scene_spec *scene)
{
	struct bench bench = { .experiment = x, .scene = scene };
	struct text text = { 0 };
	int status = 0;
	size_t rows = x->structure_count * x->measure_count, mine = 0;
	for (size_t i = 0; i < rows; i++)
		mine += is_mine(r, r->row + i);
	if (mine == 0) {
		r->row += rows;
		return 0;
	}
	bench.imagings = calloc(x->measure_count, sizeof *bench.imagings);
	if (!bench.imagings)
		return err_memory(r->err, "run");
	bench.loaded = load_scene(&bench.primitives, &bench.setting, &text, scene, &bench.fault) == 0;
	if (bench.loaded && r->job->save_scenes)
		status = keep_scene(r->record.folder, scene->name, &text, r->err);
	bench.text_hash = hash_bytes(text.bytes, text.size);
	text_free(&text);
	for (size_t i = 0; status == 0 && i < x->structure_count; i++)
		status = do_structure(r, &bench, &r->job->structures[x->structure_first + i]);
	for (size_t i = 0; i < x->measure_count; i++)
		imaging_free(&bench.imagings[i]);
	free(bench.imagings);
	scene_free(&bench.setting);
	primitives_free(&bench.primitives);
	return status;
}

static int do_experiment(struct run *r, const struct experiment *x)
{
	int status = 0;
	for (size_t i = 0; status == 0 && i < x->scene_count; i++)
		status = do_scene(r, x, &r->job->scenes[x->scene_first + i]);
	return status;
}

/* Make the plan of a shard, and leave its keys for the merge. */
static int plan_shard(struct run *r)
{
	char path[4096];
	struct text keys = { 0 };
	if (plan_make(&r->plan, r->job, r->options->shards, r->options->stop, r->err) != 0)
		return -1;
	r->rows = 0;
	for (size_t i = 0; i < r->plan.count; i++)
		r->rows += is_mine(r, i);
	plan_print_keys(&r->plan, &keys);
	snprintf(path, sizeof path, "%s/plan.csv", r->record.folder);
	int status = text_write_file(&keys, path, r->err);
	text_free(&keys);
	return status;
}

static void name_folder(struct run_result *result, const struct job *job, const struct run_options *o)
{
	char shard[64] = "";
	if (o->shards)
		snprintf(shard, sizeof shard, "/shards/%" PRIu32 "-of-%" PRIu32, o->shard, o->shards);
	if (o->folder)
		snprintf(result->folder, sizeof result->folder, "%s%s", o->folder, shard);
	else
		snprintf(result->folder, sizeof result->folder, "out/%s%s", job->name, shard);
}

/* Every row of the plan; the folder is open. */
static int do_rows(struct run *r)
{
	int status = r->options->shards ? plan_shard(r) : 0;
	for (size_t i = 0; status == 0 && i < r->job->experiment_count; i++)
		status = do_experiment(r, &r->job->experiments[i]);
	return status == 0 ? record_finish(&r->record, r->err) : -1;
}

/* What people are told in the end. The rows are read again: hundreds of thousands need not be held all the time. */
static int summarize(const struct run *r, const struct run_result *result, struct text *table)
{
	char path[4096];
	struct text rows = { 0 };
	if (r->options->shards) {
		text_print(table, "%zu rows, %zu failed; see %s/counts.csv\n", result->kept + result->added, result->failed, result->folder);
		return 0;
	}
	snprintf(path, sizeof path, "%s/counts.csv", result->folder);
	int status = text_read_file(&rows, path, SIZE_MAX, r->err);
	if (status == 0)
		status = summary_print(table, r->job, rows.bytes, result->folder, r->err);
	text_free(&rows);
	return status;
}

int run_job(const struct job *job, const struct run_options *o, struct run_result *result, struct text *table, struct err *e)
{
	struct run r = { .job = job, .options = o, .rows = job_rows(job), .err = e };
	struct manifest manifest;
	*result = (struct run_result){ 0 };
	name_folder(result, job, o);
	manifest_start(&manifest, job, o);
	progress_open(&r.progress);
	int status = record_open(&r.record, result->folder, o->fresh, e);
	bool locked = status == 0;
	if (locked && (status = manifest_write(&manifest, result, -1, e)) == 0)
		status = do_rows(&r);
	progress_close(&r.progress);
	result->kept = r.record.kept;
	result->added = r.record.added;
	result->failed = r.record.failed;
	if (locked && manifest_write(&manifest, result, status == 0 ? (result->failed ? STATUS_PARTIAL : STATUS_DONE) : e->code, e) != 0)
		status = -1;
	if (status == 0)
		status = summarize(&r, result, table);
	plan_free(&r.plan);
	record_close(&r.record);
	return status;
}
