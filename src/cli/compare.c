/* raycost compare BASE NEW */
#include "cli/cli.h"
#include "report/compare.h"

#include <string.h>

static const char help[] =
	"usage: raycost compare BASE NEW [options]\n\n"
	"Hold the output folder NEW against BASE, combination by combination. Exit status 3 if it is worse.\n\n"
	"  --fail-if COLUMN:LIMIT  the limit is a percentage (1%) or a difference (0.5); may be repeated. A column of counts.csv fails\n"
	"                          where it moves further, either way. One of times.csv fails where the median ratio over all rows is\n"
	"                          worse by more, with its whole 95 % interval. Without rules all of counts.csv must be equal\n"
	"  --lenient               rows that NEW does not have are no fault\n"
	"  --format FORMAT         text, markdown or csv\n"
	"  -o FILE                 where the report goes; it is written before the verdict is told\n";

struct arguments {
	const char *folders[2], *path;
	int folder_count;
	struct compare_options options;
};

static bool parse_format(const char *word, enum compare_format *format)
{
	static const char *const words[] = { "text", "markdown", "csv" };
	for (int i = 0; i < 3; i++)
		if (strcmp(word, words[i]) == 0) {
			*format = (enum compare_format)i;
			return true;
		}
	return false;
}

static int parse(struct arguments *a, int count, char **words, struct err *e)
{
	struct compare_options *o = &a->options;
	for (int i = 0; i < count; i++) {
		const char *word = words[i], *value = NULL;
		bool takes = strcmp(word, "--fail-if") == 0 || strcmp(word, "--format") == 0 || strcmp(word, "-o") == 0;
		if (takes && i + 1 == count)
			return cli_usage(e, "compare", "%s needs a value", word);
		if (takes)
			value = words[++i];
		if (strcmp(word, "--fail-if") == 0 && o->rule_count < RULES_MOST && compare_parse_rule(&o->rules[o->rule_count], value))
			o->rule_count++;
		else if (strcmp(word, "--format") == 0 && parse_format(value, &o->format))
			continue;
		else if (strcmp(word, "-o") == 0)
			a->path = value;
		else if (strcmp(word, "--lenient") == 0)
			o->lenient = true;
		else if (takes)
			return cli_usage(e, "compare", "%s %s: not a value it can have", word, value);
		else if (*word == '-' || a->folder_count == 2)
			return cli_usage(e, "compare", "'%s' is not understood", word);
		else
			a->folders[a->folder_count++] = word;
	}
	return a->folder_count == 2 ? 0 : cli_usage(e, "compare", "two folders are needed");
}

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct arguments a = { 0 };
	struct measured both[2] = { 0 };
	struct compare_result result = { 0 };
	struct text report = { 0 };
	int status = parse(&a, count, words, e);
	if (status == 0)
		status = measured_read(&both[0], a.folders[0], e);
	if (status == 0)
		status = measured_read(&both[1], a.folders[1], e);
	if (status == 0)
		status = measured_name(both, 2, e);
	if (status == 0)
		status = compare_print(a.path ? &report : &cli->out, &both[0], &both[1], &a.options, &result, e);
	if (status == 0 && a.path)
		text_write_file(&report, a.path, e);
	if (e->code == 0 && result.faults)
		err_at(e, STATUS_WORSE, NULL, 0, "%s is worse than %s: %zu faults in %zu rows", a.folders[1], a.folders[0], result.faults,
		       result.compared + result.missing);
	text_free(&report);
	measured_free(&both[0]);
	measured_free(&both[1]);
	return e->code;
}

const struct cli_command cli_compare = { "compare", "hold two output folders against each other: a gate", help, run };
