/* What tells a row from every other one, whatever its number: a hash of all that determines what is measured. */
#ifndef BATCH_ROW_KEY_H
#define BATCH_ROW_KEY_H

#include "batch/job.h"

uint64_t hash_bytes(const char *bytes, size_t count);

/* Of the format of rows, the options that mean something, the job's name and seed, the scene's name and family, its primitives (NULL: it
 * could not be had) and, for images, text_hash: hash_bytes of its text. */
uint64_t row_key(const struct job *job, const struct scene_spec *scene, const struct structure_spec *structure,
                 const struct measure_spec *measure, const struct primitives *p, uint64_t text_hash);

#endif
