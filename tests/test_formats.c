/* The table of formats, and scenes through files of each and back. */
#include "tests/check.h"

#include "base/rng.h"
#include "io/facets.h"
#include "io/format.h"
#include "io/mesh.h"
#include "io/nff.h"
#include "scene/duplicates.h"

#include <string.h>
#include <unistd.h>

static const struct write_options exact = { .digits = DIGITS_EXACT, .resolution = SPD_RESOLUTION };

static void endings_name_formats(void **state)
{
	(void)state;
	static const struct {
		const char *path, *name;
	} cases[] = {
		{ "a.nff", "NFF" }, { "a.nff.gz", "NFF" }, { "dir.obj/a.aff", "NFF" }, { "a.OBJ", "OBJ" }, { "a.b.ply.GZ", "PLY" },
		{ "x.pov", "POV-Ray" }, { "x.inc.gz", "POV-Ray" }, { "x.glb", "glTF" }, { "x.stl", "mesh" }, { "x.3ds", "mesh" },
		{ "x", NULL }, { "x.gz", NULL }, { "nff", NULL }, { ".gz", NULL }, { "x.nf", NULL }, { "x.nffx", NULL }, { "a.obj/x", NULL }, { "x.", NULL },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const struct format *f = format_of_path(cases[i].path);
		if (!cases[i].name)
			assert_null(f);
		else
			assert_string_equal(f->name, cases[i].name);
	}
}

static int read_text(struct scene *s, const char *name, const char *text, struct err *e)
{
	const struct read_options o = { 0 };
	struct read_summary summary;
	return format_read(s, name, text, strlen(text), &o, &summary, e);
}

