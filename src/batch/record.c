#include "batch/record.h"

#include "batch/csv.h"
#include "batch/row.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* Whether the lock's name still leads to the file that is locked: nobody has removed or replaced the folder. */
static int check_lock(const struct record *r, struct err *e)
{
	char path[4096];
	struct stat held, named;
	make_path(r, ".lock", path, sizeof path);
	if (fstat(r->lock, &held) == 0 && stat(path, &named) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev)
		return 0;
	return err_at(e, STATUS_ENVIRONMENT, r->folder, 0, "the output folder was removed or replaced; the same command starts again");
}

static int take_lock(struct record *r, struct err *e)
{
	char path[4096];
	make_path(r, ".lock", path, sizeof path);
	r->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
	if (r->lock < 0)
		return fault(r, ".lock", e);
	if (flock(r->lock, LOCK_EX | LOCK_NB) == 0)
		return check_lock(r, e);
	if (errno == EWOULDBLOCK)
		return err_at(e, STATUS_BUSY, r->folder, 0, "another run is at work here");
	return fault(r, ".lock", e);
}

/* Whether a name is NAME.NUMBER.tmp: a file that a killed run was writing beside the one it was to replace. */
static bool is_leftover(const char *name)
{
	const char *end = strstr(name, ".tmp"), *p = end;
	if (!end || end[4])
		return false;
	while (p > name && isdigit((unsigned char)p[-1]))
		p--;
	return p < end && p > name && p[-1] == '.';
}

/* Only the lock's holder writes here: whatever is half written has no writer any more. */
static void remove_leftovers(const struct record *r)
{
	static const char *const folders[] = { ".", "scenes", "images", "drawings", "plots" };
	for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
		char path[4096], file[4400];
		make_path(r, folders[i], path, sizeof path);
		DIR *folder = opendir(path);
		for (struct dirent *entry; folder && (entry = readdir(folder)) != NULL;) {
			snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
			if (is_leftover(entry->d_name))
				unlink(file);
		}
		if (folder)
			closedir(folder);
	}
}

const char *line_next(const char *line)
{
	const char *end = strchr(line, '\n');
	return end && end[1] ? end + 1 : NULL;
}

static const char *first_line(const struct text *text)
{
	return text->size ? text->bytes : NULL;
}

static size_t line_length(const char *line)
{
	return (size_t)(strchr(line, '\n') + 1 - line);
}

static int compare_keys(const void *a, const void *b)
{
	const char *x = *(const char *const *)a, *y = *(const char *const *)b;
	return strncmp(x, y, KEY_LENGTH);
}

bool line_is_ok(const char *line)
{
	char status[16];
	return csv_field(line, row_column("status"), status, sizeof status) && strcmp(status, "ok") == 0;
}

int line_index_make(struct line_index *index, const struct text *rows, bool ok_only, struct err *e)
{
	size_t lines = 0;
	for (const char *line = first_line(rows); line; line = line_next(line))
		lines++;
	*index = (struct line_index){ malloc((lines + 1) * sizeof *index->lines), 0 };
	if (!index->lines)
		return err_memory(e, "record");
	for (const char *line = first_line(rows); line; line = line_next(line))
		if (!ok_only || line_is_ok(line))
			index->lines[index->count++] = line;
	qsort(index->lines, index->count, sizeof *index->lines, compare_keys);
	return 0;
}

const char *line_index_find(const struct line_index *index, const char *key)
{
	const char *const *found = bsearch(&key, index->lines, index->count, sizeof *index->lines, compare_keys);
	return found ? *found : NULL;
}

/* A key of 16 hexadecimal digits and as many fields as there are columns. line: ended by a newline. */
static bool is_row(const char *line, size_t length, int columns)
{
	char field[8];
	return length > KEY_LENGTH && strspn(line, "0123456789abcdef") == KEY_LENGTH && !memchr(line, '\0', length) &&
	       csv_field(line, columns - 1, field, sizeof field) && !csv_field(line, columns, field, sizeof field);
}

