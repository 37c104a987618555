#include "accel/bvh_draft.h"
int bvh_build_insertion(struct bvh_draft *d, const struct bvh_rules *rules) { return bvh_build_binned(d, rules); }
int bvh_build_spatial(struct bvh_draft *d, const struct bvh_rules *rules) { return bvh_build_binned(d, rules); }
int bvh_optimise(struct bvh_draft *d, int rounds) { (void)d; return rounds < 0 ? -1 : 0; }
