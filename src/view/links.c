/// Networks of lines.
#include "view/links.h"

#include "view/page.h"
#include "view/scale.h"

#include <math.h>

#define WIDTH  640.0 /* pt, of the network at most */
#define HEIGHT 420.0
#define MARGIN 22.0
#define TOP    40.0
#define BELOW  34.0
#define WIDEST 6.0 /* times the mean force */

static const scree_colour ink = {0.13, 0.13, 0.15}, weak = {0.66, 0.70, 0.76}, strong = {0.80, 0.20, 0.10};

typedef struct drawing {
    const scree_links *links;
    double low[2], high[2], scale;
} drawing;

static void draw_those(cairo_t *cairo, const drawing *d, bool marked)
{
    scree_page_colour(cairo, marked ? strong : weak);
    for (size_t k = 0; k < d->links->count; k++) {
        const scree_link *link = &d->links->link[k];
        if (link->marked != marked) continue;
        cairo_set_line_width(cairo, fmax(0.25, d->links->width * d->scale * fmin(WIDEST, link->force)));
        cairo_move_to(cairo, MARGIN + (link->from[0] - d->low[0]) * d->scale,
                      TOP + (d->high[1] - link->from[1]) * d->scale);
        cairo_line_to(cairo, MARGIN + (link->to[0] - d->low[0]) * d->scale,
                      TOP + (d->high[1] - link->to[1]) * d->scale);
        cairo_stroke(cairo);
    }
}

static double draw_key(cairo_t *cairo, double x, double y, scree_colour colour, const char *name)
{
    const scree_text_style text = {.size = 9, .colour = ink};
    scree_page_colour(cairo, colour);
    cairo_set_line_width(cairo, 3);
    cairo_move_to(cairo, x, y - 3);
    cairo_line_to(cairo, x + 16, y - 3);
    cairo_stroke(cairo);
    scree_text_show(cairo, x + 21, y, 0, name, text);
    return x + 45 + scree_text_width(cairo, name, text);
}

static void draw_page(cairo_t *cairo, void *user)
{
    const drawing *d = user;
    const double base = TOP + (d->high[1] - d->low[1]) * d->scale + 24;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    scree_text_show(cairo, 12, 22, 0, d->links->title, (scree_text_style){.size = 11, .bold = true, .colour = ink});
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    draw_those(cairo, d, false);
    draw_those(cairo, d, true);
    const double next = draw_key(cairo, MARGIN, base, strong, d->links->marked_name);
    (void)draw_key(cairo, next, base, weak, d->links->other_name);
}

scree_status scree_links_draw(const char *path, const scree_links *links, scree_error *error)
{
    drawing d = {.links = links, .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (size_t k = 0; k < links->count; k++)
        for (int i = 0; i < 2; i++) {
            d.low[i] = fmin(d.low[i], fmin(links->link[k].from[i], links->link[k].to[i]));
            d.high[i] = fmax(d.high[i], fmax(links->link[k].from[i], links->link[k].to[i]));
        }
    const double wide = d.high[0] - d.low[0], high = d.high[1] - d.low[1];
    if (!(wide > 0) || !(high > 0) || !isfinite(wide + high))
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no network to draw");
    d.scale = fmin(WIDTH / wide, HEIGHT / high);
    const scree_page page = {.width = fmax(420, 2 * MARGIN + wide * d.scale),
                             .height = TOP + high * d.scale + BELOW,
                             .marks = links->count,
                             .draw = draw_page,
                             .user = &d};
    return scree_page_write(path, &page, error);
}
