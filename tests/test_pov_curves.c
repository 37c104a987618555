/* Shapes of POV-Ray that follow formulas of the language: splines, sweeps, patches, polygons, polynomials, letters. */
#include "tests/pov_solids.h"

/* Middles of segments by the formulas of the language. */
static void splines(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 1, 0, 0 } } }, { { { 2, 1, 0 } } }, { { { 1, 2, 0 } } }, { { { 3, 3, 0 } } } };
	static const struct { enum pov_spline kind; double weight[4]; } cases[] = {
		{ POV_LINEAR, { 0, 1, 0, 0 } },
		{ POV_QUADRATIC, { -0.125, 0.75, 0.375, 0 } },
		{ POV_CUBIC, { -0.0625, 0.5625, 0.5625, -0.0625 } },
		{ POV_BEZIER, { 0.125, 0.375, 0.375, 0.125 } },
	};
	for (size_t i = 0; i < 4; i++) {
		struct bench b = bench_open(32);
		struct vec at = vec(0, 0, 0);
		for (int k = 0; k < 4; k++)
			at = vec_add(at, vec_scale(p[k], cases[i].weight[k]));
		mesh(&b, new_profile(&b, POV_LATHE, (struct pov_profile){ cases[i].kind, false, 0, 0, p, 4 }));
		assert_true(has_corner(&b, at));
		/* Controls are not reached. */
		assert_int_equal(has_corner(&b, p[0]), cases[i].kind == POV_LINEAR || cases[i].kind == POV_BEZIER);
		assert_int_equal(has_corner(&b, p[3]), cases[i].kind != POV_CUBIC);
		bench_close(&b);
	}
}

/* The squared radius is Hermite's cubic in the height. */
static void sor_formula(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0.5, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 2, 2, 0 } } }, { { { 1, 4, 0 } } } };
	struct bench b = bench_open(32);
	struct pov_solid *s = new_profile(&b, POV_SOR, (struct pov_profile){ POV_LINEAR, false, 0, 0, p, 4 });
	double slope[2] = { 2 * 1 * (2 - 0.5) / 2, 2 * 2 * (1 - 1) / 3.0 };
	double middle = (1 + 4) / 2.0 + (slope[0] - slope[1]) / 8;
	mesh(&b, s);
	assert_true(has_corner(&b, vec(sqrt(middle), 1.5, 0)));
	assert_int_equal(open_edges(&b), 0);
	struct box all = bounds(&b);
	assert_near(all.lo.y, 1, 0);
	assert_near(all.hi.y, 2, 0);
	s->open = true;
	mesh(&b, s);
	assert_true(open_edges(&b) > 0);
	bench_close(&b);
}

/* A span in which the squared radius falls below zero is not there at all, as POV-Ray has it; the others are. */
static void sor_gap(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0.2, -1, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 0.5, 2, 0 } } }, { { { 6, 2.5, 0 } } },
		                        { { { 6, 3, 0 } } } };
	struct bench b = bench_open(64);
	struct pov_solid *s = new_profile(&b, POV_SOR, (struct pov_profile){ POV_LINEAR, false, 0, 0, p, 6 });
	struct vec at, normal;
	mesh(&b, s);
	for (size_t i = 0; i < b.scene.point_count; i++)
		assert_true(b.scene.points[i].y <= 1 || b.scene.points[i].y >= 2);
	assert_true(pov_solid_trace(&b.mem, s, vec(9, 0.503, 0), vec(-1, 0, 0), &at, &normal));
	assert_near(at.x, 1.078, 2e-3);
	assert_true(pov_solid_trace(&b.mem, s, vec(9, 2.203, 0), vec(-1, 0, 0), &at, &normal));
	assert_near(at.x, 3.186, 0.02 * 3.186);
	assert_false(pov_solid_trace(&b.mem, s, vec(9, 1.1, 0), vec(-1, 0, 0), &at, &normal));
	bench_close(&b);
}

/* Loops of quadratic and cubic prisms close at their second point. */
static void prism_loops(void **state)
{
	(void)state;
	static const struct vec p[] = { { { { 0, 1, 0 } } }, { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 0, 1, 0 } } },
		                        { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } } };
	for (int cubic = 0; cubic < 2; cubic++) {
		struct bench b = bench_open(32);
		struct pov_profile profile = { cubic ? POV_CUBIC : POV_QUADRATIC, false, 0, 1, p, 6 + (size_t)cubic };
		struct pov_solid *s = new_profile(&b, POV_PRISM, profile);
		mesh(&b, s);
		assert_int_equal(open_edges(&b), 0);
		assert_true(has_corner(&b, vec(0, 0, 0)) && has_corner(&b, vec(1, 1, 1)));
		assert_true(pov_solid_inside(s, vec(0.5, 0.5, 0.5)));
		assert_false(pov_solid_inside(s, vec(0.5, 1.5, 0.5)));
		agree(&b, s, 0.01, 1);
		bench_close(&b);
	}
}

