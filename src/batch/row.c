#include "batch/row.h"

#include "batch/csv.h"
#include "batch/row_key.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#define AT(field) offsetof(struct row, field)
#define TEXT(name, text) { #name, COLUMN_TEXT, AT(name), text }
#define COUNT(name, text) { #name, COLUMN_COUNT, AT(name), text }
#define REAL(name, field, text) { name, COLUMN_REAL, AT(field), text }
#define OPTION(name, text) { #name, COLUMN_OPTION, 0, text }
#define MEASURE(name, text) { #name, COLUMN_MEASURE, 0, text }
#define CLASS(name, class) \
	{ name "_rays", COLUMN_COUNT, AT(class_counts[class][0]), "image: " name " rays, those that visit no cell included" }, \
	{ name "_hits", COLUMN_COUNT, AT(class_counts[class][1]), "image: " name " rays that end on a primitive" }, \
	{ name "_leaves", COLUMN_COUNT, AT(class_counts[class][2]), "image: leaves visited by " name " rays, in all" }, \
	{ name "_tests", COLUMN_COUNT, AT(class_counts[class][3]), "image: ray-primitive tests of " name " rays, in all" }, \
	{ name "_inner", COLUMN_COUNT, AT(class_counts[class][4]), "image: inner nodes visited by " name " rays, in all" }

