/* make bench: bounding volume hierarchies beside Embree (libembree-dev), in one process, one thread each, rounds interleaved; every
 * figure is the median over the rounds of what happened in the same round.
 * usage: bench_bvh [ROUNDS [RAYS [SCENE...]]] */
#include "accel/bvh.h"
#include "accel/octree.h"
#include "base/rng.h"
#include "scene/tessellate.h"
#include "spd/spd.h"
#include "trace/camera.h"
#include "trace/rays.h"
#include "tests/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef HAVE_EMBREE
#include <embree3/rtcore.h>
#endif

enum { PEERS_MOST = 8, CAMERA = 1024 };

#define OFF 1e-4

struct setting {
	int rounds;
	size_t rays;
};

/* Rays of one kind. */
struct set {
	const char *name;
	struct ray *rays;
	size_t count;
	bool any;
	float near; /* where Embree starts to look for hits */
};

/* A contestant: shoots a set once and returns how many hit. */
struct peer {
	const char *name;
	uint64_t (*shoot)(const void *what, const struct set *s);
	const void *what;
	double took[ROUNDS_MOST];
	uint64_t hits;
};

static uint64_t shoot_single(const void *what, const struct set *s)
{
	const struct accel *a = what;
	uint64_t hits = 0;
	struct hit h;
	for (size_t i = 0; i < s->count; i++)
		hits += a->ops->shoot(a, &s->rays[i], &h);
	return hits;
}

static struct hit *many_hits;
static struct tally *many_tallies;

static uint64_t shoot_batch(const void *what, const struct set *s)
{
	const struct accel *a = what;
	uint64_t hits = 0;
	accel_hit_many(a, s->rays, s->count, many_hits);
	for (size_t i = 0; i < s->count; i++)
		hits += many_hits[i].id != NO_PRIMITIVE;
	return hits;
}

static uint64_t shoot_counted_batch(const void *what, const struct set *s)
{
	const struct accel *a = what;
	uint64_t hits = 0;
	a->ops->shoot_many(a, s->rays, s->count, many_hits, many_tallies);
	for (size_t i = 0; i < s->count; i++)
		hits += many_tallies[i].hits;
	return hits;
}

#ifdef HAVE_EMBREE
static struct RTCRay embree_ray(const struct ray *r, float near)
{
	return (struct RTCRay){ .org_x = (float)r->o.x, .org_y = (float)r->o.y, .org_z = (float)r->o.z, .dir_x = (float)r->d.x,
		         .dir_y = (float)r->d.y, .dir_z = (float)r->d.z, .tnear = near, .tfar = (float)r->t_max, .mask = UINT32_MAX };
}

static uint64_t shoot_embree(const void *what, const struct set *s)
{
	RTCScene scene = *(const RTCScene *)what;
	uint64_t hits = 0;
	struct RTCIntersectContext context;
	rtcInitIntersectContext(&context);
	for (size_t i = 0; i < s->count; i++) {
		if (s->any) {
			struct RTCRay r = embree_ray(&s->rays[i], s->near);
			rtcOccluded1(scene, &context, &r);
			hits += r.tfar < 0;
		} else {
			struct RTCRayHit h = { .ray = embree_ray(&s->rays[i], s->near) };
			h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
			rtcIntersect1(scene, &context, &h);
			hits += h.hit.geomID != RTC_INVALID_GEOMETRY_ID;
		}
	}
	return hits;
}

static RTCScene build_embree(RTCDevice device, const struct primitives *p, enum RTCBuildQuality quality, double *took)
{
	RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
	float *v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * (size_t)p->count);
	unsigned *t = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, p->count);
	for (size_t i = 0; i < 9 * (size_t)p->count; i++)
		v[i] = (float)p->all[i / 9].triangle.v[i / 3 % 3].a[i % 3];
	for (uint32_t i = 0; i < 3 * p->count; i++)
		t[i] = i;
	double start = seconds();
	rtcSetGeometryBuildQuality(g, quality);
	rtcCommitGeometry(g);
	RTCScene scene = rtcNewScene(device);
	rtcSetSceneBuildQuality(scene, quality);
	rtcAttachGeometry(scene, g);
	rtcReleaseGeometry(g);
	rtcCommitScene(scene);
	*took = seconds() - start;
	return scene;
}
#endif

/* Options "KEY=WORD KEY=WORD" of a structure, the rest by default. */
static double build(struct accel *a, const char *name, void (*choose)(void *), const struct primitives *p)
{
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
	struct err e = { 0 };
	const struct accel_ops *ops = accel_find(name);
	key_defaults(ops->keys, options);
	if (choose)
		choose(options);
	double start = seconds();
	if (accel_build(a, ops, options, p, &e) != 0) {
		fprintf(stderr, "%s\n", e.text);
		exit(1);
	}
	return seconds() - start;
}

