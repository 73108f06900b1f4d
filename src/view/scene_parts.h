/// What the parts of a scene share: where things lie on the page and how large they are drawn. Private to src/view/.
#ifndef SCREE_VIEW_SCENE_PARTS_H
#define SCREE_VIEW_SCENE_PARTS_H

#include "view/page.h"
#include "view/projection.h"
#include "view/scale.h"
#include "view/scene_content.h"

/// Colours and line widths are drawn in so many steps, one path each, which keeps files small. Odd: zero is one of the
/// colours of a diverging map.
#define SCREE_SCENE_LEVELS       97
#define SCREE_SCENE_FORCE_LIMIT  6.0  ///< times the mean normal force: lines grow no wider beyond it
#define SCREE_SCENE_FORCE_WIDTH  0.11 ///< width of the line of the mean force over the mean diameter
#define SCREE_SCENE_LEGEND_WIDTH 106  ///< pt

typedef struct scree_scene_view {
    const scree_snapshot *snapshot;
    const scree_scene *scene;
    // what is drawn
    size_t disc_count;                        ///< discs with a place on the page
    double low[2], high[2];                   ///< m, corners of what is drawn
    scree_periodic_edges periodic;            ///< edges of the periodic cell
    double mean_radius;                       ///< m
    scree_limits limits;                      ///< of the field
    uint32_t *order;                          ///< drawn discs by colour level; with depth: far to near
    size_t start[SCREE_SCENE_LEVELS + 2];     ///< of each level in `order`; the last level is "undefined"
    double mean_force;                        ///< N, magnitude over contacts between discs that bear one; 0: none
    bool tension;                             ///< some of them pull
    double arrow_scale;                       ///< drawn over true length; 0: no arrows
    size_t arrows;                            ///< discs that have one
    double overhang_low[2], overhang_high[2]; ///< m, how far arrows reach beyond the corners
    // where, pt
    double scale;                    ///< pt per m
    double left, top, width, height; ///< of the sample and its overhang
    double page_width, page_height;
    cairo_surface_t *raster; ///< the page's marks as pixels, which both files show; NULL: they are drawn
    double pixel;            ///< pt, of the raster that is drawn on; 0: on none
    char title[512], caption[256], field_name[160];
} scree_scene_view;

/// Line colours and text styles of all scenes.
extern const scree_colour scree_scene_ink, scree_scene_quiet, scree_scene_weak, scree_scene_strong, scree_scene_pull,
    scree_scene_boundary;
scree_text_style scree_scene_text(double size);

static inline double scree_scene_x(const scree_scene_view *view, double x)
{
    return view->left + (x - view->low[0] + view->overhang_low[0]) * view->scale;
}
static inline double scree_scene_y(const scree_scene_view *view, double y)
{
    return view->top + (view->high[1] + view->overhang_high[1] - y) * view->scale;
}
/// After so many marks a path is drawn: Cairo holds the edges of a path, some kB a disc.
enum { SCREE_SCENE_PATH = 4096 };

/// Colour of disc `k` by its field.
scree_colour scree_scene_disc_colour(const scree_scene_view *view, size_t k);

/// Whether disc `k` has a place on the page.
bool scree_scene_drawn(const scree_snapshot *snapshot, size_t k);

/// Width [pt] of the line of a force that is `ratio` times the mean.
double scree_scene_force_width(const scree_scene_view *view, double ratio);
/// One arrow from (x, y) by (dx, dy), all pt on the page; filled by the caller.
void scree_scene_arrow(const scree_scene_view *view, cairo_t *cairo, double x, double y, double dx, double dy);

/// Whether cells are coloured (and not shaded above a threshold).
static inline bool scree_scene_coloured(const scree_scene *scene)
{
    return scene->cells && !(scene->cell_threshold > 0);
}
/// Cells, their outline, and the edges of a band.
void scree_scene_cells(const scree_scene_view *view, cairo_t *cairo);
/// What the shading and the lines mean; returns the y below it (y itself when there is nothing to explain).
double scree_scene_cell_legend(const scree_scene_view *view, cairo_t *cairo, double x, double y);

/// Everything that lies in the sample, bottom to top.
void scree_scene_marks(const scree_scene_view *view, cairo_t *cairo);

/// Legend at (x, y), growing down; returns the y below it (y itself when there is nothing to explain).
double scree_scene_legend(const scree_scene_view *view, cairo_t *cairo, double x, double y);
/// Scale bar in mm with its left end at (x, y).
void scree_scene_scale_bar(const scree_scene_view *view, cairo_t *cairo, double x, double y);

#endif
