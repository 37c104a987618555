#include "batch/job.h"

#include "batch/job_reader.h"
#include "io/text.h"
#include "trace/flight.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct output_spec {
	bool scenes, images, drawings, report;
};
static const struct key output_keys[] = {
	{ "scenes", KEY_BOOL, offsetof(struct output_spec, scenes), 0, 1, 0, NULL, "keep every scene as scenes/NAME.nff.gz" },
	{ "images", KEY_BOOL, offsetof(struct output_spec, images), 0, 1, 0, NULL, "keep every rendering as images/NAME.png" },
	{ "drawings", KEY_BOOL, offsetof(struct output_spec, drawings), 0, 1, 0, NULL,
	  "edges, rays and visited leaves of small scenes as drawings/NAME.dat" },
	{ "report", KEY_BOOL, offsetof(struct output_spec, report), 0, 1, 0, NULL, "plots and report.html at the end" },
	{ 0 }
};

struct head_spec {
	const char *name;
	int64_t seed;
};
static const struct key head_keys[] = {
	{ "name", KEY_TEXT, offsetof(struct head_spec, name), 0, 0, 0, NULL, "of the output folder" },
	{ "seed", KEY_INT, offsetof(struct head_spec, seed), 0, 9e15, 1, NULL, "every random number follows from it" },
	{ 0 }
};

int job_append(struct job_reader *r, void **array, size_t *count, size_t *room, const void *item, size_t size)
{
	if (*count >= JOB_ROWS_MOST && !r->options->many)
		return values_fault(&r->values, 0, "more than %d combinations; --many if they are meant", JOB_ROWS_MOST);
	if (*count >= JOB_ROWS_MANY)
		return values_fault(&r->values, 0, "more than %d combinations", JOB_ROWS_MANY);
	if (*count == *room) {
		size_t want = *room ? *room * 2 : 64;
		void *grown = arena_grow(&r->job->mem, *array, *count, want, size);
		if (!grown)
			return err_memory(r->values.err, "job");
		*array = grown;
		*room = want;
	}
	memcpy((char *)*array + *count * size, item, size);
	++*count;
	return 0;
}

static int append_structure(struct job_reader *r)
{
	void *array = r->job->structures;
	int status = job_append(r, &array, &r->job->structure_count, &r->structure_room, &r->structure, sizeof r->structure);
	r->job->structures = array;
	return status;
}

/* The place of a whole-numbered option of the structure at hand, or NULL where it has none of that name. */
static int64_t *find_option(struct job_reader *r, const char *name)
{
	const struct key *k = key_find(r->structure.ops->keys, name);
	return k && k->type == KEY_INT ? (int64_t *)(void *)(r->structure.options + k->offset) : NULL;
}

/* Structures left to chance take the job's seed, and 'runs' of them are as many structures. */
static int emit_structure(void *ctx)
{
	struct job_reader *r = ctx;
	int64_t *seed = find_option(r, "seed"), *runs = find_option(r, "runs"), *run = find_option(r, "run");
	if (seed && *seed == 0)
		*seed = r->job->seed;
	if (!runs || !run || *runs == 0)
		return append_structure(r);
	int64_t count = *runs, first = *run;
	int status = 0;
	*runs = 0;
	for (int64_t i = 0; status == 0 && i < count; i++) {
		*run = first + i;
		status = append_structure(r);
	}
	*runs = count;
	*run = first;
	return status;
}

static int emit_measure(void *ctx)
{
	struct job_reader *r = ctx;
	void *array = r->job->measures;
	struct flight flight;
	struct err fault = { 0 };
	if (r->measure.render && flight_parse(&flight, r->measure.image.flight, &fault) != 0)
		return values_fault(&r->values, r->line, "%s", fault.text);
	render_resolve(&r->measure.image);
	int status = job_append(r, &array, &r->job->measure_count, &r->measure_room, &r->measure, sizeof r->measure);
	r->job->measures = array;
	return status;
}

/* "list", or a map of one entry: {octree: {...}}. */
static int read_structure(struct job_reader *r, const struct yaml_node *entry)
{
	const char *name = entry->kind == YAML_SCALAR ? values_text(&r->values, entry) : NULL;
	const struct yaml_node *options = NULL;
	if (entry->kind == YAML_MAP && entry->first && !entry->first->next) {
		name = entry->first->key;
		options = entry->first;
	}
	if (!name)
		return values_fault(&r->values, entry->line, "a structure is NAME or {NAME: {OPTION: VALUE, ...}}");
	const struct accel_ops *ops = accel_find(name);
	if (!ops) {
		char known[200] = "";
		for (const struct accel_ops *const *k = accel_all; *k; k++) {
			size_t n = strlen(known);
			snprintf(known + n, sizeof known - n, "%s%s", n ? ", " : "", (*k)->name);
		}
		return values_fault(&r->values, entry->line, "no structure '%s'; known are: %s", name, known);
	}
	if (options && options->kind == YAML_LIST)
		return values_fault(&r->values, entry->line, "%s: its options are a map", name);
	r->structure = (struct structure_spec){ .ops = ops };
	key_defaults(ops->keys, r->structure.options);
	return values_sweep(&r->values, name, options ? options->first : NULL, ops->keys, NULL, r->structure.options,
	                    emit_structure, r);
}

