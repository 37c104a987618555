/* raycost history FOLDER... */
#include "cli/cli.h"
#include "report/history.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char help[] =
	"usage: raycost history FOLDER... [--column NAME] [-o DIR]\n\n"
	"Print and draw a column over several runs of a job, in the order given: its median over the rows that all of them have.\n"
	"Folders without counts.csv are passed over, so that out/*/ will do.\n\n"
	"  --column NAME  of counts.csv or times.csv (actual)\n"
	"  -o DIR         the plot goes to DIR/plots/history-NAME.svg (out)\n";

struct arguments {
	const char *column, *folder;
	const char **names; /* of the runs */
	size_t count;
};

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	for (int i = 0; i < count; i++) {
		const char *word = words[i];
		bool column = strcmp(word, "--column") == 0, takes = column || strcmp(word, "-o") == 0;
		char path[4200];
		struct stat info;
		if (takes && i + 1 == count)
			return cli_usage(e, "history", "%s needs a value", word);
		if (takes) {
			*(column ? &a->column : &a->folder) = words[++i];
			continue;
		}
		if (*word == '-')
			return cli_usage(e, "history", "'%s' is not understood", word);
		snprintf(path, sizeof path, "%s/counts.csv", word);
		if (stat(path, &info) == 0)
			a->names[a->count++] = word;
	}
	if (strspn(a->column, "abcdefghijklmnopqrstuvwxyz0123456789_") != strlen(a->column) || strlen(a->column) > 60)
		return cli_usage(e, "history", "--column %s: not a column", a->column);
	return a->count ? 0 : cli_usage(e, "history", "no folder with a counts.csv given");
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { .column = "actual", .folder = "out", .names = calloc((size_t)count + 1, sizeof *a.names) };
	struct measured *runs = calloc((size_t)count + 1, sizeof *runs);
	int status = a.names && runs ? parse(&a, count, words, e) : err_memory(e, "history");
	for (size_t i = 0; status == 0 && i < a.count; i++)
		status = measured_read(&runs[i], a.names[i], e);
	if (status == 0)
		status = measured_name(runs, a.count, e);
	if (status == 0)
		history_write(&cli->out, runs, a.names, a.count, a.column, a.folder, e);
	for (size_t i = 0; runs && i < a.count; i++)
		measured_free(&runs[i]);
	free(runs);
	free(a.names);
	return e->code;
}

const struct cli_command cli_history = { "history", "draw a column over several runs", help, run };
