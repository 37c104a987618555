/* Images as height fields. */
#ifndef IO_POV_IMAGE_H
#define IO_POV_IMAGE_H

#include "base/arena.h"

#include <stddef.h>

/* The heights of an image file in memory by POV-Ray's rules, row z = 0 (the image's bottom row) first, in the arena: grey as
 * value / 255 or / 65535, colours (256 r + g) / 65535, indexed by their index / 255. Known by their first bytes: PNG, PGM and PPM, GIF,
 * BMP, JPEG where libjpeg was there at build; TGA and POT, which have no mark, where 'type' is "tga" or "pot" (else it may be NULL).
 * NULL and *why: not readable, one phrase for a message. */
double *pov_image_heights(struct arena *a, const void *bytes, size_t n, const char *type, int *width, int *height, const char **why);

#endif
