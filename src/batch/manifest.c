#include "batch/manifest.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static void print_now(char *out, size_t size)
{
	struct tm utc;
	time_t now = time(NULL);
	gmtime_r(&now, &utc);
	strftime(out, size, "%Y-%m-%dT%H:%M:%SZ", &utc);
}

void manifest_start(struct manifest *m, const struct job *job, const struct run_options *o)
{
	*m = (struct manifest){ .job = job, .options = o };
	print_now(m->start, sizeof m->start);
}

/* A JSON string. Bytes of 0x80 and above are UTF-8 already: YAML accepts nothing else. */
static void add_string(struct text *t, const char *name, const char *value, const char *end)
{
	text_print(t, "  \"%s\": \"", name);
	for (const char *p = value; *p; p++) {
		unsigned char c = (unsigned char)*p;
		if (c == '"' || c == '\\')
			text_print(t, "\\%c", c);
		else if (c < 0x20)
			text_print(t, "\\u%04x", c);
		else
			text_add(t, p, 1);
	}
	text_print(t, "\"%s\n", end);
}

/* The processor's name as Linux tells it, or "unknown". */
static void find_processor(char *out, size_t size)
{
	char line[256];
	FILE *f = fopen("/proc/cpuinfo", "r");
	snprintf(out, size, "unknown");
	while (f && fgets(line, sizeof line, f)) {
		const char *colon = strchr(line, ':');
		if (strncmp(line, "model name", 10) != 0 || !colon)
			continue;
		snprintf(out, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
		break;
	}
	if (f)
		fclose(f);
}

int manifest_write(const struct manifest *m, const struct run_result *result, int status, struct err *e)
{
	char path[4096], processor[200], end[32];
	struct text t = { 0 };
	struct err own = { 0 };
	find_processor(processor, sizeof processor);
	print_now(end, sizeof end);
	text_print(&t, "{\n");
	add_string(&t, "name", m->job->name, ",");
	add_string(&t, "version", m->options->version, ",");
	add_string(&t, "compiler", __VERSION__, ",");
	add_string(&t, "processor", processor, ",");
	add_string(&t, "start", m->start, ",");
	if (status < 0)
		text_print(&t, "  \"end\": null,\n");
	else
		add_string(&t, "end", end, ",");
	text_print(&t, "  \"seed\": %lld,\n  \"threads\": %d,\n", (long long)m->job->seed, m->options->threads);
	if (m->options->shards)
		text_print(&t, "  \"shard\": %u,\n  \"shards\": %u,\n", m->options->shard, m->options->shards);
	text_print(&t, "  \"rows_kept\": %zu,\n  \"rows_added\": %zu,\n  \"rows_failed\": %zu,\n", result->kept, result->added,
	           result->failed);
	if (status < 0)
		text_print(&t, "  \"status\": null,\n");
	else
		text_print(&t, "  \"status\": %d,\n", status);
	add_string(&t, "job", m->job->text, "");
	text_print(&t, "}\n");
	snprintf(path, sizeof path, "%s/manifest.json", result->folder);
	int written = text_write_file(&t, path, &own);
	text_free(&t);
	return written == 0 ? 0 : err_at(e, own.code, NULL, 0, "%s", own.text);
}
