/// Fields of the Delaunay cells: coloured, or shaded where they exceed so many times their mean (P figs. 3.10, 3.11),
/// with the outline of all cells, and the edges of a shear band. Cells of one colour share a path, and a hairline of
/// the same colour closes the seams between colours. Cost: levels x cells.
#include "view/scene_parts.h"

#include <math.h>
#include <stdio.h>

#define SEAM 0.25 /* pt */

static const scree_colour shade = {0.16, 0.20, 0.36};
static const scree_colour band_edge = {0.80, 0.25, 0.10};

static const double *corner(const scree_scene *scene, size_t cell, int node)
{
    return scene->cell_place + 3 * (size_t)scene->cells->node[cell][node];
}

static void add_cell(const scree_scene_view *view, cairo_t *cairo, size_t cell)
{
    for (int n = 0; n < 3; n++) {
        const double *x = corner(view->scene, cell, n);
        if (n == 0)
            cairo_move_to(cairo, scree_scene_x(view, x[0]), scree_scene_y(view, x[1]));
        else
            cairo_line_to(cairo, scree_scene_x(view, x[0]), scree_scene_y(view, x[1]));
    }
    cairo_close_path(cairo);
}

static void fill(cairo_t *cairo, scree_colour colour)
{
    scree_page_colour(cairo, colour);
    cairo_fill_preserve(cairo);
    cairo_set_line_width(cairo, SEAM);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
}

static int level_of(const scree_scene_view *view, size_t cell)
{
    double value = view->scene->cell_field[cell];
    if (!isfinite(value)) return SCREE_SCENE_LEVELS;
    double position = (value - view->limits.low) / (view->limits.high - view->limits.low);
    return (int)lround(fmin(1, fmax(0, position)) * (SCREE_SCENE_LEVELS - 1));
}

static void draw_coloured(const scree_scene_view *view, cairo_t *cairo)
{
    for (int level = 0; level <= SCREE_SCENE_LEVELS; level++) {
        double position = level == SCREE_SCENE_LEVELS ? NAN : (double)level / (SCREE_SCENE_LEVELS - 1);
        const scree_colour colour = scree_colour_at(view->scene->map, position);
        for (size_t k = 0, added = 0; k < view->scene->cells->count; k++) {
            if (level_of(view, k) != level) continue;
            add_cell(view, cairo, k);
            if (++added % SCREE_SCENE_PATH == 0) fill(cairo, colour);
        }
        fill(cairo, colour);
    }
}

static void draw_shaded(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_scene *scene = view->scene;
    double limit = scene->cell_threshold * scree_cells_mean(scene->cells, scene->cell_field);
    for (size_t k = 0, added = 0; k < scene->cells->count; k++) {
        if (!(scene->cell_field[k] > limit)) continue;
        add_cell(view, cairo, k);
        if (++added % SCREE_SCENE_PATH == 0) fill(cairo, shade);
    }
    fill(cairo, shade);
}

/// Edges with a cell on one side only.
static void draw_outline(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_scene *scene = view->scene;
    for (size_t k = 0; k < scene->cells->count; k++)
        for (int n = 0; n < 3; n++) {
            if (scene->cells->neighbour[k][n] >= 0) continue;
            const double *a = corner(scene, k, (n + 1) % 3), *b = corner(scene, k, (n + 2) % 3);
            cairo_move_to(cairo, scree_scene_x(view, a[0]), scree_scene_y(view, a[1]));
            cairo_line_to(cairo, scree_scene_x(view, b[0]), scree_scene_y(view, b[1]));
        }
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, 0.8);
    scree_page_colour(cairo, scree_scene_quiet);
    cairo_stroke(cairo);
}

