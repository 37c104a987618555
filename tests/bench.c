/* make bench: building and shooting, timed side by side in one process, one thread each, rounds interleaved; medians and ratios.
 * Embree (libembree-dev) is the peer where it was found at build time. */
#include "accel/kd_split.h"
#include "accel/octree.h"
#include "scene/tessellate.h"
#include "spd/spd.h"
#include "trace/rays.h"
#include "trace/sort.h"
#include "tests/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef HAVE_EMBREE
#include <embree3/rtcore.h>
#endif

enum { RAYS = 1000000, ROUNDS = 9 };

/* A contestant: shoots all rays once and returns how many hit. */
struct peer {
	const char *name;
	uint64_t (*shoot)(const void *what, const struct ray *rays);
	const void *what;
	double seconds[ROUNDS];
	uint64_t hits;
};

static uint64_t shoot_fast(const void *what, const struct ray *rays)
{
	const struct accel *a = what;
	uint64_t hits = 0;
	struct hit h;
	for (int i = 0; i < RAYS; i++)
		hits += a->ops->shoot(a, &rays[i], &h);
	return hits;
}

static uint64_t shoot_counted(const void *what, const struct ray *rays)
{
	const struct accel *a = what;
	struct tally n = { 0 };
	struct hit h;
	for (int i = 0; i < RAYS; i++)
		a->ops->shoot_counted(a, &rays[i], &h, &n);
	return n.hits;
}

/* As a job does it: sorted, shot and summed up a block at a time. */
static uint64_t shoot_sorted(const void *what, const struct ray *rays)
{
	static struct ray sorted[RAYS_BLOCK];
	static struct sorter sorter;
	static struct hit h[RAYS_BLOCK];
	static struct tally n[RAYS_BLOCK];
	const struct accel *a = what;
	uint64_t hits = 0;
	for (int i = 0; i < RAYS; i += RAYS_BLOCK) {
		size_t count = RAYS - i < RAYS_BLOCK ? (size_t)(RAYS - i) : RAYS_BLOCK;
		rays_sort(sorted, &sorter, &rays[i], count, &a->root);
		a->ops->shoot_many(a, sorted, count, h, n);
		for (size_t k = 0; k < count; k++)
			hits += n[k].hits;
	}
	return hits;
}

static uint64_t shoot_many(const void *what, const struct ray *rays)
{
	enum { PIECE = 4096 };
	const struct accel *a = what;
	static struct hit h[PIECE];
	static struct tally n[PIECE];
	uint64_t hits = 0;
	for (int i = 0; i < RAYS; i += PIECE) {
		int count = RAYS - i < PIECE ? RAYS - i : PIECE;
		a->ops->shoot_many(a, &rays[i], (size_t)count, h, n);
		for (int k = 0; k < count; k++)
			hits += n[k].hits;
	}
	return hits;
}

#ifdef HAVE_EMBREE
static uint64_t shoot_embree(const void *what, const struct ray *rays)
{
	RTCScene scene = *(const RTCScene *)what;
	uint64_t hits = 0;
	struct RTCIntersectContext context;
	rtcInitIntersectContext(&context);
	for (int i = 0; i < RAYS; i++) {
		const struct ray *r = &rays[i];
		struct RTCRayHit h = { .ray = { .org_x = (float)r->o.x, .org_y = (float)r->o.y, .org_z = (float)r->o.z,
			                        .dir_x = (float)r->d.x, .dir_y = (float)r->d.y, .dir_z = (float)r->d.z,
			                        .tnear = 1e-4f, .tfar = INFINITY, .mask = UINT32_MAX } };
		h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
		rtcIntersect1(scene, &context, &h);
		hits += h.hit.geomID != RTC_INVALID_GEOMETRY_ID;
	}
	return hits;
}

