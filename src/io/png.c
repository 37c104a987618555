#include "io/png.h"

#include "io/text.h"

#include <png.h>
#include <stdlib.h>

int png_write_rgb(const char *path, const unsigned char *pixels, int width, int height, struct err *e)
{
	png_image image = { .version = PNG_IMAGE_VERSION, .width = (png_uint_32)width, .height = (png_uint_32)height,
		            .format = PNG_FORMAT_RGB };
	struct text file = { 0 };
	png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
	char *bytes = malloc(size);
	int status = bytes ? 0 : err_memory(e, "image");
	if (status == 0 && !png_image_write_to_memory(&image, bytes, &size, 0, pixels, 0, NULL))
		status = err_at(e, STATUS_ENVIRONMENT, path, 0, "%s", image.message);
	if (status == 0) {
		text_add(&file, bytes, size);
		status = file.lost ? err_memory(e, "image") : text_write_file(&file, path, e);
	}
	text_free(&file);
	free(bytes);
	return status;
}
