/// Scenes: measure what is to be drawn, lay out the page, draw it.
///
/// The page is at most 170 mm wide and 180 mm high, so that it fits an A4 text block as it is, and shrunk to a column
/// of 80 mm its smallest text still has 5 pt. Sample at the left, legend at the right, title above, scale bar below.
#include "view/scene_parts.h"

#include "base/memory.h"
#include "state/plates.h"
#include "view/projection.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RASTER_MARKS  100000 /* more of them are pixels: a vector file would have tens of megabytes */
#define RASTER_BYTES  ((size_t)64 << 20)
#define FRAME_PIXELS  1200 /* long side of a frame of a movie */
#define MARGIN        9.0
#define LEGEND_GAP    14.0
#define SAMPLE_WIDTH  345.0 /* pt: with margins and legend 170 mm */
#define SAMPLE_HEIGHT 430.0
#define LARGEST_DISC  30.0 /* pt, mean radius of a sample of a few discs */
#define TITLE_SIZE    11.0
#define CAPTION_SIZE  8.5

const scree_colour scree_scene_ink = {0.13, 0.13, 0.15};
const scree_colour scree_scene_quiet = {0.38, 0.38, 0.41};
const scree_colour scree_scene_weak = {0.60, 0.66, 0.75};
const scree_colour scree_scene_strong = {0.07, 0.13, 0.30};
const scree_colour scree_scene_pull = {0.84, 0.37, 0.00};
const scree_colour scree_scene_boundary = {0.0, 0.56, 0.42};

const char *scree_strain_name(bool of_cell)
{
    return of_cell ? "strain of the cell" : "axial strain";
}

scree_text_style scree_scene_text(double size)
{
    return (scree_text_style){.size = size, .colour = scree_scene_ink};
}

bool scree_scene_drawn(const scree_snapshot *snapshot, size_t k)
{
    return isfinite(snapshot->x[k]) && isfinite(snapshot->y[k]) && isfinite(snapshot->radius[k]) &&
           snapshot->radius[k] > 0;
}

static void extend(scree_scene_view *view, int axis, double low, double high)
{
    view->low[axis] = fmin(view->low[axis], low);
    view->high[axis] = fmax(view->high[axis], high);
}

static bool is_shown(const scree_scene_view *view, size_t k)
{
    const double *shown = view->scene->shown, x = view->snapshot->x[k];
    return !shown || (x >= shown[0] && x <= shown[1]);
}

/// Nothing of what lies beyond is left in the corners.
static void cut_extent(scree_scene_view *view)
{
    if (!view->scene->shown) return;
    view->low[0] = fmax(view->low[0], view->scene->shown[0]);
    view->high[0] = fmin(view->high[0], view->scene->shown[1]);
}

/// Walls of the case, whole; of planes the part that is drawn, beside the bodies.
static void extend_by_walls(scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    const bool flat = s->dimension == 2 && s->wall_triangle_count > 0;
    const double *end = flat ? s->wall_triangle : s->wall_line;
    const size_t lines = flat ? s->wall_triangle_count : s->wall_line_count, stride = flat ? 9 : 4,
                 other = flat ? 3 : 2;
    for (size_t k = 0; k < 2 * lines; k++)
        for (int axis = 0; axis < 2; axis++) {
            double at = end[stride * (k / 2) + (k % 2) * other + (size_t)axis];
            extend(view, axis, at, at);
        }
}

scree_scene_frame scree_scene_frame_begin(void)
{
    return (scree_scene_frame){
        .low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}, .limits = {INFINITY, -INFINITY}};
}

static void share_extent(scree_scene_view *view, scree_scene_frame *frame)
{
    for (int axis = 0; axis < 2; axis++) {
        frame->low[axis] = fmin(frame->low[axis], view->low[axis]);
        frame->high[axis] = fmax(frame->high[axis], view->high[axis]);
        if (!frame->whole) continue;
        view->low[axis] = frame->low[axis];
        view->high[axis] = frame->high[axis];
    }
}