/// Both edges of the band, across the page and cut at the sample.
static void draw_band(const scree_scene_view *view, cairo_t *cairo)
{
    const scree_scene *scene = view->scene;
    const scree_band *band = scene->band;
    if (!band || !band->found) return;
    scree_vector middle = {0}, at;
    double volume = 0, reach = hypot(view->high[0] - view->low[0], view->high[1] - view->low[1]);
    for (size_t k = 0; k < scene->cells->count; k++) {
        scree_cell_centre(scene->cells, k, scene->cell_place, at);
        volume += scene->cells->volume[k];
        for (int i = 0; i < 2; i++) middle[i] += scene->cells->volume[k] * at[i];
    }
    cairo_save(cairo);
    cairo_rectangle(cairo, view->left, view->top, view->width, view->height);
    cairo_clip(cairo);
    for (int side = -1; side <= 1; side += 2) {
        double along = band->offset + side * band->thickness / 2;
        double x = middle[0] / volume + along * band->normal[0], y = middle[1] / volume + along * band->normal[1];
        cairo_move_to(cairo, scree_scene_x(view, x - reach * band->normal[1]),
                      scree_scene_y(view, y + reach * band->normal[0]));
        cairo_line_to(cairo, scree_scene_x(view, x + reach * band->normal[1]),
                      scree_scene_y(view, y - reach * band->normal[0]));
    }
    cairo_set_line_width(cairo, 1.2);
    scree_page_colour(cairo, band_edge);
    cairo_stroke(cairo);
    cairo_restore(cairo);
}

void scree_scene_cells(const scree_scene_view *view, cairo_t *cairo)
{
    if (scree_scene_coloured(view->scene))
        draw_coloured(view, cairo);
    else
        draw_shaded(view, cairo);
    draw_outline(view, cairo);
    draw_band(view, cairo);
}

// ---- legend ------------------------------------------------------------------------------------------------------

/// What the shaded cells are, and how much of the area and of the field they hold.
static double shading_legend(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    const scree_scene *scene = view->scene;
    const scree_cells *cells = scene->cells;
    double mean = scree_cells_mean(cells, scene->cell_field), area = 0, shaded = 0, held = 0;
    for (size_t k = 0; k < cells->count; k++) {
        bool above = scene->cell_field[k] > scene->cell_threshold * mean;
        area += cells->volume[k];
        shaded += above ? cells->volume[k] : 0;
        held += above ? cells->volume[k] * scene->cell_field[k] : 0;
    }
    char text[256], number[48];
    scree_page_colour(cairo, shade);
    cairo_rectangle(cairo, x, y, 9, 9);
    cairo_fill(cairo);
    (void)snprintf(text, sizeof text, "above %g × mean", scene->cell_threshold);
    scree_text_show(cairo, x + 14, y + 8, 0, text, scree_scene_text(9));
    scree_number_text(number, sizeof number, mean, 3);
    (void)snprintf(text, sizeof text, "%s; mean over the area: %s", view->field_name, number);
    y = scree_text_paragraph(cairo, x, y + 15, SCREE_SCENE_LEGEND_WIDTH, text, scree_scene_text(8.5));
    if (!(mean > 0)) return y;
    (void)snprintf(text, sizeof text, "shaded: %.0f %% of the area with %.0f %% of the total", 100 * shaded / area,
                   100 * held / (area * mean));
    scree_text_style note = scree_scene_text(7);
    note.colour = scree_scene_quiet;
    return scree_text_paragraph(cairo, x, y + 3, SCREE_SCENE_LEGEND_WIDTH, text, note);
}

double scree_scene_cell_legend(const scree_scene_view *view, cairo_t *cairo, double x, double y)
{
    const scree_scene *scene = view->scene;
    if (!scene->cells) return y;
    if (!scree_scene_coloured(scene)) y = shading_legend(view, cairo, x, y);
    if (!scene->band || !scene->band->found) return y;
    if (!scree_scene_coloured(scene)) y += 16;
    scree_page_colour(cairo, band_edge);
    cairo_set_line_width(cairo, 1.2);
    cairo_move_to(cairo, x, y + 5);
    cairo_line_to(cairo, x + 14, y + 5);
    cairo_stroke(cairo);
    scree_text_show(cairo, x + 19, y + 8, 0, "shear band", scree_scene_text(8.5));
    char text[128];
    (void)snprintf(text, sizeof text, "%.0f° to the axis, %.1f mean diameters thick, %.0f %% of the distortion",
                   scene->band->angle, scene->band->thickness / (2 * view->mean_radius), 100 * scene->band->share);
    scree_text_style note = scree_scene_text(7);
    note.colour = scree_scene_quiet;
    return scree_text_paragraph(cairo, x, y + 13, SCREE_SCENE_LEGEND_WIDTH, text, note);
}
