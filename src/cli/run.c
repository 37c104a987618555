/* raycost run JOB.yaml */
#include "base/par.h"
#include "batch/run.h"
#include "batch/row.h"
#include "cli/cli.h"
#include "report/page.h"

#include <string.h>

enum { SETTINGS_MOST = 64 };

static const char help[] =
	"usage: raycost run JOB.yaml [options]\n\n"
	"Predict and measure every combination of a job into out/NAME/. The same command again goes on where it stopped.\n\n"
	"  --set NAME=VALUE[,VALUE]  override a variable of the job's vars; may be repeated\n"
	"  -o DIR                    output folder instead of out/NAME\n"
	"  --threads N               threads (default: all processors); the results do not depend on it\n"
	"  --shard K/N               only shard K (0 .. N-1) of N, into shards/K-of-N below the output folder; see raycost merge\n"
	"  --dry-run                 print the rows and run nothing\n"
	"  --fresh                   do all rows anew\n"
	"  --many                    more than 100,000 rows are meant\n"
	"  --allow-outside           scene files may lie outside the job file's folder\n";

struct arguments {
	const char *path;
	const char *settings[SETTINGS_MOST];
	struct job_options job;
	struct run_options run;
	bool dry_run;
};

/* The value after option number *i, or NULL and the fault. */
static const char *value_of(int count, char **words, int *i, struct err *e)
{
	if (*i + 1 < count)
		return words[++*i];
	cli_usage(e, "run", "%s needs a value", words[*i]);
	return NULL;
}

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 0; i < count; i++) {
		const char *word = words[i], *value = NULL;
		bool takes = strcmp(word, "--set") == 0 || strcmp(word, "-o") == 0 || strcmp(word, "--threads") == 0 ||
		             strcmp(word, "--shard") == 0;
		if (takes && !(value = value_of(count, words, &i, e)))
			return STATUS_INPUT;
		long long n;
		if (strcmp(word, "--set") == 0 && a->job.setting_count < SETTINGS_MOST)
			a->settings[a->job.setting_count++] = value;
		else if (strcmp(word, "-o") == 0)
			a->run.folder = value;
		else if (strcmp(word, "--threads") == 0 && cli_integer(value, 1, 256, &n))
			a->run.threads = (int)n;
		else if (strcmp(word, "--shard") == 0 && cli_shard(value, &a->run.shard, &a->run.shards))
			continue;
		else if (strcmp(word, "--dry-run") == 0)
			a->dry_run = true;
		else if (strcmp(word, "--fresh") == 0)
			a->run.fresh = true;
		else if (strcmp(word, "--many") == 0)
			a->job.many = true;
		else if (strcmp(word, "--allow-outside") == 0)
			a->job.allow_outside = true;
		else if (takes)
			return cli_usage(e, "run", "%s %s: not a value it can have", word, value);
		else if (*word == '-' || a->path)
			return cli_usage(e, "run", "'%s' is not understood", word);
		else
			a->path = word;
	}
	return a->path ? 0 : cli_usage(e, "run", "no job file given");
}

static void print_plan(struct text *out, const struct job *job)
{
	char structure[256], measure[512];
	for (size_t n = 0; n < job->experiment_count; n++) {
		const struct experiment *x = &job->experiments[n];
		for (size_t i = 0; i < x->scene_count; i++)
			for (size_t k = 0; k < x->structure_count; k++)
				for (size_t m = 0; m < x->measure_count; m++) {
					structure_print(&job->structures[x->structure_first + k], structure, sizeof structure);
					measure_print(&job->measures[x->measure_first + m], measure, sizeof measure);
					text_print(out, "%s  %s  %s\n", job->scenes[x->scene_first + i].name, structure, measure);
				}
	}
	text_print(out, "%zu rows\n", job_rows(job));
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { .run = { .version = cli->version, .threads = par_processors(), .stop = cli->stop } };
	struct job job = { 0 };
	struct run_result result;
	int status = parse(&a, count, words, e);
	if (status != 0)
		return status;
	a.job.settings = a.settings;
	if (job_read(&job, a.path, &a.job, e) != 0)
		status = e->code;
	else if (a.dry_run)
		print_plan(&cli->out, &job);
	else if (run_job(&job, &a.run, &result, &cli->out, e) != 0)
		status = e->code;
	else if (job.report && !a.run.shards && report_write(result.folder, &cli->out, e) != 0)
		status = e->code;
	else if (result.failed)
		status = STATUS_PARTIAL;
	job_free(&job);
	return status;
}

const struct cli_command cli_run = { "run", "predict and measure every combination of a job file", help, run };