static void sweep_controls(void **state)
{
	(void)state;
	static const struct pov_sphere p[] = { { { { { 0, 0, 0 } } }, 1 }, { { { { 4, 0, 0 } } }, 1 }, { { { { 8, 0, 0 } } }, 1 },
		                               { { { { 12, 0, 0 } } }, 1 } };
	static const struct { enum pov_spline kind; double low, high; } cases[] = { { POV_LINEAR, -1, 13 }, { POV_CUBIC, 3, 9 },
		                                                                    { POV_B_SPLINE, 3, 9 } };
	for (int i = 0; i < 3; i++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = pov_solid_new(&b.mem, POV_SPHERE_SWEEP);
		s->shape.sweep = (struct pov_sphere_sweep){ cases[i].kind, p, 4 };
		mesh(&b, seal(&b, s));
		struct box all = bounds(&b);
		assert_near(all.lo.x, cases[i].low, 1e-9);
		assert_near(all.hi.x, cases[i].high, 1e-9);
		assert_true(pov_solid_inside(s, vec(cases[i].low + 0.01, 0, 0)));
		assert_false(pov_solid_inside(s, vec(cases[i].low - 0.01, 0, 0)));
		agree(&b, s, 0.03, 2);
		bench_close(&b);
	}
}

/* Between spheres of unlike radii is the cone that touches both. */
static void sweep_cone(void **state)
{
	(void)state;
	static const struct pov_sphere p[] = { { { { { 0, 0, 0 } } }, 2 }, { { { { 4, 0, 0 } } }, 1 } };
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_SPHERE_SWEEP);
	s->shape.sweep = (struct pov_sphere_sweep){ POV_LINEAR, p, 2 };
	mesh(&b, seal(&b, s));
	/* Over x = 2 the line that touches both circles: 2 / cos a - 2 tan a with sin a = 1/4. */
	double cosine = sqrt(15) / 4, high = 2 / cosine - 2 * 0.25 / cosine;
	assert_true(pov_solid_inside(s, vec(2, high - 1e-9, 0)));
	assert_false(pov_solid_inside(s, vec(2, high + 1e-9, 0)));
	agree(&b, s, 0.02, 3);
	bench_close(&b);
}

static void bicubic(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_BICUBIC_PATCH);
	struct vec middle = vec(0, 0, 0);
	static const double weight[4] = { 0.125, 0.375, 0.375, 0.125 };
	for (int i = 0; i < 16; i++) {
		s->shape.bicubic.points[i] = vec(i % 4, i / 4, (i * 7) % 5);
		middle = vec_add(middle, vec_scale(s->shape.bicubic.points[i], weight[i / 4] * weight[i % 4]));
	}
	s->shape.bicubic.u_steps = 3;
	s->shape.bicubic.v_steps = 9;
	mesh(&b, seal(&b, s));
	assert_int_equal(b.scene.object_count, 8 * 16 * 2);
	assert_true(has_corner(&b, middle));
	for (int i = 0; i < 16; i += i == 0 || i == 12 ? 3 : 9)
		assert_true(has_corner(&b, s->shape.bicubic.points[i]));
	bench_close(&b);
}

static struct pov_solid *new_polygon(struct bench *b, const struct vec *points, size_t n)
{
	struct pov_solid *s = pov_solid_new(&b->mem, POV_POLYGON);
	s->shape.polygon = (struct pov_polygon){ points, n };
	return seal(b, s);
}

