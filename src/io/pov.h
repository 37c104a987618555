/* POV-Ray scene files, versions 1.0 to 3.8: the language is run, the objects' surfaces become triangles and spheres.
 *
 * Scenes are programs, so what they may use up is bounded. What cannot be meshed (noise, fractals, a font that is not there) is left
 * out and counted; textures are passed over except for their first colour and the finish. Coordinates and camera are kept as
 * they are written: POV-Ray's pictures of them are left-handed, and so is the view. */
#ifndef IO_POV_H
#define IO_POV_H

#include "io/pov_solid.h"
#include "io/text.h"

/* Where files named in a scene come from. load: append the content of the file at 'path' (gunzipped) to *t; 0, or -1: there is none.
 * match: the spelling in which a folder ("" or ending with '/') holds a name if case is ignored, into out[size]; false: none.
 * NULL functions: the file system. */
struct pov_access {
	int (*load)(void *context, const char *path, struct text *t);
	bool (*match)(void *context, const char *folder, const char *name, char *out, size_t size);
	void *context;
};

/* What no scene may exceed; exceeding one is an error that names it. */
struct pov_budget {
	size_t tokens;  /* read again in loops, macros and repeated inclusions, 2.5e8 */
	size_t rounds;  /* of loops, 1e7 */
	size_t objects; /* 1e7 */
	size_t bytes;   /* of memory while reading, 4e9 */
	int depth;      /* of inclusions and macros within each other, 200 */
};

struct pov_options {
	bool strict;                    /* refuse what POV-Ray 3.7 would refuse, and scenes with objects that cannot be meshed */
	const char *const *directories; /* searched for included files after the scene's own folder, in order; borrowed */
	size_t directory_count;
	double clock;
	int width, height; /* of the image, as the scene may ask */
	struct pov_access access;
	struct pov_budget budget;
	struct pov_mesh_options mesh;
};

/* Not strict, no directories but that of Debian's povray-includes, 800 x 600, the budgets above. */
struct pov_options pov_defaults(void);

/* What was read, skipped and approximated. */
struct pov_summary {
	struct pov_tally tally;
	size_t missing;   /* included files not found */
	size_t unknown;   /* results of functions that are not known here: noise, patterns, pigments */
	size_t ignored;   /* statements passed over because their word is unknown */
	char camera[32];  /* a kind of camera replaced by a perspective one, or empty */
	char reason[256]; /* the first of what was missing, unknown or ignored, with its place */
};

/* Fill an empty scene from n bytes of text. name: the file's path, for messages and to find its includes.
 * 0, or -1 and *e with "file:line: message" and where it was included or called from. */
int pov_read(struct scene *s, const char *name, const char *text, size_t n, const struct pov_options *o, struct pov_summary *summary,
             struct err *e);

/* Append the one line of the summary, without a newline:
 * "pov: objects 12, skipped 3 (julia_fractal 1, isosurface 2), approximated 1, missing includes 0, triangles 1000, spheres 2". */
void pov_summary_print(const struct pov_summary *s, struct text *out);

#endif
