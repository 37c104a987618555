#include "batch/record.h"

#include "batch/csv.h"
#include "batch/row.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* Characters of a key. */
enum { KEY_LENGTH = 16 };

static const char times_head[] = "key,job,scene,structure,seconds_build,seconds_predict,seconds_shoot,seconds_walk,rays_per_second,bytes_held,"
                                 "bytes_peak\n";

static int fault(const struct record *r, const char *file, struct err *e)
{
	char path[4096];
	snprintf(path, sizeof path, "%s%s%s", r->folder, *file ? "/" : "", file);
	return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
}

static void make_path(const struct record *r, const char *file, char *path, size_t size)
{
	snprintf(path, size, "%s/%s", r->folder, file);
}

/* Make the folder and those above it. */
static int make_folders(const struct record *r, struct err *e)
{
	char path[sizeof r->folder];
	snprintf(path, sizeof path, "%s", r->folder);
	for (char *p = path + 1;; p++) {
		if (*p && *p != '/')
			continue;
		char end = *p;
		*p = '\0';
		if (mkdir(path, 0777) != 0 && errno != EEXIST)
			return fault(r, "", e);
		if (!end)
			return 0;
		*p = end;
	}
}

static int take_lock(struct record *r, struct err *e)
{
	char path[4096];
	make_path(r, ".lock", path, sizeof path);
	r->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
	if (r->lock < 0)
		return fault(r, ".lock", e);
	if (flock(r->lock, LOCK_EX | LOCK_NB) == 0)
		return 0;
	if (errno == EWOULDBLOCK)
		return err_at(e, STATUS_BUSY, r->folder, 0, "another run is at work here");
	return fault(r, ".lock", e);
}

static int append_aside(const struct record *r, const char *head, const struct text *rows, struct err *e)
{
	char path[4096];
	struct text whole = { 0 };
	make_path(r, "counts.old.csv", path, sizeof path);
	if (access(path, F_OK) == 0) {
		if (text_read_file(&whole, path, SIZE_MAX, e) != 0) {
			text_free(&whole);
			return -1;
		}
	}
	if (whole.size == 0 || strncmp(whole.bytes, head, strlen(head)) != 0)
		text_add(&whole, head, strlen(head));
	text_add(&whole, rows->bytes, rows->size);
	int status = text_write_file(&whole, path, e);
	text_free(&whole);
	return status;
}

/* Read counts.csv into r->old; set aside what has other columns. */
static int read_old(struct record *r, struct err *e)
{
	char path[4096];
	struct text found = { 0 }, head = { 0 };
	int status = 0;
	make_path(r, "counts.csv", path, sizeof path);
	row_print_head(&head);
	if (access(path, F_OK) == 0)
		status = text_read_file(&found, path, SIZE_MAX, e);
	while (found.size > 0 && found.bytes[found.size - 1] != '\n')
		found.size--;
	if (found.bytes)
		found.bytes[found.size] = '\0';
	if (status == 0 && found.size >= head.size && memcmp(found.bytes, head.bytes, head.size) == 0)
		text_add(&r->old, found.bytes + head.size, found.size - head.size);
	else if (status == 0 && found.size > 0)
		status = append_aside(r, "", &found, e);
	text_free(&found);
	text_free(&head);
	return status;
}

static int open_file(struct record *r, const char *name, const char *head, bool truncate, int *fd, struct err *e)
{
	char path[4096];
	make_path(r, name, path, sizeof path);
	*fd = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (truncate ? O_TRUNC : 0), 0666);
	if (*fd < 0)
		return fault(r, name, e);
	struct stat info;
	if (fstat(*fd, &info) != 0)
		return fault(r, name, e);
	if (info.st_size == 0 && write(*fd, head, strlen(head)) != (ssize_t)strlen(head))
		return fault(r, name, e);
	return 0;
}

/* counts.csv again from what was good in it, so that new rows can be appended. */
static int start_counts(struct record *r, struct err *e)
{
	char path[4096];
	struct text good = { 0 };
	make_path(r, "counts.csv", path, sizeof path);
	row_print_head(&r->done);
	text_add(&good, r->done.bytes, r->done.size);
	text_add(&good, r->old.size ? r->old.bytes : "", r->old.size);
	int status = text_write_file(&good, path, e);
	text_free(&good);
	return status == 0 ? open_file(r, "counts.csv", "", false, &r->counts, e) : -1;
}

