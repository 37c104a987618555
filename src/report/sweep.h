/* Rows that differ in where subdivision ends, as Subramanian and Fussell 1990 swept it, and where along such a sweep a cost is least. */
#ifndef REPORT_SWEEP_H
#define REPORT_SWEEP_H

#include "report/table.h"

/* The paper's structures; OCTREE is a BSP tree whose empty halves are cut too, ABV its automatic bounding volume hierarchy,
 * a primitive a leaf, all of whose subtrees that are met are visited. */
enum sweep_method { SWEEP_BSP, SWEEP_OCTREE, SWEEP_ARTS, SWEEP_KD, SWEEP_ABV, SWEEP_METHODS };

/* One sweep: a method over the scenes of a family, with full mailboxes where it has any. random: rays of the invariant law, else images.
 * restart: of BSP trees and octrees, those in which every leaf is found from the root on, else those walked recursively. */
struct sweep {
	const struct table *table;
	enum sweep_method method;
	const char *family;
	bool random, restart;
};

bool sweep_holds(const struct sweep *s, size_t row);

/* What ends subdivision: planes above a leaf, levels of an octree, cells a side. */
double sweep_height(const struct sweep *s, size_t row);

/* The least value of a column along the sweep; row == table->rows where there is none. low, high: heights between which it stays
 * within 2 % of the least. */
struct sweep_best {
	size_t row;
	double height, value, low, high;
};
struct sweep_best sweep_least(const struct sweep *s, const char *column);

/* The same of the seconds spent shooting, of which the last line of a key in 'times' counts; low and high within 10 %, since a clock on a
 * machine at work tells no finer. */
struct sweep_best sweep_fastest(const struct sweep *s, const struct table *times);

/* The value of a column at the sweep's row of this height, or NAN. */
double sweep_at(const struct sweep *s, double height, const char *column);

#endif
