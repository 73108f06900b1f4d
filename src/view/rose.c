/// Roses: what there is in each direction.
#include "view/map.h"
#include "view/page.h"

#include <math.h>
#include <stdio.h>

#define RADIUS 140.0 /* pt */
#define CENTRE 185.0
#define TOP    205.0
#define WIDTH  500.0
#define HEIGHT 385.0

static const scree_colour ink = {0.13, 0.13, 0.15}, quiet = {0.45, 0.45, 0.48}, grid = {0.86, 0.86, 0.88},
                          petal = {0.34, 0.55, 0.75}, red = {0.80, 0.20, 0.10};

typedef struct drawing {
    const scree_rose *rose;
    double largest; ///< at the full radius
} drawing;

/// What a direction on the page stands for where both sides of the rose are the same.
static int elevation_of(int degree)
{
    return degree <= 90 ? degree : degree <= 270 ? 180 - degree : degree - 360;
}

static void draw_grid(cairo_t *cairo, const drawing *d)
{
    const scree_ticks ticks = scree_ticks_make(0, d->largest);
    const scree_text_style small = {.size = 8.5, .colour = quiet};
    char text[64];
    cairo_set_line_width(cairo, 0.6);
    for (int k = 0; k < ticks.count; k++) {
        const double radius = RADIUS * ticks.value[k] / d->largest;
        if (!(radius > 1)) continue;
        scree_page_colour(cairo, grid);
        cairo_arc(cairo, CENTRE, TOP, radius, 0, 2 * M_PI);
        cairo_stroke(cairo);
    }
    for (int degree = 0; degree < 360; degree += 30) {
        const double x = cos(degree * M_PI / 180), y = -sin(degree * M_PI / 180);
        scree_page_colour(cairo, grid);
        cairo_move_to(cairo, CENTRE, TOP);
        cairo_line_to(cairo, CENTRE + RADIUS * x, TOP + RADIUS * y);
        cairo_stroke(cairo);
        (void)snprintf(text, sizeof text, "%d°", d->rose->width ? elevation_of(degree) : degree);
        scree_text_show(cairo, CENTRE + (RADIUS + 16) * x, TOP + (RADIUS + 16) * y + 3, 0.5, text, small);
    }
}

/// Numbers of the rings, above all else.
static void draw_numbers(cairo_t *cairo, const drawing *d)
{
    const scree_ticks ticks = scree_ticks_make(0, d->largest);
    const scree_text_style small = {.size = 8.5, .colour = ink};
    for (int k = 0; k < ticks.count; k++) {
        const double radius = RADIUS * ticks.value[k] / d->largest;
        if (!(radius > 1)) continue;
        const double x = CENTRE + 0.2588 * radius, y = TOP - 0.9659 * radius;
        const double width = scree_text_width(cairo, ticks.text[k], small) + 4;
        cairo_set_source_rgba(cairo, 1, 1, 1, 0.8);
        cairo_rectangle(cairo, x - width / 2, y - 6, width, 11);
        cairo_fill(cairo);
        scree_text_show(cairo, x, y + 3, 0.5, ticks.text[k], small);
    }
}

static void draw_petals(cairo_t *cairo, const drawing *d)
{
    const scree_rose *r = d->rose;
    for (size_t k = 0; k < r->sectors; k++) {
        const double half = r->width ? 0.5 * r->width[k] : M_PI / (double)r->sectors;
        if (!(r->petal[k] > 0)) continue;
        cairo_move_to(cairo, CENTRE, TOP);
        cairo_arc(cairo, CENTRE, TOP, RADIUS * r->petal[k] / d->largest, -r->angle[k] - half, -r->angle[k] + half);
        cairo_close_path(cairo);
        scree_page_colour(cairo, petal);
        cairo_fill_preserve(cairo);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_set_line_width(cairo, 0.5);
        cairo_stroke(cairo);
    }
}

static void draw_line(cairo_t *cairo, const drawing *d)
{
    const scree_rose *r = d->rose;
    bool begun = false;
    if (!r->line) return;
    for (size_t k = 0; k < r->sectors; k++) {
        const double radius = RADIUS * r->line[k] / d->largest;
        if (!isfinite(radius)) continue;
        const double x = CENTRE + radius * cos(r->angle[k]), y = TOP - radius * sin(r->angle[k]);
        if (begun)
            cairo_line_to(cairo, x, y);
        else
            cairo_move_to(cairo, x, y);
        begun = true;
    }
    cairo_close_path(cairo);
    scree_page_colour(cairo, red);
    cairo_set_line_width(cairo, 1.6);
    cairo_stroke(cairo);
}

static void draw_page(cairo_t *cairo, void *user)
{
    const drawing *d = user;
    const scree_text_style text = {.size = 9, .colour = ink};
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    scree_text_show(cairo, 12, 22, 0, d->rose->title, (scree_text_style){.size = 11, .bold = true, .colour = ink});
    draw_grid(cairo, d);
    draw_petals(cairo, d);
    draw_line(cairo, d);
    draw_numbers(cairo, d);
    scree_page_colour(cairo, petal);
    cairo_rectangle(cairo, 362, 62, 9, 9);
    cairo_fill(cairo);
    const double below = scree_text_paragraph(cairo, 377, 60, WIDTH - 385, d->rose->name, text);
    if (!d->rose->line) return;
    scree_page_colour(cairo, red);
    cairo_set_line_width(cairo, 1.6);
    cairo_move_to(cairo, 362, below + 12);
    cairo_line_to(cairo, 371, below + 12);
    cairo_stroke(cairo);
    (void)scree_text_paragraph(cairo, 377, below + 6, WIDTH - 385, d->rose->line_name, text);
}

scree_status scree_rose_draw(const char *path, const scree_rose *rose, scree_error *error)
{
    drawing d = {.rose = rose};
    for (size_t k = 0; k < rose->sectors; k++) {
        d.largest = fmax(d.largest, rose->petal[k]);
        if (rose->line) d.largest = fmax(d.largest, rose->line[k]);
    }
    if (!(d.largest > 0)) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no number to draw");
    const scree_page page = {.width = WIDTH, .height = HEIGHT, .marks = rose->sectors, .draw = draw_page, .user = &d};
    return scree_page_write(path, &page, error);
}
