#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>

void err_flatten(char *text)
{
	for (; *text; text++)
		if ((unsigned char)*text < ' ' || *text == 127)
			*text = ' ';
}

int err_at(struct err *e, int code, const char *file, long line, const char *fmt, ...)
{
	if (e->code)
		return -1;
	e->code = code;
	int n = 0;
	if (file && line > 0)
		n = snprintf(e->text, sizeof e->text, "%s:%ld: ", file, line);
	else if (file)
		n = snprintf(e->text, sizeof e->text, "%s: ", file);
	if (n < 0 || (size_t)n >= sizeof e->text)
		return -1;
	va_list args;
	va_start(args, fmt);
	vsnprintf(e->text + n, sizeof e->text - (size_t)n, fmt, args);
	va_end(args);
	return -1;
}

int err_memory(struct err *e, const char *what)
{
	return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "out of memory (%s)", what);
}
