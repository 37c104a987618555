/* The Animated File Format of BART: NFF with meshes, textured triangles, included files and transforms; read as it stands still. */
#ifndef IO_AFF_H
#define IO_AFF_H

#include "io/nff.h"
#include "io/read.h"

/* As nff_read, with AFF's records besides:
 *
 *   fm ambient diffuse specular (r g b each) shine t ior     material: the diffuse colour, ks the largest specular component
 *   la name x y z [r g b]                light
 *   tt texture, then 3 times x y z u v   triangle;   ttp the same with x y z nx ny nz u v
 *   tpa times, then each: t and 3 times x y z nx ny nz       animated triangle: its first position
 *   m [vertices n ..] [normals n ..] [texturecoords n texture ..] triangles n ..   mesh; an index triple for each array there is
 *   xs sx sy sz rx ry rz degrees tx ty tz { .. }             scale, turn about an axis, move what is in the braces
 *   i file                               included, where include_read finds it; 16 deep, 1000 and 1 GiB in all at the most
 *
 * '#' and '%' start comments. Skipped and counted, or refused by a strict reader, since they say how things move or look:
 * a (animation), am (ambient light), d (detail level), k NAME {..} (key frames), and the name of x NAME {..}, whose content is read
 * where it is. A sphere or cone that an uneven scale deforms becomes triangles. */
int aff_read(struct scene *s, const char *name, const char *text, size_t n, const struct read_options *o,
             struct nff_skipped *skipped, struct err *e);

#endif
