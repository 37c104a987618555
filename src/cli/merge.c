/* raycost merge FOLDER */
#include "batch/merge.h"
#include "cli/cli.h"

static const char help[] =
	"usage: raycost merge out/JOB\n\n"
	"Bring the shards in out/JOB/shards/ together: out/JOB/counts.csv, the same bytes as without shards. Keys that no shard has are\n"
	"printed, and the exit status is 4; 'raycost plan JOB.yaml --missing' tells what they are, and 'raycost run JOB.yaml' does them.\n";

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	struct merge_result result;
	if (count != 1)
		return cli_usage(e, "merge", count ? "'%s' is not understood" : "no folder given", count ? words[1] : "");
	if (merge_shards(words[0], &result, &cli->out, e) != 0)
		return e->code;
	if (result.missing || result.failed) {
		err_at(e, STATUS_PARTIAL, words[0], 0, "of %zu rows %zu failed and %zu are missing", result.rows, result.failed, result.missing);
		return STATUS_PARTIAL;
	}
	text_print(&cli->out, "%zu rows of %zu shards; see %s/counts.csv\n", result.rows, result.shards, words[0]);
	return STATUS_DONE;
}

const struct cli_command cli_merge = { "merge", "bring the shards of a job together", help, run };
