/* The order in which many rays are shot: those that start near each other in similar directions meet the same nodes, which are then
 * still in the cache. Sorted by a code of origin and direction with their bits in turn (Morton 1966), by radix. */
#include "accel/bvh8.h"

#include <stdlib.h>

enum { LEVELS = 5, DIGIT = 10, DIGITS = 3, BUCKETS = 1 << DIGIT, SAMPLES = 64 };

struct place {
	uint32_t code, ray;
};

/* The LEVELS bits of x, six apart. */
static uint32_t spread_bits(uint32_t x)
{
	uint32_t bits = 0;
	for (int i = 0; i < LEVELS; i++)
		bits |= (x >> i & 1) << 6 * i;
	return bits;
}

struct coder {
	uint32_t spread[1 << LEVELS];
	struct vec origin, per_cell;
};

static uint32_t cell_of(double x)
{
	return x < 0 ? 0 : x >= (1 << LEVELS) ? (1 << LEVELS) - 1 : (uint32_t)x;
}

static uint32_t code_of(const struct coder *c, const struct ray *r)
{
	uint32_t code = 0;
	for (int i = 0; i < 3; i++) {
		code |= c->spread[cell_of((r->o.a[i] - c->origin.a[i]) * c->per_cell.a[i])] << (3 + i);
		code |= c->spread[cell_of((r->d.a[i] + 1) * (1 << (LEVELS - 1)))] << i;
	}
	return code;
}

static void sort(struct place *places, struct place *scratch, size_t count)
{
	static const size_t none[BUCKETS];
	for (int digit = 0; digit < DIGITS; digit++) {
		size_t first[BUCKETS], sum = 0;
		for (int i = 0; i < BUCKETS; i++)
			first[i] = none[i];
		for (size_t i = 0; i < count; i++)
			first[places[i].code >> digit * DIGIT & (BUCKETS - 1)]++;
		for (int i = 0; i < BUCKETS; i++) {
			size_t n = first[i];
			first[i] = sum;
			sum += n;
		}
		for (size_t i = 0; i < count; i++)
			scratch[first[places[i].code >> digit * DIGIT & (BUCKETS - 1)]++] = places[i];
		struct place *done = scratch;
		scratch = places;
		places = done;
	}
}

/* Whether rays that follow each other are alike already, as those of an image are. */
static bool are_alike(const struct accel *a, const struct ray *r, size_t count)
{
	int alike = 0;
	double near = 0.02 * box_diagonal(&a->root);
	for (size_t i = 0; i < SAMPLES; i++) {
		const struct ray *p = &r[i * (count - 1) / SAMPLES], *q = p + 1;
		alike += vec_dot(p->d, q->d) > 0.98 && vec_length(vec_sub(p->o, q->o)) < near;
	}
	return alike > SAMPLES / 2;
}

uint32_t *bvh8_order(const struct accel *a, const struct ray *r, size_t count)
{
	struct coder c = { .origin = a->root.lo };
	if (count < 2 || are_alike(a, r, count))
		return NULL;
	struct place *places = arena_pages(2 * count * sizeof *places);
	if (!places)
		return NULL;
	for (uint32_t i = 0; i < 1 << LEVELS; i++)
		c.spread[i] = spread_bits(i);
	for (int i = 0; i < 3; i++)
		c.per_cell.a[i] = (1 << LEVELS) / (a->root.hi.a[i] - a->root.lo.a[i]);
	for (size_t i = 0; i < count; i++)
		places[i] = (struct place){ code_of(&c, &r[i]), (uint32_t)i };
	sort(places, places + count, count);
	uint32_t *order = (uint32_t *)places;
	for (size_t i = 0; i < count; i++)
		order[i] = places[count + i].ray;
	return order;
}
