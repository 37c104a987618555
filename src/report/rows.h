/* Which rows of counts.csv belong to which figure and statement, and what they are called there. */
#ifndef REPORT_ROWS_H
#define REPORT_ROWS_H

#include "report/table.h"

/* Find out what tells ordinary rows of random rays from those that are there to show convergence: the latter have fewer rays than
 * 200,000, or than the most there are if that is less. Call it once. 0, or -1 and *e (memory). */
int rows_prepare(struct table *t, struct err *e);

/* Ordinary rows of random rays in octrees split for what they list. */
bool rows_is_random_rays(const struct table *t, size_t row);

/* A row of few random rays, or the ordinary one of the same tree. */
bool rows_is_convergence(const struct table *t, size_t row);

/* Images: in octrees split for what they list, in random octrees, in either. */
bool rows_is_image(const struct table *t, size_t row);
bool rows_is_image_by_chance(const struct table *t, size_t row);
bool rows_is_image_of_any_tree(const struct table *t, size_t row);

/* A wall model seen from outside: the camera keyword is part of the scene's name where it is not that. */
bool rows_is_wall_outside(const struct table *t, size_t row);

/* The scene's family, its name, and what the paper gave a mark of its own: tetra's sizes, which are different surfaces, other
 * families as one, cameras apart. */
void rows_name_family(const struct table *t, size_t row, char *out, size_t size);
void rows_name_scene(const struct table *t, size_t row, char *out, size_t size);
void rows_name_surface(const struct table *t, size_t row, char *out, size_t size);

#endif
