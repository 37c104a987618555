/* POV-Ray's height fields, from images and from functions. */
#include "tests/pov_solids.h"

#include "io/pov_image.h"

static struct pov_solid *new_hills(struct bench *b, const double *h, int width, int height, double level)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_HEIGHT_FIELD);
	s->shape.height_field = (struct pov_height_field){ h, width, height, false, level };
	return seal(b, s);
}

static double height_at(struct bench *b, struct pov_solid *s, double x, double z)
{
	struct vec at, normal;
	assert_true(pov_solid_trace(&b->mem, s, vec(x, 5, z), vec(0, -2, 0), &at, &normal));
	assert_true(normal.y > 0);
	return at.y;
}

/* Cells are split from (x0, z1) to (x1, z0); no walls and no floor; the solid is all below. */
static void height_field(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	static const double corner[] = { 0, 0, 0, 1 }, ramp[] = { 0, 1, 0, 1 };
	struct pov_solid *s = new_hills(&b, corner, 2, 2, 0);
	mesh(&b, s);
	assert_int_equal(b.scene.object_count, 2);
	assert_near(height_at(&b, s, 0.501, 0.5), 0.001, 1e-9);
	assert_near(height_at(&b, s, 0.75, 0.75), 0.5, 1e-9);
	assert_near(height_at(&b, s, 0.25, 0.25), 0, 1e-9);
	assert_true(pov_solid_inside(s, vec(0.75, 0.4, 0.75)));
	assert_true(pov_solid_inside(s, vec(0.75, -9, 0.75)));
	assert_false(pov_solid_inside(s, vec(0.75, 0.6, 0.75)));
	assert_false(pov_solid_inside(s, vec(1.1, -9, 0.75)));
	mesh(&b, new_hills(&b, ramp, 2, 2, 0.5));
	assert_near(area(&b), sqrt(2) / 2, 1e-9);
	assert_near(bounds(&b).lo.y, 0.5, 0);
	bench_close(&b);
}

static double slope_function(void *context, const double *x)
{
	(void)context;
	return 0.1 * x[0] + 0.5 * x[1];
}

/* Functions count rows from the top, z = 1. */
static void height_function(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	double *h = pov_heights_sample(&b.mem, (struct pov_function){ slope_function, NULL }, 3, 5);
	struct pov_solid *s = new_hills(&b, h, 3, 5, 0);
	assert_near(height_at(&b, s, 0.25, 0.75), 0.1 * 0.25 + 0.5 * 0.25, 1e-9);
	bench_close(&b);
}

/* Images: the bottom row is z = 0, the left column x = 0. */
static void images(void **state)
{
	(void)state;
	static const struct { const char *bytes; size_t n; const char *type; double at[4]; } cases[] = {
		{ "P2 2 2 255\n1 2\n3 4\n", 19, NULL, { 3 / 255.0, 4 / 255.0, 1 / 255.0, 2 / 255.0 } },
		{ "P5 2 2 255\n\x01\x02\x03\x04", 15, NULL, { 3 / 255.0, 4 / 255.0, 1 / 255.0, 2 / 255.0 } },
		{ "P5 2 2 65535\n\x01\x02\x03\x04\x05\x06\x07\x08", 21, NULL, { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "P6 2 2 255\n\x01\x02\x09\x03\x04\x09\x05\x06\x09\x07\x08\x09", 23, NULL,
		  { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x02\0\x18\0\x09\x06\x05\x09\x08\x07\x09\x02\x01\x09\x04\x03", 30, "tga",
		  { 0x506 / 65535.0, 0x708 / 65535.0, 0x102 / 65535.0, 0x304 / 65535.0 } },
		{ "GIF87a\x02\0\x02\0\x81\0\0\0\0\0\x01\x01\x01\x02\x02\x02\x03\x03\x03,\0\0\0\0\x02\0\x02\0\0\x02\x03\x44\x34\x05\0;", 42, NULL,
		  { 2 / 255.0, 3 / 255.0, 0, 1 / 255.0 } },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct arena mem = { 0 };
		int width, height;
		const char *why;
		double *h = pov_image_heights(&mem, cases[i].bytes, cases[i].n, cases[i].type, &width, &height, &why);
		if (!h)
			fail_msg("image %zu: %s", i, why);
		assert_int_equal(width, 2);
		assert_int_equal(height, 2);
		for (int k = 0; k < 4; k++)
			assert_near(h[k], cases[i].at[k], 1e-12);
		arena_free(&mem);
	}
}

/* Damaged images are refused, whatever they hold. */
static void bad_images(void **state)
{
	(void)state;
	static const char *const marks[] = { "\x89PNG\r\n\x1a\n", "\xff\xd8\xff\xe0", "GIF89a", "BM", "P2 ", "P5 9 9 255 ", "P6 3 3 65535 ", "" };
	for (size_t i = 0; i < sizeof marks / sizeof *marks; i++)
		for (uint64_t k = 0; k < 200; k++) {
			unsigned char bytes[200];
			struct arena mem = { 0 };
			int width, height;
			const char *why;
			size_t n = strlen(marks[i]);
			for (size_t j = 0; j < sizeof bytes; j++)
				bytes[j] = (unsigned char)(rng_uniform(rng_key(k, i, j), 0) * (k % 2 ? 256 : 4));
			memcpy(bytes, marks[i], n);
			double *h = pov_image_heights(&mem, bytes, n + k, i % 2 ? "tga" : "pot", &width, &height, &why);
			assert_true(h ? width >= 2 && height >= 2 : why[0] != '\0');
			arena_free(&mem);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(height_field), cmocka_unit_test(height_function), cmocka_unit_test(images),
		cmocka_unit_test(bad_images),
	};
	return cmocka_run_group_tests_name("pov_heights", tests, NULL, NULL);
}