const struct column row_columns[] = {
	{ "key", COLUMN_KEY, AT(key), "hash of what determines the row: scene content, options, workload, seed" },
	TEXT(job, "name of the job"),
	TEXT(scene, "name of the scene; its file is scenes/NAME.nff.gz"),
	TEXT(family, "generator of the scene; empty for a file"),
	COUNT(size, "size given to the generator"),
	COUNT(triangles, "triangles in the scene"),
	COUNT(spheres, "spheres in the scene"),
	TEXT(structure, "kind of the structure"),
	OPTION(balanced, "octree: leaves that share a vertex differ by at most one level"),
	OPTION(max_objects, "octree, kd by balance, bsp: a cell that lists more primitives is split; bvh: what a leaf may list"),
	OPTION(root, "the region: bounding cube or tight bounding box"),
	OPTION(max_depth, "octree, kd, bsp: cells below so many splits are not split"),
	OPTION(overlap, "octree: exact or bounding-box lists"),
	OPTION(criterion, "octree: what cells are split for"),
	OPTION(cutoff, "octree, features: cells of at most this share of the root's side are not split"),
	OPTION(root_level, "octree, random: level of the root"),
	OPTION(run, "octree, random: which of the trees"),
	OPTION(traversal, "kd, bsp: recursive or restart; bvh: how rays find their way"),
	OPTION(split, "kd: how planes are chosen"),
	OPTION(empty_cutoff, "kd: a plane that cuts off an empty part of this share of the cell goes before others"),
	OPTION(boxes, "kd: a cell whose primitives' bounding box has less than this share of its area holds that box"),
	OPTION(touching, "bsp: what becomes of primitives that touch a cell and do not reach into it"),
	OPTION(empty_halves, "bsp: what the remaining planes of an octree's step do to a half that lists nothing"),
	OPTION(setting, "grid: how the cells along each axis are chosen"),
	OPTION(resolution, "grid: cells along x"),
	OPTION(resolution_y, "grid: cells along y; 0: as along x"),
	OPTION(resolution_z, "grid: cells along z; 0: as along x"),
	OPTION(density, "grid: cells a primitive"),
	OPTION(mailbox, "kd, bsp, grid: which tests are spared"),
	OPTION(stop, "kd, bsp, grid: by whose prediction subdivision ends"),
	OPTION(builder, "bvh: how the tree is made"),
	OPTION(bins, "bvh: bins an axis"),
	OPTION(step, "bvh, kd: what builders take an inner node to cost"),
	OPTION(test, "bvh, kd: what builders take a primitive in a leaf to cost"),
	OPTION(optimise, "bvh: rounds of reinsertion"),
	OPTION(kernel, "bvh8: instructions"),
	TEXT(workload, "invariant, invariant-one-sided, invariant-ext, lines, segments, segments-twice, interior, interior-hits or render"),
	MEASURE(width, "image: pixels"),
	MEASURE(height, "image: pixels"),
	MEASURE(sampling, "image: primary rays through pixel centers or corners"),
	MEASURE(shadows, "image: shadow rays to all lights, or to those that the surface faces"),
	MEASURE(ray_depth, "image: of the tree of rays; a primary ray has 1"),
	MEASURE(weight, "image: rays that could add less than this share to a pixel are not shot"),
	MEASURE(light, "image: where lights stand if not as in the scene: inside or outside the box of the primitives"),
	MEASURE(flight, "image: places the camera flies through, and what it looks at"),
	MEASURE(frames, "image: of the flight, whose rays count together"),
	MEASURE(pilot_width, "image: pixels of the pilot"),
	MEASURE(pilot_height, "image: pixels of the pilot"),
	COUNT(rays, "number of rays shot"),
	COUNT(missed, "image: rays that visit no cell; they are in no mean"),
	COUNT(seed, "of the job; every random number follows from it and the scene"),
	REAL("alpha", alpha, "cost of a visited leaf; of a bvh's inner node"),
	REAL("beta", beta, "cost of a ray-primitive test"),
	TEXT(status, "ok or failed"),
	TEXT(message, "why it failed"),
	COUNT(nodes, "nodes of the structure, leaves included"),
	COUNT(leaves, "leaves of the structure; N_V of a grid"),
	COUNT(empty_leaves, "leaves that list nothing; N_EV of a grid"),
	COUNT(references, "entries in all lists; N_OIV of a grid"),
	COUNT(depth, "of the deepest leaf; the root has 0"),
	COUNT(stopped_at, "the max_depth or resolution that the prediction chose"),
	REAL("root_area", root_area, "surface area of the root, scene units^2"),
	REAL("object_area", object_area, "one-sided area of all primitives, scene units^2"),
	REAL("area_inside", predicted.area_inside, "surface found inside the cells; equals object_area"),
	REAL("area_leaves", predicted.area_leaves, "sum of the leaves' surface areas, scene units^2"),
	REAL("predicted", predicted.predicted, "cost a ray by eq. (3) of Aronov et al. 2002 as printed"),
	REAL("predicted_two_sided", predicted.predicted_two_sided, "the same with both sides of the surface in the denominator"),
	REAL("predicted_exact", predicted.predicted_exact, "expected cost a ray, exact for the workload"),
	REAL("predicted_one", predicted.predicted_one, "the exact form with one side of every surface: rays that start on the front sides only, "
	     "if none ran inside a solid"),
	REAL("model_per_leaf", model.per_leaf, "model of Subramanian and Fussell 1990: primitives a leaf"),
	REAL("model_chance", model.chance, "model: chance that a region stops a ray"),
	REAL("model_regions", model.regions, "model: regions a ray examines, as printed"),
	REAL("model_regions_truncated", model.regions_truncated, "model: the same with the rays that nothing stops"),
	REAL("model_height", model.height, "model: planes above a leaf, on average"),
	REAL("model_descent", model.descent, "model of a hierarchy: flops to add where most rays start inside"),
	REAL("model_scene", model.flops.scene, "model: flops a ray for primitives, C_sc"),
	REAL("model_traversal", model.flops.traversal, "model: flops a ray for traversal, C_tr"),
	REAL("model_cost", model.cost, "model: flops a ray, C_sc + C_tr"),
	REAL("model_cost_truncated", model.cost_truncated, "model: the same with model_regions_truncated"),
	REAL("flops_exact_scene", flops_exact.scene, "exact expectation of flops a ray for primitives: 15.5 a test (with a mailbox: a one-deep one)"),
	REAL("flops_exact_traversal", flops_exact.traversal, "the same for traversal: 4.5 a plane passed, 15.5 a box, or 6.5 a voxel"),
	REAL("flops_exact", flops_exact_sum, "their sum"),
	REAL("flops_replay", flops_replay_sum, "image: flops a ray of the pilot's rays in this structure"),
	REAL("predicted_volumes", predicted.volumes, "bvh: expected cost a ray of the nodes met up to its first hit"),
	REAL("sah", predicted.sah, "bvh: surface area heuristic, sum of cost times area over the root's area"),
	REAL("epo", predicted.epo, "bvh: end-point overlap, sum of cost times the surface of others inside over all surface"),
	REAL("dq", predicted.dq, "bvh: the same with the node's own surface: what paths to leaves cost"),
	REAL("surface_share", predicted.surface_share, "bvh: share of rays that start on surfaces: predicted_volumes = (1 - share) sah + share (epo + dq)"),
	REAL("replay", replay.mean, "image: cost a ray of the pilot's rays in this structure"),
	REAL("replay_low", replay.low, "lower end of its 95 % interval, by bootstrap over the pilot's pixels"),
	REAL("replay_high", replay.high, "upper end of it"),
	REAL("calibrated", calibrated.mean, "image: cost a ray from the flux of the pilot's rays through a grid and the cells of this structure"),
	REAL("calibrated_low", calibrated.low, "lower end of its 95 % interval, by groups of the pilot's pixels"),
	REAL("calibrated_high", calibrated.high, "upper end of it"),
	REAL("predicted_leaves", predicted.leaves, "expected leaves visited a ray"),
	REAL("predicted_tests", predicted.tests, "expected ray-primitive tests a ray"),
	REAL("predicted_tests_one", predicted.tests_one, "expected tests with a one-deep mailbox; at least as many as with a full one"),
	REAL("predicted_inner_step", predicted.inner_step, "expected inner nodes a ray while stepping from leaf to leaf"),
	REAL("predicted_inner_start", predicted.inner_start, "expected inner nodes of the first descent"),
	REAL("predicted_inner", predicted.inner, "expected inner nodes in all, as the structure's rays travel"),
	REAL("predicted_inner_top_down", predicted.inner_top_down, "expected inner nodes of a recursive front-to-back traversal"),
	REAL("predicted_inner_restart", predicted.inner_restart, "expected inner nodes where every leaf is found from the root"),
	REAL("predicted_boxes", predicted.boxes, "expected boxes of inner nodes tested"),
	REAL("actual", actual.cost.mean, "measured cost a ray: alpha * leaves + beta * tests"),
	REAL("actual_se", actual.cost.se, "its standard error"),
	REAL("actual_low", actual_low, "lower end of its 95 % interval"),
	REAL("actual_high", actual_high, "upper end of its 95 % interval"),
	REAL("actual_leaves", actual.leaves.mean, "leaves visited a ray; N_ETS of a grid"),
	REAL("actual_leaves_se", actual.leaves.se, "its standard error"),
	REAL("actual_tests", actual.tests.mean, "ray-primitive tests a ray; N_IT of a grid"),
	REAL("actual_tests_se", actual.tests.se, "its standard error"),
	REAL("actual_tests_made", tests_made.mean, "of these the ones the mailbox did not spare"),
	REAL("actual_tests_made_se", tests_made.se, "its standard error"),
	REAL("actual_barycentric", barycentric.mean, "kd, bsp, grid: of the triangles tested those whose plane the ray meets before its hit; "
	     "a test that begins with the plane does no more for the others"),
	REAL("actual_barycentric_se", barycentric.se, "its standard error"),
	REAL("actual_inner_step", actual.inner_step.mean, "inner nodes visited a ray while stepping from leaf to leaf"),
	REAL("actual_inner_step_se", actual.inner_step.se, "its standard error"),
	REAL("actual_inner_start", actual.inner_start.mean, "inner nodes visited by the first descent"),
	REAL("actual_inner_start_se", actual.inner_start.se, "its standard error"),
	REAL("actual_inner", actual.inner.mean, "inner nodes visited a ray"),
	REAL("actual_inner_se", actual.inner.se, "its standard error"),
	REAL("actual_boxes", actual.boxes.mean, "ray-box tests a ray"),
	REAL("actual_boxes_se", actual.boxes.se, "its standard error"),
	REAL("flops_actual_scene", flops_actual.scene, "measured flops a ray for primitives: 15.5 a test made"),
	REAL("flops_actual_traversal", flops_actual.traversal, "measured flops a ray for traversal"),
	REAL("flops_actual", flops_actual_sum, "their sum"),
	REAL("lcv", lcv, "bvh: leaf count variability, the standard deviation of the leaves visited a ray"),
	REAL("actual_hits", actual.hits.mean, "share of rays that end on a primitive"),
	REAL("actual_hits_se", actual.hits.se, "its standard error"),
	REAL("ratio", ratio, "predicted / actual"),
	REAL("ratio_exact", ratio_exact, "predicted_exact / actual"),
	REAL("ratio_volumes", ratio_volumes, "predicted_volumes / actual"),
	REAL("ratio_replay", ratio_replay, "replay / actual"),
	REAL("ratio_calibrated", ratio_calibrated, "calibrated / actual"),
	REAL("z_exact", z_exact, "(actual - predicted_exact) / actual_se"),
	REAL("z_leaves", z_leaves, "the same for leaves"),
	REAL("z_tests", z_tests, "the same for tests"),
	REAL("z_inner_step", z_inner_step, "the same for inner_step"),
	REAL("z_inner_start", z_inner_start, "the same for inner_start"),
	REAL("z_tests_made", z_tests_made, "the same for tests with a one-deep mailbox"),
	REAL("z_inner", z_inner, "the same for inner nodes in all"),
	REAL("z_boxes", z_boxes, "the same for boxes"),
	REAL("overhead_predicted", overhead_predicted, "vertical motion: (leaves + inner_step) / leaves, predicted"),
	REAL("overhead_actual", overhead_actual, "vertical motion: (leaves + inner_step) / leaves, measured"),
	CLASS("primary", RAY_PRIMARY),
	CLASS("shadow", RAY_SHADOW),
	CLASS("reflected", RAY_REFLECTED),
	CLASS("refracted", RAY_REFRACTED),
	{ 0 }
};

