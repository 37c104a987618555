/* No structure: one cell that lists everything. The baseline of every comparison and the oracle of every test. */
#include "accel/root.h"
#include "accel/walk.h"

struct list_options {
	int root;
};

static const char *const root_words[] = { "cube", "box", NULL };
static const struct key keys[] = {
	{ "root", KEY_WORD, offsetof(struct list_options, root), 0, 0, ROOT_BOX, root_words,
	  "the region: bounding cube or tight bounding box" },
	{ 0 }
};

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct list_options *o = opt;
	uint32_t n = a->primitives->count, *ids = NEW(&a->mem, uint32_t, n);
	if (!ids)
		return err_memory(e, "list");
	for (uint32_t i = 0; i < n; i++)
		ids[i] = i;
	a->impl = ids;
	a->root = root_box(&a->primitives->bounds, (enum root_kind)o->root);
	a->slack = 1e-9 * box_diagonal(&a->root);
	a->nodes = a->leaves = 1;
	a->references = n;
	return 0;
}

static int cells(const struct accel *a, cell_fn *fn, void *ctx)
{
	return fn(ctx, &(struct cell){ .bounds = a->root, .area = box_area(&a->root), .ids = a->impl,
	                               .count = a->primitives->count, .leaf = true });
}

WALK walk(const struct accel *a, const struct ray *r, struct hit *h, struct tally *tally, const bool count)
{
	struct vec start, per_d = vec(1 / nonzero(r->d.x), 1 / nonzero(r->d.y), 1 / nonzero(r->d.z));
	*h = hit_none(r);
	if (!root_enter(&a->root, r, per_d, a->slack, &start))
		return false;
	COUNT(leaves, 1);
	COUNT(tests, a->primitives->count);
	test_all(a->primitives->all, a->impl, a->primitives->count, r, h);
	if (r->through)
		*h = hit_none(r);
	COUNT(hits, h->id != NO_PRIMITIVE);
	return h->id != NO_PRIMITIVE;
}
WALK_TWICE(walk)

static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n)
{
	for (size_t i = 0; i < count; i++) {
		n[i] = (struct tally){ 0 };
		shoot_counted(a, &r[i], &h[i], &n[i]);
	}
}

static int check(const struct accel *a, struct err *e)
{
	return a->references == a->primitives->count ? 0 : err_at(e, STATUS_ENVIRONMENT, NULL, 0, "list: a primitive is missing");
}

const struct accel_ops accel_list = {
	"list", "no structure: every ray tests every primitive", keys, sizeof(struct list_options), NULL,
	build, cells, shoot, shoot_counted, shoot_many, check, NULL
};
