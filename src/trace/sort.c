#include "trace/sort.h"

#include <string.h>

/* The bits of i, two zeros after each. */
static uint32_t spread_bits(uint32_t i)
{
	uint32_t spread = 0;
	for (int bit = 0; bit < SORT_LEVELS; bit++)
		spread |= (i >> bit & 1) << 3 * bit;
	return spread;
}

void rays_sort(struct ray *sorted, struct sorter *s, const struct ray *rays, size_t n, const struct box *root)
{
	uint32_t spread[1 << SORT_LEVELS];
	struct vec scale;
	for (uint32_t i = 0; i < 1 << SORT_LEVELS; i++)
		spread[i] = spread_bits(i);
	for (int i = 0; i < 3; i++)
		scale.a[i] = (1 << SORT_LEVELS) / (root->hi.a[i] - root->lo.a[i]);
	memset(s->first, 0, sizeof s->first);
	for (size_t k = 0; k < n; k++) {
		uint32_t cell = 0;
		for (int i = 0; i < 3; i++) {
			double x = (rays[k].o.a[i] - root->lo.a[i]) * scale.a[i];
			cell |= spread[x < 0 ? 0 : x >= (1 << SORT_LEVELS) ? (1 << SORT_LEVELS) - 1 : (int)x] << i;
		}
		s->cell[k] = cell;
		s->first[cell + 1]++;
	}
	for (int c = 0; c < SORT_CELLS; c++)
		s->first[c + 1] += s->first[c];
	for (size_t k = 0; k < n; k++)
		sorted[s->first[s->cell[k]]++] = rays[k];
}
