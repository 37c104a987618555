/* How a kd tree chooses its planes. */
#ifndef ACCEL_KD_SPLIT_H
#define ACCEL_KD_SPLIT_H

#include "accel/planes.h"

enum kd_split { SPLIT_BALANCE };

struct kd_options {
	struct plane_options common;
	int split;
};

/* The rule behind every value of the option 'split'. */
extern const char *const kd_split_words[];
extern plane_rule *const kd_split_rules[];

#endif
