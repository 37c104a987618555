/* What tests of POV-Ray's scene language share: scenes read from memory, which tell their values by the places and colours of lights, for
 * these need no shapes. */
#ifndef TESTS_POV_TEXT_H
#define TESTS_POV_TEXT_H

#include "tests/check.h"

#include "io/pov.h"

#include <string.h>

/* Files in memory. */
struct file {
	const char *path, *text;
};

static inline int load_memory(void *context, const char *path, struct text *t)
{
	for (const struct file *f = context; f && f->path; f++)
		if (strcmp(f->path, path) == 0) {
			text_add(t, f->text, strlen(f->text));
			return 0;
		}
	return -1;
}

static inline bool match_memory(void *context, const char *folder, const char *name, char *out, size_t size)
{
	for (const struct file *f = context; f && f->path; f++) {
		size_t n = strlen(folder);
		if (strncmp(f->path, folder, n) != 0 || strlen(f->path + n) != strlen(name) || strchr(f->path + n, '/'))
			continue;
		bool equal = true;
		for (size_t i = 0; name[i]; i++)
			equal = equal && (f->path[n + i] | 32) == (name[i] | 32);
		if (equal) {
			snprintf(out, size, "%s", f->path + n);
			return true;
		}
	}
	return false;
}

static inline struct pov_options make_options(const struct file *files)
{
	static const char *const folders[] = { "lib" };
	struct pov_options o = pov_defaults();
	o.directories = folders;
	o.access = (struct pov_access){ load_memory, match_memory, (void *)files };
	return o;
}

static inline int read_text(struct scene *s, const char *text, const struct pov_options *o, struct pov_summary *m, struct err *e)
{
	return pov_read(s, "scenes/a.pov", text, strlen(text), o, m, e);
}

/* A scene that must be read; close it with scene_free. */
static inline struct scene read_with(const char *text, const struct file *files)
{
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	struct pov_options o = make_options(files);
	if (read_text(&s, text, &o, &m, &e) != 0)
		fail_msg("%s\n%s", e.text, text);
	return s;
}

/* The 'count' lights of a scene are at x = expected[i]. */
static inline void assert_lights(const char *text, size_t count, const double *expected)
{
	struct scene s = read_with(text, NULL);
	if (s.light_count != count)
		fail_msg("%zu lights instead of %zu\n%s", s.light_count, count, text);
	for (size_t i = 0; i < count; i++)
		if (!(fabs(s.lights[i].at.x - expected[i]) <= 1e-9 * (1 + fabs(expected[i]))))
			fail_msg("light %zu at %.17g instead of %.17g\n%s", i, s.lights[i].at.x, expected[i], text);
	scene_free(&s);
}

#define ASSERT_LIGHTS(text, ...) \
	do { \
		const double expected_[] = { __VA_ARGS__ }; \
		assert_lights(text, sizeof expected_ / sizeof *expected_, expected_); \
	} while (0)

/* Components of an expression, behind some statements. */
static inline void assert_value(const char *before, const char *expression, const double *expected, double tolerance)
{
	char text[4096];
	snprintf(text, sizeof text,
	         "%s\n#declare Value_ = %s;\nlight_source{<Value_.x,Value_.y,Value_.z>, rgb <Value_.filter,Value_.transmit,0>}", before,
	         expression);
	struct scene s = read_with(text, NULL);
	const double got[5] = { s.lights[0].at.x, s.lights[0].at.y, s.lights[0].at.z, s.lights[0].color.r, s.lights[0].color.g };
	for (int i = 0; i < 5; i++)
		if (!(fabs(got[i] - expected[i]) <= tolerance * (1 + fabs(expected[i]))))
			fail_msg("%s %s: component %d is %.17g, not %.17g", before, expression, i, got[i], expected[i]);
	scene_free(&s);
}

/* A float has its value in every component. */
static inline void assert_number(const char *before, const char *expression, double expected)
{
	const double all[5] = { expected, expected, expected, expected, expected };
	assert_value(before, expression, all, 1e-9);
}

static inline void assert_vector(const char *before, const char *expression, double x, double y, double z)
{
	const double all[5] = { x, y, z, 0, 0 };
	assert_value(before, expression, all, 1e-9);
}

static inline void assert_color(const char *expression, double r, double g, double b, double f, double t)
{
	const double all[5] = { r, g, b, f, t };
	assert_value("", expression, all, 1e-12);
}

static inline void assert_string(const char *before, const char *expression, const char *expected)
{
	char test[2048];
	snprintf(test, sizeof test, "strcmp(%s, \"%s\")", expression, expected);
	assert_number(before, test, 0);
}

static inline void refuse_with(const char *text, const struct pov_options *o, const char *expected)
{
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	if (read_text(&s, text, o, &m, &e) == 0)
		fail_msg("was read: %.200s", text);
	if (strcmp(e.text, expected) != 0)
		fail_msg("'%s' instead of '%s'", e.text, expected);
	scene_free(&s);
}

static inline void refuse(const char *text, const char *expected)
{
	struct pov_options o = make_options(NULL);
	refuse_with(text, &o, expected);
}

#endif