int row_column(const char *name)
{
	for (int i = 0; row_columns[i].name; i++)
		if (strcmp(row_columns[i].name, name) == 0)
			return i;
	return -1;
}

void structure_print(const struct structure_spec *s, char *out, size_t size)
{
	size_t n = (size_t)snprintf(out, size, "%s", s->ops->name);
	for (const struct key *k = s->ops->keys; k->name && n < size; k++) {
		char value[64];
		if (!accel_applies(s->ops, s->options, k->name))
			continue;
		key_print(k, s->options, value, sizeof value);
		n += (size_t)snprintf(out + n, size - n, " %s=%s", k->name, value);
	}
}

void row_identify(struct row *r, const struct job *job, const struct scene_spec *scene, const struct structure_spec *structure,
                  const struct measure_spec *measure, const struct primitives *p, uint64_t text_hash)
{
	*r = (struct row){ .job = job->name, .scene = scene->name, .structure = structure->ops->name, .spec = structure,
		           .measure = measure, .rays = measure->render ? ROW_NONE : (uint64_t)measure->count, .missed = ROW_NONE,
		           .seed = (uint64_t)job->seed, .alpha = measure->alpha,
		           .beta = measure->beta };
	r->key = row_key(job, scene, structure, measure, p, text_hash);
	r->family = scene->family ? scene->family->name : NULL;
	r->size = ROW_NONE;
	if (scene->family && scene->family->default_size)
		r->size = (uint64_t)(scene->spd.size == SPD_DEFAULT_SIZE ? scene->family->default_size : scene->spd.size);
	r->workload = measure_workload(measure);
	r->triangles = p ? p->triangles : ROW_NONE;
	r->spheres = p ? p->spheres : ROW_NONE;
	for (int c = 0; c < RAY_CLASSES; c++)
		for (int i = 0; i < 5; i++)
			r->class_counts[c][i] = ROW_NONE;
	r->nodes = r->leaves = r->empty_leaves = r->references = r->depth = r->stopped_at = ROW_NONE;
	for (const struct column *c = row_columns; c->name; c++)
		if (c->type == COLUMN_REAL && strcmp(c->name, "alpha") != 0 && strcmp(c->name, "beta") != 0)
			*(double *)(void *)((char *)r + c->offset) = NAN;
}

