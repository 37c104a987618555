/* Meshes through Assimp: what is read, and that nothing a file does harms the reader. */
#include "tests/check.h"

#include "base/progress.h"
#include "base/rng.h"
#include "io/format.h"
#include "io/mesh.h"

#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const struct mesh_limits usual = { (size_t)1 << 30, 30 };

static int read_bytes(struct scene *s, const char *name, const void *bytes, size_t n, const struct mesh_limits *limits, struct err *e)
{
	const struct read_options o = { 0 };
	return mesh_read_within(s, name, bytes, n, &o, limits, e);
}

static struct scene must_read(const char *name, const char *text)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	if (read_bytes(&s, name, text, strlen(text), &usual, &e) != 0)
		fail_msg("%s", e.text);
	return s;
}

static void assert_corner(const struct scene *s, size_t object, int corner, double x, double y, double z)
{
	struct vec p = s->points[s->objects[object].first + (size_t)corner];
	if (p.x != x || p.y != y || p.z != z)
		fail_msg("corner %d of object %zu is (%g, %g, %g)", corner, object, p.x, p.y, p.z);
}

static void obj(void **state)
{
	(void)state;
	struct scene s = must_read("t.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\nl 1 2\n");
	assert_int_equal(s.object_count, 3);
	assert_true(s.objects[0].kind == OBJECT_PATCH);
	assert_corner(&s, 0, 2, 1, 1, 0);
	assert_corner(&s, 0, 3, 0, 0, 1);
	assert_false(s.view.given || s.light_count);
	scene_free(&s);
}

static const char ply_head[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                               "property list uchar int vertex_indices\nend_header\n";

static void ply_by_ending_and_by_content(void **state)
{
	(void)state;
	static const char *const names[] = { "t.ply", "t.ply.gz", "mesh" };
	char text[400];
	snprintf(text, sizeof text, "%s0 0 0\n0.5 0 0\n0 2 1\n3 0 1 2\n", ply_head);
	for (int i = 0; i < 3; i++) {
		struct scene s = must_read(names[i], text);
		assert_int_equal(s.object_count, 1);
		assert_true(s.objects[0].kind == OBJECT_POLYGON);
		assert_corner(&s, 0, 1, 0.5, 0, 0);
		assert_corner(&s, 0, 2, 0, 2, 1);
		scene_free(&s);
	}
}

static void stl(void **state)
{
	(void)state;
	struct scene s = must_read("t.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
	                                    "endsolid a\n");
	assert_int_equal(s.object_count, 1);
	assert_corner(&s, 0, 1, 1, 0, 0);
	scene_free(&s);
}

/* One triangle, (0 0 0) (1 0 0) (0 1 0), used by two nodes under one that moves both; the second mirrors it. */
static const char gltf[] =
	"{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1,2],\"translation\":[0,0,10]},"
	"{\"mesh\":0,\"scale\":[2,2,2]},{\"mesh\":0,\"scale\":[-1,1,1],\"translation\":[0,5,0]}],\"meshes\":[{\"primitives\":[{\"attributes\":"
	"{\"POSITION\":0},\"indices\":1,\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.2,0.4,0.8,1]}}],"
	"\"buffers\":[{\"byteLength\":42,\"uri\":\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"
	"\"}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],\"accessors\":["
	"{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},"
	"{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}]}";

static void transforms_of_nodes(void **state)
{
	(void)state;
	struct scene s = must_read("t.gltf", gltf);
	assert_int_equal(s.object_count, 2);
	assert_corner(&s, 0, 0, 0, 0, 10);
	assert_corner(&s, 0, 1, 2, 0, 10);
	assert_corner(&s, 0, 2, 0, 2, 10);
	for (size_t i = 0; i < 2; i++) { /* the mirrored one is turned over, so that its front stays in front */
		const struct vec *p = &s.points[s.objects[i].first];
		assert_true(vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0])).z > 0);
	}
	assert_corner(&s, 1, 1, -1, 5, 10);
	const struct material *m = &s.materials[s.objects[0].material];
	assert_true(m->kd == 0.8 && m->color.r == 0.25 && m->color.g == 0.5 && m->color.b == 1);
	scene_free(&s);
}

static void write_file(const char *folder, const char *name, const char *text)
{
	char path[128];
	snprintf(path, sizeof path, "%s/%s", folder, name);
	FILE *f = fopen(path, "w");
	assert_non_null(f);
	fputs(text, f);
	fclose(f);
}

