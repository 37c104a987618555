#include "report/sweep.h"

#include <math.h>

bool sweep_holds(const struct sweep *s, size_t row)
{
	static const char *const structures[] = { "bsp", "bsp", "grid", "kd", "bvh" };
	const struct table *t = s->table;
	if (!table_is(t, row, "status", "ok") || !table_is(t, row, "structure", structures[s->method]) ||
	    !table_is(t, row, "family", s->family) || !table_is(t, row, "workload", s->random ? "invariant" : "render"))
		return false;
	if (s->method == SWEEP_BSP || s->method == SWEEP_OCTREE)
		if (!table_is(t, row, "empty_halves", s->method == SWEEP_BSP ? "keep" : "cut"))
			return false;
	if (s->method == SWEEP_ABV)
		return true;
	return table_is(t, row, "mailbox", "full") && (table_is(t, row, "stop", "none") || table_is(t, row, "stop", ""));
}

double sweep_height(const struct sweep *s, size_t row)
{
	if (s->method == SWEEP_ARTS)
		return table_number(s->table, row, "resolution");
	return table_number(s->table, row, "max_depth") / (s->method == SWEEP_OCTREE ? 3 : 1);
}

struct sweep_best sweep_least(const struct sweep *s, const char *column)
{
	struct sweep_best b = { .row = s->table->rows, .height = NAN, .value = INFINITY, .low = INFINITY, .high = -INFINITY };
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && table_number(s->table, i, column) < b.value) {
			b.row = i;
			b.value = table_number(s->table, i, column);
			b.height = sweep_height(s, i);
		}
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && table_number(s->table, i, column) <= 1.02 * b.value) {
			b.low = fmin(b.low, sweep_height(s, i));
			b.high = fmax(b.high, sweep_height(s, i));
		}
	return b;
}

double sweep_at(const struct sweep *s, double height, const char *column)
{
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && sweep_height(s, i) == height)
			return table_number(s->table, i, column);
	return NAN;
}
