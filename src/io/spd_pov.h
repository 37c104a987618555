/* POV-Ray scenes byte for byte as the SPD programs write them: -r 2, 3 and 4 for POV-Ray 1, 2 and 3. For anything else there is
 * io/pov_write.h. */
#ifndef IO_SPD_POV_H
#define IO_SPD_POV_H

#include "io/text.h"
#include "scene/scene.h"

/* Append a generated scene, with s->notes where it was asked for them. version: of POV-Ray, 1, 2 or 3. Kept as they are in the
 * originals: names of textures cut to six characters, so that they repeat from the 1000th on; in version 1 a disc that is moved,
 * and spheres at the wrong end of tapering cones. 0, or -1 and *e (memory). */
int spd_pov_write(const struct scene *s, int version, struct text *out, struct err *e);

/* The image 'spd_pov_image_name' that a scene with a height field refers to, as a Targa file; nothing where it refers to none. */
void spd_pov_image(const struct scene *s, struct text *out);

extern const char spd_pov_image_name[];

#endif