/* The .mtl is found beside the file or in the folders, and nothing but that is left behind. */
static void materials_from_a_second_file(void **state)
{
	(void)state;
	char folder[] = "/tmp/raycost-mesh-XXXXXX", name[64], elsewhere[64];
	static const char text[] = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\nusemtl glass\nf 3 2 1\n";
	assert_non_null(mkdtemp(folder));
	write_file(folder, "t.mtl", "newmtl red\nKd 0.5 0 0\nKs 0.25 0 0\nNs 8\nnewmtl glass\nKd 1 1 1\nd 0.25\nNi 1.5\n");
	snprintf(name, sizeof name, "%s/t.obj.gz", folder);
	snprintf(elsewhere, sizeof elsewhere, "%s/none/t.obj", folder);
	for (int i = 0; i < 3; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		const struct read_options o = { .include = i == 1 ? folder : NULL };
		assert_int_equal(mesh_read_within(&s, i ? elsewhere : name, text, sizeof text - 1, &o, &usual, &e), 0);
		assert_int_equal(s.object_count, 2);
		const struct material *red = &s.materials[s.objects[0].material], *glass = &s.materials[s.objects[1].material];
		if (i < 2) {
			assert_true(red->kd == 0.5 && red->color.r == 1 && red->color.g == 0 && red->ks == 0.25 && red->shine == 8);
			assert_true(glass->transmit == 0.75 && glass->ior == 1.5 && glass->kd == 1);
		} else {
			assert_true(red->color.g == red->color.r);
		}
		scene_free(&s);
	}
	snprintf(name, sizeof name, "%s/t.mtl", folder);
	assert_int_equal(unlink(name), 0);
	assert_int_equal(rmdir(folder), 0); /* empty: nothing was written */
}

/* One line that starts with the file's name, whatever is in it. */
static void check_refused(const char *name, const void *bytes, size_t n)
{
	struct err e = { 0 };
	struct scene s = { 0 };
	assert_int_equal(read_bytes(&s, name, bytes, n, &usual, &e), -1);
	assert_int_equal(e.code, STATUS_INPUT);
	assert_int_equal(strncmp(e.text, name, strlen(name)), 0);
	assert_int_equal(strncmp(e.text + strlen(name), ": ", 2), 0);
	assert_true(strlen(e.text) > strlen(name) + 2);
	assert_null(strchr(e.text, '\n'));
	scene_free(&s);
}

static void bad_files_are_refused(void **state)
{
	(void)state;
	static const char *const names[] = { "t.obj", "t.ply", "t.stl", "t.gltf", "t.glb", "t.3ds", "t.fbx", "t.dae", "t.x", "t.off", "t.ac", "t.lwo" };
	unsigned char noise[500];
	for (size_t i = 0; i < sizeof noise; i++)
		noise[i] = (unsigned char)(256 * rng_uniform(rng_key(8, 8, i), 0));
	for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
		check_refused(names[i], noise, sizeof noise);
		check_refused(names[i], "", 0);
	}
	check_refused("t.obj", "v 0 0 0\nv 1 0 0\nf 1 2 999\n", 27);
	check_refused("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n", 30);
	check_refused("t.gltf", gltf, sizeof gltf / 2);
	check_refused("t.stl", "solid a\nendsolid a\n", 19);
}

