#include "accel/flux.h"

int flux_open(struct flux *f, const struct box *root, int level, struct err *e)
{
	*f = (struct flux){ .root = *root, .side = 1 << level };
	f->step = vec_scale(vec_sub(root->hi, root->lo), 1.0 / f->side);
	size_t nodes = (size_t)f->side + 1;
	nodes *= nodes * nodes;
	uint32_t **tables[] = { &f->crossings[0], &f->crossings[1], &f->crossings[2], &f->ends[FLUX_FREE], &f->ends[FLUX_ON_SURFACE] };
	for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
		if (!(*tables[i] = NEW(&f->mem, uint32_t, nodes)))
			return err_memory(e, "flux");
	return 0;
}

void flux_close(struct flux *f)
{
	arena_free(&f->mem);
	*f = (struct flux){ 0 };
}

static size_t node(const struct flux *f, int32_t x, int32_t y, int32_t z)
{
	size_t row = (size_t)f->side + 1;
	return ((size_t)z * row + (size_t)y) * row + (size_t)x;
}

void flux_add_crossing(struct flux *f, int axis, const int32_t at[3])
{
	f->crossings[axis][node(f, at[0] + (axis != 0), at[1] + (axis != 1), at[2] + (axis != 2))]++;
}

void flux_add_end(struct flux *f, enum flux_end kind, const int32_t at[3])
{
	f->ends[kind][node(f, at[0] + 1, at[1] + 1, at[2] + 1)]++;
}

/* Let every node hold the sum over those up to it along an axis. */
static void sum_along(const struct flux *f, uint32_t *table, int axis)
{
	size_t row = (size_t)f->side + 1, all = row * row * row, stride = axis == 0 ? 1 : axis == 1 ? row : row * row;
	for (size_t i = stride; i < all; i++)
		if (i / stride % row != 0)
			table[i] += table[i - stride];
}

void flux_seal(struct flux *f)
{
	for (int axis = 0; axis < 3; axis++) {
		for (int across = 0; across < 3; across++)
			if (across != axis)
				sum_along(f, f->crossings[across], axis);
		for (int kind = 0; kind < FLUX_ENDS; kind++)
			sum_along(f, f->ends[kind], axis);
	}
}

struct box flux_place(const struct flux *f, const struct box *b)
{
	struct box placed;
	for (int i = 0; i < 3; i++) {
		placed.lo.a[i] = fmax(0, (b->lo.a[i] - f->root.lo.a[i]) / f->step.a[i]);
		placed.hi.a[i] = fmin(f->side, (b->hi.a[i] - f->root.lo.a[i]) / f->step.a[i]);
	}
	return placed;
}

/* A table's value at a point between nodes, linear along every axis. */
static double value_at(const struct flux *f, const uint32_t *table, struct vec p)
{
	int32_t at[3];
	double part[3];
	for (int i = 0; i < 3; i++) {
		at[i] = p.a[i] < f->side - 1 ? (int32_t)p.a[i] : f->side - 1;
		part[i] = p.a[i] - at[i];
	}
	size_t row = (size_t)f->side + 1, first = node(f, at[0], at[1], at[2]);
	double along[2][2];
	for (size_t k = 0; k < 4; k++) {
		const uint32_t *pair = &table[first + k / 2 * row * row + k % 2 * row];
		along[k / 2][k % 2] = pair[0] + part[0] * ((double)pair[1] - pair[0]);
	}
	double low = along[0][0] + part[1] * (along[0][1] - along[0][0]), high = along[1][0] + part[1] * (along[1][1] - along[1][0]);
	return low + part[2] * (high - low);
}

/* A corner of a box: its upper side along axis i where bit i is set. */
static struct vec corner(const struct box *b, int bits)
{
	return vec(bits & 1 ? b->hi.x : b->lo.x, bits & 2 ? b->hi.y : b->lo.y, bits & 4 ? b->hi.z : b->lo.z);
}

double flux_crossings(const struct flux *f, const struct box *b)
{
	double sum = 0;
	for (int axis = 0; axis < 3; axis++)
		for (int bits = 0; bits < 8; bits++) {
			/* Within a face, the corners that are upper along one side only are taken away. */
			int uppers = 0;
			for (int i = 0; i < 3; i++)
				uppers += i != axis && bits >> i & 1;
			sum += (uppers == 1 ? -1 : 1) * value_at(f, f->crossings[axis], corner(b, bits));
		}
	return sum;
}

double flux_ends(const struct flux *f, enum flux_end kind, const struct box *b)
{
	double sum = 0;
	for (int bits = 0; bits < 8; bits++) {
		int lowers = !(bits & 1) + !(bits & 2) + !(bits & 4);
		sum += (lowers % 2 ? -1 : 1) * value_at(f, f->ends[kind], corner(b, bits));
	}
	return sum;
}
