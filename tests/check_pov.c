/* Our reading of a POV-Ray scene held against POV-Ray's own: the same rays through both, hit for hit.
 *
 *   check_pov [-L folder]... scene.pov
 *
 * prints one line: agree, differ, unread (by us) or refused (by POV-Ray), the share of rays that agree, the scene, and why.
 * POV-Ray is asked by its trace(): the scene is copied, without what may not stand in a union (camera, lights, settings), into
 *   #declare All = union { #include "scene" }
 * and every ray is traced against that. Half of the rays are the camera's, half go between random points of the box; a ray agrees if
 * both miss, or both hit within 2 % of the distance. Surfaces without end count within the box of our scene only, domes not at all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "accel/accel.h"
#include "base/rng.h"
#include "io/pov.h"
#include "trace/camera.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RAYS = 300, FILES_MOST = 200, FOLDERS_MOST = 16, WIDTH = 160, HEIGHT = 120, SECONDS = 100 };

struct check {
	const char *scene, *folders[FOLDERS_MOST];
	size_t folder_count;
	char work[64], home[1024];      /* working folder; folder of the scene */
	char *copied[FILES_MOST];       /* paths copied so far; the copy is NUMBER.inc */
	size_t copies;
	struct ray rays[RAYS];
	double entry[RAYS];              /* of the box of our scene */
	double ours[RAYS], theirs[RAYS]; /* distance, or -1 */
};

struct scanner {
	struct check *check;
	const char *at, *end, *folder;
	struct text out;
	int depth;
	bool assigned; /* the last token was '=' */
};

static int copy_file(struct check *c, const char *path);

