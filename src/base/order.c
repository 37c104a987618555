#include "base/order.h"

#include <stdint.h>
#include <string.h>

enum { FEW = 48, BYTES = sizeof(uint64_t) };

static void sort_few(double *v, size_t n)
{
	for (size_t i = 1; i < n; i++) {
		double x = v[i];
		size_t k = i;
		for (; k > 0 && v[k - 1] > x; k--)
			v[k] = v[k - 1];
		v[k] = x;
	}
}

/* Bits that compare as the numbers do. */
static uint64_t bits_of(double x)
{
	uint64_t b;
	memcpy(&b, &x, sizeof b);
	return b ^ (b >> 63 ? UINT64_MAX : (uint64_t)1 << 63);
}

static void sort_many(double *v, double *spare, size_t n)
{
	size_t count[BYTES][256] = { { 0 } };
	double *from = v, *to = spare;
	for (size_t i = 0; i < n; i++) {
		uint64_t b = bits_of(v[i]);
		for (int k = 0; k < BYTES; k++)
			count[k][b >> 8 * k & 255]++;
	}
	for (int k = 0; k < BYTES; k++) {
		size_t first = 0, *place = count[k];
		if (place[bits_of(v[0]) >> 8 * k & 255] == n)
			continue; /* this byte is the same everywhere */
		for (int i = 0; i < 256; i++) {
			size_t here = place[i];
			place[i] = first;
			first += here;
		}
		for (size_t i = 0; i < n; i++)
			to[place[bits_of(from[i]) >> 8 * k & 255]++] = from[i];
		double *swap = from;
		from = to;
		to = swap;
	}
	if (from != v)
		memcpy(v, from, n * sizeof *v);
}

void reals_sort(double *v, double *spare, size_t n)
{
	if (n <= FEW)
		sort_few(v, n);
	else
		sort_many(v, spare, n);
}