static void content_decides_where_the_ending_does_not(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct scene s = { 0 };
	assert_int_equal(read_text(&s, "scene", "# head\ns 0 0 0 1\n", &e), 0);
	assert_int_equal(s.object_count, 1);
	assert_int_equal(read_text(&s, "scene.txt", "hello\n", &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	assert_non_null(strstr(e.text, "scene.txt: no reader for this kind of file; known endings are: nff aff"));
	e.code = 0;
	assert_int_equal(read_text(&s, "scene", "", &e), -1);
	e.code = 0;
	assert_int_equal(read_text(&s, "scene.txt", "nff\nversion 2.1\n", &e), -1);
	assert_non_null(strstr(e.text, "Sense8"));
	scene_free(&s);
}

static void summaries_tell_what_was_skipped(void **state)
{
	(void)state;
	const struct read_options o = { 0 };
	struct read_summary summary;
	struct err e = { 0 };
	struct scene s = { 0 };
	static const char text[] = "s 0 0 0 1\nqq 1\nqq 2\n";
	assert_int_equal(format_read(&s, "t.nff", text, sizeof text - 1, &o, &summary, &e), 0);
	assert_int_equal(summary.skipped, 2);
	assert_int_equal(summary.first_line, 2);
	scene_free(&s);
}

static void unknown_endings_are_not_written(void **state)
{
	(void)state;
	struct scene s = { 0 };
	static const char *const paths[] = { "out.stl", "out", "out.xyz" };
	for (int i = 0; i < 3; i++) {
		struct err e = { 0 };
		assert_int_equal(format_write(&s, paths[i], &exact, &e), -1);
		assert_int_equal(e.code, STATUS_INPUT);
		assert_non_null(strstr(e.text, "known endings are: nff aff pov inc obj ply (each also .gz)"));
	}
}

/* A scene with a bit of everything. */
static void fill(struct scene *s)
{
	const struct vec arrow[5] = { { { { 0, 0, 0 } } }, { { { 4, 0, 0 } } }, { { { 4, 4, 0 } } }, { { { 2, 1, 0 } } }, { { { 0, 4, 0 } } } };
	const struct vec corner[3] = { { { { 0, 0, 1 } } }, { { { 1, 0, 1.0 / 3 } } }, { { { 0, 1, 1 } } } };
	const struct vec normal[3] = { { { { 0, 0, 1 } } }, { { { 0.6, 0, 0.8 } } }, { { { 0, 0, 2 } } } };
	scene_set_background(s, 0.1, 0.2, 0.3);
	scene_set_view(s, vec(9, 8, 7), vec(1, 1, 0), vec(0, 0, 1), 40, 0.1, 320, 240);
	scene_add_light(s, vec(5, 5, 9));
	scene_add_colored_light(s, vec(-5, 5, 9), (struct color){ 0.5, 0.25, 1 });
	scene_add_polygon(s, arrow, 5);
	scene_add_material(s, (struct material){ { 1, 0.5, 0.25 }, 0.5, 0, 10, 0, 1 });
	scene_add_polygon(s, corner, 3);
	scene_add_patch(s, corner, normal, 3);
	scene_add_material(s, (struct material){ { 1, 1, 1 }, 0.125, 0.25, 100, 0.75, 1.5 });
	scene_add_sphere(s, vec(3, 3, 3), 0.5);
	scene_add_cone(s, vec(0, 0, 2), 0.5, vec(0, 0, 3), 0.25);
}

/* All triangles as nine numbers a row, degenerate ones too. */
static float *list_corners(const struct scene *s, size_t *count)
{
	struct facets f = { 0 };
	for (size_t i = 0; i < s->object_count; i++)
		facets_add(&f, s, &s->objects[i], SPD_RESOLUTION);
	float *x = malloc(9 * (f.count + 1) * sizeof *x);
	assert_non_null(x);
	for (size_t i = 0; i < 9 * f.count; i++)
		x[i] = (float)f.all[i / 9].corner[i % 9 / 3].a[i % 3];
	*count = f.count;
	facets_free(&f);
	return x;
}

/* Written and read back through Assimp: the same triangles with the same corners in the same order, in single precision: Assimp's
 * own reading of decimals is up to two units in the last place off. */
static void check_mesh(const struct scene *s, const char *ending)
{
	struct err e = { 0 };
	struct scene back = { 0 };
	struct text text = { 0 };
	size_t before, after;
	char name[32];
	snprintf(name, sizeof name, "t.%s", ending);
	assert_int_equal(format_of_path(name)->write(s, &exact, &text, &e), 0);
	if (read_text(&back, name, text.bytes, &e) != 0)
		fail_msg("%s", e.text);
	float *x = list_corners(s, &before), *y = list_corners(&back, &after);
	assert_int_equal(before, after);
	for (size_t i = 0; i < 9 * before; i++)
		if (!(fabsf(x[i] - y[i]) <= 0x1p-22f * fabsf(x[i])))
			fail_msg("%s: number %zu is %.9g, was %.9g", name, i, (double)y[i], (double)x[i]);
	free(x);
	free(y);
	scene_free(&back);
	text_free(&text);
}

static void meshes_come_back(void **state)
{
	(void)state;
	if (!mesh_available())
		skip();
	static const char *const families[] = { "gears", "teapot", "tetra", "mount", "jacks" };
	for (int i = 0; i < 6; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		struct spd_options o;
		key_defaults(spd_keys, &o);
		o.size = 1;
		if (i < 5)
			assert_int_equal(spd_generate(&s, spd_find(families[i]), &o, &e), 0);
		else
			fill(&s);
		check_mesh(&s, "obj");
		check_mesh(&s, "ply");
		scene_free(&s);
	}
}

/* Corners of zero area stay, so that every triangle of the source is there; corners are told once. */
static void corners_are_shared(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct scene s = { 0 };
	struct text text = { 0 };
	const struct vec q[4] = { { { { 0, 0, 0 } } }, { { { 1, 0, 0 } } }, { { { 1, 1, 0 } } }, { { { 0, 1, 0 } } } };
	scene_add_polygon(&s, q, 4);
	scene_add_polygon(&s, (const struct vec[3]){ q[0], q[1], q[1] }, 3);
	assert_int_equal(format_of_path("t.ply")->write(&s, &exact, &text, &e), 0);
	assert_non_null(strstr(text.bytes, "element vertex 4\n"));
	assert_non_null(strstr(text.bytes, "element face 3\n"));
	text_free(&text);
	scene_free(&s);
}

static void text_of_the_writers(void **state)
{
	(void)state;
	static const char *const names[] = { "mixed.nff", "mixed.pov", "mixed.obj", "mixed.mtl", "mixed.ply" };
	for (int i = 0; i < 5; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		struct text text = { 0 };
		struct write_options o = { .digits = 12, .resolution = 1, .companion = "mixed.mtl" };
		fill(&s);
		if (i == 3)
			assert_int_equal(format_of_path("mixed.obj")->write_companion(&s, &o, &text, &e), 0);
		else
			assert_int_equal(format_of_path(names[i])->write(&s, &o, &text, &e), 0);
		assert_golden(names[i], text.bytes);
		scene_free(&s);
		text_free(&text);
	}
}

/* Files, packed and plain, with the materials beside an OBJ. */
static void files_go_out_and_come_in(void **state)
{
	(void)state;
	char folder[] = "/tmp/raycost-formats-XXXXXX";
	assert_non_null(mkdtemp(folder));
	static const char *const names[] = { "a.nff.gz", "b.obj.gz", "b.mtl", "c.ply", "d.pov.gz" };
	for (int i = 0; i < 5; i++) {
		struct err e = { 0 };
		struct scene s = { 0 }, back = { 0 };
		struct text text = { 0 };
		struct read_summary summary;
		const struct read_options o = { 0 };
		char path[128];
		snprintf(path, sizeof path, "%s/%s", folder, names[i]);
		fill(&s);
		if (i != 2 && format_write(&s, path, &exact, &e) != 0)
			fail_msg("%s", e.text);
		assert_int_equal(text_read_file(&text, path, 1 << 20, &e), 0);
		if (i == 0 || (i == 1 && mesh_available())) {
			assert_int_equal(format_read(&back, path, text.bytes, text.size, &o, &summary, &e), 0);
			const struct material *m = &back.materials[back.material_count - 1], *want = &s.materials[1];
			assert_true(m->kd == want->kd && m->ks == want->ks && m->shine == want->shine && m->transmit == want->transmit &&
			            m->ior == want->ior && m->color.g == want->color.g);
		}
		scene_free(&s);
		scene_free(&back);
		text_free(&text);
	}
	for (int i = 0; i < 5; i++) {
		char path[128];
		snprintf(path, sizeof path, "%s/%s", folder, names[i]);
		assert_int_equal(unlink(path), 0);
	}
	assert_int_equal(rmdir(folder), 0);
}

static void duplicates_are_counted(void **state)
{
	(void)state;
	struct scene s = { 0 };
	const struct vec a = vec(0, 0, 0), b = vec(1, 0, 0), c = vec(0, 1, 0), zero = vec(-0.0, 0, -0.0);
	scene_add_polygon(&s, (const struct vec[3]){ a, b, c }, 3);
	scene_add_polygon(&s, (const struct vec[3]){ c, zero, b }, 3);
	scene_add_polygon(&s, (const struct vec[3]){ b, a, c }, 3);
	scene_add_polygon(&s, (const struct vec[3]){ a, b, vec(0, 1, 1e-300) }, 3);
	scene_add_sphere(&s, a, 1);
	scene_add_sphere(&s, a, 2);
	scene_add_sphere(&s, a, 1);
	struct primitives p = make_primitives(&s);
	assert_int_equal(primitives_duplicates(&p), 3);
	primitives_free(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(endings_name_formats),
		cmocka_unit_test(content_decides_where_the_ending_does_not),
		cmocka_unit_test(summaries_tell_what_was_skipped),
		cmocka_unit_test(unknown_endings_are_not_written),
		cmocka_unit_test(meshes_come_back),
		cmocka_unit_test(corners_are_shared),
		cmocka_unit_test(text_of_the_writers),
		cmocka_unit_test(files_go_out_and_come_in),
		cmocka_unit_test(duplicates_are_counted),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
