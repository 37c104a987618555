#include "trace/render.h"

#include "base/par.h"
#include "trace/camera.h"
#include "trace/flight.h"
#include "trace/render_sums.h"
#include "trace/shade.h"

#include <stdlib.h>
#include <string.h>

/* Samples traced together; and blocks between two reports of progress, for each thread. */
enum { BLOCK = 1024, BAND = 16 };

const char *const render_sampling_words[] = { "centers", "corners", NULL };
const char *const render_shadows_words[] = { "all", "facing", NULL };
const char *const render_preset_words[] = { "none", "spd", NULL };
const char *const render_light_words[] = { "scene", "inside", "outside", NULL };
const char *const ray_class_words[] = { "primary", "shadow", "reflected", "refracted", NULL };

struct alone {
	struct render_options options;
};
const struct key render_keys[] = { RENDER_KEYS(struct alone, options), { 0 } };

void render_resolve(struct render_options *o)
{
	if (o->preset != PRESET_SPD)
		return;
	o->sampling = SAMPLE_CORNERS;
	o->ray_depth = 5;
	o->weight = 0;
}

/* Where a ray comes from and what it adds to its sample if nothing lies in its way (shadow), or per light that arrives along it. */
struct origin {
	struct color weight;
	uint32_t sample; /* in the block */
	uint8_t class, depth;
};

/* Rays that are shot together. */
struct wave {
	struct ray *rays;
	struct origin *origins;
	struct hit *hits;
	struct tally *tallies;
	size_t count, room;
};

struct render {
	const struct scene *scene;
	const struct accel *accel;
	const struct render_options *options;
	const struct render_run *run;
	struct camera camera;
	size_t columns, samples; /* samples: of a frame */
	size_t frame, frames, first; /* at hand; in all; block of the band at hand */
	struct render_sums *blocks; /* of the frame at hand */
	struct color *colors; /* of its samples */
	atomic_bool failed;   /* memory ran out */
};

/* A block at work. */
struct block {
	const struct render *render;
	struct render_sums *sums;
	struct color *colors;
	struct tally tally[BLOCK]; /* of every sample */
	uint32_t rays[BLOCK];
	struct wave now, next;
	bool lost;
};

static bool wave_reserve(struct wave *w)
{
	if (w->count < w->room)
		return true;
	size_t want = w->room ? 2 * w->room : 4 * BLOCK;
	void *rays = realloc(w->rays, want * sizeof *w->rays);
	w->rays = rays ? rays : w->rays;
	void *origins = realloc(w->origins, want * sizeof *w->origins);
	w->origins = origins ? origins : w->origins;
	void *hits = realloc(w->hits, want * sizeof *w->hits);
	w->hits = hits ? hits : w->hits;
	void *tallies = realloc(w->tallies, want * sizeof *w->tallies);
	w->tallies = tallies ? tallies : w->tallies;
	if (!rays || !origins || !hits || !tallies)
		return false;
	w->room = want;
	return true;
}

static void wave_free(struct wave *w)
{
	free(w->rays);
	free(w->origins);
	free(w->hits);
	free(w->tallies);
}

static void push(struct block *b, struct wave *w, struct ray r, struct origin from)
{
	if (b->lost || !wave_reserve(w)) {
		b->lost = true;
		return;
	}
	w->rays[w->count] = r;
	w->origins[w->count++] = from;
}

/* Where sample number i lies in the image. */
static void place_sample(const struct render *r, size_t i, double *x, double *y)
{
	static const double golden = 0.61803398874989485;
	double shift = r->options->sampling == SAMPLE_CORNERS ? 0 : 0.5, at = (double)i + 0.5;
	if (r->options->sampling == SAMPLE_LATTICE) {
		*x = at / (double)r->samples;
		*y = at * golden - floor(at * golden);
	} else {
		*x = ((double)(i % r->columns) + shift) / (double)r->options->width;
		*y = ((double)(i / r->columns) + shift) / (double)r->options->height;
	}
}

static void push_primaries(struct block *b, size_t first, size_t count)
{
	const struct render *r = b->render;
	for (size_t i = 0; i < count; i++) {
		double x, y;
		place_sample(r, first + i, &x, &y);
		struct ray ray = { .o = camera_origin(&r->camera, x, y), .d = camera_direction(&r->camera, x, y), .t_max = INFINITY,
			           .slack = r->accel->slack, .from = NO_PRIMITIVE };
		push(b, &b->now, ray, (struct origin){ { 1, 1, 1 }, (uint32_t)i, RAY_PRIMARY, 1 });
	}
}

static void push_shadows(struct block *b, const struct surface_point *p, const struct ray *r, uint32_t id, const struct origin *from)
{
	const struct scene *s = b->render->scene;
	for (size_t i = 0; i < s->light_count; i++) {
		struct vec toward = vec_sub(s->lights[i].at, p->at);
		double distance = vec_length(toward);
		if (distance == 0)
			continue;
		toward = vec_unit(toward);
		if (b->render->options->shadows == SHADOWS_FACING && vec_dot(toward, p->shading) <= 0)
			continue;
		struct ray shadow = { .o = p->at, .d = toward, .t_max = distance, .slack = r->slack, .from = id, .clear = true };
		struct color light = shade_light(s, i, p, r->d, toward);
		push(b, &b->next, shadow,
		     (struct origin){ color_times(light, from->weight), from->sample, RAY_SHADOW, from->depth });
	}
}