static int read_measure(struct job_reader *r, const struct yaml_node *entry)
{
	const struct yaml_node *image = entry->kind == YAML_MAP ? yaml_find(entry, "render") : NULL;
	if (entry->kind != YAML_MAP || (image && (image->kind != YAML_MAP || entry->first->next)))
		return values_fault(&r->values, entry->line, "a measure is {rays: invariant, count: N, ...} or {render: {width: N, ...}}");
	r->measure = (struct measure_spec){ .render = image };
	r->line = entry->line;
	key_defaults(measure_keys(&r->measure), &r->measure);
	return values_sweep(&r->values, image ? "render" : "a measure", (image ? image : entry)->first, measure_keys(&r->measure), NULL,
	                    &r->measure, emit_measure, r);
}

static void read_each(struct job_reader *r, const struct yaml_node *root, const char *key,
                      int (*read)(struct job_reader *, const struct yaml_node *))
{
	const struct yaml_node *list = yaml_find(root, key);
	if (!list || list->kind != YAML_LIST || !list->first) {
		values_fault(&r->values, list ? list->line : root->line ? root->line : 1, "'%s' must be a list with something in it", key);
		return;
	}
	for (const struct yaml_node *entry = list->first; entry; entry = entry->next)
		read(r, entry);
}

/* The scenes, structures and measures of a map: of the job itself, or of one of its experiments. */
static int read_experiment(struct job_reader *r, const struct yaml_node *map)
{
	struct job *job = r->job;
	r->experiment = (struct experiment){ .scene_first = job->scene_count, .structure_first = job->structure_count,
		                             .measure_first = job->measure_count };
	if (map->kind != YAML_MAP)
		return values_fault(&r->values, map->line, "an experiment is a map: scenes, structures, measure");
	read_each(r, map, "scenes", job_read_scene);
	read_each(r, map, "structures", read_structure);
	read_each(r, map, "measure", read_measure);
	r->experiment.scene_count = job->scene_count - r->experiment.scene_first;
	r->experiment.structure_count = job->structure_count - r->experiment.structure_first;
	r->experiment.measure_count = job->measure_count - r->experiment.measure_first;
	void *array = job->experiments;
	int status = job_append(r, &array, &job->experiment_count, &r->experiment_room, &r->experiment, sizeof r->experiment);
	job->experiments = array;
	return status;
}

static int read_listed_experiment(struct job_reader *r, const struct yaml_node *map)
{
	static const char *const known[] = { "scenes", "structures", "measure", NULL };
	for (const struct yaml_node *e = map->kind == YAML_MAP ? map->first : NULL; e; e = e->next) {
		int i = 0;
		while (known[i] && strcmp(known[i], e->key) != 0)
			i++;
		if (!known[i])
			values_fault(&r->values, e->line, "an experiment has no '%s'; known are: scenes, structures, measure", e->key);
	}
	return read_experiment(r, map);
}

/* What belongs into names of folders: [A-Za-z0-9._-], not starting with a dot. */
static bool is_plain_name(const char *name)
{
	return *name && *name != '.' && strlen(name) < 100 &&
	       strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") == strlen(name);
}

static int keep_nothing(void *ctx)
{
	(void)ctx;
	return 0;
}

static void read_head(struct job_reader *r, const struct yaml_node *root)
{
	static const char *const known[] = { "name", "seed", "vars", "scenes", "structures", "measure", "experiments", "output", NULL };
	struct head_spec head;
	struct output_spec output;
	key_defaults(head_keys, &head);
	key_defaults(output_keys, &output);
	for (const struct yaml_node *e = root->first; e; e = e->next) {
		int i = 0;
		while (known[i] && strcmp(known[i], e->key) != 0)
			i++;
		if (!known[i])
			values_fault(&r->values, e->line, "a job has no '%s'; known are: name, seed, vars, scenes, structures, measure, experiments, output",
			             e->key);
		else if (i >= 3 && i <= 5 && yaml_find(root, "experiments"))
			values_fault(&r->values, e->line, "'%s' belongs into the experiments where a job has some", e->key);
		else if (i < 2)
			values_set(&r->values, &head_keys[i], e, &head);
	}
	const struct yaml_node *out = yaml_find(root, "output");
	if (out && out->kind != YAML_MAP)
		values_fault(&r->values, out->line, "output is a map");
	else if (out)
		values_sweep(&r->values, "output", out->first, output_keys, NULL, &output, keep_nothing, NULL);
	if (!head.name || !is_plain_name(head.name))
		values_fault(&r->values, 1, "'name' must be given: letters, digits, '.', '_' and '-', not starting with '.'");
	r->job->name = head.name;
	r->job->seed = head.seed;
	r->job->save_scenes = output.scenes;
	r->job->save_images = output.images;
	r->job->save_drawings = output.drawings;
	r->job->report = output.report;
}

