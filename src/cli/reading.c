#include "cli/reading.h"

#include "scene/tessellate.h"

#include <stdio.h>
#include <string.h>

static bool add_folder(struct reading *r, const char *folder)
{
	size_t n = strlen(r->folders);
	r->options.include = r->folders;
	return !strchr(folder, ':') && snprintf(r->folders + n, sizeof r->folders - n, "%s%s", n ? ":" : "", folder) <
	       (int)(sizeof r->folders - n);
}

bool reading_parse(struct reading *r, const char *command, int count, char **words, int *i, int *status, struct err *e)
{
	const char *word = words[*i];
	bool folder = strcmp(word, "-L") == 0;
	const struct key *k = strncmp(word, "--", 2) == 0 ? key_find(read_keys, word + 2) : NULL;
	*status = 0;
	if (!folder && !k)
		return false;
	if (k && k->type == KEY_BOOL) {
		cli_set_key(k, "true", &r->options);
		return true;
	}
	if (*i + 1 == count) {
		*status = cli_usage(e, command, "%s needs a value", word);
		return true;
	}
	const char *value = words[++*i];
	if (folder || k->type == KEY_TEXT ? !add_folder(r, value) : !cli_set_key(k, value, &r->options))
		*status = cli_usage(e, command, "%s %s: not a value it can have", word, value);
	return true;
}

void reading_set_image(struct reading *r, int64_t width, int64_t height)
{
	r->options.width = (int)width;
	r->options.height = (int)height;
}

int reading_resolution(const struct reading *r)
{
	return r->options.resolution ? (int)r->options.resolution : SPD_RESOLUTION;
}

void reading_print(struct text *out, const struct read_summary *s)
{
	if (s->skipped)
		text_print(out, "  %-12s%u records", "skipped", s->skipped);
	if (s->skipped && s->first_line)
		text_print(out, ", the first in line %u", s->first_line);
	if (s->skipped)
		text_print(out, "\n");
	if (*s->text)
		text_print(out, "  %-12s%s\n", "notes", s->text);
}
