/// Looking at figures in tests: pixels of a PNG, well-formedness of an SVG, a scratch folder.
#ifndef VIEW_TESTING_H
#define VIEW_TESTING_H

#include "testing.h"

#include "io_scratch.h"

#include "view/colour.h"

#include <cairo.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static inline char *read_whole(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("there is no %s", path);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)size, file), (size_t)size);
    text[size] = '\0';
    fclose(file);
    return text;
}

typedef struct picture {
    cairo_surface_t *surface;
    int width, height;
} picture;

static inline picture picture_read(const char *path)
{
    picture p = {.surface = cairo_image_surface_create_from_png(path)};
    assert_int_equal(cairo_surface_status(p.surface), CAIRO_STATUS_SUCCESS);
    p.width = cairo_image_surface_get_width(p.surface);
    p.height = cairo_image_surface_get_height(p.surface);
    return p;
}

/// 0xRRGGBB.
static inline uint32_t picture_pixel(const picture *p, int x, int y)
{
    const unsigned char *row =
        cairo_image_surface_get_data(p->surface) + y * cairo_image_surface_get_stride(p->surface);
    uint32_t pixel;
    memcpy(&pixel, row + 4 * x, sizeof pixel);
    return pixel & 0xffffff;
}

/// Part of the pixels that are not white, from every third in each direction.
static inline double picture_ink(const picture *p)
{
    size_t dark = 0, all = 0;
    for (int y = 0; y < p->height; y += 3)
        for (int x = 0; x < p->width; x += 3, all++) dark += picture_pixel(p, x, y) != 0xffffff;
    return (double)dark / (double)all;
}

/// Colours are stored in 8 bits, and rounding is up to the library.
static inline bool is_colour(uint32_t pixel, scree_colour colour)
{
    return fabs((pixel >> 16) - 255 * colour.red) <= 1 && fabs((pixel >> 8 & 255) - 255 * colour.green) <= 1 &&
           fabs((pixel & 255) - 255 * colour.blue) <= 1;
}

/// Width and height of the box around all pixels of this colour in the left `part` of the picture.
static inline void picture_extent(const picture *p, scree_colour colour, double part, int *width, int *height)
{
    int low_x = p->width, high_x = -1, low_y = p->height, high_y = -1;
    for (int y = 0; y < p->height; y++)
        for (int x = 0; x < part * p->width; x++) {
            if (!is_colour(picture_pixel(p, x, y), colour)) continue;
            low_x = x < low_x ? x : low_x;
            high_x = x > high_x ? x : high_x;
            low_y = y < low_y ? y : low_y;
            high_y = y > high_y ? y : high_y;
        }
    *width = high_x - low_x + 1;
    *height = high_y - low_y + 1;
}

/// What a non-validating XML reader demands of elements, attributes and entities. NULL, or what is wrong.
static inline const char *xml_problem(const char *text)
{
    const char *open[64];
    size_t depth = 0, elements = 0;
    for (const char *c = text; *c; c++) {
        if (*c == '&') {
            const char *end = strchr(c, ';');
            if (!end || end - c > 8 || end == c + 1) return "bare ampersand";
        }
        if (*c != '<') continue;
        if (strncmp(c, "<!--", 4) == 0) c = strstr(c, "-->");
        if (strncmp(c, "<![CDATA[", 9) == 0) c = strstr(c, "]]>");
        if (!c) return "comment or CDATA without end";
        if (*c != '<') continue;
        bool closing = c[1] == '/', other = c[1] == '?' || c[1] == '!', quoted = false;
        const char *name = c + 1 + closing, *end = c + 1;
        char quote = 0;
        for (; *end && (quoted || *end != '>'); end++) {
            if (quoted ? *end == quote : *end == '"' || *end == '\'') {
                quote = *end;
                quoted = !quoted;
            } else if (*end == '<') {
                return "< inside a tag";
            }
        }
        if (!*end) return "tag without end";
        size_t length = strcspn(name, " \t\r\n/>");
        if (closing) {
            if (depth == 0 || strncmp(open[depth - 1], name, length) != 0) return "end tag of another element";
            depth--;
        } else if (!other) {
            elements++;
            if (end[-1] != '/' && depth < sizeof open / sizeof open[0]) open[depth++] = name;
        }
        c = end;
    }
    return depth > 0 ? "element without end" : elements == 0 ? "no element" : NULL;
}

static inline void assert_well_formed(const char *path)
{
    char *text = read_whole(path);
    const char *problem = xml_problem(text);
    if (problem) fail_msg("%s: %s", path, problem);
    assert_non_null(strstr(text, "<svg"));
    free(text);
}

/// NAME.svg and NAME.png are there, the one well-formed, the other large enough and neither blank nor full.
static inline void assert_figure(const char *name)
{
    char path[300];
    (void)snprintf(path, sizeof path, "%s.svg", name);
    assert_well_formed(path);
    (void)snprintf(path, sizeof path, "%s.png", name);
    picture p = picture_read(path);
    assert_true((p.width > p.height ? p.width : p.height) >= 1600);
    double ink = picture_ink(&p);
    if (ink < 0.002 || ink > 0.9) fail_msg("%s: %.2f %% of the pixels are not white", path, 100 * ink);
    cairo_surface_destroy(p.surface);
}

#endif
