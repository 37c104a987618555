/* raycost: what shooting a ray costs in a spatial structure. Signals in, exit status out; the rest is cli/. */
#include "cli/cli.h"

#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <unistd.h>

#ifndef VERSION
#define VERSION "unknown"
#endif

/* After a signal: seconds for ending in order. Every file is whole at every instant, so that ending at once loses little more. */
enum { PATIENCE = 1 };

/* The number of the signal that asked for the end; written by the handler, read by whoever works. */
static atomic_int stop;

static void note_signal(int number)
{
	stop = number;
	alarm(PATIENCE);
}

/* Whoever works is in the middle of something long. */
static void end_at_once(int number)
{
	static const char text[] = "stopped by a signal; what was done is kept, and the same command goes on from here\n";
	(void)number;
	ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
	(void)written;
	_exit(128 + stop);
}

/* The first signal ends the run in order, a second one ends the program; one that is ignored already, as nohup does, stays so.
 * Writing to a closed pipe or beyond the limit of a file's size is an error like any other. */
static void catch_signals(void)
{
	static const int ends[] = { SIGINT, SIGTERM, SIGHUP };
	struct sigaction end = { .sa_handler = note_signal, .sa_flags = (int)SA_RESETHAND };
	struct sigaction late = { .sa_handler = end_at_once }, ignore = { .sa_handler = SIG_IGN }, old;
	for (int i = 0; i < 3; i++)
		if (sigaction(ends[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN)
			sigaction(ends[i], &end, NULL);
	sigaction(SIGALRM, &late, NULL);
	sigaction(SIGPIPE, &ignore, NULL);
	sigaction(SIGXFSZ, &ignore, NULL);
}

/* A file of ours must not become stdin, stdout or stderr where one is closed. Read-only: writing to it fails, as it should. */
static void occupy_standard_files(void)
{
	for (int fd = open("/dev/null", O_RDONLY); fd >= 0; fd = open("/dev/null", O_RDONLY))
		if (fd > STDERR_FILENO) {
			close(fd);
			return;
		}
}

int main(int count, char **arguments)
{
	struct cli cli = { .version = VERSION, .stop = &stop };
	occupy_standard_files();
	catch_signals();
	return cli_main(&cli, count - 1, arguments + 1);
}
