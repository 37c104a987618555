#include "base/key.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void key_defaults(const struct key *keys, void *target)
{
	for (const struct key *k = keys; k && k->name; k++) {
		char *at = (char *)target + k->offset;
		switch (k->type) {
		case KEY_BOOL: *(bool *)(void *)at = k->value > 0; break;
		case KEY_INT: *(int64_t *)(void *)at = (int64_t)k->value; break;
		case KEY_REAL: *(double *)(void *)at = k->value; break;
		case KEY_WORD: *(int *)(void *)at = (int)k->value; break;
		case KEY_TEXT: *(const char **)(void *)at = NULL; break;
		}
	}
}

const struct key *key_find(const struct key *keys, const char *name)
{
	for (const struct key *k = keys; k && k->name; k++)
		if (strcmp(k->name, name) == 0)
			return k;
	return NULL;
}

void key_print(const struct key *k, const void *source, char *out, size_t size)
{
	const void *at = (const char *)source + k->offset;
	const char *text = "";
	switch (k->type) {
	case KEY_BOOL: text = *(const bool *)at ? "true" : "false"; break;
	case KEY_INT: snprintf(out, size, "%lld", (long long)*(const int64_t *)at); return;
	case KEY_REAL: snprintf(out, size, "%.9g", *(const double *)at); return;
	case KEY_WORD: text = k->words[*(const int *)at]; break;
	case KEY_TEXT: text = *(const char *const *)at ? *(const char *const *)at : ""; break;
	}
	snprintf(out, size, "%s", text);
}
