/* make bench: reading POV-Ray scenes beside POV-Ray's own parsing of them, one thread each, rounds interleaved; medians and ratios.
 *
 *   bench_pov scene.pov...
 *
 * times the scenes, a mesh2 of a million triangles and the standard includes. Parsing alone is a scene that ends with an error of its own
 * behind its last statement; POV-Ray's time is what it prints, in seconds of processor, of rendering one pixel. */
#include "io/pov.h"
#include "tests/timing.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ROUNDS = 5, SIDE = 708, SECONDS_MOST = 120 };

static const char library[] = "/usr/share/povray-3.7/include", end_of_scene[] = "\n#error \"parsed\"\n";

struct times {
	double parse[ROUNDS], whole[ROUNDS], theirs[ROUNDS];
	size_t triangles;
};

/* A worst ratio so far, and whose. */
struct worst {
	double ratio;
	char name[1024];
};

static const char *find_name(const char *path)
{
	const char *slash = strrchr(path, '/');
	return slash ? slash + 1 : path;
}

/* POV-Ray on the scene in its folder, what it says on *out. */
static pid_t start_povray(const char *path, int *out)
{
	int ends[2];
	if (pipe(ends) != 0)
		return -1;
	fflush(stdout);
	pid_t child = fork();
	if (child == 0) {
		char input[1100], folder[1024], include[100];
		snprintf(input, sizeof input, "+I%s", find_name(path));
		snprintf(folder, sizeof folder, "%.*s", (int)(find_name(path) - path), path);
		snprintf(include, sizeof include, "+L%s", library);
		alarm(SECONDS_MOST);
		if (dup2(ends[1], 2) < 0 || !freopen("/dev/null", "w", stdout) || (*folder && chdir(folder) != 0))
			_exit(127);
		execlp("povray", "povray", input, include, "+W1", "+H1", "+WT1", "-D", "-F", (char *)NULL);
		_exit(127);
	}
	close(ends[1]);
	*out = ends[0];
	return child;
}

/* Seconds POV-Ray says that it parsed, or NAN. */
static double time_povray(const char *path)
{
	int fd, status;
	char line[512];
	double found = NAN;
	bool here = false;
	pid_t child = start_povray(path, &fd);
	if (child < 0)
		return NAN;
	FILE *f = fdopen(fd, "r");
	while (f && fgets(line, sizeof line, f)) {
		const char *with = strstr(line, "with ");
		here = here || strstr(line, "Parse Time:");
		if (here && isnan(found) && with && strstr(line, "CPU-seconds"))
			found = strtod(with + 5, NULL);
	}
	if (f)
		fclose(f);
	while (waitpid(child, &status, 0) < 0 && errno == EINTR)
		;
	return found;
}

/* Seconds of reading the scene; NAN: it cannot be read. Behind the last statement: what ends it, or nothing. */
static double time_read(const char *path, const char *behind, size_t *triangles)
{
	struct text t = { 0 };
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary summary;
	struct pov_options o = pov_defaults();
	o.width = o.height = 1;
	double start = seconds();
	int status = text_read_file(&t, path, (size_t)1 << 30, &e);
	text_add(&t, behind, strlen(behind));
	if (status == 0)
		status = pov_read(&s, path, t.bytes, t.size, &o, &summary, &e);
	double took = seconds() - start;
	bool read = *behind ? strstr(e.text, "parsed") != NULL : status == 0;
	if (status == 0)
		*triangles = summary.tally.triangles;
	scene_free(&s);
	text_free(&t);
	return read ? took : NAN;
}

static void note_worst(struct worst *w, double ratio, const char *name)
{
	if (ratio > w->ratio) {
		w->ratio = ratio;
		snprintf(w->name, sizeof w->name, "%s", name);
	}
}

