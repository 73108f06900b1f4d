/// Maps of fields on grids.
#include "view/map.h"

#include "view/page.h"

#include <math.h>
#include <stdio.h>

enum { MOST_LINES = 1500 };

#define WIDTH      430.0 /* pt, of the map at most */
#define HEIGHT     330.0
#define LEFT       58.0
#define TOP        42.0
#define BELOW      44.0
#define MARGIN     12.0
#define LEGEND     118.0
#define BAR_WIDTH  11.0
#define BAR_HEIGHT 150.0
#define BAR_LOWEST 40.0 /* of a map that is lower the bar reaches below it */

static const scree_colour ink = {0.13, 0.13, 0.15}, quiet = {0.45, 0.45, 0.48};

typedef struct drawing {
    const scree_map *map;
    scree_limits limits;
    double scale; ///< pt per m
    double width, height;
    scree_colour_map colours;
    bool below_zero; ///< the strong end of the colours is the low one
} drawing;

static double page_x(const drawing *d, double x)
{
    return LEFT + (x - d->map->low[0]) * d->scale;
}

static double page_y(const drawing *d, double y)
{
    return TOP + (d->map->high[1] - y) * d->scale;
}

static scree_text_style text_of(double size)
{
    return (scree_text_style){.size = size, .colour = ink};
}

/// Colour of a place between the limits, 0 to 1.
static scree_colour colour_at(const drawing *d, double part)
{
    return scree_colour_at(d->colours, d->below_zero ? 1 - part : part);
}

static void draw_cells(const drawing *d, cairo_t *cairo)
{
    const scree_map *map = d->map;
    const double dx = d->width / (double)map->columns, dy = d->height / (double)map->rows;
    // A seam of the background would show between rectangles that end within a pixel.
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
    for (size_t k = 0; k < map->columns * map->rows; k++) {
        if (!isfinite(map->value[k])) continue;
        const double part = (map->value[k] - d->limits.low) / (d->limits.high - d->limits.low);
        const size_t i = k % map->columns, j = k / map->columns;
        scree_page_colour(cairo, colour_at(d, part));
        cairo_rectangle(cairo, LEFT + (double)i * dx, TOP + d->height - (double)(j + 1) * dy, dx, dy);
        cairo_fill(cairo);
    }
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_DEFAULT);
}

/// How many of `count` have a line, when the middle one of each `gap` of them has.
static size_t lines_of(size_t count, size_t gap)
{
    return (count + gap - 1 - gap / 2) / gap;
}

/// Columns and rows of the rectangles that share a line: one where that leaves no more than MOST_LINES, else those of
/// blocks that are nearly square.
static void find_gaps(const drawing *d, size_t gap[2])
{
    const size_t count[2] = {d->map->columns, d->map->rows};
    const double size[2] = {d->width, d->height};
    double side = 0;
    for (gap[0] = gap[1] = 1; lines_of(count[0], gap[0]) * lines_of(count[1], gap[1]) > MOST_LINES;) {
        side = side > 0 ? 1.02 * side : sqrt(size[0] * size[1] / MOST_LINES);
        for (int k = 0; k < 2; k++) gap[k] = (size_t)fmin((double)count[k], ceil(side * (double)count[k] / size[k]));
    }
}

static void draw_lines(const drawing *d, cairo_t *cairo)
{
    const scree_map *map = d->map;
    const double dx = d->width / (double)map->columns, dy = d->height / (double)map->rows;
    size_t gap[2];
    if (!map->axis) return;
    find_gaps(d, gap);
    cairo_save(cairo);
    cairo_rectangle(cairo, LEFT, TOP, d->width, d->height);
    cairo_clip(cairo);
    cairo_set_line_width(cairo, 0.9);
    scree_page_colour(cairo, ink);
    for (size_t j = gap[1] / 2; j < map->rows; j += gap[1])
        for (size_t i = gap[0] / 2; i < map->columns; i += gap[0]) {
            const size_t k = j * map->columns + i;
            if (!isfinite(map->value[k]) || !isfinite(map->axis[k])) continue;
            const double room = fmin(dx * (double)gap[0], dy * (double)gap[1]);
            const double half = 0.45 * room * (map->length ? fmax(0, fmin(1, map->length[k])) : 1);
            const double x = LEFT + ((double)i + 0.5) * dx, y = TOP + d->height - ((double)j + 0.5) * dy;
            cairo_move_to(cairo, x - half * cos(map->axis[k]), y + half * sin(map->axis[k]));
            cairo_line_to(cairo, x + half * cos(map->axis[k]), y - half * sin(map->axis[k]));
        }
    cairo_stroke(cairo);
    cairo_restore(cairo);
}