static void share_limits(scree_limits *limits, scree_scene_frame *frame)
{
    if (!frame->whole && limits->smallest < limits->largest) { // all at rest says nothing of the scale
        frame->limits[0] = fmin(frame->limits[0], limits->low);
        frame->limits[1] = fmax(frame->limits[1], limits->high);
    }
    if (!frame->whole || !(frame->limits[0] < frame->limits[1])) return;
    limits->low = frame->limits[0];
    limits->high = frame->limits[1];
    limits->clipped_low = limits->smallest < limits->low;
    limits->clipped_high = limits->largest > limits->high;
}

/// Corners of the drawn discs and of the periodic cell, and of the plates that lie near them.
static scree_status measure_extent(scree_scene_view *view, scree_error *error)
{
    const scree_snapshot *s = view->snapshot;
    view->low[0] = view->low[1] = INFINITY;
    view->high[0] = view->high[1] = -INFINITY;
    for (size_t k = 0; k < s->count; k++) {
        if (!scree_scene_drawn(s, k)) continue;
        view->disc_count++;
        view->mean_radius += (s->radius[k] - view->mean_radius) / (double)view->disc_count;
        if (!is_shown(view, k)) continue;
        extend(view, 0, s->x[k] - s->radius[k], s->x[k] + s->radius[k]);
        extend(view, 1, s->y[k] - s->radius[k], s->y[k] + s->radius[k]);
    }
    const scree_projection *projection = view->scene->projection;
    view->periodic = projection ? projection->periodic : scree_periodic_edges_of(s);
    for (size_t k = 0; k < 2 * view->periodic.count; k++)
        for (int axis = 0; axis < 2; axis++) {
            double place = view->periodic.end[k / 2][k % 2][axis];
            extend(view, axis, place, place);
        }
    double size = fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]);
    if (view->disc_count == 0 || !isfinite(size) || !(size > 0))
        return scree_error_set(error, SCREE_ERROR_INPUT, "the snapshot has no disc that could be drawn");
    for (int w = 0; projection && view->scene->plates && w < 2; w++)
        for (int c = 0; c < 4 && projection->has_plate[w]; c++)
            for (int axis = 0; axis < 2; axis++)
                extend(view, axis, projection->plate[w][c][axis], projection->plate[w][c][axis]);
    extend_by_walls(view);
    for (int k = 0; view->scene->plates && k < SCREE_WALL_COUNT; k++) {
        const scree_wall *wall = &s->wall[k];
        int axis = fabs(wall->normal[0]) > 0.999 ? 0 : fabs(wall->normal[1]) > 0.999 ? 1 : -1;
        if (!wall->active || axis < 0) continue;
        double place = wall->position * wall->normal[axis];
        if (place > view->low[axis] - size / 4 && place < view->high[axis] + size / 4) extend(view, axis, place, place);
    }
    cut_extent(view);
    if (view->scene->frame) share_extent(view, view->scene->frame);
    return SCREE_OK;
}

static int colour_level(const scree_scene_view *view, size_t k)
{
    if (!view->scene->field) return 0;
    double value = view->scene->field[k];
    if (!isfinite(value)) return SCREE_SCENE_LEVELS;
    double position = (value - view->limits.low) / (view->limits.high - view->limits.low);
    return (int)lround(fmin(1, fmax(0, position)) * (SCREE_SCENE_LEVELS - 1));
}

scree_colour scree_scene_disc_colour(const scree_scene_view *view, size_t k)
{
    if (!view->scene->field) return (scree_colour){0.66, 0.72, 0.80};
    int level = colour_level(view, k);
    return scree_colour_at(view->scene->map,
                           level == SCREE_SCENE_LEVELS ? NAN : (double)level / (SCREE_SCENE_LEVELS - 1));
}

static int farther_first(const void *one, const void *other, void *depth)
{
    double a = ((const double *)depth)[*(const uint32_t *)one], b = ((const double *)depth)[*(const uint32_t *)other];
    return (a > b) - (a < b);
}

