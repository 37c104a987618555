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
		if (!table_is(t, row, "empty_halves", s->method == SWEEP_BSP ? "keep" : "cut") ||
		    !table_is(t, row, "traversal", s->restart ? "restart" : "recursive"))
			return false;
	if (s->method == SWEEP_ABV)
		return table_is(t, row, "builder", "insertion") && table_is(t, row, "max_objects", "1") &&
		       table_is(t, row, "traversal", "array");
	return table_is(t, row, "mailbox", "full") && (table_is(t, row, "stop", "none") || table_is(t, row, "stop", ""));
}

double sweep_height(const struct sweep *s, size_t row)
{
	if (s->method == SWEEP_ARTS)
		return table_number(s->table, row, "resolution");
	return table_number(s->table, row, "max_depth") / (s->method == SWEEP_OCTREE ? 3 : 1);
}

/* What a row is compared by: a column, or its time. */
static double value_of(const struct sweep *s, size_t row, const char *column, const struct table *times)
{
	double seconds = NAN;
	if (!times)
		return table_number(s->table, row, column);
	for (size_t i = 0; i < times->rows; i++)
		if (table_is(times, i, "key", table_text(s->table, row, "key")))
			seconds = table_number(times, i, "seconds_shoot");
	return seconds;
}

static struct sweep_best find_least(const struct sweep *s, const char *column, const struct table *times, double level)
{
	struct sweep_best b = { .row = s->table->rows, .height = NAN, .value = INFINITY, .low = INFINITY, .high = -INFINITY };
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && value_of(s, i, column, times) < b.value) {
			b.row = i;
			b.value = value_of(s, i, column, times);
			b.height = sweep_height(s, i);
		}
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && value_of(s, i, column, times) <= level * b.value) {
			b.low = fmin(b.low, sweep_height(s, i));
			b.high = fmax(b.high, sweep_height(s, i));
		}
	return b;
}

struct sweep_best sweep_least(const struct sweep *s, const char *column)
{
	return find_least(s, column, NULL, 1.02);
}

struct sweep_best sweep_fastest(const struct sweep *s, const struct table *times)
{
	return find_least(s, NULL, times, 1.1);
}

double sweep_at(const struct sweep *s, double height, const char *column)
{
	for (size_t i = 0; i < s->table->rows; i++)
		if (sweep_holds(s, i) && sweep_height(s, i) == height)
			return table_number(s->table, i, column);
	return NAN;
}