/* Loops by even-odd, an open last one closed; stars that cross themselves; bent ones are left out. */
static void polygons(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	mesh(&b, new_polygon(&b, square, 10));
	assert_near(area(&b), 3, 1e-12);
	mesh(&b, new_polygon(&b, square, 9));
	assert_near(area(&b), 3, 1e-12);
	struct vec star[5], bent[4] = { vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0.1), vec(0, 1, 0) };
	for (int i = 0; i < 5; i++)
		star[i] = vec(cos(4 * pi * i / 5), sin(4 * pi * i / 5), 0);
	mesh(&b, new_polygon(&b, star, 5));
	/* The five points of a pentagram without the pentagon in its middle. */
	double inner = cos(2 * pi / 5) / cos(pi / 5), whole = 5 * inner * sin(pi / 5), pentagon = 2.5 * inner * inner * sin(2 * pi / 5);
	assert_near(area(&b), whole - pentagon, 1e-9);
	mesh(&b, new_polygon(&b, bent, 4));
	assert_int_equal(b.tally.skipped, 1);
	assert_string_equal(b.tally.reasons[0].reason, "polygon that is not flat");
	bench_close(&b);
}

static void discs(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_DISC);
	s->shape.disc = (struct pov_disc){ vec(1, 2, 3), vec(0, 5, 0), 2, 1 };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 3 * pi, 2e-2);
	/* As a solid it is the half space behind it. */
	assert_true(pov_solid_inside(s, vec(50, 1.9, 0)));
	assert_false(pov_solid_inside(s, vec(1, 2.1, 3)));
	bench_close(&b);
}

static double sphere_x(void *context, const double *u)
{
	(void)context;
	return cos(u[0]) * cos(u[1]);
}

static double sphere_y(void *context, const double *u)
{
	(void)context;
	return sin(u[0]) * cos(u[1]);
}

static double sphere_z(void *context, const double *u)
{
	(void)context;
	return sin(u[1]);
}

static void parametric(void **state)
{
	(void)state;
	struct bench b = bench_open(64);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_PARAMETRIC);
	s->shape.parametric = (struct pov_parametric){ .function = { { sphere_x, NULL }, { sphere_y, NULL }, { sphere_z, NULL } },
		                                       .low = { 0, -pi / 2 }, .high = { 2 * pi, pi / 2 } };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 4 * pi, 1e-2);
	s->shape.parametric.contained = true;
	s->shape.parametric.box = (struct pov_box){ { vec(-2, -2, 0), vec(2, 2, 2) } };
	mesh(&b, seal(&b, s));
	assert_near(area(&b), 2 * pi, 1e-2);
	bench_close(&b);
}

/* Terms of polynomials: powers of x fall, then those of y, then those of z. */
static void poly_terms(void **state)
{
	(void)state;
	struct vec p = vec(1.25, -0.75, 0.5);
	for (int order = 2; order <= 5; order++) {
		struct bench b = bench_open(32);
		struct pov_solid *s = pov_solid_new(&b.mem, POV_POLY);
		double c[56], want = 0;
		int n = 0;
		for (int i = order; i >= 0; i--)
			for (int j = order - i; j >= 0; j--)
				for (int k = order - i - j; k >= 0; k--, n++) {
					c[n] = n * n - 3 * n + 1;
					want += c[n] * pow(p.x, i) * pow(p.y, j) * pow(p.z, k);
				}
		assert_int_equal(n, (order + 1) * (order + 2) * (order + 3) / 6);
		s->shape.poly = (struct pov_poly){ order, c };
		seal(&b, s);
		assert_near(pov_shape_of(s)->field(s, p), want, 1e-12 * fabs(want));
		bench_close(&b);
	}
}

static void quadric_terms(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct pov_solid *s = pov_solid_new(&b.mem, POV_QUADRIC);
	double x = 1.25, y = -0.75, z = 0.5;
	s->shape.quadric = (struct pov_quadric){ { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 } };
	seal(&b, s);
	assert_near(pov_shape_of(s)->field(s, vec(x, y, z)),
	            x * x + 2 * y * y + 3 * z * z + 4 * x * y + 5 * x * z + 6 * y * z + 7 * x + 8 * y + 9 * z + 10, 1e-12);
	bench_close(&b);
}

/* A TrueType font of two glyphs: none, and for 'o' a square ring from 100 to 600 of 1000 with a hole from 200 to 500; advance 800. */
struct font {
	unsigned char bytes[600];
	size_t n;
};

static void put16(struct font *f, int count, const int *values)
{
	for (int i = 0; i < count; i++) {
		f->bytes[f->n++] = (unsigned char)(values[i] >> 8 & 255);
		f->bytes[f->n++] = (unsigned char)(values[i] & 255);
	}
}