static void order_by_depth(scree_scene_view *view)
{
    size_t count = 0;
    for (size_t k = 0; k < view->snapshot->count; k++)
        if (scree_scene_drawn(view->snapshot, k)) view->order[count++] = (uint32_t)k;
    qsort_r(view->order, count, sizeof *view->order, farther_first, (void *)(uintptr_t)view->scene->depth);
}

/// Sorts the drawn discs by colour level (counting sort), or by depth.
static scree_status order_discs(scree_scene_view *view, scree_error *error)
{
    const scree_snapshot *s = view->snapshot;
    const scree_scene *scene = view->scene;
    scree_status status = SCREE_OK;
    if (scree_scene_coloured(scene))
        status = scree_limits_find(scene->cell_field, scene->cells->count, false, &view->limits, error);
    if (view->scene->field)
        status = scree_limits_find(view->scene->field, s->count, view->scene->map == SCREE_COLOUR_DIVERGING,
                                   &view->limits, error);
    if (!status && view->scene->frame) share_limits(&view->limits, view->scene->frame);
    if (!status) status = scree_allocate(&view->order, view->disc_count, sizeof *view->order, error);
    if (status) return status;
    if (view->scene->depth) {
        order_by_depth(view);
        return SCREE_OK;
    }
    size_t next[SCREE_SCENE_LEVELS + 2] = {0};
    for (size_t k = 0; k < s->count; k++)
        if (scree_scene_drawn(s, k)) view->start[colour_level(view, k) + 1]++;
    for (int level = 0; level <= SCREE_SCENE_LEVELS; level++) {
        view->start[level + 1] += view->start[level];
        next[level] = view->start[level];
    }
    for (size_t k = 0; k < s->count; k++)
        if (scree_scene_drawn(s, k)) view->order[next[colour_level(view, k)]++] = (uint32_t)k;
    return SCREE_OK;
}

static void measure_forces(scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    size_t touching = 0;
    for (size_t k = 0; view->scene->force_network && k < s->contact_count; k++) {
        const double force = s->normal_force[k];
        if (s->second[k] >= SCREE_PRIMITIVE_ID || !isfinite(force) || force == 0) continue;
        touching++;
        view->tension |= force < 0;
        view->mean_force += (fabs(force) - view->mean_force) / (double)touching;
    }
    scree_scene_frame *frame = view->scene->frame;
    if (!frame || view->mean_force == 0) return;
    frame->mean_force = fmax(frame->mean_force, view->mean_force);
    view->mean_force = frame->mean_force;
}

/// Room for the tips of the arrows; an arrow far longer than most is cut off at the edge instead.
static void measure_overhang(scree_scene_view *view, double longest)
{
    const scree_scene *scene = view->scene;
    const scree_snapshot *s = view->snapshot;
    for (size_t k = 0; k < s->count; k++) {
        if (!scree_scene_drawn(s, k) || !(hypot(scene->arrow_x[k], scene->arrow_y[k]) <= longest)) continue;
        double tip[2] = {s->x[k] + view->arrow_scale * scene->arrow_x[k],
                         s->y[k] + view->arrow_scale * scene->arrow_y[k]};
        for (int axis = 0; axis < 2; axis++) {
            view->overhang_low[axis] = fmax(view->overhang_low[axis], view->low[axis] - tip[axis]);
            view->overhang_high[axis] = fmax(view->overhang_high[axis], tip[axis] - view->high[axis]);
        }
    }
}