/* Whatever is flipped: a scene or a line. Assimp never ends on a PLY whose head does not. */
static void mutations_do_no_harm(void **state)
{
	(void)state;
	char ply[400];
	snprintf(ply, sizeof ply, "%s0 0 0\n0.5 0 0\n0 2 1\n3 0 1 2\n", ply_head);
	const char *const texts[] = { gltf, ply, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf 1 2 3\n" };
	static const char *const names[] = { "t.gltf", "t.ply", "t.obj" };
	const struct mesh_limits brief = { (size_t)1 << 30, 0.05 }, ample = { (size_t)1 << 30, 20 };
	int refused = 0, rounds = 150;
	for (int i = 0; i < rounds; i++) {
		struct err e = { 0 };
		struct scene s = { 0 };
		const char *text = texts[i % 3];
		size_t n = strlen(text);
		uint64_t key = rng_key(9, 9, (uint64_t)i);
		char *copy = malloc(n + 1);
		assert_non_null(copy);
		memcpy(copy, text, n + 1);
		for (uint64_t k = 0; k < 1 + (uint64_t)i % 4; k++)
			copy[(size_t)((double)n * rng_uniform(key, 2 * k))] = (char)(32 + 96 * rng_uniform(key, 2 * k + 1));
		int status = read_bytes(&s, names[i % 3], copy, n, i % 3 == 1 ? &brief : &ample, &e);
		if (status != 0)
			assert_int_equal(e.code, STATUS_INPUT);
		refused += status != 0;
		scene_free(&s);
		free(copy);
	}
	assert_true(refused > 5 && refused < rounds);
}

/* A file that takes Assimp seconds: a PLY of many corners. */
static struct text make_slow(void)
{
	struct text t = { 0 };
	size_t n = 400000;
	text_print(&t, "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
	               "property list uchar int vertex_indices\nend_header\n", n);
	for (size_t i = 0; i < n; i++)
		text_add(&t, "0.125 0.25 0.5\n", 15);
	text_print(&t, "3 0 1 2\n");
	assert_false(t.lost);
	return t;
}

static void time_is_limited(void **state)
{
	(void)state;
	struct text t = make_slow();
	struct err e = { 0 };
	struct scene s = { 0 };
	const struct mesh_limits limits = { (size_t)4 << 30, 0.01 };
	double start = clock_seconds();
	assert_int_equal(read_bytes(&s, "t.ply", t.bytes, t.size, &limits, &e), -1);
	assert_string_equal(e.text, "t.ply: not read within 0.01 s");
	assert_int_equal(e.code, STATUS_INPUT);
	assert_true(clock_seconds() - start < 5);
	assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* no child is left */
	scene_free(&s);
	text_free(&t);
}

static void memory_is_limited(void **state)
{
	(void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
	skip();
#endif
	static const char head[] = "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
	                           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0000000000000000";
	struct err e = { 0 };
	struct scene s = { 0 };
	assert_int_equal(read_bytes(&s, "t.ply", head, sizeof head, &usual, &e), -1);
	assert_string_equal(e.text, "t.ply: reading it takes more than 1024 MiB");
	scene_free(&s);
}

/* In a process of its own: kill whatever else its parent starts. */
_Noreturn static void kill_siblings(pid_t parent)
{
	char path[64], list[256];
	snprintf(path, sizeof path, "/proc/%ld/task/%ld/children", (long)parent, (long)parent);
	for (int tries = 0; tries < 100000; tries++) {
		FILE *f = fopen(path, "r");
		if (!f || !fgets(list, sizeof list, f))
			*list = '\0';
		if (f)
			fclose(f);
		for (char *p = list, *end; *p; p = end) {
			long pid = strtol(p, &end, 10);
			if (end == p)
				break;
			if (pid != (long)getpid() && kill((pid_t)pid, SIGKILL) == 0)
				_exit(0);
		}
	}
	_exit(1);
}

static void a_killed_importer_is_one_line(void **state)
{
	(void)state;
	struct text t = make_slow();
	struct err e = { 0 };
	struct scene s = { 0 };
	int ended;
	pid_t parent = getpid(), killer = fork();
	if (killer == 0)
		kill_siblings(parent);
	int status = read_bytes(&s, "t.ply", t.bytes, t.size, &usual, &e);
	assert_int_equal(waitpid(killer, &ended, 0), killer);
	assert_true(WIFEXITED(ended) && WEXITSTATUS(ended) == 0);
	assert_int_equal(status, -1);
	assert_int_equal(e.code, STATUS_INPUT);
	assert_non_null(strstr(e.text, "t.ply: the importer ended by signal 9"));
	scene_free(&s);
	text_free(&t);
}

static void without_assimp_it_says_how_to_get_it(void **state)
{
	(void)state;
	struct err e = { 0 };
	struct scene s = { 0 };
	assert_int_equal(read_bytes(&s, "t.obj", "", 0, &usual, &e), -1);
	assert_string_equal(e.text, "t.obj: this format needs Assimp: install libassimp-dev ('make deps'), then build anew");
	scene_free(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(obj),
		cmocka_unit_test(ply_by_ending_and_by_content),
		cmocka_unit_test(stl),
		cmocka_unit_test(transforms_of_nodes),
		cmocka_unit_test(materials_from_a_second_file),
		cmocka_unit_test(bad_files_are_refused),
		cmocka_unit_test(mutations_do_no_harm),
		cmocka_unit_test(time_is_limited),
		cmocka_unit_test(memory_is_limited),
		cmocka_unit_test(a_killed_importer_is_one_line),
	};
	const struct CMUnitTest without[] = { cmocka_unit_test(without_assimp_it_says_how_to_get_it) };
	return mesh_available() ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(without, NULL, NULL);
}
