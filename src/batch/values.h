/* Values of a job file: variables replaced, checked against a table of keys, lists swept. */
#ifndef BATCH_VALUES_H
#define BATCH_VALUES_H

#include "base/key.h"
#include "batch/yaml.h"

#include <stdbool.h>

/* Where faults of one file go, and what its variables stand for. */
struct values {
	const char *file;
	const struct yaml_node *variables; /* a map, or NULL */
	struct arena *mem;
	struct err *err;
	int faults;
};

/* Note a fault as a line of its own; the first twenty are kept. Always -1. */
__attribute__((format(printf, 3, 4)))
int values_fault(struct values *v, long line, const char *fmt, ...);

/* The node itself, or what its ${variable} stands for; NULL after a fault. */
const struct yaml_node *values_resolve(struct values *v, const struct yaml_node *node);

/* The text of a scalar with its ${variables} replaced; NULL after a fault. */
const char *values_text(struct values *v, const struct yaml_node *node);

/* Store one scalar at its key's place in the struct 'target'. 0, or -1 after a fault: type, range, unknown word. */
int values_set(struct values *v, const struct key *key, const struct yaml_node *node, void *target);

/* For every combination of the listed values of the map entries 'entry', its successors included, in file order with the last
 * varying fastest: set them in 'target' and call emit. 'what' names the map in messages. Keys that 'allowed' refuses (may be
 * NULL) and those not in the table are faults that list the others. 0, or -1 after any fault. */
int values_sweep(struct values *v, const char *what, const struct yaml_node *entry, const struct key *keys,
                 bool (*allowed)(void *ctx, const char *key), void *target, int (*emit)(void *ctx), void *ctx);

#endif
