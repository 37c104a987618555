#include "accel/flux.h"

int flux_open(struct flux *f, const struct box *root, struct err *e)
{
	const size_t side = FLUX_SIDE + 1;
	*f = (struct flux){ .root = *root, .step = vec_scale(vec_sub(root->hi, root->lo), 1.0 / FLUX_SIDE) };
	f->voxels = NEW(&f->mem, struct flux_voxel, side * side * side);
	return f->voxels ? 0 : err_memory(e, "flux");
}

void flux_close(struct flux *f)
{
	arena_free(&f->mem);
	*f = (struct flux){ 0 };
}

struct box flux_place(const struct flux *f, const struct box *b)
{
	struct box placed;
	for (int i = 0; i < 3; i++) {
		placed.lo.a[i] = fmax(0, (b->lo.a[i] - f->root.lo.a[i]) / f->step.a[i]);
		placed.hi.a[i] = fmin(FLUX_SIDE, (b->hi.a[i] - f->root.lo.a[i]) / f->step.a[i]);
	}
	return placed;
}

/* Voxels along an axis: first .. end - 1. */
struct stretch {
	int32_t first, end;
};

/* Those that low .. high reaches into. */
static struct stretch stretch_of(double low, double high)
{
	return (struct stretch){ (int32_t)low, (int32_t)ceil(high) };
}

/* How much of voxel i lies in low .. high. */
static double share_of(int32_t i, double low, double high)
{
	return fmin(high, i + 1) - fmax(low, i);
}

static void add_scaled(double sum[FLUX_GROUPS], const uint32_t counts[FLUX_GROUPS], double weight)
{
	for (int g = 0; g < FLUX_GROUPS; g++)
		sum[g] += weight * counts[g];
}

/* Crossings of grid plane 'plane' across an axis, as far as it is seen through the box along that axis. */
static void add_plane(const struct flux *f, const struct box *b, int axis, int32_t plane, double weight, double sum[FLUX_GROUPS])
{
	int u = (axis + 1) % 3, v = (axis + 2) % 3;
	struct stretch across = stretch_of(b->lo.a[u], b->hi.a[u]), along = stretch_of(b->lo.a[v], b->hi.a[v]);
	int32_t at[3];
	at[axis] = plane;
	for (at[v] = along.first; at[v] < along.end; at[v]++) {
		double part = weight * share_of(at[v], b->lo.a[v], b->hi.a[v]);
		for (at[u] = across.first; at[u] < across.end; at[u]++)
			add_scaled(sum, f->voxels[flux_at(at)].crossings[axis], part * share_of(at[u], b->lo.a[u], b->hi.a[u]));
	}
}

void flux_crossings(const struct flux *f, const struct box *b, double sum[FLUX_GROUPS])
{
	for (int g = 0; g < FLUX_GROUPS; g++)
		sum[g] = 0;
	for (int axis = 0; axis < 3; axis++)
		for (int upper = 0; upper < 2; upper++) {
			double x = upper ? b->hi.a[axis] : b->lo.a[axis];
			int32_t plane = (int32_t)x;
			add_plane(f, b, axis, plane, plane + 1 - x, sum);
			if (x > plane)
				add_plane(f, b, axis, plane + 1, x - plane, sum);
		}
}

void flux_ends(const struct flux *f, enum flux_end kind, const struct box *b, double sum[FLUX_GROUPS])
{
	struct stretch s[3];
	int32_t at[3];
	for (int g = 0; g < FLUX_GROUPS; g++)
		sum[g] = 0;
	for (int i = 0; i < 3; i++)
		s[i] = stretch_of(b->lo.a[i], b->hi.a[i]);
	for (at[2] = s[2].first; at[2] < s[2].end; at[2]++)
		for (at[1] = s[1].first; at[1] < s[1].end; at[1]++) {
			double part = share_of(at[2], b->lo.z, b->hi.z) * share_of(at[1], b->lo.y, b->hi.y);
			for (at[0] = s[0].first; at[0] < s[0].end; at[0]++)
				add_scaled(sum, f->voxels[flux_at(at)].ends[kind], part * share_of(at[0], b->lo.x, b->hi.x));
		}
}
