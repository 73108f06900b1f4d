/// The legend of a scene, a column of parts from top to bottom: colour bar, line widths, reference arrow, boundary. A
/// part that the scene does not have takes no room.
#include "view/scene_parts.h"

#include <math.h>
#include <stdio.h>

#define BAR_WIDTH   11.0
#define BAR_HIGHEST 150.0
#define BAR_LOWEST  60.0
#define BAR_TIP     9.0 /* triangles for values beyond the limits */
#define GAP         16.0

/// Gradient of the colour map from (0, bottom) to (0, top).
static void set_gradient(cairo_t *cairo, scree_colour_map map, double bottom, double top)
{
    const int stops = 48;
    cairo_pattern_t *pattern = cairo_pattern_create_linear(0, bottom, 0, top);
    for (int k = 0; k <= stops; k++) {
        scree_colour c = scree_colour_at(map, (double)k / stops);
        cairo_pattern_add_color_stop_rgb(pattern, (double)k / stops, c.red, c.green, c.blue);
    }
    cairo_set_source(cairo, pattern);
    cairo_pattern_destroy(pattern);
}

/// Outline of the bar; the ends are pointed where values lie beyond the limits.
static void bar_path(const scree_limits *limits, cairo_t *cairo, double x, double top, double bottom)
{
    cairo_move_to(cairo, x, top);
    if (limits->clipped_high) cairo_line_to(cairo, x + BAR_WIDTH / 2, top - BAR_TIP);
    cairo_line_to(cairo, x + BAR_WIDTH, top);
    cairo_line_to(cairo, x + BAR_WIDTH, bottom);
    if (limits->clipped_low) cairo_line_to(cairo, x + BAR_WIDTH / 2, bottom + BAR_TIP);
    cairo_line_to(cairo, x, bottom);
    cairo_close_path(cairo);
}

static void draw_ticks(const scree_limits *limits, const scree_ticks *ticks, cairo_t *cairo, double x, double top,
                       double bottom)
{
    cairo_set_line_width(cairo, 0.6);
    for (int k = 0; k < ticks->count; k++) {
        double part = (ticks->value[k] - limits->low) / (limits->high - limits->low);
        double y = bottom + part * (top - bottom);
        scree_page_colour(cairo, scree_scene_ink);
        cairo_move_to(cairo, x, y);
        cairo_line_to(cairo, x + 3, y);
        cairo_stroke(cairo);
        scree_text_show(cairo, x + 6, y + 3, 0, ticks->text[k], scree_scene_text(8.5));
    }
    if (ticks->factor[0]) {
        char text[40];
        (void)snprintf(text, sizeof text, "× %s", ticks->factor);
        scree_text_show(cairo, x + 6, top - 9, 0, text, scree_scene_text(8.5));
    }
}

/// What the limits are, so that a reader can tell the colours from the extremes.
static void limits_text(const scree_limits *limits, bool symmetric, char *text, size_t size)
{
    char smallest[64], largest[64];
    scree_number_text(smallest, sizeof smallest, limits->smallest, 3);
    scree_number_text(largest, sizeof largest, limits->largest, 3);
    if (isnan(limits->smallest))
        (void)snprintf(text, size, "no finite value");
    else if (limits->smallest == limits->largest)
        (void)snprintf(text, size, "all values equal %s", smallest);
    else if (!limits->clipped_low && !limits->clipped_high)
        (void)snprintf(text, size, "values from %s to %s", smallest, largest);
    else
        (void)snprintf(text, size, "limits: %s; values from %s to %s",
                       symmetric ? "98th percentile of the magnitude" : "2nd and 98th percentile", smallest, largest);
}

/// As high as the sample, with the texts around it, where that is flat.
static double bar_height(const scree_scene_view *view)
{
    return fmin(BAR_HIGHEST, fmax(BAR_LOWEST, view->height - 40));
}

static double draw_bar(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    const scree_scene *scene = view->scene;
    if (!scene->field && !scree_scene_coloured(scene)) return y;
    scree_text_style name = scree_scene_text(9), note = scree_scene_text(7);
    note.colour = scree_scene_quiet;
    y = scree_text_paragraph(cairo, x, y, SCREE_SCENE_LEGEND_WIDTH, view->field_name, name);
    scree_ticks ticks = scree_ticks_make(view->limits.low, view->limits.high);
    double above = fmax(view->limits.clipped_high ? BAR_TIP : 0, ticks.factor[0] ? 14 : 0);
    double top = y + 5 + above, bottom = top + bar_height(view);
    bar_path(&view->limits, cairo, x, top, bottom);
    set_gradient(cairo, scene->map, bottom, top);
    cairo_fill_preserve(cairo);
    scree_page_colour(cairo, scree_scene_ink);
    cairo_set_line_width(cairo, 0.6);
    cairo_stroke(cairo);
    draw_ticks(&view->limits, &ticks, cairo, x + BAR_WIDTH, top, bottom);
    char text[256];
    limits_text(&view->limits, scene->map == SCREE_COLOUR_DIVERGING, text, sizeof text);
    double below = bottom + (view->limits.clipped_low ? BAR_TIP : 0) + 4;
    y = scree_text_paragraph(cairo, x, below, SCREE_SCENE_LEGEND_WIDTH, text, note);
    if (view->limits.undefined > 0) {
        scree_page_colour(cairo, scree_colour_at(scene->map, NAN));
        cairo_arc(cairo, x + 4, y + 10, 4, 0, 2 * M_PI);
        cairo_fill(cairo);
        (void)snprintf(text, sizeof text, "undefined (%zu)", view->limits.undefined);
        scree_text_show(cairo, x + 13, y + 12.5, 0, text, note);
        y += 15;
    }
    return y + GAP;
}

