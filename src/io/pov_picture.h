/* An image while its heights are read. */
#ifndef IO_POV_PICTURE_H
#define IO_POV_PICTURE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stdint.h>

/* The heights as they are filled, in the arena, and the bytes as they are read. 'spent': read past the end. */
struct picture {
	struct arena *mem;
	double *heights;
	int width, height;
	const unsigned char *at, *end;
	bool spent;
};

/* Room for the heights; false: too large, too small, or memory is out. */
bool picture_open(struct picture *p, uint64_t width, uint64_t height);

/* Row 0 is the image's top, z = 1. */
void picture_put(struct picture *p, int x, int row, double height);

/* POV-Ray's height of a colour. */
double picture_height_of_color(unsigned red, unsigned green);

/* Formats read by libraries; false: damaged, or no such library here. */
bool picture_read_png(struct picture *p);
bool picture_read_jpeg(struct picture *p);

#endif
