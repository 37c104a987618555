/* A job file being read: what job.c and job_scenes.c share. */
#ifndef BATCH_JOB_READER_H
#define BATCH_JOB_READER_H

#include "batch/job.h"
#include "batch/values.h"

/* A job being read. 'scene', 'structure' and 'measure' are what the sweep at hand fills in. */
struct job_reader {
	struct job *job;
	struct values values;
	const struct job_options *options;
	const char *folder; /* of the job file, with the slash, or "" */
	long line;          /* of the scene or the measure at hand */
	struct key keys[40]; /* of the scene family at hand */
	struct scene_spec scene;
	struct structure_spec structure;
	struct measure_spec measure;
	size_t scene_room, structure_room, measure_room, experiment_room;
	struct experiment experiment; /* at hand */
};

/* Append a copy of 'item' to an array of the job. 0, or -1 after a fault: too many, memory. */
int job_append(struct job_reader *r, void **array, size_t *count, size_t *room, const void *item, size_t size);

/* One entry of 'scenes', every combination of its lists. 0, or -1 after a fault. */
int job_read_scene(struct job_reader *r, const struct yaml_node *entry);

#endif