/// Chosen so that the 95th percentile is drawn two to three diameters long, as a round number times the true length.
static scree_status measure_arrows(scree_scene_view *view, scree_error *error)
{
    const scree_scene *scene = view->scene;
    const scree_snapshot *s = view->snapshot;
    double *length;
    if (!scene->arrow_x || !scene->arrow_y) return SCREE_OK;
    scree_status status = scree_allocate(&length, s->count, sizeof *length, error);
    if (status) return status;
    size_t count = 0;
    for (size_t k = 0; k < s->count; k++) {
        double size = hypot(scene->arrow_x[k], scene->arrow_y[k]);
        if (isfinite(size) && scree_scene_drawn(s, k)) length[count++] = size;
    }
    view->arrows = count;
    scree_sort(length, count);
    double typical = scree_quantile(length, count, 0.95);
    if (!(typical > 0)) typical = count > 0 ? length[count - 1] : 0;
    scree_release(&length);
    double chosen = typical > 0 ? scree_round_below(6 * view->mean_radius / typical) : 0;
    if (!(chosen > 0) || !isfinite(chosen)) return SCREE_OK;
    view->arrow_scale = scene->arrow_scale > 0 ? scene->arrow_scale : chosen;
    measure_overhang(view, 3 * typical);
    return SCREE_OK;
}

/// What the bodies are called.
static const char *kind_of(const scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    size_t round = 0;
    if (view->scene->depth || view->scene->section) return "sphere";
    if (!s->corner_count) return "disc";
    for (size_t k = 0; k < s->count; k++) round += s->corner_count[k] == 0;
    return round == 0 ? "polygon" : "polygons and disc";
}

static void write_caption(scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    char strain[48] = "", time[48] = "", left_out[64] = "", beyond[64] = "", number[32];
    if (isfinite(s->axial_strain))
        (void)snprintf(strain, sizeof strain, ", %s %.2f %%", scree_strain_name(view->scene->of_cell),
                       100 * s->axial_strain);
    scree_number_text(number, sizeof number, s->time, 4);
    if (isfinite(s->time)) (void)snprintf(time, sizeof time, ", t = %s s", number);
    if (view->disc_count < s->count && !view->scene->section)
        (void)snprintf(left_out, sizeof left_out, ", %zu without a position", s->count - view->disc_count);
    // The bodies of a membrane are drawn too, but are no grains.
    size_t grains = 0, outside = 0;
    for (size_t k = 0; k < s->count; k++) {
        const bool grain = scree_snapshot_is_grain(s, k) && scree_scene_drawn(s, k);
        grains += grain;
        outside += grain && !is_shown(view, k);
    }
    if (outside > 0) (void)snprintf(beyond, sizeof beyond, ", %zu of them beyond the picture", outside);
    (void)snprintf(view->caption, sizeof view->caption, "%s%zu %s%s%s%s%s%s", view->scene->section ? "section, " : "",
                   grains, kind_of(view), grains == 1 ? "" : "s", beyond, left_out, strain, time);
}

/// Title and caption from the top margin; returns the y below them.
static double draw_heading(const scree_scene_view *view, cairo_t *cairo)
{
    scree_text_style title = {.size = TITLE_SIZE, .bold = true, .colour = scree_scene_ink};
    scree_text_style caption = {.size = CAPTION_SIZE, .colour = scree_scene_quiet};
    double width = view->page_width - 2 * MARGIN;
    double y = scree_text_paragraph(cairo, MARGIN, MARGIN, width, view->title, title);
    return scree_text_paragraph(cairo, MARGIN, y + 1, width, view->caption, caption);
}

/// Heading and legend are drawn once on paper that is thrown away, to learn their heights.
static void lay_out(scree_scene_view *view)
{
    double width = view->high[0] - view->low[0] + view->overhang_low[0] + view->overhang_high[0];
    double height = view->high[1] - view->low[1] + view->overhang_low[1] + view->overhang_high[1];
    view->scale = fmin(fmin(SAMPLE_WIDTH / width, SAMPLE_HEIGHT / height), LARGEST_DISC / view->mean_radius);
    view->width = width * view->scale;
    view->height = height * view->scale;
    cairo_surface_t *paper = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, NULL);
    cairo_t *cairo = cairo_create(paper);
    double legend = scree_scene_legend(view, cairo, 0, 0);
    double column = legend > 0 ? LEGEND_GAP + SCREE_SCENE_LEGEND_WIDTH : 0;
    view->page_width = fmax(2 * MARGIN + view->width + column, 230);
    view->left = MARGIN;
    view->top = draw_heading(view, cairo) + 9;
    view->page_height = view->top + fmax(view->height + 22, legend) + MARGIN;
    cairo_destroy(cairo);
    cairo_surface_destroy(paper);
}

