/* raycost columns */
#include "batch/row.h"
#include "cli/cli.h"

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	if (count > 0)
		return cli_usage(e, "columns", "'%s' is not understood", words[0]);
	for (const struct column *c = row_columns; c->name; c++)
		text_print(&cli->out, "%-26s%s\n", c->name, c->text);
	return STATUS_DONE;
}

const struct cli_command cli_columns = { "columns", "explain the columns of counts.csv",
	                                 "usage: raycost columns\n\nPrint every column of counts.csv and what it means. An empty "
	                                 "field means \"not applicable\".\n",
	                                 run };