/// The colour of contacts that pull; their widths are those of pressure.
static double draw_tension_key(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    const double width = scree_scene_force_width(view, 1), row = fmax(13, width + 5);
    scree_page_colour(cairo, scree_scene_pull);
    cairo_set_line_width(cairo, width);
    cairo_move_to(cairo, x, y + row / 2);
    cairo_line_to(cairo, x + 20, y + row / 2);
    cairo_stroke(cairo);
    scree_text_show(cairo, x + 25, y + row / 2 + 3, 0, "tension", scree_scene_text(8));
    return y + row;
}

static double draw_widths(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    static const struct {
        double ratio;
        const char *text;
    } sample[] = {{0.5, "half the mean"}, {1, "mean"}, {3, "3 × mean"}, {6, "6 × mean or more"}};
    if (!view->scene->force_network) return y;
    char text[96], force[64];
    y = scree_text_paragraph(cairo, x, y, SCREE_SCENE_LEGEND_WIDTH, "normal contact force", scree_scene_text(9));
    scree_number_text(force, sizeof force, view->mean_force, 3);
    (void)snprintf(text, sizeof text, "mean %s N", force);
    if (view->mean_force <= 0) (void)snprintf(text, sizeof text, "no contacts");
    y = scree_text_paragraph(cairo, x, y + 1, SCREE_SCENE_LEGEND_WIDTH, text, scree_scene_text(8.5)) + 3;
    for (size_t k = 0; k < sizeof sample / sizeof sample[0] && view->mean_force > 0; k++) {
        double width = scree_scene_force_width(view, sample[k].ratio), row = fmax(13, width + 5);
        scree_page_colour(cairo, sample[k].ratio < 1 ? scree_scene_weak : scree_scene_strong);
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
        cairo_set_line_width(cairo, width);
        cairo_move_to(cairo, x, y + row / 2);
        cairo_line_to(cairo, x + 20, y + row / 2);
        cairo_stroke(cairo);
        scree_text_show(cairo, x + 25, y + row / 2 + 3, 0, sample[k].text, scree_scene_text(8));
        y += row;
    }
    if (view->tension) y = draw_tension_key(view, cairo, x, y);
    return y + GAP;
}

static double draw_reference_arrow(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    if (view->arrow_scale <= 0 || view->scene->arrows_have_no_size) return y;
    double stretch = view->arrow_scale * view->scale;
    double reference = scree_round_below(36 / stretch);
    char length[64], factor[48], text[192];
    scree_length_text(length, sizeof length, reference);
    scree_number_text(factor, sizeof factor, view->arrow_scale, 3);
    if (view->arrow_scale >= 0.001 && view->arrow_scale < 1e4)
        (void)snprintf(factor, sizeof factor, "%g", view->arrow_scale);
    y += 5;
    scree_scene_arrow(view, cairo, x, y, reference * stretch, 0);
    scree_page_colour(cairo, scree_scene_strong);
    cairo_fill(cairo);
    scree_text_show(cairo, x + reference * stretch + 6, y + 3, 0, length, scree_scene_text(9));
    const int used = snprintf(text, sizeof text, "arrows drawn %s × their true length", factor);
    if (view->arrows < view->disc_count)
        (void)snprintf(text + used, sizeof text - (size_t)used, ", of %zu of %zu grains", view->arrows, view->disc_count);
    scree_text_style note = scree_scene_text(7);
    note.colour = scree_scene_quiet;
    return scree_text_paragraph(cairo, x, y + 7, SCREE_SCENE_LEGEND_WIDTH, text, note) + GAP;
}

static double draw_boundary_key(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    if (!view->scene->boundary || view->snapshot->loop_count == 0) return y;
    scree_page_colour(cairo, scree_scene_boundary);
    cairo_set_line_width(cairo, 1.1);
    cairo_move_to(cairo, x, y + 5);
    cairo_line_to(cairo, x + 14, y + 5);
    cairo_stroke(cairo);
    scree_text_show(cairo, x + 19, y + 8, 0, "Delaunay boundary", scree_scene_text(8));
    return y + 12 + GAP;
}

static double draw_marked_key(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    if (!view->scene->marked) return y;
    cairo_set_source_rgb(cairo, 0, 0, 0);
    cairo_arc(cairo, x + 5, y + 5, 5, 0, 2 * M_PI);
    cairo_fill(cairo);
    scree_text_show(cairo, x + 15, y + 8, 0, view->scene->marked_name ? view->scene->marked_name : "",
                    scree_scene_text(8));
    return y + 12 + GAP;
}

double scree_scene_legend(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    double below = draw_bar(view, cairo, x, y);
    double cells = scree_scene_cell_legend(view, cairo, x, below);
    below = cells > below ? cells + GAP : below;
    below = draw_widths(view, cairo, x, below);
    below = draw_reference_arrow(view, cairo, x, below);
    below = draw_boundary_key(view, cairo, x, below);
    below = draw_marked_key(view, cairo, x, below);
    return below > y ? below - GAP : y;
}

void scree_scene_scale_bar(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    double length = scree_round_below(view->width / view->scale / 3);
    double drawn = length * view->scale;
    char text[64];
    scree_length_text(text, sizeof text, length);
    scree_page_colour(cairo, scree_scene_ink);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cairo, 1.2);
    cairo_move_to(cairo, x, y);
    cairo_line_to(cairo, x + drawn, y);
    cairo_stroke(cairo);
    cairo_set_line_width(cairo, 0.8);
    for (int end = 0; end < 2; end++) {
        cairo_move_to(cairo, x + end * drawn, y - 3);
        cairo_line_to(cairo, x + end * drawn, y + 3);
    }
    cairo_stroke(cairo);
    scree_text_show(cairo, x + drawn + 6, y + 3.2, 0, text, scree_scene_text(9));
}