static void choose_octree(void *o)
{
	((struct octree_options *)o)->max_objects = 10;
}

static void run_set(struct peer *peers, int count, const struct set *s, const struct setting *o)
{
	for (int round = 0; round < o->rounds; round++)
		for (int i = 0; i < count; i++) {
			double start = seconds();
			peers[i].hits = peers[i].shoot(peers[i].what, s);
			peers[i].took[round] = seconds() - start;
		}
	printf("  %-30s", s->name);
	for (int i = 0; i < count; i++) {
		double ratio[ROUNDS_MOST];
		for (int k = 0; k < o->rounds; k++)
			ratio[k] = peers[count - 1].took[k] / peers[i].took[k];
		printf("  %s %.2f (%.2f)", peers[i].name, (double)s->count / median(peers[i].took, o->rounds) / 1e6, median(ratio, o->rounds));
	}
	printf("  hits %.4f..%.4f\n", (double)peers[0].hits / (double)s->count, (double)peers[count - 1].hits / (double)s->count);
	fflush(stdout);
}

/* Invariant rays. Embree knows nothing of the primitive a ray starts on: it looks for hits from OFF on. So that all do the same, rays
 * start there; 'at_surface' leaves them where they are, with what that means here: surfaces that coincide with the start are met. */
static struct set make_invariant(const struct accel *a, size_t count, bool at_surface)
{
	struct err e = { 0 };
	struct ray_source source;
	struct set s = { at_surface ? "invariant, closest, at surface" : "invariant, closest", malloc(count * sizeof *s.rays), count, false,
		         at_surface ? (float)OFF : 0 };
	if (!s.rays || ray_source_open(&source, a, WORKLOAD_INVARIANT, 2002, &e) != 0)
		exit(1);
	for (size_t i = 0; i < count; i++) {
		s.rays[i] = ray_source_draw(&source, i);
		s.rays[i].o = vec_add(s.rays[i].o, vec_scale(s.rays[i].d, at_surface ? 0 : OFF));
	}
	ray_source_close(&source);
	return s;
}

static struct set make_camera(const struct accel *a, const struct view *v, size_t count)
{
	size_t side = CAMERA;
	while (side > 1 && side * side > count + count / 8)
		side--;
	struct set s = { "camera, closest", malloc(side * side * sizeof *s.rays), side * side, false, 0 };
	struct camera c = camera_make(v, &a->primitives->bounds, (double)side, (double)side);
	if (!s.rays)
		exit(1);
	for (size_t i = 0; i < s.count; i++)
		s.rays[i] = (struct ray){ .o = c.from, .t_max = INFINITY, .slack = a->slack, .from = NO_PRIMITIVE,
			                  .d = camera_direction(&c, ((double)(i % side) + 0.5) / (double)side, ((double)(i / side) + 0.5) / (double)side) };
	return s;
}

/* Smits 1999: between random points of a box 20 % larger. */
static struct set make_segments(const struct accel *a, size_t count)
{
	struct set s = { "segments, any", malloc(count * sizeof *s.rays), count, true, 0 };
	const struct box *b = &a->primitives->bounds;
	if (!s.rays)
		exit(1);
	for (size_t i = 0; i < count; i++) {
		struct vec p[2];
		uint64_t key = rng_key(2002, 99, i);
		for (int k = 0; k < 6; k++)
			p[k / 3].a[k % 3] = b->lo.a[k % 3] + (b->hi.a[k % 3] - b->lo.a[k % 3]) * (1.2 * rng_uniform(key, (uint64_t)k) - 0.1);
		struct vec d = vec_sub(p[1], p[0]);
		s.rays[i] = (struct ray){ .o = p[0], .d = vec_unit(d), .t_max = vec_length(d), .slack = a->slack, .from = NO_PRIMITIVE, .any = true };
	}
	return s;
}

/* The same rays, asking for any hit. */
static struct set make_any(const struct set *from, const char *name)
{
	struct set s = { name, malloc(from->count * sizeof *s.rays), from->count, true, from->near };
	if (!s.rays)
		exit(1);
	for (size_t i = 0; i < s.count; i++) {
		s.rays[i] = from->rays[i];
		s.rays[i].any = true;
	}
	return s;
}

static void print_builds(const struct primitives *p, const struct setting *o, void *device)
{
	double ours[ROUNDS_MOST], peer[ROUNDS_MOST], ratio[ROUNDS_MOST];
	int rounds = o->rounds < 9 ? o->rounds : 9;
	for (int i = 0; i < rounds; i++) {
		struct accel a;
		ours[i] = build(&a, "bvh8", NULL, p);
		accel_free(&a);
#ifdef HAVE_EMBREE
		rtcReleaseScene(build_embree(device, p, RTC_BUILD_QUALITY_MEDIUM, &peer[i]));
#else
		(void)device;
		peer[i] = NAN;
#endif
		ratio[i] = peer[i] / ours[i];
	}
	printf("  build: bvh8 %.1f ms, %.2f M triangles/s (%.2f); Embree medium %.1f ms\n", 1e3 * median(ours, rounds),
	       p->count / median(ours, rounds) / 1e6, median(ratio, rounds), 1e3 * median(peer, rounds));
}