/* The mirrored and the refracted ray. What cannot leave by refraction is mirrored. */
static void push_bounces(struct block *b, const struct surface_point *p, const struct ray *r, uint32_t id, const struct origin *from)
{
	const struct render_options *o = b->render->options;
	double mirrored = p->material->ks, transmitted = p->material->transmit;
	double least = o->weight / fmax(fmax(from->weight.r, from->weight.g), fmax(from->weight.b, 1e-300));
	struct ray ray = { .o = p->at, .t_max = INFINITY, .slack = r->slack, .from = id, .clear = true };
	if (from->depth >= o->ray_depth)
		return;
	if (transmitted > 0 && !refract(p, r->d, &ray.d)) {
		mirrored += transmitted;
		transmitted = 0;
	}
	if (transmitted > 0 && transmitted >= least)
		push(b, &b->next, ray, (struct origin){ color_scale(from->weight, transmitted), from->sample, RAY_REFRACTED,
		                                        (uint8_t)(from->depth + 1) });
	ray.d = reflect(p, r->d);
	if (mirrored > 0 && mirrored >= least)
		push(b, &b->next, ray, (struct origin){ color_scale(from->weight, mirrored), from->sample, RAY_REFLECTED,
		                                        (uint8_t)(from->depth + 1) });
}

static void keep_segment(struct block *b, const struct ray *r, const struct hit *h, const struct origin *from, size_t first)
{
	struct render_sums *s = b->sums;
	if (s->segment_count == s->segment_room) {
		size_t want = s->segment_room ? 2 * s->segment_room : 2 * BLOCK;
		void *grown = realloc(s->segments, want * sizeof *s->segments);
		if (!grown) {
			b->lost = true;
			return;
		}
		s->segments = grown;
		s->segment_room = want;
	}
	struct segment *g = &s->segments[s->segment_count++];
	first += b->render->frame * b->render->samples;
	*g = (struct segment){ *r, (uint32_t)(first + from->sample), from->class, h->id != NO_PRIMITIVE };
	g->ray.t_max = h->t;
}

static void count_ray(struct block *b, const struct origin *from, const struct tally *n)
{
	struct class_tally *c = &b->sums->classes[from->class];
	c->rays++;
	if (n->leaves + n->inner_start + n->inner_step == 0) {
		c->missed++;
		return;
	}
	tally_add(&c->sum, n);
	tally_add(&b->tally[from->sample], n);
	b->rays[from->sample]++;
}

/* Shoot a wave; what its rays add to the image, and the next wave. */
static void shoot_wave(struct block *b, size_t first)
{
	const struct render *r = b->render;
	struct wave *w = &b->now;
	r->accel->ops->shoot_many(r->accel, w->rays, w->count, w->hits, w->tallies);
	b->next.count = 0;
	for (size_t i = 0; i < w->count && !b->lost; i++) {
		const struct origin *from = &w->origins[i];
		const struct hit *h = &w->hits[i];
		struct color *color = &b->colors[from->sample];
		count_ray(b, from, &w->tallies[i]);
		if (r->run->segments)
			keep_segment(b, &w->rays[i], h, from, first);
		if (from->class == RAY_SHADOW) {
			if (h->id == NO_PRIMITIVE)
				color_add(color, from->weight);
		} else if (h->id == NO_PRIMITIVE) {
			color_add(color, color_times(from->weight, r->scene->background));
		} else {
			struct surface_point p = surface_point_make(r->scene, r->accel->primitives, &w->rays[i], h);
			color_add(color, color_times(from->weight, shade_ambient(r->scene, &p)));
			push_shadows(b, &p, &w->rays[i], h->id, from);
			push_bounces(b, &p, &w->rays[i], h->id, from);
		}
	}
	struct wave done = b->now;
	b->now = b->next;
	b->next = done;
}

static void render_block(void *ctx, size_t i)
{
	struct render *r = ctx;
	i += r->first;
	if ((r->run->stop && *r->run->stop) || atomic_load(&r->failed))
		return;
	struct block *b = calloc(1, sizeof *b);
	if (!b) {
		atomic_store(&r->failed, true);
		return;
	}
	size_t first = i * BLOCK, count = first + BLOCK < r->samples ? BLOCK : r->samples - first;
	b->render = r;
	b->sums = &r->blocks[i];
	b->colors = &r->colors[first];
	push_primaries(b, first, count);
	while (b->now.count > 0 && !b->lost)
		shoot_wave(b, first);
	for (size_t k = 0; k < count; k++)
		render_sums_add(b->sums, r->accel, &b->tally[k], b->rays[k]);
	if (b->lost)
		atomic_store(&r->failed, true);
	wave_free(&b->now);
	wave_free(&b->next);
	free(b);
}

