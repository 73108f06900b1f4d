/// Pages through Cairo: an SVG surface and an image surface get the same drawing calls. Files are written aside and
/// renamed (io/run_directory.h), so a full disk leaves no torn figure.
#include "view/page.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/font.h"
#include "view/png_file.h"

#include <scree/scree.h>

#include <cairo-svg.h>
#include <limits.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static atomic_int chosen; ///< long side of PNG files; 0: the standard one

int scree_page_chosen_pixels(void)
{
    return atomic_load_explicit(&chosen, memory_order_relaxed);
}

scree_status scree_figure_pixels_choose(const char *text, scree_error *error)
{
    enum { SMALLEST = 200, LARGEST = 20000 };
    char *end = NULL;
    const long pixels = text ? strtol(text, &end, 10) : 0;
    if (text && (end == text || *end || pixels < SMALLEST || pixels > LARGEST))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "long side of PNG figures '%s': expected a whole number of pixels, %d to %d", text,
                               SMALLEST, LARGEST);
    atomic_store_explicit(&chosen, (int)pixels, memory_order_relaxed);
    return SCREE_OK;
}

/// Long side of the PNG of a page. A page that has pixels of its own (a frame of a movie) keeps them.
static int page_pixels(const scree_page *page)
{
    const int asked = scree_page_chosen_pixels();
    return page->pixels > 0 ? page->pixels : asked > 0 ? asked : SCREE_PAGE_PIXELS;
}

static cairo_status_t append(void *file, const unsigned char *data, unsigned int length)
{
    return fwrite(data, 1, length, file) == length ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_status_t draw_svg(FILE *file, const scree_page *page)
{
    cairo_surface_t *surface = cairo_svg_surface_create_for_stream(append, file, page->width, page->height);
    cairo_t *cairo = cairo_create(surface);
    page->draw(cairo, page->user);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    if (!status) status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    return status;
}

static cairo_status_t draw_png(FILE *file, const scree_page *page)
{
    double scale = page_pixels(page) / fmax(page->width, page->height);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)lround(page->width * scale),
                                                          (int)lround(page->height * scale));
    cairo_t *cairo = cairo_create(surface);
    cairo_scale(cairo, scale, scale);
    page->draw(cairo, page->user);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    if (!status) status = scree_png_write(file, surface);
    cairo_surface_destroy(surface);
    return status;
}

/// Bytes that Cairo (1.16) may take for a page whose largest shape has `marks` discs: the pixels of the PNG, fonts, and
/// the edges of that shape, which are cut into pieces of some pixels. Discs that fill a page have a rim of sqrt(marks)
/// pages; measured were 0.5 MB of that and 5 kB a disc.
static size_t page_bytes(const scree_page *page)
{
    enum { PIXEL = 4, LIBRARY = 8 << 20, RIM = 700 << 10, MARK = 6 << 10 };
    const size_t side = (size_t)page_pixels(page), marks = page->marks;
    return PIXEL * side * side + LIBRARY + (size_t)(RIM * sqrt((double)marks)) + MARK * marks;
}

typedef cairo_status_t render(FILE *file, const scree_page *page);

static scree_status write_one(const char *path, const char *extension, render *renderer, const scree_page *page,
                              scree_error *error)
{
    char name[PATH_MAX];
    FILE *file;
    if (snprintf(name, sizeof name, "%s.%s", path, extension) >= (int)sizeof name)
        return scree_error_set(error, SCREE_ERROR_IO, "the path of the figure '%s' is too long", path);
    // Where it cannot have memory for edges, Cairo jumps to a place on the stack that it has left.
    scree_status status = scree_memory_check(page_bytes(page), error);
    if (!status) status = scree_replace_begin(name, &file, error);
    if (status) return status;
    cairo_status_t cairo_status = renderer(file, page);
    scree_memory_trim();
    status = scree_replace_finish(name, file, cairo_status == CAIRO_STATUS_SUCCESS, error);
    if (cairo_status)
        status = scree_error_set(error, SCREE_ERROR_IO, "cannot draw the figure '%s': %s", name,
                                 cairo_status_to_string(cairo_status));
    return status;
}

