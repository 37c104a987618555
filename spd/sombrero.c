/* A damped cosine as a height field of n x n samples, n = 32 * 2^(size-1): 2 (n-1)^2 triangles (SPD "sombrero"). */
#include "spd/common.h"

/* SPD writes this value of pi here. */
#define SHORT_PI 3.14159265358

static void sample(float *height, int n)
{
	double y = -4;
	for (int i = 0; i < n; i++, y += 8.0 / n) {
		double x = -4;
		for (int j = 0; j < n; j++, x += 8.0 / n) {
			double q = sqrt(x * x + y * y);
			height[i * n + j] = (float)(3 * cos(2 * SHORT_PI * q) * exp(-q) / 3);
		}
	}
}

static struct vec place(const float *height, int n, int i, int j)
{
	return vec(-4 + j * 8.0 / (n - 1), -3 + (double)height[i * n + j], -4 + i * 8.0 / (n - 1));
}

static void fill(struct scene *s, const struct spd_options *o)
{
	int n = 32 * (1 << (o->size - 1));
	spd_set_sky(s);
	spd_set_view(s, vec(0, 5, -8), vec(0, 0, 0), vec(0, 0, 1), 40, 0.01);
	scene_add_light(s, vec(10, 10, -10));
	spd_add_material(s, (struct spd_material){ { 1, 0.1, 0.1 }, 0.8, 0, 40, 0, 1 });
	spd_note_finish(s, 0.1, 0.5);
	struct arena scratch = { 0 };
	float *height = NEW(&scratch, float, (size_t)n * (size_t)n);
	if (!height) {
		s->lost = true;
		return;
	}
	sample(height, n);
	for (int i = 0; i + 1 < n; i++)
		for (int j = 0; j + 1 < n; j++) {
			struct vec a = place(height, n, i, j), b = place(height, n, i + 1, j), c = place(height, n, i + 1, j + 1),
			           d = place(height, n, i, j + 1);
			spd_add_triangle(s, a, c, d);
			spd_add_triangle(s, a, b, c);
		}
	spd_note_heights(s, 0, height, n);
	arena_free(&scratch);
}

static const char *const options[] = { NULL };
const struct spd_family spd_sombrero = { "sombrero", "damped cosine over a grid of 32*2^(size-1) samples a side", 1, 1, 10, fill,
	                                 options };
