#include "batch/yaml.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>
#include <yaml.h>

/* YAML's flow style gives braces a meaning of their own: before parsing, ${name} becomes a name between two characters of Unicode's
 * private range, and afterwards in every scalar ${name} again. */
static const char open_mark[] = "\xee\x80\x80", close_mark[] = "\xee\x80\x81";
enum { MARK = 3 };

struct tree {
	const char *name;
	struct arena *mem;
	struct err *err;
	yaml_parser_t parser;
	int nodes;
};

/* Length of "${name}" at p, or 0. */
static size_t match_variable(const char *p, const char *end)
{
	const char *q = p + 2;
	if (end - p < 4 || p[0] != '$' || p[1] != '{')
		return 0;
	while (q < end && (isalnum((unsigned char)*q) || *q == '_'))
		q++;
	return q > p + 2 && q < end && *q == '}' ? (size_t)(q + 1 - p) : 0;
}

static char *mark_variables(struct tree *t, const char *text, size_t n, size_t *marked)
{
	char *out = arena_alloc(t->mem, 2 * n + 1, 1), *q = out;
	const char *end = text + n;
	for (const char *p = text; out && p < end;) {
		size_t length = match_variable(p, end);
		if (!length) {
			*q++ = *p++;
			continue;
		}
		memcpy(q, open_mark, MARK);
		memcpy(q + MARK, p + 2, length - 3);
		memcpy(q + MARK + length - 3, close_mark, MARK);
		q += 2 * MARK + length - 3;
		p += length;
	}
	*marked = out ? (size_t)(q - out) : 0;
	return out;
}

static char *unmark_variables(struct tree *t, const char *text, size_t n)
{
	char *out = arena_alloc(t->mem, n + 1, 1), *q = out;
	for (size_t i = 0; out && i < n;) {
		bool opens = n - i >= MARK && memcmp(text + i, open_mark, MARK) == 0;
		if (opens) {
			*q++ = '$';
			*q++ = '{';
			i += MARK;
		} else if (n - i >= MARK && memcmp(text + i, close_mark, MARK) == 0) {
			*q++ = '}';
			i += MARK;
		} else {
			*q++ = text[i++];
		}
	}
	return out;
}

static int refuse(struct tree *t, size_t line, const char *why)
{
	return err_at(t->err, STATUS_INPUT, t->name, (long)line + 1, "%s", why);
}

static int next_event(struct tree *t, yaml_event_t *event)
{
	if (yaml_parser_parse(&t->parser, event))
		return 0;
	if (t->parser.error == YAML_MEMORY_ERROR)
		return err_memory(t->err, t->name);
	return refuse(t, t->parser.problem_mark.line, t->parser.problem ? t->parser.problem : "not YAML");
}

static struct yaml_node *read_node(struct tree *t, const yaml_event_t *event, int depth);

/* Entries up to the end of a list or map, hung on 'node'. */
static int read_entries(struct tree *t, struct yaml_node *node, int depth)
{
	struct yaml_node **end = &node->first;
	for (;;) {
		yaml_event_t event;
		const char *key = NULL;
		if (next_event(t, &event) != 0)
			return -1;
		if (event.type == YAML_SEQUENCE_END_EVENT || event.type == YAML_MAPPING_END_EVENT) {
			yaml_event_delete(&event);
			return 0;
		}
		if (node->kind == YAML_MAP) {
			struct yaml_node *name = read_node(t, &event, depth + 1);
			yaml_event_delete(&event);
			if (!name)
				return -1;
			if (name->kind != YAML_SCALAR)
				return refuse(t, (size_t)name->line - 1, "a key must be a word");
			if (yaml_find(node, name->text))
				return err_at(t->err, STATUS_INPUT, t->name, name->line, "'%s' is given twice", name->text);
			key = name->text;
			if (next_event(t, &event) != 0)
				return -1;
		}
		struct yaml_node *entry = read_node(t, &event, depth + 1);
		yaml_event_delete(&event);
		if (!entry)
			return -1;
		entry->key = key;
		*end = entry;
		end = &entry->next;
	}
}

/* The node that starts with this event, or NULL and the error. */
static struct yaml_node *read_node(struct tree *t, const yaml_event_t *event, int depth)
{
	size_t line = event->start_mark.line;
	struct yaml_node *node = NEW(t->mem, struct yaml_node, 1);
	const yaml_char_t *anchor = NULL;
	if (!node) {
		err_memory(t->err, t->name);
		return NULL;
	}
	node->line = (long)line + 1;
	if (event->type == YAML_SCALAR_EVENT) {
		anchor = event->data.scalar.anchor;
		node->kind = YAML_SCALAR;
		node->text = unmark_variables(t, (const char *)event->data.scalar.value, event->data.scalar.length);
	} else if (event->type == YAML_SEQUENCE_START_EVENT) {
		anchor = event->data.sequence_start.anchor;
		node->kind = YAML_LIST;
	} else if (event->type == YAML_MAPPING_START_EVENT) {
		anchor = event->data.mapping_start.anchor;
		node->kind = YAML_MAP;
	}
	if (anchor || event->type == YAML_ALIAS_EVENT)
		refuse(t, line, "anchors and aliases are not allowed");
	else if (++t->nodes > YAML_NODES)
		refuse(t, line, "more than 100000 values");
	else if (depth > YAML_DEPTH)
		refuse(t, line, "nested more than 32 deep");
	else if (node->kind == YAML_SCALAR && !node->text)
		err_memory(t->err, t->name);
	else if (node->kind == YAML_SCALAR || read_entries(t, node, depth) == 0)
		return node;
	return NULL;
}

/* The one document; an empty file is an empty map. */
static struct yaml_node *read_document(struct tree *t)
{
	struct yaml_node *root = NULL;
	for (;;) {
		yaml_event_t event;
		if (next_event(t, &event) != 0)
			return NULL;
		yaml_event_type_t type = event.type;
		size_t line = event.start_mark.line;
		bool content = type == YAML_SCALAR_EVENT || type == YAML_SEQUENCE_START_EVENT ||
		               type == YAML_MAPPING_START_EVENT || type == YAML_ALIAS_EVENT;
		if (content && root)
			refuse(t, line, "more than one document");
		else if (content)
			root = read_node(t, &event, 0);
		yaml_event_delete(&event);
		if (t->err->code)
			return NULL;
		if (type == YAML_STREAM_END_EVENT)
			break;
	}
	if (!root && (root = NEW(t->mem, struct yaml_node, 1)) != NULL)
		*root = (struct yaml_node){ .kind = YAML_MAP, .line = 1 };
	return root;
}

struct yaml_node *yaml_parse(const char *name, const char *text, size_t n, struct arena *mem, struct err *e)
{
	struct tree t = { .name = name, .mem = mem, .err = e };
	size_t marked;
	const char *input = mark_variables(&t, text, n, &marked);
	if (!input || !yaml_parser_initialize(&t.parser)) {
		err_memory(e, name);
		return NULL;
	}
	yaml_parser_set_input_string(&t.parser, (const unsigned char *)input, marked);
	struct yaml_node *root = read_document(&t);
	yaml_parser_delete(&t.parser);
	return root;
}

const struct yaml_node *yaml_find(const struct yaml_node *map, const char *key)
{
	for (const struct yaml_node *entry = map && map->kind == YAML_MAP ? map->first : NULL; entry; entry = entry->next)
		if (strcmp(entry->key, key) == 0)
			return entry;
	return NULL;
}
