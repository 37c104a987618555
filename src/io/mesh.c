#include "io/mesh.h"

#include "base/progress.h"
#include "io/format.h"
#include "io/mesh_import.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Sanitizers reserve address space beyond any useful limit. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { LIMITS_MEMORY = 0 };
#else
enum { LIMITS_MEMORY = 1 };
#endif

static const uint64_t triangles_most = 20000000, materials_most = 1000000;

/* The importing process as its parent sees it. */
struct importer {
	int fd;
	const char *name;
	const struct mesh_limits *limits;
	double deadline;
	struct err *err;
};

__attribute__((format(printf, 2, 3)))
static int refuse(const struct importer *i, const char *fmt, ...)
{
	char why[500];
	va_list args;
	va_start(args, fmt);
	vsnprintf(why, sizeof why, fmt, args);
	va_end(args);
	why[strcspn(why, "\n")] = '\0';
	return err_at(i->err, STATUS_INPUT, i->name, 0, "%s", why);
}

static void limit(int what, rlim_t most)
{
	struct rlimit old;
	if (getrlimit(what, &old) == 0 && old.rlim_max != RLIM_INFINITY && old.rlim_max < most)
		most = old.rlim_max;
	setrlimit(what, &(struct rlimit){ most, most });
}

/* In the new process: nothing of the parent's but the pipe is touched, nothing is printed, no file grows. */
_Noreturn static void import(int fd, const char *name, const char *text, size_t n, const char *folders, const struct mesh_limits *limits)
{
	static const int signals[] = { SIGINT, SIGTERM, SIGHUP, SIGPIPE };
	int null = open("/dev/null", O_RDWR);
	for (size_t i = 0; i < sizeof signals / sizeof *signals; i++)
		signal(signals[i], SIG_DFL);
	for (int k = 0; k < 3 && null >= 0; k++)
		dup2(null, k);
	limit(RLIMIT_CORE, 0);
	limit(RLIMIT_FSIZE, 0);
	limit(RLIMIT_CPU, (rlim_t)limits->seconds + 1);
	if (LIMITS_MEMORY)
		limit(RLIMIT_AS, limits->memory);
	_exit(mesh_import(fd, name, text, n, folders));
}

/* n bytes of the stream; -1 when it ends before (no message then) or the time is over. */
static int receive(struct importer *i, void *out, size_t n)
{
	char *p = out;
	while (n > 0) {
		double left = i->deadline - clock_seconds();
		struct pollfd ready = { i->fd, POLLIN, 0 };
		int polled = left > 0 ? poll(&ready, 1, (int)(left * 1000) + 1) : 0;
		if (polled == 0)
			return refuse(i, "not read within %g s", i->limits->seconds);
		if (polled < 0)
			return err_at(i->err, STATUS_ENVIRONMENT, i->name, 0, "interrupted");
		ssize_t got = read(i->fd, p, n);
		if (got < 0 && errno == EINTR)
			continue;
		if (got <= 0)
			return -1;
		p += got;
		n -= (size_t)got;
	}
	return 0;
}

static bool is_finite(const double *x, int n)
{
	for (int i = 0; i < n; i++)
		if (!isfinite(x[i]))
			return false;
	return true;
}

static int receive_materials(struct importer *i, uint64_t n, struct scene *s)
{
	for (uint64_t k = 0; k < n; k++) {
		struct mesh_material m;
		if (receive(i, &m, sizeof m) != 0)
			return -1;
		double kd = fmax(m.r, fmax(m.g, m.b)), scale = kd > 0 ? kd : 1;
		if (!is_finite(&m.r, 7))
			return refuse(i, "material %llu is not made of numbers", (unsigned long long)k);
		scene_add_material(s, (struct material){ .color = { m.r / scale, m.g / scale, m.b / scale }, .kd = kd, .ks = m.ks,
		                                         .shine = m.shine, .transmit = m.transmit, .ior = m.ior });
	}
	return 0;
}