static RTCScene build_embree(RTCDevice device, const struct primitives *p, double *took)
{
	RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
	float *v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * (size_t)p->count);
	unsigned *t = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, p->count);
	for (uint32_t i = 0; i < 9 * p->count; i++)
		v[i] = (float)p->all[i / 9].triangle.v[i / 3 % 3].a[i % 3];
	for (uint32_t i = 0; i < 3 * p->count; i++)
		t[i] = i;
	double start = seconds();
	rtcSetGeometryBuildQuality(g, RTC_BUILD_QUALITY_HIGH);
	rtcCommitGeometry(g);
	RTCScene scene = rtcNewScene(device);
	rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
	rtcAttachGeometry(scene, g);
	rtcReleaseGeometry(g);
	rtcCommitScene(scene);
	*took = seconds() - start;
	return scene;
}
#endif

/* How fast a structure of the usual options is built. */
static void bench_build(const char *name, const struct primitives *p)
{
	double took[ROUNDS];
	const struct accel_ops *ops = accel_find(name);
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	struct accel a = { 0 };
	key_defaults(ops->keys, options);
	for (int i = 0; i < ROUNDS; i++) {
		struct err e = { 0 };
		accel_free(&a);
		double start = seconds();
		if (accel_build(&a, ops, options, p, &e) != 0) {
			fprintf(stderr, "%s\n", e.text);
			exit(1);
		}
		took[i] = seconds() - start;
	}
	double middle = median(took, ROUNDS);
	printf("  %s: built in %.3f s, %.2f M triangles/s, %.0f bytes a leaf\n", name, middle, p->count / middle / 1e6,
	       (double)a.mem.held / (double)a.leaves);
	accel_free(&a);
}

/* kd trees by cost, one after the other in every round, and how much longer than by the SAH they take. */
static void bench_metrics(const struct primitives *p)
{
	enum { FEW = 5 };
	double took[SPLIT_EXACT + 1][FEW], ratio[FEW];
	for (int i = 0; i < FEW; i++)
		for (int split = SPLIT_SAH; split <= SPLIT_EXACT; split++) {
			struct err e = { 0 };
			struct accel a;
			struct kd_options o;
			key_defaults(accel_find("kd")->keys, &o);
			o.split = split;
			double start = seconds();
			if (accel_build(&a, accel_find("kd"), &o, p, &e) != 0) {
				fprintf(stderr, "%s\n", e.text);
				exit(1);
			}
			took[split][i] = seconds() - start;
			accel_free(&a);
		}
	for (int split = SPLIT_SAH; split <= SPLIT_EXACT; split++) {
		for (int i = 0; i < FEW; i++)
			ratio[i] = took[split][i] / took[SPLIT_SAH][i];
		printf("  kd split=%s: built in %.3f s, %.2f of sah\n", kd_split_words[split], median(took[split], FEW), median(ratio, FEW));
	}
}

static double build_octree(struct accel *a, const struct primitives *p, int max_objects)
{
	double took[ROUNDS];
	const struct octree_options o = { .max_objects = max_objects, .max_depth = 8, .root = ROOT_BOX };
	for (int i = 0; i < ROUNDS; i++) {
		struct err e = { 0 };
		if (i)
			accel_free(a);
		double start = seconds();
		if (accel_build(a, accel_find("octree"), &o, p, &e) != 0) {
			fprintf(stderr, "%s\n", e.text);
			exit(1);
		}
		took[i] = seconds() - start;
	}
	return median(took, ROUNDS);
}

static void run_rounds(struct peer *peers, int count, const struct ray *rays)
{
	for (int round = 0; round < ROUNDS; round++)
		for (int i = 0; i < count; i++) {
			double start = seconds();
			peers[i].hits = peers[i].shoot(peers[i].what, rays);
			peers[i].seconds[round] = seconds() - start;
		}
}

static void print_peers(struct peer *peers, int count)
{
	double last = 0;
	for (int i = count - 1; i >= 0; i--) {
		double ratio[ROUNDS];
		for (int k = 0; k < ROUNDS; k++)
			ratio[k] = peers[count - 1].seconds[k] / peers[i].seconds[k];
		double r = median(ratio, ROUNDS);
		last = median(peers[i].seconds, ROUNDS);
		printf("  %-30s %7.3f Mray/s  %5.2f of %s  hits %.4f\n", peers[i].name, RAYS / last / 1e6, r,
		       peers[count - 1].name, (double)peers[i].hits / RAYS);
	}
}

