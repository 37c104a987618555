/* Neutral File Format (Eric Haines), both ways. */
#ifndef IO_NFF_H
#define IO_NFF_H

#include "base/err.h"
#include "io/text.h"
#include "scene/scene.h"

/* Append the scene to 'out' byte for byte as the SPD programs print it: background, view, lights, then materials and objects in
 * order, numbers as %g with 'digits' significant digits (6: as SPD; 17: the fewest that read back as the same double).
 * Neighbouring corners of a polygon nearer than 1e-6 are merged as SPD does when digits is 6. 0, or -1 and *e (memory). */
int nff_write(const struct scene *s, int digits, struct text *out, struct err *e);

/* Copy a polygon's n corners to 'kept' without those nearer than 1e-6 to the next one, as SPD does; returns how many are left. */
size_t nff_clean_corners(const struct vec *corners, size_t n, struct vec *kept);

/* Tallies of what a tolerant reader passed over; first_line is where it happened first. */
struct nff_skipped {
	uint32_t records, first_line;
};

/* Fill an empty scene from n bytes of NFF text. name: the file's, for messages. strict: unknown keywords and other oddities are
 * errors; else they are skipped and counted in *skipped. 0, or -1 and *e with "name:line: message". */
int nff_read(struct scene *s, const char *name, const char *text, size_t n, bool strict, struct nff_skipped *skipped,
             struct err *e);

/* Whether the text starts with an NFF keyword. */
bool nff_is(const char *text, size_t n);

#endif
