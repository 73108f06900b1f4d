/// PNG files of pictures.
#include "view/png_file.h"

#include <png.h>
#include <stdbool.h>
#include <stdint.h>

enum { EIGHT_BITS = 8, PACKING = 4 }; ///< PACKING: level of zlib, 1 quick to 9 small

/// Words of a pixel are 0x00RRGGBB: their bytes are in the order of the machine.
static void tell_order(png_structp png)
{
    const uint32_t word = 1;
    const bool low_first = *(const unsigned char *)&word == 1;
    png_set_filler(png, 0, low_first ? PNG_FILLER_AFTER : PNG_FILLER_BEFORE);
    if (low_first) png_set_bgr(png);
}

cairo_status_t scree_png_write(FILE *file, cairo_surface_t *surface)
{
    const int columns = cairo_image_surface_get_width(surface), rows = cairo_image_surface_get_height(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    cairo_surface_flush(surface);
    const unsigned char *pixels = cairo_image_surface_get_data(surface);
    if (!info || !pixels) {
        png_destroy_write_struct(&png, NULL);
        return CAIRO_STATUS_NO_MEMORY;
    }
    if (setjmp(png_jmpbuf(png))) { // NOLINT: how libpng says that it failed
        png_destroy_write_struct(&png, &info);
        return CAIRO_STATUS_WRITE_ERROR;
    }
    png_init_io(png, file);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_level(png, PACKING);
    png_set_IHDR(png, info, (png_uint_32)columns, (png_uint_32)rows, EIGHT_BITS, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    tell_order(png);
    for (int k = 0; k < rows; k++) png_write_row(png, pixels + (size_t)k * (size_t)stride);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return CAIRO_STATUS_SUCCESS;
}