static bool is_word_char(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The end of the comment, string or single character that starts at 'at'; *kind: ' ' comment or blank, '"' string, else the character. */
static const char *skip_piece(const char *at, const char *end, char *kind)
{
	*kind = *at;
	if (end - at >= 2 && at[0] == '/' && at[1] == '/') {
		*kind = ' ';
		while (at < end && *at != '\n')
			at++;
		return at;
	}
	if (end - at >= 2 && at[0] == '/' && at[1] == '*') {
		int depth = 0;
		*kind = ' ';
		do {
			bool opens = end - at >= 2 && at[0] == '/' && at[1] == '*', closes = end - at >= 2 && at[0] == '*' && at[1] == '/';
			depth += opens - closes;
			at += opens || closes ? 2 : 1;
		} while (depth > 0 && at < end);
		return at;
	}
	if (*at == '"') {
		for (at++; at < end && *at != '"'; at++)
			at += *at == '\\' && at + 1 < end;
		return at < end ? at + 1 : end;
	}
	if (*at == ' ' || (*at >= '\t' && *at <= '\r'))
		*kind = ' ';
	return at + 1;
}

static const char *skip_blanks(const char *at, const char *end)
{
	char kind;
	while (at < end) {
		const char *next = skip_piece(at, end, &kind);
		if (kind != ' ')
			break;
		at = next;
	}
	return at;
}

/* Behind the brace that closes the one at 'at'. */
static const char *skip_block(const char *at, const char *end)
{
	int depth = 0;
	while (at < end) {
		char kind;
		at = skip_piece(at, end, &kind);
		depth += (kind == '{') - (kind == '}');
		if (kind == '}' && depth == 0)
			break;
	}
	return at;
}

static bool is_one_of(const char *word, size_t n, const char *const *list)
{
	for (; *list; list++)
		if (strlen(*list) == n && strncmp(*list, word, n) == 0)
			return true;
	return false;
}

static bool block_holds(const char *at, const char *end, const char *word)
{
	size_t n = strlen(word);
	for (; at + n < end; at++)
		if (strncmp(at, word, n) == 0)
			return true;
	return false;
}

/* The path of an included file that lies beside the scene, or false: one of POV-Ray's own. */
static bool find_local(const struct check *c, const char *folder, const char *name, char *path, size_t size)
{
	const char *folders[2 + FOLDERS_MOST] = { c->home, folder };
	for (size_t i = 0; i < c->folder_count; i++)
		folders[2 + i] = c->folders[i];
	for (size_t i = 0; i < 2 + c->folder_count; i++) {
		snprintf(path, size, "%s%s%s", folders[i], *folders[i] && folders[i][strlen(folders[i]) - 1] != '/' ? "/" : "", name);
		if (access(path, R_OK) == 0)
			return true;
	}
	return false;
}

/* #include, #default, #version; others pass. 'word' behind the '#'. */
static void scan_directive(struct scanner *s, const char *word, size_t n)
{
	const char *next = skip_blanks(word + n, s->end), *start = s->at;
	char kind = ' ', path[2048], name[1024];
	s->at = word + n;
	if (n == 7 && strncmp(word, "default", n) == 0 && next < s->end && *next == '{') {
		s->at = skip_block(next, s->end);
	} else if (n == 7 && strncmp(word, "version", n) == 0 && next < s->end && *next >= '3') {
		while (next < s->end && ((*next >= '0' && *next <= '9') || *next == '.'))
			next++;
		double version = strtod(skip_blanks(word + n, s->end), NULL);
		text_print(&s->out, "#version %g", version > 3.7 ? 3.7 : version);
		s->at = next;
	} else if (n == 7 && strncmp(word, "include", n) == 0 && next < s->end && *next == '"') {
		const char *close = skip_piece(next, s->end, &kind);
		snprintf(name, sizeof name, "%.*s", (int)(close - next - 2), next + 1);
		int copy = find_local(s->check, s->folder, name, path, sizeof path) ? copy_file(s->check, path) : -1;
		s->at = close;
		if (copy >= 0)
			text_print(&s->out, "#include \"copy%d.inc\"", copy);
		else
			text_add(&s->out, start, (size_t)(close - start));
	} else {
		text_add(&s->out, start, (size_t)(s->at - start));
	}
}

static void scan(struct scanner *s);

static void scan_word(struct scanner *s)
{
	static const char *const banned[] = { "light_source", "camera", "global_settings", "background", "sky_sphere", "fog", "rainbow", "media",
		                              "atmosphere", "photons", "radiosity", "default", NULL };
	const char *word = s->at;
	while (s->at < s->end && is_word_char(*s->at))
		s->at++;
	size_t n = (size_t)(s->at - word);
	const char *next = skip_blanks(s->at, s->end);
	bool block = s->depth <= 0 && !s->assigned && next < s->end && *next == '{';
	const char *close = block ? skip_block(next, s->end) : next;
	bool group = n == 11 && strncmp(word, "light_group", n) == 0;
	if (block && group) {
		/* What it holds, as if it stood there itself. */
		struct scanner inner = { .check = s->check, .at = next + 1, .end = close - 1, .folder = s->folder };
		scan(&inner);
		text_add(&s->out, inner.out.bytes ? inner.out.bytes : "", inner.out.size);
		text_free(&inner.out);
		s->at = close;
	} else if (n == 13 && strncmp(word, "global_lights", n) == 0) {
		const char *flag = next;
		while (flag < s->end && is_word_char(*flag))
			flag++;
		s->at = flag;
	} else if (block && is_one_of(word, n, banned) && !(*word == 'l' && block_holds(next, close, "looks_like"))) {
		s->at = close;
	} else {
		text_add(&s->out, word, n);
	}
	s->assigned = false;
}

static void scan(struct scanner *s)
{
	while (s->at < s->end) {
		if (*s->at == '#') {
			const char *word = s->at + 1, *stop;
			while (word < s->end && (*word == ' ' || *word == '\t'))
				word++;
			for (stop = word; stop < s->end && is_word_char(*stop);)
				stop++;
			scan_directive(s, word, (size_t)(stop - word));
			s->assigned = false;
		} else if (is_word_char(*s->at)) {
			scan_word(s);
		} else {
			char kind;
			const char *start = s->at;
			s->at = skip_piece(s->at, s->end, &kind);
			text_add(&s->out, start, (size_t)(s->at - start));
			s->depth += (kind == '{') - (kind == '}');
			s->assigned = kind == '=' || (kind == ' ' && s->assigned);
		}
	}
}

/* Copy a file, changed, into the working folder; its number, or -1. */
static int copy_file(struct check *c, const char *path)
{
	struct text t = { 0 };
	struct err e = { 0 };
	char name[128], folder[1024];
	for (size_t i = 0; i < c->copies; i++)
		if (strcmp(c->copied[i], path) == 0)
			return (int)i;
	if (c->copies == FILES_MOST || text_read_file(&t, path, 1 << 28, &e) != 0)
		return -1;
	int number = (int)c->copies;
	c->copied[c->copies++] = strdup(path);
	const char *slash = strrchr(path, '/');
	snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) + 1 : 0, path);
	struct scanner s = { .check = c, .at = t.bytes, .end = t.bytes + t.size, .folder = folder };
	scan(&s);
	snprintf(name, sizeof name, "%s/copy%d.inc", c->work, number);
	FILE *f = fopen(name, "w");
	if (f) {
		fwrite(s.out.bytes, 1, s.out.size, f);
		fclose(f);
	}
	text_free(&s.out);
	text_free(&t);
	return number;
}

