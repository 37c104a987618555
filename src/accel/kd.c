/* kd tree: planes anywhere, across any axis, chosen by a rule (kd_split.c). */
#include "accel/check.h"
#include "accel/kd_split.h"

static const struct key keys[] = {
	PLANE_MAX_OBJECTS(struct kd_options, common),
	PLANE_KEYS(struct kd_options, common, 20),
	{ "split", KEY_WORD, offsetof(struct kd_options, split), 0, 0, SPLIT_BALANCE, kd_split_words,
	  "how planes are chosen: halves balanced, few primitives cut" },
	{ "boxes", KEY_REAL, offsetof(struct kd_options, common.boxes), 0, 1, 0, NULL,
	  "a cell whose primitives' bounding box has less than this share of its area holds that box; 0: none does" },
	{ 0 }
};

static int build(struct accel *a, const void *opt, struct err *e)
{
	const struct kd_options *o = opt;
	if (o->common.boxes > 0 && o->common.travel != 0)
		return err_at(e, STATUS_INPUT, NULL, 0, "kd: boxes are for the recursive traversal only");
	return planes_build(a, o, &o->common, kd_split_rules[o->split], e);
}

const struct accel_ops accel_kd = {
	"kd", "planes that balance the halves and cut few primitives", keys, sizeof(struct kd_options), NULL,
	build, planes_cells, planes_shoot, planes_shoot_counted, planes_shoot_many, check_lists
};