/* Deviation in standard errors. A count that does not vary is right when it agrees but for rounding; a deviation then has no scale
 * and is infinite, which prints as a very large number. */
static double deviation(struct mean actual, double predicted)
{
	double far = actual.mean - predicted;
	if (actual.se > 0)
		return far / actual.se;
	return fabs(far) <= 1e-12 * fabs(predicted) ? 0 : copysign(1e9, far);
}

/* Deviations of the counts from what they are expected to be. */
static void compare_exact(struct row *r, enum mailbox_kind mailbox)
{
	const struct prediction *p = &r->predicted;
	const struct actual *a = &r->actual;
	r->z_exact = deviation(a->cost, p->predicted_exact);
	r->z_leaves = deviation(a->leaves, p->leaves);
	r->z_tests = deviation(a->tests, p->tests);
	if (!isnan(p->inner_start)) {
		r->z_inner_step = deviation(a->inner_step, p->inner_step);
		r->z_inner_start = deviation(a->inner_start, p->inner_start);
	}
	if (mailbox == MAILBOX_ONE && !isnan(p->tests_one))
		r->z_tests_made = deviation(a->tests_made, p->tests_one);
	r->z_inner = deviation(a->inner, p->inner);
	r->z_boxes = deviation(a->boxes, p->boxes);
}