scree_status scree_page_write(const char *path, const scree_page *page, scree_error *error)
{
    scree_status status = page->pixels > 0 ? SCREE_OK : write_one(path, "svg", draw_svg, page, error);
    return status ? status : write_one(path, "png", draw_png, page, error);
}

void scree_page_colour(cairo_t *cairo, scree_colour colour)
{
    cairo_set_source_rgb(cairo, colour.red, colour.green, colour.blue);
}

static void select_font(cairo_t *cairo, scree_text_style style)
{
    // Without hinting a text is equally wide on both surfaces.
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(cairo, SCREE_FONT, CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, style.size);
}

double scree_text_width(cairo_t *cairo, const char *text, scree_text_style style)
{
    cairo_text_extents_t extents;
    select_font(cairo, style);
    cairo_text_extents(cairo, text, &extents);
    return extents.x_advance;
}

void scree_text_show(cairo_t *cairo, double x, double y, double anchor, const char *text, scree_text_style style)
{
    double width = scree_text_width(cairo, text, style);
    scree_page_colour(cairo, style.colour);
    cairo_move_to(cairo, x - anchor * width, y);
    cairo_show_text(cairo, text);
    cairo_new_path(cairo);
}

/// Number of bytes of `text` that go on one line: up to the last space that fits, at least one word. A number keeps its
/// percent sign.
static size_t line_length(cairo_t *cairo, const char *text, double width, scree_text_style style)
{
    char line[1024];
    size_t fitting = 0, end = 0;
    while (text[end]) {
        end += strspn(text + end, " ");
        end += strcspn(text + end, " ");
        if (strncmp(text + end, " %", 2) == 0) end += 1 + strcspn(text + end + 1, " ");
        if (end >= sizeof line) break;
        memcpy(line, text, end);
        line[end] = '\0';
        if (fitting > 0 && scree_text_width(cairo, line, style) > width) break;
        fitting = end;
    }
    return fitting > 0 ? fitting : end;
}

double scree_text_paragraph(cairo_t *cairo, double x, double y, double width, const char *text, scree_text_style style)
{
    char line[1024];
    while (*text) {
        size_t length = line_length(cairo, text, width, style);
        size_t kept = length < sizeof line ? length : sizeof line - 1;
        memcpy(line, text, kept);
        line[kept] = '\0';
        y += 1.25 * style.size;
        scree_text_show(cairo, x, y - 0.25 * style.size, 0, line, style);
        text += length;
        text += strspn(text, " ");
    }
    return y;
}

/// Bytes of the UTF-8 character at `text`, 0 when it is none (RFC 3629: no overlong forms, no surrogates).
static size_t character_length(const unsigned char *text)
{
    if (text[0] < 0x80) return 1;
    size_t length = text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
    if (text[0] < 0xc2 || text[0] > 0xf4) return 0;
    for (size_t k = 1; k < length; k++)
        if ((text[k] & 0xc0) != 0x80) return 0;
    bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    bool outside = (text[0] == 0xed && text[1] > 0x9f) || (text[0] == 0xf4 && text[1] > 0x8f);
    return overlong || outside ? 0 : length;
}

void scree_text_clean(char *out, size_t size, const char *text)
{
    size_t used = 0;
    while (*text) {
        size_t length = character_length((const unsigned char *)text);
        if (used + (length ? length : 1) >= size) break;
        bool space = strchr(" \t\n\r\v\f", *text) != NULL;
        bool control = (unsigned char)*text < 0x20 || *text == 0x7f || length == 0;
        if (space || control)
            out[used++] = space ? ' ' : '?';
        else
            for (size_t k = 0; k < length; k++) out[used++] = text[k];
        text += length ? length : 1;
    }
    out[used] = '\0';
}
