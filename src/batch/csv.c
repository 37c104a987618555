#include "batch/csv.h"

#include <string.h>

void csv_add(struct text *line, const char *field, bool first)
{
	if (!first)
		text_add(line, ",", 1);
	if (!strpbrk(field, ",\"\r\n")) {
		text_add(line, field, strlen(field));
		return;
	}
	text_add(line, "\"", 1);
	for (const char *p = field; *p; p++)
		text_add(line, *p == '"' ? "\"\"" : *p == '\n' || *p == '\r' ? " " : p, *p == '"' ? 2 : 1);
	text_add(line, "\"", 1);
}

bool csv_field(const char *line, int index, char *out, size_t size)
{
	size_t n = 0;
	for (const char *p = line;; p++) {
		bool quoted = *p == '"';
		p += quoted;
		for (; *p && *p != '\n' && (quoted || *p != ','); p++) {
			if (quoted && *p == '"' && *++p != '"')
				break;
			if (index == 0 && n + 1 < size)
				out[n++] = *p;
		}
		if (index-- == 0) {
			out[n] = '\0';
			return true;
		}
		if (*p != ',')
			return false;
	}
}
