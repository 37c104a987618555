#include "accel/accel.h"

#include <string.h>

extern const struct accel_ops accel_list, accel_octree, accel_kd, accel_bsp, accel_grid, accel_bvh, accel_bvh8;

const struct accel_ops *const accel_all[] = {
	&accel_list, &accel_octree, &accel_kd, &accel_bsp, &accel_grid, &accel_bvh, &accel_bvh8, NULL
};

const struct accel_ops *accel_find(const char *name)
{
	for (const struct accel_ops *const *ops = accel_all; *ops; ops++)
		if (strcmp((*ops)->name, name) == 0)
			return *ops;
	return NULL;
}

int accel_build(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, struct err *e)
{
	return accel_build_on(a, ops, opt, p, 1, e);
}

int accel_build_on(struct accel *a, const struct accel_ops *ops, const void *opt, const struct primitives *p, int threads,
                   struct err *e)
{
	*a = (struct accel){ .ops = ops, .primitives = p, .threads = threads };
	if (ops->build(a, opt, e) == 0)
		return 0;
	accel_free(a);
	return -1;
}

void accel_free(struct accel *a)
{
	arena_free(&a->mem);
	*a = (struct accel){ 0 };
}

void accel_hit_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h)
{
	if (a->ops->hit_many) {
		a->ops->hit_many(a, r, count, h);
		return;
	}
	for (size_t i = 0; i < count; i++)
		a->ops->shoot(a, &r[i], &h[i]);
}

bool accel_applies(const struct accel_ops *ops, const void *opt, const char *key)
{
	return key_find(ops->keys, key) && (!ops->applies || ops->applies(opt, key));
}
