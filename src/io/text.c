#include "io/text.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static bool reserve(struct text *t, size_t more)
{
	if (t->lost)
		return false;
	if (t->room - t->size > more)
		return true;
	size_t want = t->room * 2 > t->size + more + 1 ? t->room * 2 : t->size + more + 256;
	char *grown = realloc(t->bytes, want);
	if (!grown) {
		t->lost = true;
		return false;
	}
	t->bytes = grown;
	t->room = want;
	return true;
}

void text_print(struct text *t, const char *fmt, ...)
{
	for (size_t need = 64; reserve(t, need);) {
		va_list args;
		va_start(args, fmt);
		int n = vsnprintf(t->bytes + t->size, t->room - t->size, fmt, args);
		va_end(args);
		if (n < 0)
			return;
		if ((size_t)n < t->room - t->size) {
			t->size += (size_t)n;
			return;
		}
		need = (size_t)n + 1;
	}
}

void text_add(struct text *t, const char *bytes, size_t n)
{
	if (!reserve(t, n + 1))
		return;
	memcpy(t->bytes + t->size, bytes, n);
	t->size += n;
	t->bytes[t->size] = '\0';
}

void text_free(struct text *t)
{
	free(t->bytes);
	*t = (struct text){ 0 };
}

/* What zlib or the system has to say about a file that cannot be read on. */
static int report_gz(gzFile f, const char *path, struct err *e)
{
	int code;
	gzerror(f, &code);
	if (code == Z_ERRNO)
		return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	if (code == Z_MEM_ERROR)
		return err_memory(e, path);
	return err_at(e, STATUS_INPUT, path, 0, "damaged or truncated gzip");
}

/* Scenes as text shrink to a fifth or a twentieth; a gzip file made to fill the memory, to a thousandth. */
enum { RATIO_MOST = 100, SMALL = 64 << 20 };

static int read_all(struct text *t, gzFile f, const char *path, size_t limit, size_t packed, struct err *e)
{
	char piece[65536];
	int n;
	while ((n = gzread(f, piece, sizeof piece)) > 0) {
		if (t->size + (size_t)n > limit)
			return err_at(e, STATUS_INPUT, path, 0, "more than %zu bytes of content", limit);
		if (t->size > SMALL && t->size / RATIO_MOST > packed)
			return err_at(e, STATUS_INPUT, path, 0, "unpacks to more than %d times its size", RATIO_MOST);
		text_add(t, piece, (size_t)n);
		if (t->lost)
			return err_memory(e, path);
	}
	/* At a truncated end gzread returns 0 as at a whole one; only gzerror and gzclose tell. */
	int code;
	gzerror(f, &code);
	return n < 0 || (code != Z_OK && code != Z_STREAM_END) ? report_gz(f, path, e) : 0;
}

int text_read_file(struct text *t, const char *path, size_t limit, struct err *e)
{
	/* A FIFO without a writer must not hang the run. */
	int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
	struct stat info;
	if (fd < 0)
		return err_at(e, STATUS_INPUT, path, 0, "%s", strerror(errno));
	if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
		close(fd);
		return err_at(e, STATUS_INPUT, path, 0, "not a regular file");
	}
	gzFile f = gzdopen(fd, "rb");
	if (!f) {
		close(fd);
		return err_memory(e, path);
	}
	text_add(t, "", 0);
	int status = read_all(t, f, path, limit, (size_t)info.st_size, e);
	int closed = gzclose(f);
	if (status == 0 && closed != Z_OK)
		status = err_at(e, STATUS_INPUT, path, 0, "damaged or truncated gzip");
	return status;
}

static int write_all(int fd, const char *bytes, size_t n)
{
	while (n > 0) {
		ssize_t done = write(fd, bytes, n);
		if (done < 0 && errno == EINTR)
			continue;
		if (done < 0)
			return -1;
		bytes += done;
		n -= (size_t)done;
	}
	return 0;
}

/* The gzip form of a text: no name, no time. */
static int compress_text(const struct text *t, struct text *packed)
{
	z_stream z = { .next_in = (Bytef *)t->bytes };
	if (deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
		return -1;
	size_t left = t->size;
	int status = Z_OK;
	do {
		Bytef piece[65536];
		if (z.avail_in == 0) {
			z.avail_in = left < 1u << 30 ? (uInt)left : 1u << 30;
			left -= z.avail_in;
		}
		z.next_out = piece;
		z.avail_out = sizeof piece;
		status = deflate(&z, left ? Z_NO_FLUSH : Z_FINISH);
		text_add(packed, (const char *)piece, sizeof piece - z.avail_out);
	} while (status == Z_OK);
	deflateEnd(&z);
	return status == Z_STREAM_END && !packed->lost ? 0 : -1;
}

static int replace_file(const char *bytes, size_t n, const char *path, struct err *e)
{
	char beside[4096];
	if (snprintf(beside, sizeof beside, "%s.%ld.tmp", path, (long)getpid()) >= (int)sizeof beside)
		return err_at(e, STATUS_ENVIRONMENT, path, 0, "path too long");
	int fd = open(beside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
	if (fd < 0)
		return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	int failed = write_all(fd, bytes, n) != 0 || fsync(fd) != 0 ? errno : 0;
	if (close(fd) != 0 && !failed)
		failed = errno;
	if (!failed && rename(beside, path) != 0)
		failed = errno;
	if (!failed)
		return 0;
	unlink(beside);
	return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(failed));
}

int text_write_file(const struct text *t, const char *path, struct err *e)
{
	size_t length = strlen(path);
	if (t->lost)
		return err_memory(e, path);
	if (length < 3 || strcmp(path + length - 3, ".gz") != 0)
		return replace_file(t->bytes, t->size, path, e);
	struct text packed = { 0 };
	int status = compress_text(t, &packed) == 0 ? replace_file(packed.bytes, packed.size, path, e) : err_memory(e, path);
	text_free(&packed);
	return status;
}