/* Where a ray enters the box, a little before it; 0 where it starts inside or misses. */
static double entry_of(const struct ray *r, const struct box *b)
{
	double in = 0, out = INFINITY;
	for (int k = 0; k < 3; k++) {
		double t0 = (b->lo.a[k] - r->o.a[k]) / r->d.a[k], t1 = (b->hi.a[k] - r->o.a[k]) / r->d.a[k];
		in = fmax(in, fmin(t0, t1));
		out = fmin(out, fmax(t0, t1));
	}
	return in <= out ? fmax(0, in - 1e-3 * box_diagonal(b)) : 0;
}

/* POV-Ray's rays start where they enter the box of our scene, so that surfaces without end are met within it only. */
static void write_driver(struct check *c, const struct box *b)
{
	char name[128];
	snprintf(name, sizeof name, "%s/driver.pov", c->work);
	FILE *f = fopen(name, "w");
	if (!f)
		exit(1);
	fprintf(f, "global_settings { assumed_gamma 1 }\n#declare All__ = union { #include \"copy0.inc\" }\n#version 3.7;\n"
	           "#fopen Out__ \"hits.txt\" write\n"
	           "#macro Ray__(A__, B__) #local N__ = <0,0,0>; #local P__ = trace(All__, A__, B__, N__);\n"
	           "#if (vlength(N__) = 0) #write(Out__, \"-1\\n\") #else #write(Out__, str(vlength(P__ - A__), 0, 12), \"\\n\") #end #end\n");
	for (int i = 0; i < RAYS; i++) {
		const struct ray *r = &c->rays[i];
		c->entry[i] = entry_of(r, b);
		struct vec o = vec_add(r->o, vec_scale(r->d, c->entry[i]));
		fprintf(f, "Ray__(<%.17g,%.17g,%.17g>,<%.17g,%.17g,%.17g>)\n", o.x, o.y, o.z, r->d.x, r->d.y, r->d.z);
	}
	fprintf(f, "#fclose Out__\n");
	fclose(f);
}

static int run_povray(const struct check *c)
{
	pid_t child = fork();
	if (child == 0) {
		char option[FOLDERS_MOST + 2][1100], width[16], height[16];
		char *args[FOLDERS_MOST + 20] = { "povray", "+Idriver.pov", "-D", "-F", "-GR", "-GS", "+GF", "+WT1", "+L/usr/share/povray-3.7/include" };
		int n = 9;
		snprintf(width, sizeof width, "+W%d", WIDTH);
		snprintf(height, sizeof height, "+H%d", HEIGHT);
		args[n++] = width;
		args[n++] = height;
		snprintf(option[0], sizeof option[0], "+L%s", c->home);
		args[n++] = option[0];
		for (size_t i = 0; i < c->folder_count; i++) {
			snprintf(option[i + 1], sizeof option[0], "+L%s", c->folders[i]);
			args[n++] = option[i + 1];
		}
		args[n] = NULL;
		if (chdir(c->work) != 0 || !freopen("log.txt", "w", stderr) || !freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "r", stdin))
			_exit(127);
		alarm(SECONDS);
		execvp("povray", args);
		_exit(127);
	}
	int status;
	return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* The distances POV-Ray wrote; false: not all. */
