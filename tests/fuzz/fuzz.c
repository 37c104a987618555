#define _GNU_SOURCE /* memfd_create */
#include "tests/fuzz/fuzz.h"

#include "accel/walk.h"
#include "scene/primitives.h"
#include "trace/rays.h"

#include <sys/mman.h>
#include <unistd.h>

enum { OBJECTS_MOST = 200, POINTS_MOST = 2000, PRIMITIVES_MOST = 100, RAYS = 32, DEPTH_MOST = 3 };

const char *fuzz_file(const uint8_t *data, size_t n)
{
	static char path[64];
	static int fd = -1;
	if (fd >= 0)
		close(fd);
	fd = memfd_create("fuzz", 0);
	MUST(fd >= 0 && write(fd, data, n) == (ssize_t)n);
	snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
	return path;
}

/* The structure's own options, shallow where it has a depth: the scenes are small. */
static void set_options(const struct accel_ops *ops, unsigned char *options)
{
	key_defaults(ops->keys, options);
	const struct key *depth = key_find(ops->keys, "max_depth");
	if (depth && depth->type == KEY_INT)
		*(int64_t *)(void *)(options + depth->offset) = DEPTH_MOST;
}

static void shoot_both(const struct accel *list, const struct accel *a)
{
	struct ray_source source;
	struct err e = { 0 };
	if (ray_source_open(&source, list, WORKLOAD_INVARIANT, 1, &e) != 0)
		return;
	for (uint64_t i = 0; i < RAYS; i++) {
		struct ray r = ray_source_draw(&source, i);
		struct hit want, got, counted, many;
		struct tally tally = { 0 }, tally_many;
		bool hit = list->ops->shoot(list, &r, &want);
		MUST(a->ops->shoot(a, &r, &got) == a->ops->shoot_counted(a, &r, &counted, &tally));
		a->ops->shoot_many(a, &r, 1, &many, &tally_many);
		MUST(got.id == counted.id && got.id == many.id && tally.tests == tally_many.tests && tally.leaves == tally_many.leaves);
		MUST(hit == (got.id != NO_PRIMITIVE));
		MUST(want.id == got.id && (!hit || (want.t == counted.t && want.t == many.t)));
		MUST(!hit || fabs(want.t - got.t) <= 5e-4 * box_diagonal(&a->root)); /* see 'shoot' in accel.h */
	}
	ray_source_close(&source);
}

void fuzz_scene(const struct scene *s)
{
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	struct primitives p = { 0 };
	struct accel list, a;
	struct err e = { 0 };
	if (s->object_count > OBJECTS_MOST || s->point_count > POINTS_MOST)
		return;
	if (primitives_make(&p, s, CURVES_KEEP, 2, "fuzz", &e) == 0 && p.count <= PRIMITIVES_MOST) {
		const struct accel_ops *none = accel_find("list");
		set_options(none, options);
		MUST(accel_build(&list, none, options, &p, &e) == 0);
		for (const struct accel_ops *const *ops = accel_all; *ops; ops++) {
			struct err own = { 0 };
			set_options(*ops, options);
			if (accel_build(&a, *ops, options, &p, &own) != 0) {
				MUST(own.code == STATUS_ENVIRONMENT || own.code == STATUS_INPUT);
				continue;
			}
			MUST(a.ops->check(&a, &own) == 0);
			shoot_both(&list, &a);
			accel_free(&a);
		}
		accel_free(&list);
	}
	primitives_free(&p);
}