/// Ticks in millimetres along both axes.
static void draw_axes(const drawing *d, cairo_t *cairo)
{
    const scree_map *map = d->map;
    scree_page_colour(cairo, ink);
    cairo_set_line_width(cairo, 0.7);
    cairo_rectangle(cairo, LEFT, TOP, d->width, d->height);
    cairo_stroke(cairo);
    for (int axis = 0; axis < 2; axis++) {
        const scree_ticks ticks = scree_ticks_make(1e3 * map->low[axis], 1e3 * map->high[axis]);
        // A low map has room for few numbers beside it.
        const int every = axis == 1 && d->height < 12.0 * ticks.count ? 2 : 1;
        for (int k = 0; k < ticks.count; k += every) {
            const double at = 1e-3 * ticks.value[k];
            const double x = axis == 0 ? page_x(d, at) : LEFT, y = axis == 0 ? TOP + d->height : page_y(d, at);
            scree_page_colour(cairo, ink);
            cairo_move_to(cairo, x, y);
            cairo_line_to(cairo, axis == 0 ? x : x - 4, axis == 0 ? y + 4 : y);
            cairo_stroke(cairo);
            scree_text_show(cairo, axis == 0 ? x : x - 6, axis == 0 ? y + 14 : y + 3, axis == 0 ? 0.5 : 1,
                            ticks.text[k], text_of(8.5));
        }
    }
    scree_text_show(cairo, LEFT + 0.5 * d->width, TOP + d->height + 30, 0.5, "x (mm)", text_of(9));
    cairo_save(cairo);
    cairo_translate(cairo, 14, TOP + 0.5 * d->height);
    cairo_rotate(cairo, -M_PI / 2);
    scree_text_show(cairo, 0, 0, 0.5, "height (mm)", text_of(9));
    cairo_restore(cairo);
}

/// Returns the y below its last line.
static double draw_bar(const drawing *d, cairo_t *cairo)
{
    const double x = LEFT + d->width + 22,
                 below = scree_text_paragraph(cairo, x, TOP - 2, LEGEND - 22, d->map->name, text_of(9));
    const scree_ticks ticks = scree_ticks_make(d->limits.low, d->limits.high);
    const double top = below + (ticks.factor[0] ? 20 : 8),
                 bottom = top + fmin(BAR_HEIGHT, fmax(BAR_LOWEST, TOP + d->height - top));
    cairo_pattern_t *pattern = cairo_pattern_create_linear(0, bottom, 0, top);
    for (int k = 0; k <= 48; k++) {
        const scree_colour c = colour_at(d, k / 48.0);
        cairo_pattern_add_color_stop_rgb(pattern, k / 48.0, c.red, c.green, c.blue);
    }
    cairo_rectangle(cairo, x, top, BAR_WIDTH, bottom - top);
    cairo_set_source(cairo, pattern);
    cairo_fill_preserve(cairo);
    cairo_pattern_destroy(pattern);
    scree_page_colour(cairo, ink);
    cairo_set_line_width(cairo, 0.6);
    cairo_stroke(cairo);
    for (int k = 0; k < ticks.count; k++) {
        const double y = bottom + (ticks.value[k] - d->limits.low) / (d->limits.high - d->limits.low) * (top - bottom);
        scree_text_show(cairo, x + BAR_WIDTH + 5, y + 3, 0, ticks.text[k], text_of(8.5));
    }
    char text[160], smallest[64], largest[64];
    if (ticks.factor[0]) {
        (void)snprintf(text, sizeof text, "× %s", ticks.factor);
        scree_text_show(cairo, x, top - 7, 0, text, text_of(8.5));
    }
    scree_number_text(smallest, sizeof smallest, d->limits.smallest, 3);
    scree_number_text(largest, sizeof largest, d->limits.largest, 3);
    (void)snprintf(text, sizeof text, "values from %s to %s", smallest, largest);
    return scree_text_paragraph(cairo, x, bottom + 6, LEGEND - 22, text,
                                (scree_text_style){.size = 7, .colour = quiet});
}

static void draw_page(cairo_t *cairo, void *user)
{
    const drawing *d = user;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    scree_text_show(cairo, 12, 22, 0, d->map->title, (scree_text_style){.size = 11, .bold = true, .colour = ink});
    draw_cells(d, cairo);
    draw_lines(d, cairo);
    draw_axes(d, cairo);
    (void)draw_bar(d, cairo);
}

/// The bar is drawn once on paper that is thrown away, to learn where it ends.
static double bar_end(const drawing *d)
{
    cairo_surface_t *paper = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cairo = cairo_create(paper);
    const double end = draw_bar(d, cairo);
    cairo_destroy(cairo);
    cairo_surface_destroy(paper);
    return end;
}

/// Half of a diverging scale would not be used by values of one sign, but for the few that lie beyond the limits.
static scree_status find_colours(drawing *d, scree_error *error)
{
    const scree_map *map = d->map;
    const size_t count = map->columns * map->rows;
    d->colours = map->colours;
    scree_status status = scree_limits_find(map->value, count, false, &d->limits, error);
    if (status || map->colours != SCREE_COLOUR_DIVERGING) return status;
    if (d->limits.low < 0 && d->limits.high > 0) return scree_limits_find(map->value, count, true, &d->limits, error);
    d->colours = SCREE_COLOUR_SEQUENTIAL;
    d->below_zero = d->limits.high <= 0 && d->limits.low < 0;
    return SCREE_OK;
}

scree_status scree_map_draw(const char *path, const scree_map *map, scree_error *error)
{
    drawing d = {.map = map};
    const double wide = map->high[0] - map->low[0], high = map->high[1] - map->low[1];
    scree_status status = find_colours(&d, error);
    if (status) return status;
    if (isnan(d.limits.smallest) || !(wide > 0) || !(high > 0))
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no number to draw");
    d.scale = fmin(WIDTH / wide, HEIGHT / high);
    d.width = wide * d.scale;
    d.height = high * d.scale;
    const scree_page page = {.width = LEFT + d.width + LEGEND + 8,
                             .height = fmax(TOP + d.height + BELOW, bar_end(&d) + MARGIN),
                             .marks = map->columns * map->rows,
                             .draw = draw_page,
                             .user = &d};
    return scree_page_write(path, &page, error);
}