static void complete_image(struct row *r, const struct accel *a)
{
	r->rays = r->missed = 0;
	for (int c = 0; c < RAY_CLASSES; c++) {
		const struct class_tally *t = &r->classes[c];
		const uint64_t counts[5] = { t->rays, t->sum.hits, t->sum.leaves, t->sum.tests, t->sum.inner_step + t->sum.inner_start };
		memcpy(r->class_counts[c], counts, sizeof counts);
		r->rays += t->rays;
		r->missed += t->missed;
	}
	const struct replay_counts *n = &r->replayed;
	struct flops f = flops_of(a, n->tests_made, n->leaves, n->inner, n->boxes);
	r->flops_replay_sum = f.scene + f.traversal;
	r->ratio_replay = r->replay.mean / r->actual.cost.mean;
	r->ratio_calibrated = r->calibrated.mean / r->actual.cost.mean;
}

static void count_flops(struct row *r, const struct accel *a)
{
	const struct prediction *p = &r->predicted;
	const struct actual *n = &r->actual;
	r->flops_exact = flops_of(a, isnan(p->tests_one) ? p->tests : p->tests_one, p->leaves, p->inner, p->boxes);
	r->flops_actual = flops_of(a, a->mailbox ? n->tests_made.mean : n->tests.mean, n->leaves.mean, n->inner.mean, n->boxes.mean);
	r->flops_exact_sum = r->flops_exact.scene + r->flops_exact.traversal;
	r->flops_actual_sum = r->flops_actual.scene + r->flops_actual.traversal;
}

void row_complete(struct row *r, const struct accel *a, const struct measure_spec *measure)
{
	const struct prediction *p = &r->predicted;
	const struct actual *actual = &r->actual;
	r->status = "ok";
	if (!measure->render)
		r->rays = actual->rays;
	r->nodes = a->nodes;
	r->leaves = a->leaves;
	r->empty_leaves = a->empty_leaves;
	r->references = a->references;
	r->depth = (uint64_t)a->depth;
	r->root_area = box_area(&a->root);
	r->object_area = a->primitives->area;
	r->actual_low = actual->cost.mean - 1.96 * actual->cost.se;
	r->actual_high = actual->cost.mean + 1.96 * actual->cost.se;
	r->ratio = p->predicted / actual->cost.mean;
	r->ratio_exact = p->predicted_exact / actual->cost.mean;
	r->ratio_volumes = p->volumes / actual->cost.mean;
	if (a->volumes && !measure->render)
		r->lcv = actual->leaves.se * sqrt((double)actual->rays - 1);
	r->overhead_predicted = (p->leaves + p->inner_step) / p->leaves;
	r->overhead_actual = (actual->leaves.mean + actual->inner_step.mean) / actual->leaves.mean;
	if (a->mailbox != MAILBOX_NONE)
		r->tests_made = actual->tests_made;
	if (a->plane_tests && (measure->render || (measure->rays != RAYS_LINES && measure->rays != RAYS_INTERIOR)))
		r->barycentric = actual->barycentric;
	count_flops(r, a);
	if (measure->render)
		complete_image(r, a);
	else if (!isnan(p->predicted_exact))
		compare_exact(r, a->mailbox);
}

static void print_field(const struct row *r, const struct column *c, char *out, size_t size)
{
	const void *at = (const char *)r + c->offset;
	const struct key *option;
	*out = '\0';
	switch (c->type) {
	case COLUMN_TEXT:
		snprintf(out, size, "%s", *(const char *const *)at ? *(const char *const *)at : "");
		break;
	case COLUMN_COUNT:
		if (*(const uint64_t *)at != ROW_NONE)
			snprintf(out, size, "%" PRIu64, *(const uint64_t *)at);
		break;
	case COLUMN_REAL:
		if (isfinite(*(const double *)at))
			snprintf(out, size, "%.9g", *(const double *)at);
		break;
	case COLUMN_KEY:
		snprintf(out, size, "%016" PRIx64, *(const uint64_t *)at);
		break;
	case COLUMN_OPTION:
		if (accel_applies(r->spec->ops, r->spec->options, c->name))
			key_print(key_find(r->spec->ops->keys, c->name), r->spec->options, out, size);
		break;
	case COLUMN_MEASURE:
		option = r->measure->render ? key_find(measure_image_keys, c->name) : NULL;
		if (option && measure_applies(r->measure, c->name))
			key_print(option, r->measure, out, size);
		break;
	}
}

void row_print(const struct row *r, struct text *line)
{
	char field[4096];
	for (const struct column *c = row_columns; c->name; c++) {
		print_field(r, c, field, sizeof field);
		csv_add(line, field, c == row_columns);
	}
	text_add(line, "\n", 1);
}

void row_print_head(struct text *line)
{
	for (const struct column *c = row_columns; c->name; c++)
		csv_add(line, c->name, c == row_columns);
	text_add(line, "\n", 1);
}