int old_rows_read(struct old_rows *old, const char *path, struct err *e)
{
	struct text found = { 0 }, head = { 0 };
	struct err own = { 0 };
	int columns = 0;
	bool ours = false;
	while (row_columns[columns].name)
		columns++;
	row_print_head(&head);
	if (access(path, F_OK) == 0 && text_read_file(&found, path, SIZE_MAX, &own) != 0)
		err_at(e, STATUS_ENVIRONMENT, NULL, 0, "%s", own.text);
	/* What follows the last newline is torn. */
	for (const char *line = found.bytes, *end; line && (end = memchr(line, '\n', (size_t)(found.bytes + found.size - line))) != NULL;
	     line = end + 1) {
		size_t length = (size_t)(end + 1 - line);
		bool is_head = length > 4 && memcmp(line, "key,", 4) == 0;
		if (is_head)
			ours = length == head.size && memcmp(line, head.bytes, length) == 0;
		if (!ours)
			text_add(&old->foreign, line, length);
		else if (!is_head && is_row(line, length, columns))
			text_add(&old->rows, line, length);
	}
	bool lost = head.lost || old->rows.lost || old->foreign.lost;
	text_free(&found);
	text_free(&head);
	return own.code ? -1 : lost ? err_memory(e, path) : 0;
}

void old_rows_free(struct old_rows *old)
{
	text_free(&old->rows);
	text_free(&old->foreign);
}

/* Of every key one row, of status ok if there is one. */
static int fold_rows(struct text *rows, struct err *e)
{
	struct text folded = { 0 };
	struct line_index all, good = { 0 };
	int status = line_index_make(&good, rows, true, e);
	if (status == 0 && (status = line_index_make(&all, rows, false, e)) == 0) {
		for (const char *line = first_line(rows); line; line = line_next(line)) {
			const char *chosen = line_index_find(&good, line);
			if ((chosen ? chosen : line_index_find(&all, line)) == line)
				text_add(&folded, line, line_length(line));
		}
		free(all.lines);
	}
	free(good.lines);
	if (folded.lost)
		status = err_memory(e, "record");
	text_free(rows);
	*rows = folded;
	return status;
}

/* counts.old.csv: these rows and what other versions wrote; no file where there are none. */
static int write_aside(const struct record *r, const struct text *rows, struct err *e)
{
	char path[4096];
	struct text whole = { 0 };
	make_path(r, "counts.old.csv", path, sizeof path);
	if (rows->size == 0 && r->old.foreign.size == 0)
		return unlink(path) == 0 || errno == ENOENT ? 0 : fault(r, "counts.old.csv", e);
	if (rows->size)
		row_print_head(&whole);
	text_add(&whole, rows->size ? rows->bytes : "", rows->size);
	text_add(&whole, r->old.foreign.size ? r->old.foreign.bytes : "", r->old.foreign.size);
	int status = text_write_file(&whole, path, e);
	text_free(&whole);
	return status;
}

static int read_old(struct record *r, bool fresh, struct err *e)
{
	char counts[4096], aside[4096];
	make_path(r, "counts.csv", counts, sizeof counts);
	make_path(r, "counts.old.csv", aside, sizeof aside);
	if (!fresh && (old_rows_read(&r->old, aside, e) != 0 || old_rows_read(&r->old, counts, e) != 0 || fold_rows(&r->old.rows, e) != 0))
		return -1;
	return line_index_make(&r->good, &r->old.rows, true, e);
}

/* counts.csv with nothing but its head, open for rows; what it held is aside by now. */
static int start_counts(struct record *r, struct err *e)
{
	char path[4096];
	struct text head = { 0 };
	make_path(r, "counts.csv", path, sizeof path);
	row_print_head(&head);
	int status = text_write_file(&head, path, e);
	text_free(&head);
	if (status != 0)
		return -1;
	r->counts = open(path, O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK);
	return r->counts < 0 ? fault(r, "counts.csv", e) : 0;
}

