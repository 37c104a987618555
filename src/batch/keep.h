/* What a run keeps beside its rows, when the job asks for it: FOLDER/KIND/NAME files, written whole or not at all. */
#ifndef BATCH_KEEP_H
#define BATCH_KEEP_H

#include "accel/accel.h"
#include "io/text.h"
#include "trace/render.h"

/* scenes/NAME.nff.gz; one of the same content stays. All: 0, or -1 and *e. */
int keep_scene(const char *folder, const char *name, const struct text *nff, struct err *e);

/* images/NAME.png, or NAME-NUMBER.png for a positive number. */
int keep_image(const char *folder, const char *name, size_t number, const struct rendering *image, const struct render_options *o,
               struct err *e);

/* drawings/NAME.dat (drawing.h); nothing for a scene that is too large to be drawn. */
int keep_drawing(const char *folder, const char *name, const struct accel *a, uint64_t seed, struct err *e);

#endif
