/* raycost plan JOB.yaml */
#include "batch/found.h"
#include "batch/plan.h"
#include "batch/row.h"
#include "cli/cli.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { SETTINGS_MOST = 64 };

static const char help[] =
	"usage: raycost plan JOB.yaml [options]\n\n"
	"Print the rows of a job as raycost run would do them: key, estimated seconds on one processor, scene, structure, measure.\n\n"
	"  --shard K/N               only those of shard K (0 .. N-1) of N\n"
	"  --missing                 only those that neither the output folder nor its shards have; exit status 4 if there are some\n"
	"  --set NAME=VALUE[,VALUE]  override a variable of the job's vars; may be repeated\n"
	"  -o DIR                    output folder instead of out/NAME\n"
	"  --many                    more than 100,000 rows are meant\n"
	"  --allow-outside           scene files may lie outside the job file's folder\n";

struct arguments {
	const char *path, *folder;
	const char *settings[SETTINGS_MOST];
	struct job_options job;
	uint32_t shard, shards;
	bool missing;
};

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 0; i < count; i++) {
		const char *word = words[i], *value = NULL;
		bool takes = strcmp(word, "--set") == 0 || strcmp(word, "-o") == 0 || strcmp(word, "--shard") == 0;
		if (takes && i + 1 == count)
			return cli_usage(e, "plan", "%s needs a value", word);
		if (takes)
			value = words[++i];
		if (strcmp(word, "--set") == 0 && a->job.setting_count < SETTINGS_MOST)
			a->settings[a->job.setting_count++] = value;
		else if (strcmp(word, "-o") == 0)
			a->folder = value;
		else if (strcmp(word, "--shard") == 0 && cli_shard(value, &a->shard, &a->shards))
			continue;
		else if (strcmp(word, "--missing") == 0)
			a->missing = true;
		else if (strcmp(word, "--many") == 0)
			a->job.many = true;
		else if (strcmp(word, "--allow-outside") == 0)
			a->job.allow_outside = true;
		else if (takes)
			return cli_usage(e, "plan", "%s %s: not a value it can have", word, value);
		else if (*word == '-' || a->path)
			return cli_usage(e, "plan", "'%s' is not understood", word);
		else
			a->path = word;
	}
	return a->path ? 0 : cli_usage(e, "plan", "no job file given");
}

/* What is printed, and of how much. */
struct listing {
	const struct arguments *arguments;
	const struct job *job;
	const struct plan *plan;
	const struct found *found; /* NULL: whatever is there */
	size_t rows;
	double seconds;
};

static void print_row(struct text *out, struct listing *l, size_t row, size_t scene, size_t structure, size_t measure)
{
	char key[20], structure_text[256], measure_text[512];
	snprintf(key, sizeof key, "%016" PRIx64, l->plan->keys[row]);
	if ((l->arguments->shards && l->plan->shards[row] != l->arguments->shard) || (l->found && found_line(l->found, key)))
		return;
	double seconds = (double)l->plan->costs[row] * 1e-9;
	structure_print(&l->job->structures[structure], structure_text, sizeof structure_text);
	measure_print(&l->job->measures[measure], measure_text, sizeof measure_text);
	text_print(out, "%s  %.3f  %s  %s  %s\n", key, seconds, l->job->scenes[scene].name, structure_text, measure_text);
	l->rows++;
	l->seconds += seconds;
}

static void print_rows(struct text *out, struct listing *l)
{
	size_t row = 0;
	for (size_t n = 0; n < l->job->experiment_count; n++) {
		const struct experiment *x = &l->job->experiments[n];
		for (size_t i = 0; i < x->scene_count; i++)
			for (size_t k = 0; k < x->structure_count; k++)
				for (size_t m = 0; m < x->measure_count; m++)
					print_row(out, l, row++, x->scene_first + i, x->structure_first + k, x->measure_first + m);
	}
	text_print(out, "%zu rows%s, about %.1f s on one processor\n", l->rows, l->found ? " missing" : "", l->seconds);
}

static int print_plan(struct cli *cli, const struct arguments *a, const struct job *job, struct err *e)
{
	char folder[3000];
	struct plan plan = { 0 };
	struct found found = { 0 };
	struct listing listing = { .arguments = a, .job = job, .plan = &plan, .found = a->missing ? &found : NULL };
	snprintf(folder, sizeof folder, "%s%s", a->folder ? a->folder : "out/", a->folder ? "" : job->name);
	int status = plan_make(&plan, job, a->shards ? a->shards : 1, cli->stop, e);
	if (status == 0 && a->missing)
		status = found_read(&found, folder, e);
	if (status == 0)
		print_rows(&cli->out, &listing);
	found_free(&found);
	plan_free(&plan);
	return status != 0 ? e->code : a->missing && listing.rows ? STATUS_PARTIAL : STATUS_DONE;
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { 0 };
	struct job job = { 0 };
	int status = parse(&a, count, words, e);
	if (status != 0)
		return status;
	a.job.settings = a.settings;
	status = job_read(&job, a.path, &a.job, e) == 0 ? print_plan(cli, &a, &job, e) : e->code;
	job_free(&job);
	return status;
}

const struct cli_command cli_plan = { "plan", "list the rows of a job, of a shard of it, or those still missing", help, run };
