/* What the tests share: near equality, golden files, and scenes made in one line. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scene/primitives.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

static inline void assert_near(double got, double want, double tolerance)
{
	if (!(fabs(got - want) <= tolerance))
		fail_msg("%.17g is not within %g of %.17g", got, tolerance, want);
}

static inline void assert_golden(const char *name, const char *text)
{
	static char want[1 << 20];
	char path[256];
	snprintf(path, sizeof path, "tests/golden/%s", name);
	FILE *f = fopen(path, getenv("UPDATE_GOLDEN") ? "w" : "r");
	if (!f)
		fail_msg("%s: missing; make golden", path);
	if (getenv("UPDATE_GOLDEN")) {
		fputs(text, f);
		fclose(f);
		return;
	}
	want[fread(want, 1, sizeof want - 1, f)] = '\0';
	fclose(f);
	assert_string_equal(text, want);
}

/* The primitives of an SPD family; close with primitives_free. */
static inline struct primitives make_family(const char *family, const struct spd_options *o)
{
	struct err e = { 0 };
	struct scene scene = { 0 };
	struct primitives p = { 0 };
	if (spd_generate(&scene, spd_find(family), o, &e) != 0 ||
	    primitives_make(&p, &scene, CURVES_KEEP, SPD_RESOLUTION, family, &e) != 0)
		fail_msg("%s", e.text);
	scene_free(&scene);
	return p;
}

static inline struct primitives make_spd(const char *family, int size, bool tessellate)
{
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = tessellate;
	return make_family(family, &o);
}

/* Primitives of a scene filled by hand; frees the scene. */
static inline struct primitives make_primitives(struct scene *s)
{
	struct err e = { 0 };
	struct primitives p = { 0 };
	if (scene_complete(s, "test", &e) != 0 ||
	    primitives_make(&p, s, CURVES_KEEP, SPD_RESOLUTION, "test", &e) != 0)
		fail_msg("%s", e.text);
	scene_free(s);
	return p;
}

#endif
