/* How a kd tree chooses its planes. */
#ifndef ACCEL_KD_SPLIT_H
#define ACCEL_KD_SPLIT_H

#include "accel/planes.h"

enum kd_split { SPLIT_BALANCE, SPLIT_SAH, SPLIT_HQ26, SPLIT_FAST6, SPLIT_EXACT };

struct kd_options {
	struct plane_options common;
	int split;
	double step, test, empty_cutoff; /* all but SPLIT_BALANCE: cost of an inner node, of a primitive; share of the cell */
};

/* The rule behind every value of the option 'split'. */
extern const char *const kd_split_words[];
extern plane_rule *const kd_split_rules[];

/* Planes of least expected cost (kd_cost.c). */
plane_rule kd_choose_sah, kd_choose_hq26, kd_choose_fast6, kd_choose_exact;

#endif