/// The page of the first frame, with room for one more line of caption, is that of all.
static void share_page(scree_scene_view *view, scree_scene_frame *frame)
{
    if (frame->width == 0) {
        frame->width = view->page_width;
        frame->height = view->page_height + 1.5 * CAPTION_SIZE;
    }
    view->page_width = frame->width;
    view->page_height = frame->height;
}

/// More marks than a vector file is good for are drawn once, as pixels; both files show these, with their text and
/// legend as vectors.
static void make_raster(scree_scene_view *view, double pixels)
{
    const double scale = pixels / fmax(view->page_width, view->page_height);
    view->raster = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)lround(view->page_width * scale),
                                              (int)lround(view->page_height * scale));
    view->pixel = 1 / scale;
    cairo_t *cairo = cairo_create(view->raster);
    cairo_scale(cairo, scale, scale);
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_FAST);
    scree_scene_marks(view, cairo);
    cairo_destroy(cairo);
}

static void show_raster(const scree_scene_view *view, cairo_t *cairo)
{
    cairo_save(cairo);
    cairo_scale(cairo, view->pixel, view->pixel);
    cairo_set_source_surface(cairo, view->raster, 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
}

static void draw_page(cairo_t *cairo, void *user)
{
    const scree_scene_view *view = user;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    if (view->raster) show_raster(view, cairo);
    draw_heading(view, cairo);
    if (!view->raster) scree_scene_marks(view, cairo);
    scree_scene_scale_bar(view, cairo, view->left, view->top + view->height + 15);
    double legend = fmax(view->left + view->width + LEGEND_GAP, view->page_width - MARGIN - SCREE_SCENE_LEGEND_WIDTH);
    scree_scene_legend(view, cairo, legend, view->top);
}

/// Marks that are drawn some thousand at a time: discs of one colour, contacts of one width, cells.
static size_t many_marks(const scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    return s->count + s->contact_count + (view->scene->cells ? view->scene->cells->count : 0);
}

/// No shape has more discs or lines: some of these, the net, the lines of walls.
static size_t largest_shape(const scree_scene_view *view)
{
    const scree_snapshot *s = view->snapshot;
    const size_t many = many_marks(view), lines = s->wall_line_count + s->wall_triangle_count;
    return (many < SCREE_SCENE_PATH ? many : SCREE_SCENE_PATH) + s->triangle_count + lines;
}

scree_status scree_scene_draw(const char *path, const scree_snapshot *snapshot, const scree_scene *scene,
                              scree_error *error)
{
    scree_scene_view view = {.snapshot = snapshot, .scene = scene};
    scree_text_clean(view.title, sizeof view.title, scene->title ? scene->title : "");
    scree_text_clean(view.field_name, sizeof view.field_name, scene->field_name ? scene->field_name : "");
    scree_status status = measure_extent(&view, error);
    if (!status) status = order_discs(&view, error);
    if (!status) status = measure_arrows(&view, error);
    if (!status) measure_forces(&view);
    if (!status && (!scene->frame || scene->frame->whole)) {
        write_caption(&view);
        lay_out(&view);
        if (scene->frame) share_page(&view, scene->frame);
        const bool raster = many_marks(&view) > RASTER_MARKS;
        const int pixels = scene->frame ? FRAME_PIXELS : 0;
        status = scree_memory_check(raster ? RASTER_BYTES : 1, error);
        if (!status && raster)
            make_raster(&view, pixels > 0 ? pixels : fmax(SCREE_PAGE_PIXELS, scree_page_chosen_pixels()));
        const scree_page page = {view.page_width, view.page_height, largest_shape(&view), draw_page, &view, pixels};
        if (!status) status = scree_page_write(path, &page, error);
        if (view.raster) cairo_surface_destroy(view.raster);
    }
    scree_release(&view.order);
    return status;
}
