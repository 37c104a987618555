/* A camera that flies: through places given in a text, evenly in time, along a smooth curve. */
#ifndef TRACE_FLIGHT_H
#define TRACE_FLIGHT_H

#include "base/err.h"
#include "scene/scene.h"

enum { FLIGHT_PLACES = 64 };

/* Where the camera stands, and what it looks at. */
struct flight {
	int count;
	struct vec from[FLIGHT_PLACES], at[FLIGHT_PLACES];
};

/* Read "x y z to x y z, ...": places and what is looked at from each; NULL: none. 0, or -1 and *e (STATUS_INPUT, no place): not of this
 * form, more than FLIGHT_PLACES, looking at where it stands. */
int flight_parse(struct flight *f, const char *text, struct err *e);

/* Put the camera where it is at time t of the flight, 0 to 1, which has a place at least: between two places a cubic whose slopes there
 * follow from their neighbours (Catmull and Rom 1974). The other settings of the view stay. */
void flight_place(const struct flight *f, double t, struct view *v);

#endif