static bool read_hits(struct check *c)
{
	char name[128];
	int n = 0;
	snprintf(name, sizeof name, "%s/hits.txt", c->work);
	FILE *f = fopen(name, "r");
	while (f && n < RAYS && fscanf(f, "%lf", &c->theirs[n]) == 1)
		n++;
	if (f)
		fclose(f);
	return n == RAYS;
}

static void make_rays(struct check *c, const struct scene *s, const struct box *b)
{
	struct camera camera = camera_make(&s->view, b, WIDTH, HEIGHT);
	for (uint32_t i = 0; i < RAYS; i++) {
		uint64_t key = rng_key(1, 0, i);
		struct ray *r = &c->rays[i];
		*r = (struct ray){ .t_max = INFINITY, .from = NO_PRIMITIVE, .clear = true };
		if (i % 2 == 0) {
			double x = rng_uniform(key, 0), y = rng_uniform(key, 1);
			r->o = camera_origin(&camera, x, y);
			r->d = camera_direction(&camera, x, y);
			continue;
		}
		/* From a sphere about the box toward a point in the box. */
		struct vec center = vec_scale(vec_add(b->lo, b->hi), 0.5), to = b->lo, out;
		double z = 2 * rng_uniform(key, 0) - 1, turn = 6.28318530717958648 * rng_uniform(key, 1), ring = sqrt(1 - z * z);
		out = vec(ring * cos(turn), ring * sin(turn), z);
		for (int k = 0; k < 3; k++)
			to.a[k] += rng_uniform(key, 3 + (uint64_t)k) * (b->hi.a[k] - b->lo.a[k]);
		r->o = vec_add(center, vec_scale(out, 1.05 * box_diagonal(b) / 2));
		r->d = vec_unit(vec_sub(to, r->o));
	}
}

static void shoot(struct check *c, const struct primitives *p)
{
	const struct accel_ops *ops = accel_find("octree");
	char options[ACCEL_OPT_MOST];
	struct accel a;
	struct err e = { 0 };
	for (int i = 0; i < RAYS; i++)
		c->ours[i] = -1;
	if (p->count == 0)
		return;
	key_defaults(ops->keys, options);
	if (accel_build(&a, ops, options, p, &e) != 0) {
		printf("unread   -     %s  %s\n", c->scene, e.text);
		exit(0);
	}
	for (int i = 0; i < RAYS; i++) {
		struct hit h = { INFINITY, NO_PRIMITIVE };
		struct ray r = c->rays[i];
		r.slack = a.slack;
		c->ours[i] = a.ops->shoot(&a, &r, &h) ? h.t : -1;
	}
	accel_free(&a);
}

static bool is_inside(struct vec p, const struct box *b)
{
	double grow = 1e-3 * box_diagonal(b);
	for (int k = 0; k < 3; k++)
		if (!(p.a[k] >= b->lo.a[k] - grow && p.a[k] <= b->hi.a[k] + grow))
			return false;
	return true;
}

static double count_agreeing(const struct check *c, const struct box *b)
{
	int agree = 0;
	bool list = getenv("CHECK_POV_LIST") != NULL;
	for (int i = 0; i < RAYS; i++) {
		double ours = c->ours[i], theirs = c->theirs[i] < 0 ? -1 : c->theirs[i] + c->entry[i];
		const struct ray *r = &c->rays[i];
		if (theirs >= 0 && !is_inside(vec_add(r->o, vec_scale(r->d, theirs)), b))
			theirs = -1;
		bool same = ours < 0 || theirs < 0 ? ours < 0 && theirs < 0 : fabs(ours - theirs) <= 0.02 * theirs + 1e-9;
		agree += same;
		if (list && !same)
			fprintf(stderr, "%d from %g %g %g toward %g %g %g: %g, POV-Ray %g\n", i, r->o.x, r->o.y, r->o.z, r->d.x, r->d.y, r->d.z, ours,
			        theirs);
	}
	return (double)agree / RAYS;
}