/* The next line of a text, or NULL at its end. */
static const char *next_line(const char *line)
{
	const char *end = strchr(line, '\n');
	return end && end[1] ? end + 1 : NULL;
}

static int compare_keys(const void *a, const void *b)
{
	const char *x = *(const char *const *)a, *y = *(const char *const *)b;
	return strncmp(x, y, KEY_LENGTH);
}

/* Index the lines of a text, or only those of status ok. */
static int make_index(struct line_index *index, const struct text *text, bool ok_only, struct err *e)
{
	size_t lines = 0;
	for (const char *line = text->size ? text->bytes : NULL; line; line = next_line(line))
		lines++;
	*index = (struct line_index){ malloc((lines + 1) * sizeof *index->lines), 0 };
	if (!index->lines)
		return err_memory(e, "record");
	for (const char *line = text->size ? text->bytes : NULL; line; line = next_line(line)) {
		char status[16];
		if (!ok_only || (csv_field(line, row_column("status"), status, sizeof status) && strcmp(status, "ok") == 0))
			index->lines[index->count++] = line;
	}
	qsort(index->lines, index->count, sizeof *index->lines, compare_keys);
	return 0;
}

static const char *find_line(const struct line_index *index, const char *key)
{
	const char *const *found = bsearch(&key, index->lines, index->count, sizeof *index->lines, compare_keys);
	return found ? *found : NULL;
}

int record_open(struct record *r, const char *folder, bool fresh, struct err *e)
{
	*r = (struct record){ .lock = -1, .counts = -1, .times = -1 };
	if ((size_t)snprintf(r->folder, sizeof r->folder, "%s", folder) >= sizeof r->folder)
		return err_at(e, STATUS_INPUT, NULL, 0, "the output folder's path is too long");
	if (make_folders(r, e) != 0 || take_lock(r, e) != 0)
		return -1;
	if (!fresh && read_old(r, e) != 0)
		return -1;
	if (make_index(&r->good, &r->old, true, e) != 0 || start_counts(r, e) != 0)
		return -1;
	return open_file(r, "times.csv", times_head, fresh, &r->times, e);
}

const char *record_find(const struct record *r, const char *key)
{
	return find_line(&r->good, key);
}

int record_keep(struct record *r, const char *line, struct err *e)
{
	text_add(&r->done, line, (size_t)(strchr(line, '\n') + 1 - line));
	r->kept++;
	return r->done.lost ? err_memory(e, "record") : 0;
}

static int write_line(const struct record *r, int fd, const char *name, const char *line, struct err *e)
{
	size_t n = strlen(line);
	errno = ENOSPC; /* what a short write means */
	return write(fd, line, n) == (ssize_t)n ? 0 : fault(r, name, e);
}

int record_add(struct record *r, const char *line, bool failed, struct err *e)
{
	text_add(&r->done, line, strlen(line));
	r->added++;
	r->failed += failed;
	return r->done.lost ? err_memory(e, "record") : write_line(r, r->counts, "counts.csv", line, e);
}

int record_time(struct record *r, const char *line, struct err *e)
{
	return write_line(r, r->times, "times.csv", line, e);
}

/* Old rows whose key no combination of this run has. */
static int list_strangers(const struct record *r, struct text *strangers, struct err *e)
{
	struct line_index done;
	if (make_index(&done, &r->done, false, e) != 0)
		return -1;
	for (const char *line = r->old.size ? r->old.bytes : NULL; line; line = next_line(line))
		if (!find_line(&done, line))
			text_add(strangers, line, (size_t)(strchr(line, '\n') + 1 - line));
	free(done.lines);
	return strangers->lost ? err_memory(e, "record") : 0;
}

int record_finish(struct record *r, struct err *e)
{
	char path[4096];
	struct text strangers = { 0 }, head = { 0 };
	row_print_head(&head);
	int status = list_strangers(r, &strangers, e);
	if (status == 0 && strangers.size)
		status = append_aside(r, head.bytes, &strangers, e);
	make_path(r, "counts.csv", path, sizeof path);
	if (status == 0)
		status = text_write_file(&r->done, path, e);
	text_free(&strangers);
	text_free(&head);
	return status;
}

void record_close(struct record *r)
{
	if (r->counts >= 0)
		close(r->counts);
	if (r->times >= 0)
		close(r->times);
	if (r->lock >= 0)
		close(r->lock);
	free(r->good.lines);
	text_free(&r->old);
	text_free(&r->done);
}