static int receive_triangles(struct importer *i, const struct mesh_head *head, struct scene *s)
{
	enum { BATCH = 256 };
	struct mesh_triangle batch[BATCH];
	for (uint64_t left = head->triangles; left > 0;) {
		size_t n = left < BATCH ? (size_t)left : BATCH;
		if (receive(i, batch, n * sizeof *batch) != 0)
			return -1;
		for (size_t k = 0; k < n && !s->lost; k++) {
			const struct mesh_triangle *t = &batch[k];
			struct vec corner[3], normal[3];
			if (!is_finite(t->corner[0], 9))
				return refuse(i, "a corner that is not a number");
			memcpy(corner, t->corner, sizeof corner);
			memcpy(normal, t->normal, sizeof normal);
			static const double none[3][3] = { { 0 } };
			if (memcmp(t->normal, none, sizeof none) == 0 || !is_finite(t->normal[0], 9))
				scene_add_polygon(s, corner, 3);
			else
				scene_add_patch(s, corner, normal, 3);
			if (!s->lost)
				s->objects[s->object_count - 1].material = t->material < head->materials ? (uint32_t)t->material : NO_MATERIAL;
		}
		left -= n;
	}
	return 0;
}

static int receive_scene(struct importer *i, struct scene *s)
{
	struct mesh_head head;
	if (receive(i, &head, sizeof head) != 0)
		return -1;
	head.message[sizeof head.message - 1] = '\0';
	if (head.magic != MESH_MAGIC || head.triangles > triangles_most || head.materials > materials_most)
		return refuse(i, "the importer answered nonsense, or more than %llu triangles", (unsigned long long)triangles_most);
	if (strstr(head.message, "bad_alloc"))
		return refuse(i, "reading it takes more than %zu MiB", i->limits->memory >> 20);
	if (*head.message)
		return refuse(i, "%s", head.message);
	if (head.triangles == 0)
		return refuse(i, "no triangles in it");
	if (receive_materials(i, head.materials, s) != 0 || receive_triangles(i, &head, s) != 0)
		return -1;
	return scene_complete(s, i->name, i->err);
}

int mesh_receive(int fd, struct scene *s, const char *name, const struct mesh_limits *limits, struct err *e)
{
	struct importer i = { .fd = fd, .name = name, .limits = limits, .deadline = clock_seconds() + limits->seconds, .err = e };
	return receive_scene(&i, s);
}

/* How the process ended, for what has no message yet. */
static int explain(const struct importer *i, int ended)
{
	if (WIFSIGNALED(ended) && WTERMSIG(ended) == SIGXCPU)
		return refuse(i, "not read within %g s", i->limits->seconds);
	if (WIFSIGNALED(ended))
		return refuse(i, "the importer ended by signal %d: a damaged file, or one that takes more than %zu MiB", WTERMSIG(ended),
		              i->limits->memory >> 20);
	return refuse(i, "the importer gave up");
}

/* The path Assimp sees: without .gz, with an ending that names the format. */
static int name_for_importer(const char *name, const char *text, size_t n, char *out, size_t size)
{
	size_t length = strlen(name);
	bool packed = length > 3 && strcmp(name + length - 3, ".gz") == 0;
	const char *ending = format_of_path(name) ? "" : n >= 3 && memcmp(text, "ply", 3) == 0 ? ".ply" : ".glb";
	return snprintf(out, size, "%.*s%s", (int)(packed ? length - 3 : length), name, ending) < (int)size ? 0 : -1;
}

int mesh_read_within(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
                     const struct mesh_limits *limits, struct err *e)
{
	struct importer i = { .name = name, .limits = limits, .err = e };
	char path[4096];
	int ends[2], ended = 0;
	if (!mesh_available())
		return refuse(&i, "this format needs Assimp: install libassimp-dev ('make deps'), then build anew");
	if (name_for_importer(name, text, n, path, sizeof path) != 0)
		return refuse(&i, "path too long");
	if (pipe(ends) != 0)
		return err_at(e, STATUS_ENVIRONMENT, name, 0, "%s", strerror(errno));
	pid_t pid = fork();
	if (pid == 0) {
		close(ends[0]);
		import(ends[1], path, text, n, o->include, limits);
	}
	close(ends[1]);
	if (pid < 0) {
		close(ends[0]);
		return err_at(e, STATUS_ENVIRONMENT, name, 0, "%s", strerror(errno));
	}
	int status = mesh_receive(ends[0], s, name, limits, e);
	if (status == 0 || e->code)
		kill(pid, SIGKILL);
	close(ends[0]);
	while (waitpid(pid, &ended, 0) < 0 && errno == EINTR)
		;
	return status != 0 && !e->code ? explain(&i, ended) : status;
}

int mesh_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
              struct read_summary *summary, struct err *e)
{
	struct mesh_limits limits = { .memory = ((size_t)2 << 30) + 100 * n, .seconds = 10 + 2 * (double)(n >> 20) };
	(void)summary;
	return mesh_read_within(s, name, text, n, o, &limits, e);
}