/* How much of times.csv is whole lines; what has another head than today's becomes times.old.csv. */
static int find_times(const struct record *r, off_t *whole, struct err *e)
{
	char path[4096], aside[4096];
	struct text found = { 0 };
	struct err own = { 0 };
	make_path(r, "times.csv", path, sizeof path);
	make_path(r, "times.old.csv", aside, sizeof aside);
	*whole = 0;
	if (access(path, F_OK) != 0)
		return 0;
	if (text_read_file(&found, path, SIZE_MAX, &own) != 0)
		err_at(e, STATUS_ENVIRONMENT, NULL, 0, "%s", own.text);
	size_t size = found.size, head = sizeof times_head - 1;
	while (size > 0 && found.bytes[size - 1] != '\n')
		size--;
	if (own.code == 0 && size >= head && memcmp(found.bytes, times_head, head) == 0)
		*whole = (off_t)size;
	else if (own.code == 0 && size > 0 && rename(path, aside) != 0)
		own.code = fault(r, "times.old.csv", e);
	text_free(&found);
	return own.code ? -1 : 0;
}

/* times.csv open for lines; a torn last one is cut off. */
static int start_times(struct record *r, bool fresh, struct err *e)
{
	char path[4096];
	off_t whole = 0;
	make_path(r, "times.csv", path, sizeof path);
	if (!fresh && find_times(r, &whole, e) != 0)
		return -1;
	r->times = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
	if (r->times < 0 || ftruncate(r->times, whole) != 0)
		return fault(r, "times.csv", e);
	return whole == 0 ? record_time(r, times_head, e) : 0;
}

int record_open(struct record *r, const char *folder, bool fresh, struct err *e)
{
	*r = (struct record){ .lock = -1, .counts = -1, .times = -1 };
	if ((size_t)snprintf(r->folder, sizeof r->folder, "%s", folder) >= sizeof r->folder)
		return err_at(e, STATUS_INPUT, NULL, 0, "the output folder's path is too long");
	if (make_folders(r, e) != 0 || take_lock(r, e) != 0)
		return -1;
	remove_leftovers(r);
	if (read_old(r, fresh, e) != 0 || write_aside(r, &r->old.rows, e) != 0 || start_counts(r, e) != 0)
		return -1;
	return start_times(r, fresh, e);
}

const char *record_find(const struct record *r, const char *key)
{
	return line_index_find(&r->good, key);
}

static int write_line(const struct record *r, int fd, const char *name, const char *line, size_t n, struct err *e)
{
	ssize_t done;
	if (check_lock(r, e) != 0)
		return -1;
	do {
		errno = ENOSPC; /* what a short write means */
		done = write(fd, line, n);
	} while (done < 0 && errno == EINTR);
	return done == (ssize_t)n ? 0 : fault(r, name, e);
}

/* The next row of counts.csv. */
static int write_row(struct record *r, const char *line, struct err *e)
{
	text_print(&r->keys, "%.*s\n", KEY_LENGTH, line);
	return r->keys.lost ? err_memory(e, "record") : write_line(r, r->counts, "counts.csv", line, line_length(line), e);
}

int record_keep(struct record *r, const char *line, struct err *e)
{
	r->kept++;
	return write_row(r, line, e);
}

int record_add(struct record *r, const char *line, bool failed, struct err *e)
{
	r->added++;
	r->failed += failed;
	return write_row(r, line, e);
}

int record_time(struct record *r, const char *line, struct err *e)
{
	return write_line(r, r->times, "times.csv", line, strlen(line), e);
}

/* Old rows whose key no combination of this run has. Failed ones are not kept: of a scene that could not be read the key is another. */
static int list_strangers(const struct record *r, struct text *strangers, struct err *e)
{
	struct line_index done;
	if (line_index_make(&done, &r->keys, false, e) != 0)
		return -1;
	for (const char *line = first_line(&r->old.rows); line; line = line_next(line))
		if (line_is_ok(line) && !line_index_find(&done, line))
			text_add(strangers, line, line_length(line));
	free(done.lines);
	return strangers->lost ? err_memory(e, "record") : 0;
}

int record_finish(struct record *r, struct err *e)
{
	struct text strangers = { 0 };
	int status = fsync(r->counts) == 0 ? list_strangers(r, &strangers, e) : fault(r, "counts.csv", e);
	if (status == 0)
		status = write_aside(r, &strangers, e);
	text_free(&strangers);
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
	old_rows_free(&r->old);
	text_free(&r->keys);
}
