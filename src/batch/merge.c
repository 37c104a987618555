#include "batch/merge.h"

#include "batch/found.h"

#include <dirent.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The plan that all shards share. */
static int read_plan(struct text *plan, const struct found *f, struct err *e)
{
	const char *first = NULL;
	for (size_t i = 1; i < f->source_count; i++) {
		const struct found_source *s = &f->sources[i];
		char path[4200];
		struct text keys = { 0 };
		struct stat info;
		snprintf(path, sizeof path, "%s/plan.csv", s->folder);
		if (stat(path, &info) != 0)
			continue; /* ended before it had a plan */
		if (text_read_file(&keys, path, SIZE_MAX, e) != 0) {
			text_free(&keys);
			return -1;
		}
		bool same = !first || (keys.size == plan->size && memcmp(keys.bytes, plan->bytes, keys.size) == 0);
		if (first) {
			text_free(&keys);
		} else {
			*plan = keys;
			first = s->folder;
		}
		if (!same)
			return err_at(e, STATUS_INPUT, NULL, 0, "%s and %s are shards of different jobs: the job or a scene has changed; remove one of them",
			              first, s->folder);
		if (s->old.foreign.size && !s->old.rows.size)
			return err_at(e, STATUS_INPUT, s->folder, 0, "its rows are those of another version of raycost");
	}
	return first ? 0 : err_at(e, STATUS_INPUT, f->sources[0].folder, 0, "there are no shards");
}

static int add_rows(struct record *r, struct merge_result *result, const struct text *plan, const struct found *f,
                    struct text *missing, struct err *e)
{
	int status = 0;
	for (const char *key = line_next(plan->bytes); status == 0 && key; key = line_next(key)) {
		const struct found_row *row = found_row(f, key);
		result->rows++;
		if (row)
			status = record_add(r, row->line, !row->ok, e);
		else
			text_print(missing, "%.16s\n", key);
		result->missing += !row;
	}
	result->failed = r->failed;
	return missing->lost ? err_memory(e, "merge") : status;
}

/* The times of all rows, those of FOLDER first; a line that is there already is not added again. */
static int add_times(struct record *r, const struct found *f, struct err *e)
{
	struct text known = { 0 };
	int status = 0;
	for (size_t i = 0; status == 0 && i < f->source_count; i++) {
		char path[4200];
		struct text times = { 0 };
		struct line_index index = { 0 };
		struct stat info;
		snprintf(path, sizeof path, "%s/times.csv", f->sources[i].folder);
		if (stat(path, &info) != 0)
			continue;
		if (text_read_file(&times, path, SIZE_MAX, e) != 0 || line_index_make(&index, &known, false, e) != 0)
			status = -1;
		for (const char *line = times.size ? line_next(times.bytes) : NULL; status == 0 && line; line = line_next(line)) {
			const char *end = strchr(line, '\n');
			if (!end)
				break;
			struct text one = { 0 };
			const char *old = line_index_find(&index, line);
			text_add(&one, line, (size_t)(end + 1 - line));
			if (i > 0 && !(old && strncmp(old, one.bytes, one.size) == 0))
				status = record_time(r, one.bytes, e);
			text_free(&one);
		}
		if (i == 0 && times.size)
			text_add(&known, times.bytes, times.size);
		free(index.lines);
		text_free(&times);
	}
	text_free(&known);
	return status;
}

/* What a shard keeps of one kind moves to where an unsharded run keeps it. */
static int move_files(const char *from, const char *to, const char *kind, struct err *e)
{
	char source[4096], target[4096];
	int status = 0;
	snprintf(source, sizeof source, "%s/%s", from, kind);
	snprintf(target, sizeof target, "%s/%s", to, kind);
	DIR *open = opendir(source);
	if (!open)
		return 0;
	if (mkdir(target, 0777) != 0 && errno != EEXIST)
		status = err_at(e, STATUS_ENVIRONMENT, target, 0, "%s", strerror(errno));
	for (struct dirent *entry; status == 0 && (entry = readdir(open)) != NULL;) {
		char old[4400], new[4400];
		if (*entry->d_name == '.')
			continue;
		snprintf(old, sizeof old, "%s/%s", source, entry->d_name);
		snprintf(new, sizeof new, "%s/%s", target, entry->d_name);
		if (rename(old, new) != 0)
			status = err_at(e, STATUS_ENVIRONMENT, new, 0, "%s", strerror(errno));
	}
	closedir(open);
	return status;
}

static int move_all(const char *folder, const struct found *f, struct err *e)
{
	static const char *const kinds[] = { "scenes", "images", "drawings" };
	int status = 0;
	for (size_t i = 1; i < f->source_count; i++)
		for (size_t k = 0; status == 0 && k < sizeof kinds / sizeof *kinds; k++)
			status = move_files(f->sources[i].folder, folder, kinds[k], e);
	return status;
}

int merge_shards(const char *folder, struct merge_result *result, struct text *missing, struct err *e)
{
	struct found found = { 0 };
	struct text plan = { 0 };
	struct record record = { .lock = -1, .counts = -1, .times = -1 };
	*result = (struct merge_result){ 0 };
	int status = found_read(&found, folder, e);
	if (status == 0)
		status = read_plan(&plan, &found, e);
	if (status == 0)
		status = found_check(&found, e);
	if (status == 0)
		status = record_open(&record, folder, false, e);
	if (status == 0)
		status = add_rows(&record, result, &plan, &found, missing, e);
	if (status == 0)
		status = add_times(&record, &found, e);
	if (status == 0)
		status = move_all(folder, &found, e);
	if (status == 0)
		status = record_finish(&record, e);
	result->shards = found.source_count - 1;
	record_close(&record);
	text_free(&plan);
	found_free(&found);
	return status;
}