static unsigned char to_byte(double x)
{
	return (unsigned char)(255 * fmin(1, fmax(0, x)) + 0.5);
}

static void fill_pixels(struct rendering *out, const struct render *r)
{
	size_t width = (size_t)r->options->width, height = (size_t)r->options->height;
	size_t corner = r->options->sampling == SAMPLE_CORNERS;
	for (size_t y = 0; y < height; y++)
		for (size_t x = 0; x < width; x++) {
			struct color sum = { 0 };
			for (size_t k = 0; k < (corner ? 4u : 1u); k++)
				color_add(&sum, r->colors[(y + k / 2) * r->columns + x + k % 2]);
			sum = color_scale(sum, corner ? 0.25 : 1);
			unsigned char *p = &out->pixels[3 * (y * width + x)];
			p[0] = to_byte(sum.r);
			p[1] = to_byte(sum.g);
			p[2] = to_byte(sum.b);
		}
}

static int gather_segments(struct rendering *out, const struct render_sums *sums, size_t blocks, struct err *e)
{
	size_t count = 0;
	for (size_t i = 0; i < blocks; i++)
		count += sums[i].segment_count;
	out->segments = NEW(&out->mem, struct segment, count);
	if (!out->segments)
		return err_memory(e, "pilot image");
	for (size_t i = 0; i < blocks; i++) {
		const struct render_sums *b = &sums[i];
		if (b->segment_count)
			memcpy(&out->segments[out->segment_count], b->segments, b->segment_count * sizeof *b->segments);
		out->segment_count += b->segment_count;
	}
	return 0;
}

/* A frame, band after band, with a word about it between them. */
static int render_blocks(struct render *r, size_t blocks, struct err *e)
{
	const struct render_run *run = r->run;
	size_t band = (size_t)(run->threads > 1 ? run->threads : 1) * BAND;
	for (r->first = 0; r->first < blocks; r->first += band) {
		if (run->progress)
			run->progress(run->ctx, r->frame * blocks + r->first, r->frames * blocks);
		par_for(run->threads, blocks - r->first < band ? blocks - r->first : band, render_block, r);
		if (atomic_load(&r->failed))
			return err_memory(e, "rendering");
		if (run->stop && *run->stop)
			return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "interrupted");
	}
	return 0;
}

/* Frame after frame; sums[frames][blocks]. */
static int render_flight(struct rendering *out, struct render *r, const struct flight *flight, struct render_sums *sums, size_t blocks,
                         struct err *e)
{
	struct view view = r->scene->view;
	for (r->frame = 0; r->frame < r->frames; r->frame++) {
		if (flight->count > 0)
			flight_place(flight, r->frames > 1 ? (double)r->frame / (double)(r->frames - 1) : 0, &view);
		r->camera = camera_make(&view, &r->accel->primitives->bounds, (double)r->options->width, (double)r->options->height);
		r->blocks = &sums[r->frame * blocks];
		memset(r->colors, 0, r->samples * sizeof *r->colors);
		if (render_blocks(r, blocks, e) != 0)
			return -1;
		if (r->frame == 0)
			fill_pixels(out, r);
	}
	return 0;
}

int render_scene(struct rendering *out, const struct scene *s, const struct accel *a, const struct render_options *o,
                 const struct render_run *run, struct err *e)
{
	size_t extra = o->sampling == SAMPLE_CORNERS, columns = (size_t)o->width + extra, rows = (size_t)o->height + extra;
	size_t blocks = (columns * rows + BLOCK - 1) / BLOCK, frames = render_frames(o);
	struct scene lit = *s;
	struct render r = { .scene = &lit, .accel = a, .options = o, .run = run, .columns = columns, .samples = columns * rows, .frames = frames };
	struct flight flight;
	*out = (struct rendering){ 0 };
	if (flight_parse(&flight, o->flight, e) != 0)
		return -1;
	lit.lights = lights_place(&out->mem, s, &a->primitives->bounds, (enum light_place)o->light);
	struct render_sums *sums = NEW(&out->mem, struct render_sums, frames * blocks);
	r.colors = NEW(&out->mem, struct color, r.samples);
	out->pixels = NEW(&out->mem, unsigned char, 3 * (size_t)o->width * (size_t)o->height);
	int status = sums && r.colors && out->pixels && (lit.lights || s->light_count == 0) ? 0 : err_memory(e, "rendering");
	if (status == 0)
		status = render_flight(out, &r, &flight, sums, blocks, e);
	if (status == 0) {
		render_sum_up(out, a, run, r.samples * r.frames, sums, frames * blocks);
		status = run->segments ? gather_segments(out, sums, frames * blocks, e) : 0;
	}
	for (size_t i = 0; sums && i < frames * blocks; i++)
		free(sums[i].segments);
	return status;
}

void rendering_free(struct rendering *r)
{
	arena_free(&r->mem);
	*r = (struct rendering){ 0 };
}
