#include "batch/plan.h"

#include "batch/load.h"
#include "batch/row.h"
#include "batch/row_key.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Measured on scenes of 64 to 36,000 triangles; only their proportions matter. Nanoseconds: building and predicting, a primitive; a ray,
 * and for every doubling of the primitives; a test where there is no structure. */
enum { COST_PRIMITIVE = 30000, COST_RAY = 200, COST_RAY_LEVEL = 40, COST_TEST = 5 };

/* Doublings from 1 to n. */
static uint64_t count_levels(uint64_t n)
{
	uint64_t levels = 0;
	while (n >>= 1)
		levels++;
	return levels;
}

static uint64_t estimate(const struct accel_ops *ops, const struct measure_spec *m, uint64_t primitives, uint64_t lights)
{
	uint64_t rays = m->render ? (uint64_t)m->image.width * (uint64_t)m->image.height * render_frames(&m->image) * (1 + lights) : (uint64_t)m->count;
	if (strcmp(ops->name, "list") == 0)
		return rays * (COST_RAY + COST_TEST * primitives);
	return COST_PRIMITIVE * primitives + rays * (COST_RAY + COST_RAY_LEVEL * count_levels(primitives));
}

static int fill_scene(struct plan *plan, const struct job *job, const struct experiment *x, const struct scene_spec *scene,
                      const atomic_int *stop, struct err *e)
{
	struct primitives p = { 0 };
	struct scene setting = { 0 };
	struct text text = { 0 };
	struct err ignored = { 0 }; /* what cannot be loaded will be a failed row */
	struct row row;
	bool loaded = load_scene(&p, &setting, &text, scene, &ignored) == 0;
	uint64_t hash = hash_bytes(text.bytes, text.size);
	for (size_t i = 0; i < x->structure_count; i++)
		for (size_t k = 0; k < x->measure_count; k++) {
			const struct structure_spec *structure = &job->structures[x->structure_first + i];
			const struct measure_spec *measure = &job->measures[x->measure_first + k];
			row_identify(&row, job, scene, structure, measure, loaded ? &p : NULL, hash);
			plan->keys[plan->count] = row.key;
			plan->costs[plan->count++] = loaded ? estimate(structure->ops, measure, p.count, setting.light_count) : 0;
		}
	text_free(&text);
	scene_free(&setting);
	primitives_free(&p);
	int signal = stop ? *stop : 0;
	return signal ? err_at(e, 128 + signal, NULL, 0, "stopped by signal %d", signal) : 0;
}

struct entry {
	uint64_t cost, key;
	size_t row;
};

static int compare_entries(const void *a, const void *b)
{
	const struct entry *x = a, *y = b;
	if (x->cost != y->cost)
		return x->cost > y->cost ? -1 : 1;
	if (x->key != y->key)
		return x->key < y->key ? -1 : 1;
	return x->row < y->row ? -1 : x->row > y->row;
}

/* Whether shard a is to have its next row before b. */
static bool is_before(const uint64_t *load, uint32_t a, uint32_t b)
{
	return load[a] < load[b] || (load[a] == load[b] && a < b);
}

/* Restore the order of a heap whose top has grown. */
static void sift_down(uint32_t *heap, const uint64_t *load, uint32_t count)
{
	for (uint32_t at = 0, child; (child = 2 * at + 1) < count; at = child) {
		child += child + 1 < count && is_before(load, heap[child + 1], heap[child]);
		if (is_before(load, heap[at], heap[child]))
			return;
		uint32_t top = heap[at];
		heap[at] = heap[child];
		heap[child] = top;
	}
}

int plan_assign(uint32_t *assigned, const uint64_t *costs, const uint64_t *keys, size_t count, uint32_t shards, struct err *e)
{
	struct entry *entries = malloc((count + 1) * sizeof *entries);
	uint64_t *load = calloc(shards, sizeof *load);
	uint32_t *heap = malloc(shards * sizeof *heap);
	int status = entries && load && heap ? 0 : err_memory(e, "plan");
	for (size_t i = 0; status == 0 && i < count; i++)
		entries[i] = (struct entry){ costs[i], keys[i], i };
	for (uint32_t i = 0; status == 0 && i < shards; i++)
		heap[i] = i;
	if (status == 0)
		qsort(entries, count, sizeof *entries, compare_entries);
	for (size_t i = 0; status == 0 && i < count; i++) {
		assigned[entries[i].row] = heap[0];
		load[heap[0]] += entries[i].cost + 1; /* rows that cost nothing are spread as well */
		sift_down(heap, load, shards);
	}
	free(entries);
	free(load);
	free(heap);
	return status;
}

int plan_make(struct plan *plan, const struct job *job, uint32_t shards, const atomic_int *stop, struct err *e)
{
	size_t rows = job_rows(job);
	int status = 0;
	plan->keys = NEW(&plan->mem, uint64_t, rows);
	plan->costs = NEW(&plan->mem, uint64_t, rows);
	plan->shards = NEW(&plan->mem, uint32_t, rows);
	if (!plan->keys || !plan->costs || !plan->shards)
		return err_memory(e, "plan");
	for (size_t n = 0; n < job->experiment_count; n++)
		for (size_t i = 0; status == 0 && i < job->experiments[n].scene_count; i++)
			status = fill_scene(plan, job, &job->experiments[n], &job->scenes[job->experiments[n].scene_first + i], stop, e);
	return status == 0 ? plan_assign(plan->shards, plan->costs, plan->keys, plan->count, shards, e) : -1;
}

void plan_free(struct plan *plan)
{
	arena_free(&plan->mem);
	*plan = (struct plan){ 0 };
}

void plan_print_keys(const struct plan *plan, struct text *out)
{
	text_print(out, "key\n");
	for (size_t i = 0; i < plan->count; i++)
		text_print(out, "%016" PRIx64 "\n", plan->keys[i]);
}
