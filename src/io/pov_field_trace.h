/* Rays that meet blobs and isosurfaces themselves, not their meshes. */
#ifndef IO_POV_FIELD_TRACE_H
#define IO_POV_FIELD_TRACE_H

#include "io/pov_term.h"

/* Whether rays can meet a resolved solid so: there is a blob or an isosurface in it, and all else in it are spheres, planes and boxes.
 * *room: the numbers of working space they need. */
bool pov_field_traceable(const struct pov_term *t, size_t *room);

/* See pov_solid_trace; toward: unit. */
bool pov_field_trace(const struct pov_term *t, struct vec from, struct vec toward, double *room, struct vec *at, struct vec *normal);

#endif
