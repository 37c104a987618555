/* Where the primary rays of an image come from. */
#ifndef TRACE_CAMERA_H
#define TRACE_CAMERA_H

#include "geom/box.h"
#include "geom/ray.h"
#include "scene/scene.h"

/* A pinhole: the ray through image point (x, y) points along corner + x right + y down. parallel: it points along 'toward' and
 * starts at from + x right + y down. */
struct camera {
	struct vec from, corner, right, down, toward;
	bool parallel;
};

/* The scene's view, for an image of this shape: NFF's angle spans the height, pixels are square; a window's shape is its own. A scene without a view is seen
 * whole, from the corner (1, -2, 1) of its bounds. */
struct camera camera_make(const struct view *v, const struct box *bounds, double width, double height);

/* Where the ray through a point of the image starts. */
struct vec camera_origin(const struct camera *c, double x, double y);

/* Direction of length 1 through a point of the image: (0, 0) is the upper left corner, (1, 1) the lower right one. */
struct vec camera_direction(const struct camera *c, double x, double y);

#endif
