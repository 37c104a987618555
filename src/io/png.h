/* Images out. */
#ifndef IO_PNG_H
#define IO_PNG_H

#include "base/err.h"

/* Write pixels[height][width][3] as an 8-bit RGB PNG, whole or not at all; equal pixels give equal bytes. 0, or -1 and *e. */
int png_write_rgb(const char *path, const unsigned char *pixels, int width, int height, struct err *e);

#endif
