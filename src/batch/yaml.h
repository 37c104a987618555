/* YAML text as a small tree that remembers lines. Only what job files need: maps, lists, scalars; no anchors, aliases or tags, one
 * document. */
#ifndef BATCH_YAML_H
#define BATCH_YAML_H

#include "base/arena.h"
#include "base/err.h"

#include <stddef.h>

/* What a file may hold at the most. */
enum { YAML_BYTES = 1 << 20, YAML_DEPTH = 32, YAML_NODES = 100000 };

enum yaml_kind { YAML_SCALAR, YAML_LIST, YAML_MAP };

/* Entries of a list or map hang on 'first', linked by 'next', in file order; those of a map have a key, unique in it. */
struct yaml_node {
	enum yaml_kind kind;
	long line;
	const char *key;
	const char *text; /* scalar, NUL-terminated */
	struct yaml_node *first, *next;
};

/* The tree of n bytes; it lives in mem. ${name} may stand unquoted anywhere and stays as it is. NULL and *e with
 * "name:line: message" when it is not YAML or more than allowed. */
struct yaml_node *yaml_parse(const char *name, const char *text, size_t n, struct arena *mem, struct err *e);

/* The entry of a map called 'key', or NULL; so, too, where it is no map. */
const struct yaml_node *yaml_find(const struct yaml_node *map, const char *key);

#endif
