/* kd tree: planes anywhere, across any axis, chosen by a rule (kd_split.c). */
#include "accel/check.h"
#include "accel/kd_split.h"

#include <string.h>

static const struct key keys[] = {
	PLANE_MAX_OBJECTS(struct kd_options, common),
	PLANE_KEYS(struct kd_options, common, 20),
	{ "split", KEY_WORD, offsetof(struct kd_options, split), 0, 0, SPLIT_BALANCE, kd_split_words,
	  "how planes are chosen: halves balanced, few primitives cut; or least cost where the chance that a ray meets a cell is by area (sah), "
	  "or that of rays from inside: approximated (hq26, fast6), exact" },
	{ "step", KEY_REAL, offsetof(struct kd_options, step), 0, 1e6, 1, NULL, "cost of an inner node; all splits but balance" },
	{ "test", KEY_REAL, offsetof(struct kd_options, test), 0, 1e6, 3, NULL, "cost of a primitive in a leaf; all splits but balance" },
	{ "empty_cutoff", KEY_REAL, offsetof(struct kd_options, empty_cutoff), 0, 1, 0.3, NULL,
	  "a plane that cuts off an empty part of this share of the cell goes before others; all splits but balance" },
	{ "boxes", KEY_REAL, offsetof(struct kd_options, common.boxes), 0, 1, 0, NULL,
	  "a cell whose primitives' bounding box has less than this share of its area holds that box; 0: none does" },
	{ 0 }
};

static bool applies(const void *opt, const char *key)
{
	const struct kd_options *o = opt;
	if (strcmp(key, "max_objects") == 0)
		return o->split == SPLIT_BALANCE;
	if (strcmp(key, "step") == 0 || strcmp(key, "test") == 0 || strcmp(key, "empty_cutoff") == 0)
		return o->split != SPLIT_BALANCE;
	return true;
}

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct kd_options *o = opt;
	if (o->common.boxes > 0 && o->common.travel != 0)
		return err_at(e, STATUS_INPUT, NULL, 0, "kd: boxes are for the recursive traversal only");
	return planes_build(a, o, &o->common, kd_split_rules[o->split], e);
}

const struct accel_ops accel_kd = {
	"kd", "planes anywhere, by balance or by cost", keys, sizeof(struct kd_options), applies,
	build, planes_cells, planes_shoot, planes_shoot_counted, planes_shoot_many, check_lists, NULL
};