/* What the rounds come to, of which POV-Ray's times are whole milliseconds: a scene it parses in none is not compared. */
static void print_times(const char *path, const struct times *t, struct worst *parse, struct worst *whole)
{
	double ours = median(t->parse, ROUNDS), all = median(t->whole, ROUNDS), theirs = median(t->theirs, ROUNDS);
	if (isnan(ours) || isnan(all) || isnan(theirs)) {
		printf("%-28s %s\n", find_name(path), isnan(theirs) ? "refused by POV-Ray" : "not read");
		return;
	}
	if (theirs == 0) {
		printf("%-28s %9.4f s %9.4f s      - %9.4f s      - %10zu\n", find_name(path), theirs, ours, all, t->triangles);
		return;
	}
	printf("%-28s %9.4f s %9.4f s %6.2f %9.4f s %6.2f %10zu\n", find_name(path), theirs, ours, ours / theirs, all, all / theirs, t->triangles);
	note_worst(parse, ours / theirs, path);
	note_worst(whole, all / theirs, path);
}

static void time_scene(const char *path, struct worst *parse, struct worst *whole)
{
	struct times t = { 0 };
	for (int i = 0; i < ROUNDS; i++) {
		t.theirs[i] = time_povray(path);
		t.parse[i] = time_read(path, end_of_scene, &t.triangles);
		t.whole[i] = time_read(path, "", &t.triangles);
		if (isnan(t.theirs[i]) || isnan(t.parse[i]) || isnan(t.whole[i])) {
			for (int k = 0; k < ROUNDS; k++) {
				t.theirs[k] = t.theirs[i];
				t.parse[k] = t.parse[i];
				t.whole[k] = t.whole[i];
			}
			break;
		}
	}
	print_times(path, &t, parse, whole);
	fflush(stdout);
}

/* A wavy square of 2 SIDE^2 triangles. */
static void write_mesh(FILE *f)
{
	int side = SIDE + 1;
	fprintf(f, "mesh2 {\nvertex_vectors { %d", side * side);
	for (int i = 0; i < side * side; i++)
		fprintf(f, ",\n<%.6f,%.6f,%.6f>", i % side / (double)SIDE, 0.1 * sin(0.05 * (i % side)) * cos(0.07 * (i / side)), i / side / (double)SIDE);
	fprintf(f, "\n}\nface_indices { %d", 2 * SIDE * SIDE);
	for (int i = 0; i < SIDE * SIDE; i++) {
		int at = i / SIDE * side + i % SIDE;
		fprintf(f, ",\n<%d,%d,%d>,<%d,%d,%d>", at, at + 1, at + side, at + 1, at + side + 1, at + side);
	}
	fprintf(f, "\n}\n}\n");
}

static void write_includes(FILE *f)
{
	static const char *const names[] = { "colors", "shapes", "shapes2", "shapesq", "textures", "metals", "woods", "stones", "glass", "golds",
		                             "skies", "stars", "finish", "functions", "math", "transforms", "rand", "arrays", "strings", "consts",
		                             "chars", "debug", NULL };
	for (int i = 0; names[i]; i++)
		fprintf(f, "#include \"%s.inc\"\n", names[i]);
	fprintf(f, "sphere { 0, 1 }\n");
}

/* A scene made for the occasion. */
static void time_written(const char *name, void (*write)(FILE *f), struct worst *parse, struct worst *whole)
{
	char folder[] = "/tmp/bench_pov.XXXXXX", path[128];
	if (!mkdtemp(folder))
		return;
	snprintf(path, sizeof path, "%s/%s", folder, name);
	FILE *f = fopen(path, "w");
	if (f) {
		fprintf(f, "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n");
		write(f);
		fclose(f);
		time_scene(path, parse, whole);
		remove(path);
	}
	rmdir(folder);
}

int main(int argc, char **argv)
{
	struct worst parse = { 0 }, whole = { 0 };
	if (system("command -v povray >/dev/null") != 0) {
		printf("bench_pov: POV-Ray is not installed, and nothing is compared\n");
		return 0;
	}
	printf("%-28s %11s %11s %6s %11s %6s %10s\n", "scene", "POV-Ray", "parsed", "", "read", "", "triangles");
	time_written("million.pov", write_mesh, &parse, &whole);
	time_written("includes.pov", write_includes, &parse, &whole);
	for (int i = 1; i < argc; i++)
		time_scene(argv[i], &parse, &whole);
	printf("worst: parsed %.2f of POV-Ray's time (%s), read %.2f (%s)\n", parse.ratio, parse.name, whole.ratio, whole.name);
	return 0;
}
