#include "cli/cli.h"

#include "batch/plan.h"

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const struct cli_command cli_run, cli_plan, cli_merge, cli_compare, cli_history, cli_render, cli_report, cli_spd, cli_info, cli_view,
	cli_convert, cli_columns;

const struct cli_command *const cli_commands[] = {
	&cli_run, &cli_plan, &cli_merge, &cli_compare, &cli_history, &cli_render, &cli_report,
	&cli_spd, &cli_info, &cli_view, &cli_convert, &cli_columns, NULL
};

int cli_usage(struct err *e, const char *command, const char *fmt, ...)
{
	char why[500];
	va_list args;
	va_start(args, fmt);
	vsnprintf(why, sizeof why, fmt, args);
	va_end(args);
	err_at(e, STATUS_INPUT, NULL, 0, "raycost %s: %s; see raycost %s --help", command, why, command);
	return STATUS_INPUT;
}

bool cli_integer(const char *text, long long low, long long high, long long *out)
{
	char *end;
	errno = 0;
	*out = strtoll(text, &end, 10);
	return end != text && *end == '\0' && errno == 0 && *out >= low && *out <= high;
}

bool cli_shard(const char *text, uint32_t *shard, uint32_t *shards)
{
	char first[16];
	size_t n = strcspn(text, "/");
	long long k, count;
	if (n == 0 || n >= sizeof first || text[n] != '/')
		return false;
	memcpy(first, text, n);
	first[n] = '\0';
	if (!cli_integer(text + n + 1, 1, SHARDS_MOST, &count) || !cli_integer(first, 0, count - 1, &k))
		return false;
	*shard = (uint32_t)k;
	*shards = (uint32_t)count;
	return true;
}

bool cli_set_key(const struct key *k, const char *text, void *target)
{
	void *at = (char *)target + k->offset;
	static const char *const truth[] = { "false", "true", NULL };
	const char *const *words = k->type == KEY_BOOL ? truth : k->words;
	int word = 0;
	char *end;
	long long n;
	double x;
	switch (k->type) {
	case KEY_INT:
		if (!cli_integer(text, (long long)k->low, (long long)k->high, &n))
			return false;
		*(int64_t *)at = n;
		return true;
	case KEY_REAL:
		x = strtod(text, &end);
		if (end == text || *end || !(x >= k->low && x <= k->high))
			return false;
		*(double *)at = x;
		return true;
	case KEY_TEXT:
		*(const char **)at = text;
		return true;
	case KEY_BOOL:
	case KEY_WORD:
		while (words[word] && strcmp(words[word], text) != 0)
			word++;
		if (words[word] && k->type == KEY_BOOL)
			*(bool *)at = word == 1;
		else if (words[word])
			*(int *)at = word;
		return words[word] != NULL;
	}
	return false;
}

static void print_help(struct cli *cli)
{
	text_print(&cli->out, "raycost: what shooting a ray costs in a spatial structure, predicted and measured\n\n");
	for (const struct cli_command *const *c = cli_commands; *c; c++)
		text_print(&cli->out, "  raycost %-8s %s\n", (*c)->name, (*c)->text);
	text_print(&cli->out, "\n'raycost COMMAND --help' explains a command; 'raycost --version' tells the version.\n"
	                      "Exit status: 0 done, 1 environment, 2 refused, 3 worse, 4 rows failed or missing, 75 folder in use, 128+n signal n.\n");
}

static bool is_help(const char *word)
{
	return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

static int run_command(struct cli *cli, int count, char **arguments, struct err *e)
{
	if (count < 1) {
		print_help(cli);
		err_at(e, STATUS_INPUT, NULL, 0, "raycost: no command given");
		return STATUS_INPUT;
	}
	if (is_help(arguments[0])) {
		print_help(cli);
		return STATUS_DONE;
	}
	if (strcmp(arguments[0], "--version") == 0) {
		text_print(&cli->out, "raycost %s\n", cli->version);
		return STATUS_DONE;
	}
	for (const struct cli_command *const *c = cli_commands; *c; c++) {
		if (strcmp((*c)->name, arguments[0]) != 0)
			continue;
		for (int i = 1; i < count; i++)
			if (is_help(arguments[i])) {
				text_print(&cli->out, "%s", (*c)->help);
				return STATUS_DONE;
			}
		return (*c)->run(cli, count - 1, arguments + 1, e);
	}
	err_at(e, STATUS_INPUT, NULL, 0, "raycost: no command '%s'; see raycost --help", arguments[0]);
	return STATUS_INPUT;
}

/* stdout last of all: a closed or full one is an error like any other. */
static int flush_output(const struct text *out, struct err *e)
{
	if (out->lost)
		return err_memory(e, "output");
	if (out->size && (fwrite(out->bytes, 1, out->size, stdout) != out->size || fflush(stdout) != 0))
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "stdout: %s", strerror(errno));
	return 0;
}

int cli_main(struct cli *cli, int count, char **arguments)
{
	struct err e = { 0 }, printing = { 0 };
	int status = run_command(cli, count, arguments, &e);
	if (status == STATUS_ENVIRONMENT && *cli->stop)
		status = 128 + *cli->stop;
	if (flush_output(&cli->out, &printing) != 0) {
		fprintf(stderr, "%s\n", printing.text);
		status = status ? status : printing.code;
	}
	if (e.code)
		fprintf(stderr, "%s\n", e.text);
	text_free(&cli->out);
	return status;
}