static const int capacities[] = { 2, 5, 10 }; /* of the sweep's octrees */

static int bench_scene(const char *family, int size)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	struct primitives p = { 0 };
	struct spd_options o;
	key_defaults(spd_keys, &o);
	o.size = size;
	o.tessellate = true;
	if (spd_generate(&s, spd_find(family), &o, &e) != 0 ||
	    primitives_make(&p, &s, CURVES_TESSELLATE, SPD_RESOLUTION, family, &e) != 0) {
		fprintf(stderr, "%s\n", e.text);
		return 1;
	}
	scene_free(&s);
	printf("%s -s %d: %u triangles\n", family, size, p.count);
	struct accel trees[3];
	for (int i = 0; i < 3; i++) {
		double took = build_octree(&trees[i], &p, capacities[i]);
		printf("  octree max_objects=%d max_depth=8: built in %.3f s, %.2f M triangles/s, %.0f bytes a leaf\n", capacities[i], took,
		       p.count / took / 1e6, (double)trees[i].mem.held / (double)trees[i].leaves);
	}
	bench_build("kd", &p);
	bench_metrics(&p);
	bench_build("bsp", &p);
	bench_build("grid", &p);
	struct ray_source source;
	struct ray *rays = malloc(RAYS * sizeof *rays);
	if (!rays || ray_source_open(&source, &trees[2], WORKLOAD_INVARIANT, 2002, &e) != 0)
		return 1;
	double start = seconds();
	for (uint64_t i = 0; i < RAYS; i++)
		rays[i] = ray_source_draw(&source, i);
	printf("  rays drawn: %.1f M/s\n", RAYS / (seconds() - start) / 1e6);
	struct peer peers[] = {
		{ .name = "max_objects=2, sorted, counted", .shoot = shoot_sorted, .what = &trees[0] },
		{ .name = "max_objects=5, sorted, counted", .shoot = shoot_sorted, .what = &trees[1] },
		{ .name = "max_objects=10, sorted, counted", .shoot = shoot_sorted, .what = &trees[2] },
		{ .name = "many, counted", .shoot = shoot_many, .what = &trees[2] },
		{ .name = "one by one, counted", .shoot = shoot_counted, .what = &trees[2] },
		{ .name = "one by one", .shoot = shoot_fast, .what = &trees[2] },
#ifdef HAVE_EMBREE
		{ .name = "Embree high", .shoot = shoot_embree },
#endif
	};
	int count = (int)(sizeof peers / sizeof *peers);
#ifdef HAVE_EMBREE
	RTCDevice device = rtcNewDevice("threads=1,set_affinity=1");
	double embree_took;
	RTCScene scene = build_embree(device, &p, &embree_took);
	printf("  Embree high: built in %.3f s\n", embree_took);
	peers[count - 1].what = &scene;
#endif
	run_rounds(peers, count, rays);
	double counting[ROUNDS];
	for (int k = 0; k < ROUNDS; k++)
		counting[k] = peers[4].seconds[k] / peers[5].seconds[k];
	print_peers(peers, count);
	printf("  counting costs %.1f %%\n", 100 * (median(counting, ROUNDS) - 1));
	fflush(stdout);
#ifdef HAVE_EMBREE
	rtcReleaseScene(scene);
	rtcReleaseDevice(device);
#endif
	ray_source_close(&source);
	free(rays);
	for (int i = 0; i < 3; i++)
		accel_free(&trees[i]);
	primitives_free(&p);
	return 0;
}

int main(void)
{
	static const struct { const char *family; int size; } scenes[] = {
		{ "teapot", 12 }, { "teapot", 39 }, { "gears", 4 }, { "tetra", 8 }, { "balls", 3 },
	};
	int status = 0;
	for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
		status |= bench_scene(scenes[i].family, scenes[i].size);
#ifndef HAVE_EMBREE
	printf("Embree: not found; apt-get install libembree-dev to compare\n");
#endif
	return status;
}
