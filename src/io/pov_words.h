/* Words of POV-Ray's scene language, and the names a scene gives: each is known by one small number, so that readers compare
 * numbers only. The language's own words come first, WORD_NONE + 1 to WORD_COUNT - 1; names of the scene follow. */
#ifndef IO_POV_WORDS_H
#define IO_POV_WORDS_H

#include "base/arena.h"

#include <stdint.h>

/* One list serves the enum, the spelling and the table of names. */
#define POV_WORDS(X) \
	/* directives */ \
	X(include) X(declare) X(local) X(undef) X(if) X(ifdef) X(ifndef) X(elseif) X(else) X(end) X(while) X(for) X(switch) \
	X(case) X(range) X(break) X(macro) X(version) X(default) X(debug) X(warning) X(error) X(render) X(statistics) X(fopen) \
	X(fclose) X(read) X(write) X(append) X(deprecated) X(once) \
	/* constants */ \
	X(x) X(y) X(z) X(u) X(v) X(t) X(pi) X(true) X(false) X(on) X(off) X(yes) X(no) X(clock) X(clock_delta) X(clock_on) \
	X(image_width) X(image_height) X(frame_number) X(initial_frame) X(final_frame) X(initial_clock) X(final_clock) X(now) \
	/* colours */ \
	X(color) X(colour) X(rgb) X(rgbf) X(rgbt) X(rgbft) X(srgb) X(srgbf) X(srgbt) X(srgbft) X(red) X(green) X(blue) X(filter) \
	X(transmit) X(alpha) X(gray) X(grey) \
	/* functions of numbers */ \
	X(abs) X(ceil) X(floor) X(int) X(sqrt) X(exp) X(ln) X(log) X(sin) X(cos) X(tan) X(asin) X(acos) X(atan) X(sinh) X(cosh) \
	X(tanh) X(asinh) X(acosh) X(atanh) X(atan2) X(degrees) X(radians) X(pow) X(mod) X(div) X(min) X(max) X(sqr) X(select) \
	X(bitwise_and) X(bitwise_or) X(bitwise_xor) X(seed) X(rand) X(sum) X(prod) \
	/* of vectors, arrays, objects and strings */ \
	X(vlength) X(vdot) X(vcross) X(vnormalize) X(vrotate) X(vaxis_rotate) X(vturbulence) X(dimensions) X(dimension_size) \
	X(defined) X(inside) X(min_extent) X(max_extent) X(trace) X(strlen) X(asc) X(val) X(strcmp) \
	X(file_exists) X(concat) X(str) X(vstr) X(substr) X(strupr) X(strlwr) X(chr) X(datetime) \
	/* kinds of values */ \
	X(array) X(mixed) X(spline) X(function) X(internal) X(transform) X(inverse) X(pattern) \
	X(linear_spline) X(quadratic_spline) X(cubic_spline) X(natural_spline) X(bezier_spline) X(b_spline) \
	/* objects */ \
	X(sphere) X(box) X(cylinder) X(cone) X(torus) X(plane) X(disc) X(triangle) X(smooth_triangle) X(polygon) X(mesh) X(mesh2) \
	X(prism) X(lathe) X(sor) X(sphere_sweep) X(superellipsoid) X(blob) X(component) X(threshold) X(strength) X(quadric) X(poly) \
	X(cubic) X(quartic) X(height_field) X(bicubic_patch) X(text) X(ttf) X(isosurface) X(parametric) \
	X(julia_fractal) X(ovus) X(union) X(merge) X(intersection) X(difference) X(composite) X(object) X(light_source) X(light_group) \
	X(linear_sweep) X(conic_sweep) X(tolerance) X(type) X(flatness) X(u_steps) X(v_steps) X(smooth) X(water_level) \
	X(vertex_vectors) X(normal_vectors) X(uv_vectors) X(texture_list) X(face_indices) X(normal_indices) X(uv_indices) \
	X(inside_vector) X(contained_by) X(accuracy) X(max_gradient) X(evaluate) X(max_trace) X(all_intersections) X(precompute) \
	X(pot) X(png) X(tga) X(ppm) X(pgm) X(gif) X(jpeg) X(tiff) X(bmp) X(sys) X(exr) X(hdr) \
	X(iff) X(df3) X(charset) X(ascii) X(utf8) \
	/* modifiers */ \
	X(translate) X(scale) X(rotate) X(matrix) X(no_shadow) X(no_image) X(no_reflection) X(no_radiosity) X(hollow) \
	X(double_illuminate) X(sturm) X(hierarchy) X(cutaway_textures) X(split_union) X(open) X(clipped_by) X(bounded_by) \
	X(uv_mapping) \
	/* looks */ \
	X(texture) X(pigment) X(normal) X(finish) X(interior) X(interior_texture) X(material) X(media) X(density) X(photons) \
	X(radiosity) X(color_map) X(colour_map) X(pigment_map) X(texture_map) X(normal_map) X(slope_map) X(density_map) \
	X(image_map) X(bump_map) X(material_map) X(warp) X(ambient) X(diffuse) X(albedo) X(phong) X(phong_size) X(specular) X(roughness) \
	X(reflection) X(refraction) X(metallic) X(brilliance) X(emission) X(ior) X(quick_color) X(quick_colour) \
	/* scene */ \
	X(camera) X(global_settings) X(background) X(sky_sphere) X(fog) X(rainbow) X(atmosphere) X(max_intersections) X(max_trace_level) \
	X(perspective) X(orthographic) X(fisheye) X(ultra_wide_angle) X(omnimax) X(panoramic) X(spherical) X(mesh_camera) X(location) \
	X(direction) X(right) X(up) X(sky) X(look_at) X(angle) X(aperture) X(blur_samples) X(focal_point) X(variance) X(confidence) \
	X(spotlight) X(parallel) X(point_at) X(radius) X(falloff) X(tightness) X(area_light) X(adaptive) X(jitter) X(circular) X(orient) \
	X(shadowless) X(area_illumination) X(fade_distance) X(fade_power) X(fade_color) X(fade_colour) X(media_attenuation) \
	X(media_interaction) X(looks_like) X(projected_through) X(groups) X(global_lights)

enum pov_word {
	WORD_NONE,
#define X(word) WORD_##word,
	POV_WORDS(X)
#undef X
	WORD_COUNT
};

/* The table of names. mem: borrowed. text[id] is the spelling; text[0] is "". */
struct pov_names {
	struct arena *mem;
	const char **text;
	uint32_t count, room;
	uint32_t *slots; /* hash table of ids, 0 free; a power of two of them */
	uint32_t slot_count;
};

/* 0, or -1 when memory is out. */
int pov_names_open(struct pov_names *n, struct arena *mem);

/* The number of a word or name; new names are added. 0 when memory is out. */
uint32_t pov_name(struct pov_names *n, const char *text, size_t size);

#endif
