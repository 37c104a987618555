/* Numbers sorted by their bits are sorted. */
#include "tests/check.h"

#include "base/order.h"
#include "base/rng.h"

#include <string.h>

enum { MOST = 3000 };

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void sorts_what_is_given(void **state)
{
	(void)state;
	static const size_t sizes[] = { 0, 1, 2, 47, 48, 49, 300, MOST };
	for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
		for (uint64_t kind = 0; kind < 4; kind++) {
			double v[MOST], want[MOST], spare[MOST];
			for (size_t i = 0; i < sizes[s]; i++) {
				double u = rng_uniform(rng_key(3, kind, i), s) - 0.5;
				v[i] = kind == 0 ? u : kind == 1 ? ldexp(u, (int)(i % 200) - 100) : kind == 2 ? floor(8 * u) + 0.5 : 1;
			}
			if (sizes[s] > 2) {
				v[1] = INFINITY;
				v[2] = -INFINITY;
			}
			memcpy(want, v, sizes[s] * sizeof *v);
			qsort(want, sizes[s], sizeof *want, compare);
			reals_sort(v, spare, sizes[s]);
			assert_memory_equal(v, want, sizes[s] * sizeof *v);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(sorts_what_is_given) };
	return cmocka_run_group_tests(tests, NULL, NULL);
}
