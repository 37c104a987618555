/* raycost report FOLDER */
#include "cli/cli.h"
#include "report/page.h"

static int run(struct cli *cli, int count, char **words, struct err *e)
{
	if (count != 1)
		return cli_usage(e, "report", count ? "'%s' is not understood" : "no folder given", count ? words[1] : "");
	return report_write(words[0], &cli->out, e) == 0 ? STATUS_DONE : e->code;
}

const struct cli_command cli_report = { "report", "plots and a page of a job's results",
	                                "usage: raycost report out/JOB\n\nDraw plots/*.svg, with their scripts and data beside them (gnuplot), "
	                                "and write report.html, which needs no network\nand no other file.\n",
	                                run };