/* Replace variables by what the command line sets. */
static void apply_setting(struct job_reader *r, struct yaml_node *variables, const char *setting)
{
	const char *equals = strchr(setting, '=');
	struct yaml_node *found = NULL;
	if (!equals || equals == setting || !equals[1]) {
		values_fault(&r->values, 0, "--set %s: it must be NAME=VALUE or NAME=VALUE,VALUE", setting);
		return;
	}
	for (struct yaml_node *e = variables ? variables->first : NULL; e; e = e->next)
		if (strlen(e->key) == (size_t)(equals - setting) && strncmp(e->key, setting, strlen(e->key)) == 0)
			found = e;
	if (!found) {
		values_fault(&r->values, 0, "--set %s: the job has no such variable in vars", setting);
		return;
	}
	struct yaml_node **end = &found->first;
	found->kind = YAML_LIST;
	for (const char *p = equals + 1;; p++) {
		struct yaml_node *item = NEW(&r->job->mem, struct yaml_node, 1);
		size_t n = strcspn(p, ",");
		if (item)
			*item = (struct yaml_node){ .kind = YAML_SCALAR, .text = arena_text(&r->job->mem, p, n) };
		if (!item || !item->text) {
			err_memory(r->values.err, "job");
			return;
		}
		*end = item;
		end = &item->next;
		p += n;
		if (!*p)
			break;
	}
	*end = NULL;
	if (!found->first->next) {
		found->kind = YAML_SCALAR;
		found->text = found->first->text;
	}
}

static void read_root(struct job_reader *r, struct yaml_node *root)
{
	struct yaml_node *variables = NULL;
	if (root->kind != YAML_MAP) {
		values_fault(&r->values, root->line, "a job is a map: name, scenes, structures, measure");
		return;
	}
	for (struct yaml_node *e = root->first; e; e = e->next)
		if (strcmp(e->key, "vars") == 0)
			variables = e;
	if (variables && variables->kind != YAML_MAP) {
		values_fault(&r->values, variables->line, "vars is a map of values and lists");
		return;
	}
	r->values.variables = variables;
	for (size_t i = 0; i < r->options->setting_count; i++)
		apply_setting(r, variables, r->options->settings[i]);
	if (r->values.faults)
		return;
	read_head(r, root);
	if (yaml_find(root, "experiments"))
		read_each(r, root, "experiments", read_listed_experiment);
	else
		read_experiment(r, root);
	size_t rows = job_rows(r->job);
	if (rows > JOB_ROWS_MOST && !r->options->many)
		values_fault(&r->values, 0, "%zu rows, more than %d; --many if they are meant", rows, JOB_ROWS_MOST);
	else if (rows > JOB_ROWS_MANY)
		values_fault(&r->values, 0, "%zu rows, more than %d", rows, JOB_ROWS_MANY);
}

size_t job_rows(const struct job *job)
{
	size_t rows = 0;
	for (size_t i = 0; i < job->experiment_count; i++) {
		const struct experiment *x = &job->experiments[i];
		size_t more;
		if (__builtin_mul_overflow(x->scene_count, x->structure_count, &more) ||
		    __builtin_mul_overflow(more, x->measure_count, &more) || __builtin_add_overflow(rows, more, &rows))
			return SIZE_MAX;
	}
	return rows;
}

int job_parse(struct job *job, const char *path, const char *bytes, size_t n, const struct job_options *o, struct err *e)
{
	struct job_reader r = { .job = job, .options = o, .values = { .file = path, .mem = &job->mem, .err = e } };
	const char *slash = strrchr(path, '/');
	struct yaml_node *root = NULL;
	*job = (struct job){ 0 };
	job->text = arena_text(&job->mem, bytes, n);
	r.folder = arena_text(&job->mem, path, slash ? (size_t)(slash + 1 - path) : 0);
	if (job->text && r.folder)
		root = yaml_parse(path, bytes, n, &job->mem, e);
	else
		err_memory(e, path);
	if (root)
		read_root(&r, root);
	return e->code ? -1 : 0;
}

int job_read(struct job *job, const char *path, const struct job_options *o, struct err *e)
{
	struct text text = { 0 };
	*job = (struct job){ 0 };
	if (text_read_file(&text, path, YAML_BYTES, e) == 0)
		job_parse(job, path, text.bytes, text.size, o, e);
	text_free(&text);
	return e->code ? -1 : 0;
}

void job_free(struct job *job)
{
	arena_free(&job->mem);
	*job = (struct job){ 0 };
}