static struct font make_font(void)
{
	static const int cmap[] = { 0, 1, 3, 1, 0, 12, 4, 32, 0, 4, 4, 1, 0, 'o', 0xffff, 0, 'o', 0xffff, 1 - 'o', 1, 0, 0 };
	static const int head[] = { 1, 0, 1, 0, 0, 0, 0x5f0f, 0x3cf5, 0, 1000, 0, 0, 0, 0, 0, 0, 0, 0, 100, 0, 600, 500, 0, 8, 2, 0, 0 };
	static const int hhea[] = { 1, 0, 800, 0, 0, 800, 100, 200, 600, 1, 0, 0, 0, 0, 0, 0, 0, 2 };
	static const int hmtx[] = { 800, 0, 800, 100 }, loca[] = { 0, 0, 29 };
	static const int maxp[] = { 1, 0, 2, 8, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0 };
	/* Contours, box, ends, instructions, flags; then the points, each from the last: x, y. */
	static const int glyf[] = { 2, 100, 0, 600, 500, 3, 7, 0, 0x0101, 0x0101, 0x0101, 0x0101, 100, 500, 0, -500, 100, 0, 300, 0,
		                    0, 0, 500, 0, -400, 300, 0, -300, 0 };
	static const struct { const char *tag; const int *data; int words; } tables[] = {
		{ "cmap", cmap, 22 }, { "glyf", glyf, 29 }, { "head", head, 27 }, { "hhea", hhea, 18 },
		{ "hmtx", hmtx, 4 },  { "loca", loca, 3 },  { "maxp", maxp, 16 },
	};
	struct font f = { .n = 0 };
	int offset = 12 + 7 * 16;
	put16(&f, 6, (int[]){ 1, 0, 7, 64, 2, 48 });
	for (int i = 0; i < 7; i++) {
		memcpy(f.bytes + f.n, tables[i].tag, 4);
		f.n += 4;
		put16(&f, 6, (int[]){ 0, 0, 0, offset, 0, 2 * tables[i].words });
		offset += (2 * tables[i].words + 3) / 4 * 4;
	}
	for (int i = 0; i < 7; i++) {
		put16(&f, tables[i].words, tables[i].data);
		f.n = (f.n + 3) / 4 * 4;
	}
	return f;
}

/* Letters stand where their advances put them, the first at the edge of its ink; holes are holes. Without FreeType, or a font, text is
 * skipped and counted. */
static void letters(void **state)
{
	(void)state;
	struct bench b = bench_open(32);
	struct font f = make_font();
	static const uint32_t codes[] = { 'o', 'o' };
	struct pov_solid *s = pov_solid_new(&b.mem, POV_TEXT), *bad = pov_solid_new(&b.mem, POV_TEXT);
	s->shape.text = (struct pov_text){ f.bytes, f.n, codes, 2, 2, vec(0.25, 0, 0) };
	bad->shape.text = (struct pov_text){ f.bytes, 40, codes, 2, 2, vec(0, 0, 0) };
	mesh(&b, seal(&b, bad));
	assert_int_equal(b.tally.skipped, 1);
	bool without = strcmp(b.tally.reasons[0].reason, "text, without FreeType") == 0;
	assert_true(without || strcmp(b.tally.reasons[0].reason, "text whose font cannot be read") == 0);
	mesh(&b, seal(&b, s));
	assert_int_equal(b.tally.skipped, without);
	if (!without) {
		struct box all = bounds(&b);
		assert_near(all.lo.x, 0, 1e-12);
		assert_near(all.hi.x, 0.8 + 0.25 + 0.5, 1e-12);
		assert_near(all.lo.z, 0, 0);
		assert_near(all.hi.z, 2, 0);
		assert_near(volume(&b), 2 * 2 * (0.25 - 0.09), 1e-12);
		assert_int_equal(open_edges(&b), 0);
		assert_true(pov_solid_inside(s, vec(0.05, 0.25, 1)));
		assert_false(pov_solid_inside(s, vec(0.25, 0.25, 1)));
		agree(&b, s, 1e-9, 9);
	}
	bench_close(&b);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(splines), cmocka_unit_test(sor_formula), cmocka_unit_test(sor_gap), cmocka_unit_test(prism_loops),
		cmocka_unit_test(sweep_controls), cmocka_unit_test(sweep_cone), cmocka_unit_test(bicubic),
		cmocka_unit_test(polygons), cmocka_unit_test(discs), cmocka_unit_test(parametric), cmocka_unit_test(poly_terms),
		cmocka_unit_test(quadric_terms), cmocka_unit_test(letters),
	};
	return cmocka_run_group_tests_name("pov_curves", tests, NULL, NULL);
}
