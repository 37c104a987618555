/* What the mesh importer's process sends: whatever it is, a reason or a scene. The importer itself is not ours, and may do to itself what it
 * likes. */
#include "tests/fuzz/fuzz.h"

#include "io/mesh_import.h"

#include <fcntl.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct scene s = { 0 };
	struct err e = { 0 };
	const struct mesh_limits limits = { (size_t)1 << 30, 10 };
	int fd = open(fuzz_file(data, n), O_RDONLY);
	MUST(fd >= 0);
	if (mesh_receive(fd, &s, "fuzz.obj", &limits, &e) == 0)
		fuzz_scene(&s);
	else
		MUST(!e.code || (*e.text && (e.code == STATUS_INPUT || e.code == STATUS_ENVIRONMENT)));
	close(fd);
	scene_free(&s);
	return 0;
}
