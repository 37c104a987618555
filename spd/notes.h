/* What the SPD programs know of their scenes beyond what a scene holds, for the formats that say it: filled by the generators where
 * a scene's 'notes' ask for it, read by io/spd_pov.h. */
#ifndef SPD_NOTES_H
#define SPD_NOTES_H

#include "geom/matrix.h"
#include "scene/scene.h"

/* What a material has besides: the ambient factor, and a highlight of its own strength. */
struct spd_finish {
	double ambient, highlight;
};

enum spd_shape_kind { SPD_TORUS, SPD_DISC, SPD_HEIGHTS, SPD_PLACED };

/* Objects [first, first + count) of the scene are
 *   torus    about 'normal' through 'center': radius[0] of the ring, radius[1] of the tube
 *   disc     of radius[0]
 *   heights  n x n samples heights[i n + j], -1..1
 *   placed   objects moved by 'matrix': objects[count] and points[] as they were, first counted from points[0] */
struct spd_shape {
	enum spd_shape_kind kind;
	size_t first, count;
	struct vec center, normal;
	double radius[2];
	int n;
	float *heights;
	struct matrix matrix;
	struct object *objects;
	struct vec *points;
};

/* Zero-initialise to open, spd_notes_free to close. finishes[i] is material i's; those beyond finish_count have zeros. */
struct spd_notes {
	struct arena mem;
	struct spd_finish *finishes;
	struct spd_shape *shapes; /* in the order of the scene's objects */
	size_t finish_count, finish_room, shape_count, shape_room;
};

void spd_notes_free(struct spd_notes *n);

/* Each does nothing where the scene's notes are NULL, and sets s->lost when memory is out. */

/* Of the material added last. */
void spd_note_finish(struct scene *s, double ambient, double highlight);

/* The objects from number 'first' to the last one. */
void spd_note_torus(struct scene *s, size_t first, struct vec center, struct vec normal, double ring, double tube);
void spd_note_disc(struct scene *s, size_t first, struct vec center, struct vec normal, double radius);
void spd_note_heights(struct scene *s, size_t first, const float *heights, int n);

/* The objects from number 'first' on, before they are moved by m. */
void spd_note_placed(struct scene *s, size_t first, const struct matrix *m);

#endif
