#include "batch/found.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct shard {
	long number, of;
};

static int compare_shards(const void *a, const void *b)
{
	const struct shard *x = a, *y = b;
	return x->of != y->of ? (x->of < y->of ? -1 : 1) : (x->number > y->number) - (x->number < y->number);
}

/* The folders FOLDER/shards/K-of-N in order; *shards is the caller's. */
static int list_shards(struct shard **shards, size_t *count, const char *folder, struct err *e)
{
	char path[4096];
	size_t room = 0;
	*shards = NULL;
	*count = 0;
	snprintf(path, sizeof path, "%s/shards", folder);
	DIR *open = opendir(path);
	if (!open)
		return errno == ENOENT || errno == ENOTDIR ? 0 : err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	for (struct dirent *entry; (entry = readdir(open)) != NULL;) {
		struct shard s;
		int end = 0;
		if (sscanf(entry->d_name, "%9ld-of-%9ld%n", &s.number, &s.of, &end) != 2 || entry->d_name[end])
			continue;
		if (*count == room) {
			room = room ? 2 * room : 64;
			struct shard *grown = realloc(*shards, room * sizeof *grown);
			if (!grown) {
				closedir(open);
				return err_memory(e, "shards");
			}
			*shards = grown;
		}
		(*shards)[(*count)++] = s;
	}
	closedir(open);
	if (*count)
		qsort(*shards, *count, sizeof **shards, compare_shards);
	return 0;
}

static int read_source(struct found *f, const char *folder, struct err *e)
{
	struct found_source *s = &f->sources[f->source_count++];
	char path[4200];
	s->folder = arena_text(&f->mem, folder, strlen(folder));
	if (!s->folder)
		return err_memory(e, "rows");
	snprintf(path, sizeof path, "%s/counts.csv", folder);
	int status = old_rows_read(&s->old, path, e);
	snprintf(path, sizeof path, "%s/counts.old.csv", folder);
	return status == 0 ? old_rows_read(&s->old, path, e) : -1;
}

static int compare_rows(const void *a, const void *b)
{
	const struct found_row *x = a, *y = b;
	int order = strncmp(x->line, y->line, KEY_LENGTH);
	if (order != 0)
		return order;
	if (x->ok != y->ok)
		return x->ok ? -1 : 1;
	if (x->source != y->source)
		return x->source < y->source ? -1 : 1;
	return (x->line > y->line) - (x->line < y->line);
}

static int sort_rows(struct found *f, struct err *e)
{
	for (int turn = 0; turn < 2; turn++) {
		f->row_count = 0;
		for (size_t i = 0; i < f->source_count; i++) {
			const struct text *rows = &f->sources[i].old.rows;
			for (const char *line = rows->size ? rows->bytes : NULL; line; line = line_next(line)) {
				if (turn == 1)
					f->rows[f->row_count] = (struct found_row){ line, i, line_is_ok(line) };
				f->row_count++;
			}
		}
		if (turn == 0 && !(f->rows = NEW(&f->mem, struct found_row, f->row_count)))
			return err_memory(e, "rows");
	}
	qsort(f->rows, f->row_count, sizeof *f->rows, compare_rows);
	return 0;
}

int found_read(struct found *f, const char *folder, struct err *e)
{
	struct shard *shards;
	size_t count;
	int status = list_shards(&shards, &count, folder, e);
	f->sources = NEW(&f->mem, struct found_source, count + 1);
	if (status == 0)
		status = f->sources ? read_source(f, folder, e) : err_memory(e, "rows");
	for (size_t i = 0; status == 0 && i < count; i++) {
		char path[4096];
		snprintf(path, sizeof path, "%s/shards/%ld-of-%ld", folder, shards[i].number, shards[i].of);
		status = read_source(f, path, e);
	}
	free(shards);
	return status == 0 ? sort_rows(f, e) : -1;
}

void found_free(struct found *f)
{
	for (size_t i = 0; i < f->source_count; i++)
		old_rows_free(&f->sources[i].old);
	arena_free(&f->mem);
	*f = (struct found){ 0 };
}

const struct found_row *found_row(const struct found *f, const char *key)
{
	size_t low = 0, high = f->row_count;
	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (strncmp(f->rows[middle].line, key, KEY_LENGTH) < 0)
			low = middle + 1;
		else
			high = middle;
	}
	return low < f->row_count && strncmp(f->rows[low].line, key, KEY_LENGTH) == 0 ? &f->rows[low] : NULL;
}

const char *found_line(const struct found *f, const char *key)
{
	const struct found_row *row = found_row(f, key);
	return row && row->ok ? row->line : NULL;
}

int found_check(const struct found *f, struct err *e)
{
	for (size_t i = 1; i < f->row_count; i++) {
		const struct found_row *x = &f->rows[i - 1], *y = &f->rows[i];
		size_t n = (size_t)(strchr(x->line, '\n') + 1 - x->line);
		if (y->ok && strncmp(x->line, y->line, KEY_LENGTH) == 0 && strncmp(x->line, y->line, n) != 0)
			return err_at(e, STATUS_INPUT, NULL, 0, "%s and %s differ in the row of key %.16s", f->sources[x->source].folder,
			              f->sources[y->source].folder, x->line);
	}
	return 0;
}
