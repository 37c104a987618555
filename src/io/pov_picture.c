/* PNG by libpng, JPEG by libjpeg where it was there at build. */
#include "io/pov_picture.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#ifdef HAVE_JPEG
#include <stdio.h>

#include <jpeglib.h>
#endif

enum { PIXELS_MOST = 1 << 26 };

bool picture_open(struct picture *p, uint64_t width, uint64_t height)
{
	if (width < 2 || height < 2 || width > PIXELS_MOST / height)
		return false;
	p->width = (int)width;
	p->height = (int)height;
	p->heights = NEW(p->mem, double, (size_t)(width * height));
	return p->heights;
}

void picture_put(struct picture *p, int x, int row, double height)
{
	p->heights[(size_t)(p->height - 1 - row) * (size_t)p->width + (size_t)x] = height;
}

double picture_height_of_color(unsigned red, unsigned green)
{
	return (256 * red + green) / 65535.0;
}

/* PNG. */

static void png_bytes(png_structp png, png_bytep to, size_t n)
{
	struct picture *p = png_get_io_ptr(png);
	if ((size_t)(p->end - p->at) < n)
		png_error(png, "truncated");
	memcpy(to, p->at, n);
	p->at += n;
}

static void png_quiet(png_structp png, png_const_charp text)
{
	(void)png;
	(void)text;
}

static void png_leave(png_structp png, png_const_charp text)
{
	(void)text;
	png_longjmp(png, 1);
}

static void png_row(struct picture *p, int row, const unsigned char *b, int color, int depth)
{
	for (int x = 0; x < p->width; x++) {
		if (color == PNG_COLOR_TYPE_PALETTE)
			picture_put(p, x, row, b[x] / 255.0);
		else if (color == PNG_COLOR_TYPE_GRAY)
			picture_put(p, x, row, depth == 16 ? (b[2 * x] * 256 + b[2 * x + 1]) / 65535.0 : b[x] / 255.0);
		else
			picture_put(p, x, row, depth == 16 ? picture_height_of_color(b[6 * x], b[6 * x + 2]) : picture_height_of_color(b[3 * x], b[3 * x + 1]));
	}
}

static bool read_png_rows(struct picture *p, png_structp png, png_infop info, unsigned char **rows)
{
	if (setjmp(png_jmpbuf(png)))
		return false;
	png_set_read_fn(png, p, png_bytes);
	png_read_info(png, info);
	png_set_strip_alpha(png);
	png_set_packing(png);
	if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8)
		png_set_expand_gray_1_2_4_to_8(png);
	png_set_interlace_handling(png);
	png_read_update_info(png, info);
	size_t bytes = png_get_rowbytes(png, info);
	if (!picture_open(p, png_get_image_width(png, info), png_get_image_height(png, info)))
		return false;
	*rows = malloc((size_t)p->height * (bytes + sizeof(png_bytep)));
	if (!*rows)
		return false;
	png_bytep *row = (png_bytep *)(void *)*rows;
	for (int y = 0; y < p->height; y++)
		row[y] = *rows + (size_t)p->height * sizeof *row + (size_t)y * bytes;
	png_read_image(png, row);
	for (int y = 0; y < p->height; y++)
		png_row(p, y, row[y], png_get_color_type(png, info), png_get_bit_depth(png, info));
	return true;
}

bool picture_read_png(struct picture *p)
{
	unsigned char *rows = NULL;
	png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, png_leave, png_quiet);
	png_infop info = png ? png_create_info_struct(png) : NULL;
	bool done = info && read_png_rows(p, png, info, &rows);
	if (png)
		png_destroy_read_struct(&png, info ? &info : NULL, NULL);
	free(rows);
	return done;
}

/* JPEG. */

#ifdef HAVE_JPEG

struct jpeg_fault {
	struct jpeg_error_mgr manager;
	jmp_buf out;
};

static void jpeg_leave(j_common_ptr j)
{
	longjmp(((struct jpeg_fault *)(void *)j->err)->out, 1);
}

static void jpeg_quiet(j_common_ptr j, int level)
{
	(void)j;
	(void)level;
}

bool picture_read_jpeg(struct picture *p)
{
	struct jpeg_decompress_struct j = { 0 };
	struct jpeg_fault fault;
	j.err = jpeg_std_error(&fault.manager);
	fault.manager.error_exit = jpeg_leave;
	fault.manager.emit_message = jpeg_quiet;
	if (setjmp(fault.out)) {
		jpeg_destroy_decompress(&j);
		return false;
	}
	jpeg_create_decompress(&j);
	jpeg_mem_src(&j, p->at, (unsigned long)(p->end - p->at));
	jpeg_read_header(&j, TRUE);
	j.out_color_space = j.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
	jpeg_start_decompress(&j);
	bool gray = j.output_components == 1, done = picture_open(p, j.output_width, j.output_height);
	JSAMPARRAY row = done ? j.mem->alloc_sarray((j_common_ptr)&j, JPOOL_IMAGE, j.output_width * (unsigned)j.output_components, 1) : NULL;
	for (int y = 0; done && y < p->height; y++) {
		jpeg_read_scanlines(&j, row, 1);
		for (int x = 0; x < p->width; x++)
			picture_put(p, x, y, gray ? row[0][x] / 255.0 : picture_height_of_color(row[0][3 * x], row[0][3 * x + 1]));
	}
	jpeg_destroy_decompress(&j);
	return done;
}

#else

bool picture_read_jpeg(struct picture *p)
{
	(void)p;
	return false;
}

#endif