/* The last complaint in POV-Ray's log. */
static void print_log(const struct check *c)
{
	char name[128], line[512], last[512] = "";
	snprintf(name, sizeof name, "%s/log.txt", c->work);
	FILE *f = fopen(name, "r");
	while (f && fgets(line, sizeof line, f))
		if (strstr(line, "rror:") || strstr(line, "annot"))
			snprintf(last, sizeof last, "%s", line);
	if (f)
		fclose(f);
	last[strcspn(last, "\n")] = '\0';
	printf("%s\n", last);
}

static void remove_work(const struct check *c)
{
	char command[128];
	snprintf(command, sizeof command, "rm -rf '%s'", c->work);
	if (system(command) != 0)
		fprintf(stderr, "%s stays\n", c->work);
}

static int read_scene(const struct check *c, struct scene *s, struct primitives *p, struct text *line, struct err *e)
{
	struct text t = { 0 };
	struct pov_summary summary;
	struct pov_options o = pov_defaults();
	const char *folders[FOLDERS_MOST + 1];
	for (size_t i = 0; i < c->folder_count; i++)
		folders[i] = c->folders[i];
	folders[c->folder_count] = o.directories[0];
	o.directories = folders;
	o.directory_count = c->folder_count + 1;
	o.width = WIDTH;
	o.height = HEIGHT;
	int status = text_read_file(&t, c->scene, 1 << 30, e);
	if (status == 0)
		status = pov_read(s, c->scene, t.bytes, t.size, &o, &summary, e);
	if (status == 0) {
		pov_summary_print(&summary, line);
		/* A scene of nothing that can be seen is read, too. */
		if (s->object_count == 0)
			p->bounds = (struct box){ vec(-1, -1, -1), vec(1, 1, 1) };
		else
			status = primitives_make(p, s, CURVES_KEEP, 3, c->scene, e);
	}
	text_free(&t);
	return status;
}

int main(int argc, char **argv)
{
	static struct check c;
	struct scene s = { 0 };
	struct primitives p = { 0 };
	struct text line = { 0 };
	struct err e = { 0 };
	for (int i = 1; i < argc; i++)
		if (strcmp(argv[i], "-L") == 0 && i + 1 < argc && c.folder_count < FOLDERS_MOST)
			c.folders[c.folder_count++] = argv[++i];
		else
			c.scene = argv[i];
	if (!c.scene)
		return 2;
	const char *slash = strrchr(c.scene, '/');
	snprintf(c.home, sizeof c.home, "%.*s", slash ? (int)(slash - c.scene) + 1 : 2, slash ? c.scene : "./");
	snprintf(c.work, sizeof c.work, "/tmp/check_pov.XXXXXX");
	if (!mkdtemp(c.work))
		return 1;
	int status = read_scene(&c, &s, &p, &line, &e);
	if (status == 0) {
		make_rays(&c, &s, &p.bounds);
		shoot(&c, &p);
	}
	copy_file(&c, c.scene);
	write_driver(&c, &p.bounds);
	run_povray(&c);
	if (!read_hits(&c)) {
		printf("refused  -     %s  ", c.scene);
		print_log(&c);
	} else if (status != 0) {
		printf("unread   -     %s  %s\n", c.scene, e.text);
	} else {
		double share = count_agreeing(&c, &p.bounds);
		printf("%s   %.3f %s  %s\n", share >= 0.97 ? "agree" : "differ", share, c.scene, line.bytes);
	}
	if (!getenv("CHECK_POV_KEEP"))
		remove_work(&c);
	text_free(&line);
	primitives_free(&p);
	scene_free(&s);
	return 0;
}
