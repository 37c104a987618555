/* What the fuzz targets share. A target is one file that defines LLVMFuzzerTestOneInput: bytes in, and whatever they are, nothing crashes,
 * leaks or disagrees. 'make fuzz' runs it under libFuzzer; linked with replay.c instead it goes through files, as 'make test' does with
 * tests/fuzz/NAME and tests/crashers/NAME. */
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

/* What must hold whatever the input. */
#define MUST(condition) \
	do { \
		if (!(condition)) { \
			fprintf(stderr, "%s:%d: %s does not hold\n", __FILE__, __LINE__, #condition); \
			abort(); \
		} \
	} while (0)

/* A file in memory with these bytes; returns its path, good until the next call. */
const char *fuzz_file(const uint8_t *data, size_t n);

/* From a scene to its primitives, to every structure there is, to 32 rays that must hit what they hit without a structure. Scenes of
 * more than a hundred primitives are left alone: smaller ones have the same bugs. */
void fuzz_scene(const struct scene *s);

#endif
