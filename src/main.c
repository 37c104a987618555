/* raycost: what shooting a ray costs in a spatial structure. Signals in, exit status out; the rest is cli/. */
#include "cli/cli.h"

#include <signal.h>
#include <stdatomic.h>

#ifndef VERSION
#define VERSION "unknown"
#endif

/* The number of the signal that asked for the end; written by the handler, read by whoever works. */
static atomic_int stop;

static void note_signal(int number)
{
	stop = number;
}

/* The first signal ends the run in order, a second one ends the program. */
static void catch_signals(void)
{
	static const int ends[] = { SIGINT, SIGTERM, SIGHUP };
	struct sigaction end = { .sa_handler = note_signal, .sa_flags = (int)SA_RESETHAND };
	struct sigaction ignore = { .sa_handler = SIG_IGN };
	for (int i = 0; i < 3; i++)
		sigaction(ends[i], &end, NULL);
	sigaction(SIGPIPE, &ignore, NULL);
}

int main(int count, char **arguments)
{
	struct cli cli = { .version = VERSION, .stop = &stop };
	catch_signals();
	return cli_main(&cli, count - 1, arguments + 1);
}
