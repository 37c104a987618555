#include "batch/values.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FAULTS_MOST = 20 };

int values_fault(struct values *v, long line, const char *fmt, ...)
{
	struct err one = { 0 };
	char why[700];
	va_list args;
	va_start(args, fmt);
	vsnprintf(why, sizeof why, fmt, args);
	va_end(args);
	if (v->faults++ >= FAULTS_MOST)
		return -1;
	err_at(&one, STATUS_INPUT, v->file, line, "%s", why);
	size_t used = v->err->code ? strlen(v->err->text) : 0;
	v->err->code = STATUS_INPUT;
	snprintf(v->err->text + used, sizeof v->err->text - used, "%s%s", used ? "\n" : "", one.text);
	return -1;
}

/* Name of the first ${variable} in text and where it starts, or NULL. */
static const char *find_variable(const char *text, char *name, size_t size)
{
	for (const char *p = strstr(text, "${"); p; p = strstr(p + 2, "${")) {
		size_t n = strcspn(p + 2, "}");
		if (p[2 + n] == '}' && n > 0 && n < size) {
			memcpy(name, p + 2, n);
			name[n] = '\0';
			return p;
		}
	}
	return NULL;
}

static const struct yaml_node *look_up(struct values *v, long line, const char *name)
{
	const struct yaml_node *value = yaml_find(v->variables, name);
	if (!value)
		values_fault(v, line, "no variable '%s' in vars", name);
	return value;
}

const struct yaml_node *values_resolve(struct values *v, const struct yaml_node *node)
{
	char name[64];
	if (node->kind != YAML_SCALAR)
		return node;
	const char *at = find_variable(node->text, name, sizeof name);
	if (at != node->text || strlen(node->text) != strlen(name) + 3)
		return node;
	return look_up(v, node->line, name);
}

const char *values_text(struct values *v, const struct yaml_node *node)
{
	char name[64], out[1024];
	const struct yaml_node *whole = values_resolve(v, node);
	if (!whole)
		return NULL;
	if (whole->kind != YAML_SCALAR) {
		values_fault(v, node->line, "a single value is needed here");
		return NULL;
	}
	const char *text = whole->text, *at;
	for (int turn = 0; turn < 16 && (at = find_variable(text, name, sizeof name)) != NULL; turn++) {
		const struct yaml_node *value = look_up(v, node->line, name);
		if (!value)
			return NULL;
		if (value->kind != YAML_SCALAR) {
			values_fault(v, node->line, "'%s' is a list; it can only stand alone", name);
			return NULL;
		}
		snprintf(out, sizeof out, "%.*s%s%s", (int)(at - text), text, value->text, at + strlen(name) + 3);
		text = arena_text(v->mem, out, strlen(out));
		if (!text) {
			err_memory(v->err, v->file);
			return NULL;
		}
	}
	return text;
}

static bool parse_real(const char *text, double *x)
{
	char *end;
	if (!*text || strspn(text, "0123456789+-.eE") != strlen(text))
		return false;
	*x = strtod(text, &end);
	return *end == '\0' && isfinite(*x);
}

static int set_number(struct values *v, const struct key *k, long line, const char *text, void *at)
{
	double x;
	bool whole = k->type == KEY_INT;
	if (!parse_real(text, &x) || (whole && (x != floor(x) || fabs(x) > 9e15)))
		return values_fault(v, line, "%s: '%s' is not a %s", k->name, text, whole ? "whole number" : "number");
	if (x < k->low || x > k->high)
		return values_fault(v, line, "%s: %s is not in %.9g..%.9g", k->name, text, k->low, k->high);
	if (whole)
		*(int64_t *)at = (int64_t)x;
	else
		*(double *)at = x;
	return 0;
}

static int set_word(struct values *v, const struct key *k, long line, const char *text, int *at)
{
	char known[256] = "";
	for (int i = 0; k->words[i]; i++) {
		if (strcmp(k->words[i], text) == 0) {
			*at = i;
			return 0;
		}
		size_t n = strlen(known);
		snprintf(known + n, sizeof known - n, "%s%s", n ? ", " : "", k->words[i]);
	}
	return values_fault(v, line, "%s: '%s' is none of: %s", k->name, text, known);
}

int values_set(struct values *v, const struct key *k, const struct yaml_node *node, void *target)
{
	const char *text = values_text(v, node);
	void *at = (char *)target + k->offset;
	if (!text)
		return -1;
	switch (k->type) {
	case KEY_BOOL:
		if (strcmp(text, "true") != 0 && strcmp(text, "false") != 0)
			return values_fault(v, node->line, "%s: '%s' is neither true nor false", k->name, text);
		*(bool *)at = strcmp(text, "true") == 0;
		return 0;
	case KEY_INT:
	case KEY_REAL:
		return set_number(v, k, node->line, text, at);
	case KEY_WORD:
		return set_word(v, k, node->line, text, at);
	case KEY_TEXT:
		*(const char **)at = text;
		return 0;
	}
	return 0;
}

static int fault_unknown(struct values *v, const char *what, const struct yaml_node *entry, const struct key *keys,
                         bool (*allowed)(void *ctx, const char *key), void *ctx)
{
	char known[400] = "";
	for (const struct key *k = keys; k->name; k++) {
		size_t n = strlen(known);
		if (!allowed || allowed(ctx, k->name))
			snprintf(known + n, sizeof known - n, "%s%s", n ? ", " : "", k->name);
	}
	return values_fault(v, entry->line, "%s has no '%s'; known are: %s", what, entry->key, *known ? known : "none");
}

struct sweep {
	struct values *values;
	const struct key *keys;
	void *target, *ctx;
	int (*emit)(void *ctx);
};

static int sweep_from(const struct sweep *s, const struct yaml_node *entry)
{
	if (!entry)
		return s->emit(s->ctx);
	const struct yaml_node *value = values_resolve(s->values, entry);
	const struct yaml_node *item = value->kind == YAML_LIST ? value->first : value;
	for (; item; item = value->kind == YAML_LIST ? item->next : NULL)
		if (values_set(s->values, key_find(s->keys, entry->key), item, s->target) != 0 || sweep_from(s, entry->next) != 0)
			return -1;
	return 0;
}

int values_sweep(struct values *v, const char *what, const struct yaml_node *entry, const struct key *keys,
                 bool (*allowed)(void *ctx, const char *key), void *target, int (*emit)(void *ctx), void *ctx)
{
	int before = v->faults;
	/* Every value once, so that each fault is named once, before any combination is made. */
	for (const struct yaml_node *e = entry; e; e = e->next) {
		const struct key *k = key_find(keys, e->key);
		const struct yaml_node *value = values_resolve(v, e);
		if (!k || (allowed && !allowed(ctx, e->key)))
			fault_unknown(v, what, e, keys, allowed, ctx);
		else if (value && value->kind == YAML_LIST && !value->first)
			values_fault(v, e->line, "%s: an empty list", e->key);
		else if (value && value->kind == YAML_MAP)
			values_fault(v, e->line, "%s: a value or a list of values is needed", e->key);
		else
			for (const struct yaml_node *item = value && value->kind == YAML_LIST ? value->first : value; item;
			     item = value->kind == YAML_LIST ? item->next : NULL)
				values_set(v, k, item, target);
	}
	if (v->faults > before || v->err->code)
		return -1;
	return sweep_from(&(struct sweep){ v, keys, target, ctx, emit }, entry);
}