static void bench_scene(const char *name, const struct spd_options *options, const char *family, const struct setting *o)
{
	struct err e = { 0 };
	struct scene scene = { 0 };
	struct primitives p = { 0 };
	struct accel bvh8, bvh, octree;
	if (spd_generate(&scene, spd_find(family), options, &e) != 0 ||
	    primitives_make(&p, &scene, CURVES_TESSELLATE, SPD_RESOLUTION, family, &e) != 0) {
		fprintf(stderr, "%s\n", e.text);
		exit(1);
	}
	printf("%s: %u triangles; Mray/s (ratio to Embree)\n", name, p.count);
	double took[2] = { build(&bvh, "bvh", NULL, &p), build(&octree, "octree", choose_octree, &p) };
	build(&bvh8, "bvh8", NULL, &p);
	printf("  build: bvh %.1f ms, octree %.1f ms\n", 1e3 * took[0], 1e3 * took[1]);
	struct peer peers[PEERS_MOST] = {
		{ .name = "octree", .shoot = shoot_single, .what = &octree },
		{ .name = "bvh", .shoot = shoot_single, .what = &bvh },
		{ .name = "bvh8", .shoot = shoot_single, .what = &bvh8 },
		{ .name = "bvh8 batch", .shoot = shoot_batch, .what = &bvh8 },
		{ .name = "counted batch", .shoot = shoot_counted_batch, .what = &bvh8 },
	};
	int count = 5;
	void *device = NULL;
#ifdef HAVE_EMBREE
	double embree_took;
	device = rtcNewDevice("threads=1");
	RTCScene embree = build_embree(device, &p, RTC_BUILD_QUALITY_HIGH, &embree_took);
	printf("  build: Embree high %.1f ms\n", 1e3 * embree_took);
	peers[count++] = (struct peer){ .name = "Embree", .shoot = shoot_embree, .what = &embree };
#endif
	print_builds(&p, o, device);
	struct set sets[] = { make_invariant(&bvh8, o->rays, false), { 0 }, make_camera(&bvh8, &scene.view, o->rays), { 0 },
		              make_segments(&bvh8, o->rays), make_invariant(&bvh8, o->rays, true) };
	sets[1] = make_any(&sets[0], "invariant, any");
	sets[3] = make_any(&sets[2], "camera, any");
	for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
		run_set(peers, count, &sets[i], o);
		free(sets[i].rays);
	}
#ifdef HAVE_EMBREE
	rtcReleaseScene(embree);
	rtcReleaseDevice(device);
#endif
	accel_free(&bvh8);
	accel_free(&bvh);
	accel_free(&octree);
	scene_free(&scene);
	primitives_free(&p);
}

int main(int argc, char **argv)
{
	static const struct { const char *name, *family; int size, count; double cube; } scenes[] = {
		{ "teapot39", "teapot", 39, 0, 0 }, { "balls3", "balls", 3, 0, 0 }, { "gears4", "gears", 4, 0, 0 }, { "tetra8", "tetra", 8, 0, 0 },
		{ "soup100k", "soup", 0, 100000, 20 }, { "teapot123", "teapot", 123, 0, 0 },
	};
	struct setting o = { argc > 1 ? atoi(argv[1]) : 9, argc > 2 ? (size_t)atol(argv[2]) : 1000000 };
	size_t most = o.rays > CAMERA * CAMERA ? o.rays : CAMERA * CAMERA;
	many_hits = malloc(most * sizeof *many_hits);
	many_tallies = malloc(most * sizeof *many_tallies);
	if (!many_hits || !many_tallies || o.rounds < 1 || o.rounds > ROUNDS_MOST || o.rays < 1)
		return 1;
	for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
		struct spd_options options;
		bool chosen = argc <= 3;
		for (int k = 3; k < argc; k++)
			chosen |= strcmp(argv[k], scenes[i].name) == 0;
		if (!chosen)
			continue;
		key_defaults(spd_keys, &options);
		options.size = scenes[i].size ? scenes[i].size : options.size;
		options.tessellate = true;
		if (scenes[i].count) {
			options.count = scenes[i].count;
			options.cube = scenes[i].cube;
		}
		bench_scene(scenes[i].name, &options, scenes[i].family, &o);
	}
#ifndef HAVE_EMBREE
	printf("Embree: not found; apt-get install libembree-dev to compare\n");
#endif
	free(many_hits);
	free(many_tallies);
	return 0;
}
