/* A job file: which scenes, structures and measures to combine. A list of values is swept: the job holds every combination. */
#ifndef BATCH_JOB_H
#define BATCH_JOB_H

#include "accel/accel.h"
#include "base/arena.h"
#include "base/err.h"
#include "batch/measure.h"
#include "io/read.h"
#include "scene/primitives.h"
#include "spd/spd.h"

/* One scene: generated (family) or read (path). Texts live in the job's arena. */
struct scene_spec {
	const char *name;                 /* of one scene only in the job; names its file in scenes/ */
	const struct spd_family *family;  /* NULL: a file */
	const char *path;                 /* NULL: generated */
	struct spd_options spd;           /* generated: also the resolution of curves tessellated here */
	bool soup;
	struct read_options read;         /* of a file */
	int curves;                       /* enum curves */
};

/* R of curves that become triangles. */
int64_t scene_resolution(const struct scene_spec *s);

struct structure_spec {
	const struct accel_ops *ops;
	_Alignas(16) unsigned char options[ACCEL_OPT_MOST];
};

/* Scenes, structures and measures to combine: scenes[scene_first .. scene_first + scene_count) of the job, and so on. */
struct experiment {
	size_t scene_first, scene_count, structure_first, structure_count, measure_first, measure_count;
};

struct job {
	struct arena mem;
	const char *name, *text; /* text: of the file, for the manifest */
	int64_t seed;
	bool save_scenes, save_images, save_drawings;
	bool report; /* wanted at the end; the caller's business */
	struct scene_spec *scenes;
	struct structure_spec *structures;
	struct measure_spec *measures;
	struct experiment *experiments;
	size_t scene_count, structure_count, measure_count, experiment_count;
};

/* What the command line adds: settings "NAME=VALUE[,VALUE...]" override variables; many: more than 100,000 rows are meant;
 * allow_outside: scene files may lie outside the job file's folder. */
struct job_options {
	const char *const *settings;
	size_t setting_count;
	bool many, allow_outside;
};

/* What a job may come to, and what it may even where many are meant: keys and rows are held in memory. */
enum { JOB_ROWS_MOST = 100000, JOB_ROWS_MANY = 10000000 };

/* Fill *job (zeroed here) from the n bytes of a job file; 'path' names it in messages, and its folder is where scene files are looked
 * for. 0, or -1 and *e: every fault, up to 20, a line each. Free it in any case. */
int job_parse(struct job *job, const char *path, const char *bytes, size_t n, const struct job_options *o, struct err *e);

/* The same from the file itself. */
int job_read(struct job *job, const char *path, const struct job_options *o, struct err *e);

void job_free(struct job *job);

/* Combinations in all experiments; SIZE_MAX where they are more. */
size_t job_rows(const struct job *job);

#endif
