#include "report/plot.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NO_PROGRAM = 127 };

static int make_folder(const char *path, struct err *e)
{
	if (mkdir(path, 0777) != 0 && errno != EEXIST)
		return err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", strerror(errno));
	return 0;
}

/* Run gnuplot in the folder of the script; returns its exit status, NO_PROGRAM where it is not installed. */
static int run_gnuplot(const char *folder, const char *script)
{
	pid_t child = fork();
	if (child == 0) {
		if (chdir(folder) != 0)
			_exit(1);
		setenv("LC_ALL", "C", 1);
		execlp("gnuplot", "gnuplot", script, (char *)NULL);
		_exit(errno == ENOENT ? NO_PROGRAM : 1);
	}
	int status = 0;
	while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
		continue;
	return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

int plot_draw(const struct plot *p, const char *folder, bool *drawn, struct err *e)
{
	char plots[4000], path[4200];
	struct text script = { 0 };
	*drawn = false;
	snprintf(plots, sizeof plots, "%s/plots", folder);
	text_print(&script, "set terminal svg size 640,420 dynamic font 'sans-serif,14' background 'white'\nset output '%s.svg'\n", p->name);
	text_add(&script, p->script.bytes, p->script.size);
	snprintf(path, sizeof path, "%s/%s.gp", plots, p->name);
	int status = make_folder(plots, e);
	if (status == 0)
		status = script.lost || p->data.lost ? err_memory(e, "plot") : text_write_file(&script, path, e);
	text_free(&script);
	snprintf(path, sizeof path, "%s/%s.dat", plots, p->name);
	if (status == 0)
		status = text_write_file(&p->data, path, e);
	if (status != 0)
		return -1;
	snprintf(path, sizeof path, "%s.gp", p->name);
	int outcome = run_gnuplot(plots, path);
	*drawn = outcome == 0;
	if (outcome != 0 && outcome != NO_PROGRAM)
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "%s/%s: gnuplot could not draw it", plots, path);
	return 0;
}

void plot_free(struct plot *p)
{
	text_free(&p->script);
	text_free(&p->data);
}
