/* The subcommands: each is one file with a row in cli_commands. */
#ifndef CLI_CLI_H
#define CLI_CLI_H

#include "base/err.h"
#include "base/key.h"
#include "io/text.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

/* What every subcommand is given. */
struct cli {
	const char *version;
	const atomic_int *stop; /* becomes the number of a signal that wants the program to end */
	struct text out;          /* for stdout; written by main when the command ends */
};

/* run gets the arguments after the subcommand's name, NULL-terminated; it returns an exit status, and fills *e with the message when
 * that is not 0 (STATUS_PARTIAL may come without one). */
struct cli_command {
	const char *name, *text, *help;
	int (*run)(struct cli *cli, int count, char **arguments, struct err *e);
};

extern const struct cli_command *const cli_commands[]; /* NULL-terminated */

/* The whole program but for signals: pick the subcommand, run it, print what it said. Returns the exit status. */
int cli_main(struct cli *cli, int count, char **arguments);

/* "raycost NAME: message; see raycost NAME --help", STATUS_INPUT. Returns STATUS_INPUT. */
__attribute__((format(printf, 3, 4)))
int cli_usage(struct err *e, const char *command, const char *fmt, ...);

/* A whole number from low to high; false if it is none. */
bool cli_integer(const char *text, long long low, long long high, long long *out);

/* "K/N", shard K (0 .. N - 1) of N; false if it is not that. */
bool cli_shard(const char *text, uint32_t *shard, uint32_t *shards);

/* Store a word of the command line at its key's place in the struct 'target'; false if it is no value the key can have. */
bool cli_set_key(const struct key *k, const char *text, void *target);

#endif
