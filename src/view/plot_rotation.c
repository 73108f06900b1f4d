/// The figures of a stage rotate_particle, from its tables (run/rotation_results.h), the summary and the last snapshot:
/// decay of rotations with distance, rose of W with the axes of T, transmission per contact, and a map of the rotations
/// under the force network. A run without such a stage has no such tables, and none of these figures.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/array.h"
#include "io/run_directory.h"
#include "view/chart.h"
#include "view/page.h"
#include "view/scale.h"
#include "view/scene.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define FILE_DECAY  "rotation-decay.csv"
#define FILE_ROSE   "rotation-rose.csv"
#define FILE_BODIES "rotation-bodies.csv"
#define FILE_HANDED "rotation-handed.csv"

enum { BLUE = 1, VERMILLION, GREEN, PINK, SKY, ORANGE, BLACK };

static scree_status read_table(const scree_plot_run *run, const char *name, scree_series *table, scree_error *error)
{
    char path[PATH_MAX];
    *table = (scree_series){0};
    scree_status status = scree_path_join(path, sizeof path, run->directory, name, error);
    return status ? status : scree_series_read(table, path, error);
}

static bool has_file(const scree_plot_run *run, const char *name)
{
    char path[PATH_MAX];
    return !scree_path_join(path, sizeof path, run->directory, name, NULL) && access(path, F_OK) == 0;
}

/// A column that has to be there.
static scree_status get_column(const scree_series *table, const char *file, const char *name, const double **column,
                               scree_error *error)
{
    *column = scree_series_get(table, name);
    if (*column) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no column '%s'", file, name);
}

// ---- decay -------------------------------------------------------------------------------------------------------

typedef struct decay_columns {
    const double *body_distance, *body_ratio, *counts;
    const double *distance, *mean, *error, *fit;
} decay_columns;

static scree_status get_decay(const scree_series *bodies, const scree_series *bins, decay_columns *c,
                              scree_error *error)
{
    scree_status status = get_column(bodies, FILE_BODIES, "distance", &c->body_distance, error);
    if (!status) status = get_column(bodies, FILE_BODIES, "rotation_ratio", &c->body_ratio, error);
    if (!status) status = get_column(bodies, FILE_BODIES, "counts", &c->counts, error);
    if (!status) status = get_column(bins, FILE_DECAY, "distance", &c->distance, error);
    if (!status) status = get_column(bins, FILE_DECAY, "rotation_ratio", &c->mean, error);
    if (!status) status = get_column(bins, FILE_DECAY, "standard_error", &c->error, error);
    if (!status) status = get_column(bins, FILE_DECAY, "fit", &c->fit, error);
    return status;
}

/// What the bodies show: those that count, the forced one left out; far below the least mean there is nothing to see.
static void select_bodies(const decay_columns *c, size_t bodies, double lowest, double *ratio)
{
    for (size_t k = 0; k < bodies; k++) {
        bool shown = c->counts[k] > 0 && c->body_distance[k] > 0 && c->body_ratio[k] > 0.02 * lowest;
        ratio[k] = shown ? c->body_ratio[k] : NAN;
    }
}

static scree_status chart_decay(const scree_plot_run *run, const char *path, const scree_series *bodies,
                                const scree_series *bins, const decay_columns *c, double *room, scree_error *error)
{
    char fit[64], title[160];
    double *ratio = room, *low = ratio + bodies->row_count, *high = low + bins->row_count, lowest = INFINITY;
    double far = 0;
    for (size_t k = 0; k < bins->row_count; k++) {
        lowest = fmin(lowest, c->mean[k]);
        far = fmax(far, c->distance[k]);
        // The bar of a mean that is less than twice its error ends at a fifth of it, since the axis has no zero.
        low[k] = fmax(c->mean[k] - c->error[k], 0.2 * c->mean[k]);
        high[k] = c->mean[k] + c->error[k];
    }
    select_bodies(c, bodies->row_count, lowest, ratio);
    double background = scree_plot_result(run, "rotation_background"),
           length = scree_plot_result(run, "rotation_decay_length");
    double limit = scree_plot_result(run, "rotation_felt"), end[2] = {0.5, far}, floor[2] = {background, background};
    double felt[2] = {limit, limit};
    (void)snprintf(fit, sizeof fit, "exp(−r/ℓ), ℓ = %.2f", length);
    (void)snprintf(title, sizeof title, "Rotations around the forced particle reach %.1f mean diameters",
                   scree_plot_result(run, "rotation_reach"));
    if (isfinite(scree_plot_result(run, "rotation_decay_length_high")))
        (void)snprintf(title, sizeof title, "Rotations reach %.1f mean diameters, decay length %.2f (%.2f to %.2f)",
                       scree_plot_result(run, "rotation_reach"), length,
                       scree_plot_result(run, "rotation_decay_length_low"),
                       scree_plot_result(run, "rotation_decay_length_high"));
    const scree_chart_line line[] = {
        {.x = c->body_distance,
         .y = ratio,
         .count = bodies->row_count,
         .label = "each particle",
         .points = true,
         .bare = true,
         .faint = true,
         .colour = SKY},
        {.x = c->distance,
         .y = c->mean,
         .low = low,
         .high = high,
         .count = bins->row_count,
         .label = "mean of a shell",
         .points = true,
         .bare = true,
         .colour = BLUE},
        {.x = c->distance, .y = c->fit, .count = bins->row_count, .label = fit, .colour = VERMILLION},
        {.x = end, .y = felt, .count = 2, .label = "felt above", .dashed = true, .colour = BLACK},
        {.x = end, .y = floor, .count = 2, .label = "before forcing", .dashed = true, .colour = GREEN},
    };
    scree_chart chart = {.title = title,
                         .x_label = "distance from the forced particle (mean diameters)",
                         .y_label = "spin over that of the forced particle (1)",
                         .line = line,
                         .line_count = sizeof line / sizeof *line,
                         .log_y = true};
    return scree_chart_draw(path, &chart, error);
}

static scree_status has_decay(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (has_file(run, FILE_DECAY)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "there is no %s", FILE_DECAY);
}

static scree_status draw_decay(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_series bodies, bins = {0};
    decay_columns c;
    double *room = NULL;
    scree_status status = read_table(run, FILE_BODIES, &bodies, error);
    if (!status) status = read_table(run, FILE_DECAY, &bins, error);
    if (!status) status = get_decay(&bodies, &bins, &c, error);
    if (!status) status = scree_allocate(&room, bodies.row_count + 2 * bins.row_count, sizeof *room, error);
    if (!status) status = chart_decay(run, job->path, &bodies, &bins, &c, room, error);
    scree_release(&room);
    scree_series_destroy(&bins);
    scree_series_destroy(&bodies);
    return status;
}

// ---- rose --------------------------------------------------------------------------------------------------------

#define ROSE_RADIUS 150.0 /* pt */
#define ROSE_LEFT   195.0
#define ROSE_TOP    215.0
#define ROSE_WIDTH  560.0
#define ROSE_HEIGHT 410.0

typedef struct rose {
    const double *angle, *strength; ///< degrees, 1/m
    size_t count;
    double largest;               ///< 1/m, drawn at the full radius
    double axis, first, last;     ///< degrees, 1/m: first axis of Sym(T), both eigenvalues
    double peak_angle, off, size; ///< degrees between axis and peak; 1; degrees of a sector
    double correlation, low, high;
    double across, across_low, across_high;
} rose;

static const scree_colour ink = {0.13, 0.13, 0.15}, quiet = {0.45, 0.45, 0.48}, grid = {0.86, 0.86, 0.88},
                          petal = {0.34, 0.55, 0.75}, red = {0.80, 0.20, 0.10};

static void draw_polar_grid(cairo_t *cairo, const rose *r)
{
    scree_ticks ticks = scree_ticks_make(0, r->largest);
    scree_text_style small = {.size = 8.5, .colour = quiet};
    char text[64];
    cairo_set_line_width(cairo, 0.6);
    for (int k = 0; k < ticks.count; k++) {
        double radius = ROSE_RADIUS * ticks.value[k] / r->largest;
        if (!(radius > 1)) continue;
        scree_page_colour(cairo, grid);
        cairo_arc(cairo, ROSE_LEFT, ROSE_TOP, radius, 0, 2 * M_PI);
        cairo_stroke(cairo);
    }
    for (int degree = 0; degree < 360; degree += 30) {
        double x = cos(degree * M_PI / 180), y = -sin(degree * M_PI / 180);
        scree_page_colour(cairo, grid);
        cairo_move_to(cairo, ROSE_LEFT, ROSE_TOP);
        cairo_line_to(cairo, ROSE_LEFT + ROSE_RADIUS * x, ROSE_TOP + ROSE_RADIUS * y);
        cairo_stroke(cairo);
        (void)snprintf(text, sizeof text, "%d°", degree);
        scree_text_show(cairo, ROSE_LEFT + (ROSE_RADIUS + 17) * x, ROSE_TOP + (ROSE_RADIUS + 17) * y + 3, 0.5, text,
                        small);
    }
}

static void draw_petals(cairo_t *cairo, const rose *r)
{
    double half = 0.5 * r->size * M_PI / 180;
    cairo_set_line_width(cairo, 0.5);
    for (size_t k = 0; k < r->count; k++) {
        double middle = -r->angle[k] * M_PI / 180, radius = ROSE_RADIUS * fmax(0, r->strength[k]) / r->largest;
        cairo_move_to(cairo, ROSE_LEFT, ROSE_TOP);
        cairo_arc(cairo, ROSE_LEFT, ROSE_TOP, radius, middle - half, middle + half);
        cairo_close_path(cairo);
        scree_page_colour(cairo, petal);
        cairo_fill_preserve(cairo);
        cairo_set_source_rgb(cairo, 1, 1, 1);
        cairo_stroke(cairo);
    }
}

/// The axes of Sym(T): the first long, the second in the ratio of the eigenvalues.
static void draw_axes(cairo_t *cairo, const rose *r)
{
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, 2);
    scree_page_colour(cairo, red);
    for (int k = 0; k < 2; k++) {
        double length = ROSE_RADIUS * (k == 0 ? 1 : fmax(0, r->last / r->first));
        double x = length * cos((r->axis + 90 * k) * M_PI / 180), y = -length * sin((r->axis + 90 * k) * M_PI / 180);
        cairo_move_to(cairo, ROSE_LEFT - x, ROSE_TOP - y);
        cairo_line_to(cairo, ROSE_LEFT + x, ROSE_TOP + y);
        cairo_stroke(cairo);
    }
}

static double legend_line(cairo_t *cairo, double y, const char *text)
{
    return scree_text_paragraph(cairo, 395, y, ROSE_WIDTH - 405, text, (scree_text_style){.size = 9, .colour = ink}) +
           3;
}

static void draw_rose_legend(cairo_t *cairo, const rose *r)
{
    char text[200], number[64];
    double y = 62;
    scree_number_text(number, sizeof number, r->largest, 3);
    scree_page_colour(cairo, petal);
    cairo_rectangle(cairo, 395, y + 2, 9, 9);
    cairo_fill(cairo);
    (void)snprintf(text, sizeof text, "     W, sum of each sector of %.0f°; the longest is %s 1/m", r->size, number);
    y = legend_line(cairo, y, text) + 9;
    scree_page_colour(cairo, red);
    cairo_set_line_width(cairo, 2);
    cairo_move_to(cairo, 395, y + 6);
    cairo_line_to(cairo, 404, y + 6);
    cairo_stroke(cairo);
    y = legend_line(cairo, y, "     axes of Sym(T), lengths in the ratio of its eigenvalues");
    (void)snprintf(text, sizeof text, "eigenvalues %.3g and %.3g 1/m, first axis at %.0f°", r->first, r->last, r->axis);
    y = legend_line(cairo, y, text);
    (void)snprintf(text, sizeof text, "first axis to the peak of the rose: %.0f°", r->peak_angle);
    y = legend_line(cairo, y, text);
    (void)snprintf(text, sizeof text, "off-diagonal over diagonal of T: %.2f", r->off);
    y = legend_line(cairo, y, text) + 9;
    (void)snprintf(text, sizeof text, "rank correlation of W and rotation by direction: %.2f (%.2f to %.2f)",
                   r->correlation, r->low, r->high);
    if (isfinite(r->correlation)) y = legend_line(cairo, y, text);
    (void)snprintf(text, sizeof text, "rotation behind strong chains over that elsewhere: %.2f (%.2f to %.2f)",
                   r->across, r->across_low, r->across_high);
    if (isfinite(r->across)) (void)legend_line(cairo, y, text);
}

static void draw_rose_page(cairo_t *cairo, void *user)
{
    const rose *r = user;
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    scree_text_show(cairo, 9, 22, 0, "Force network around the forced particle: radial strength W by direction",
                    (scree_text_style){.size = 11, .bold = true, .colour = ink});
    draw_polar_grid(cairo, r);
    draw_petals(cairo, r);
    draw_axes(cairo, r);
    draw_rose_legend(cairo, r);
}

static scree_status has_plane(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (isfinite(scree_plot_result(run, "rotation_tensor_angle"))) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "a rose is drawn in two dimensions only");
}

static scree_status draw_rose(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_series table;
    rose r = {.axis = scree_plot_result(run, "rotation_tensor_angle"),
              .first = scree_plot_result(run, "rotation_tensor_first"),
              .last = scree_plot_result(run, "rotation_tensor_last"),
              .peak_angle = scree_plot_result(run, "rose_eigenvector_angle"),
              .off = scree_plot_result(run, "rotation_tensor_off_diagonal"),
              .correlation = scree_plot_result(run, "rotation_chain_correlation"),
              .low = scree_plot_result(run, "rotation_chain_correlation_low"),
              .high = scree_plot_result(run, "rotation_chain_correlation_high"),
              .across = scree_plot_result(run, "rotation_across_chains"),
              .across_low = scree_plot_result(run, "rotation_across_chains_low"),
              .across_high = scree_plot_result(run, "rotation_across_chains_high")};
    scree_status status = read_table(run, FILE_ROSE, &table, error);
    if (!status) status = get_column(&table, FILE_ROSE, "angle", &r.angle, error);
    if (!status) status = get_column(&table, FILE_ROSE, "radial_strength", &r.strength, error);
    if (!status) {
        r.count = table.row_count;
        r.size = 360.0 / (double)r.count;
        for (size_t k = 0; k < r.count; k++) r.largest = fmax(r.largest, r.strength[k]);
        const scree_page page = {ROSE_WIDTH, ROSE_HEIGHT, r.count, draw_rose_page, &r, 0};
        status = r.largest > 0 ? scree_page_write(job->path, &page, error)
                               : scree_error_set(error, SCREE_ERROR_INPUT, "no contact near the forced particle");
    }
    scree_series_destroy(&table);
    return status;
}

// ---- transmission per contact ------------------------------------------------------------------------------------

typedef struct handed_columns {
    const double *angle_low, *angle_high, *force, *angle, *ratio, *low, *high, *count;
} handed_columns;

static scree_status get_handed(const scree_series *table, handed_columns *c, scree_error *error)
{
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {
        {"angle_low", &c->angle_low},  {"angle_high", &c->angle_high}, {"force", &c->force},     {"angle", &c->angle},
        {"rotation_ratio", &c->ratio}, {"ratio_low", &c->low},         {"ratio_high", &c->high}, {"count", &c->count}};
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted && !status; k++)
        status = get_column(table, FILE_HANDED, wanted[k].name, wanted[k].column, error);
    return status;
}

/// Rows of the table from `first` on against their force or their angle.
static scree_status chart_handed(const char *path, const handed_columns *c, const double *x, size_t first, size_t count,
                                 const char *label, scree_error *error)
{
    char title[120];
    double contacts = 0, end[2] = {0, 0}, none[2] = {1, 1};
    for (size_t k = first; k < first + count; k++) {
        contacts += c->count[k];
        if (isfinite(x[k])) end[1] = fmax(end[1], x[k]);
    }
    (void)snprintf(title, sizeof title, "Rotations that %.0f contacts hand on, bars of 95 %%", contacts);
    const scree_chart_line line[] = {
        {.x = x + first,
         .y = c->ratio + first,
         .low = c->low + first,
         .high = c->high + first,
         .count = count,
         .label = "mean of the contacts in a bin",
         .points = true,
         .colour = BLUE},
        {.x = end, .y = none, .count = 2, .label = "nothing is lost", .dashed = true, .colour = BLACK},
    };
    scree_chart chart = {.title = title,
                         .x_label = label,
                         .y_label = "spin of the outer disc over that of the inner one (1)",
                         .line = line,
                         .line_count = sizeof line / sizeof *line};
    return scree_chart_draw(path, &chart, error);
}

static scree_status has_handed(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (has_file(run, FILE_HANDED)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "there is no %s", FILE_HANDED);
}

/// The rows by force come first; behind them those of all forces, by angle.
static scree_status draw_handed(const scree_plot_run *run, const scree_figure_job *job, bool by_angle,
                                scree_error *error)
{
    scree_series table;
    handed_columns c;
    scree_status status = read_table(run, FILE_HANDED, &table, error);
    if (!status) status = get_handed(&table, &c, error);
    if (!status) {
        size_t forces = 0;
        while (forces < table.row_count && c.angle_low[forces] == 0 && c.angle_high[forces] == 90) forces++;
        status = by_angle ? chart_handed(job->path, &c, c.angle, forces, table.row_count - forces,
                                         "angle to the major direction of the stress (degrees)", error)
                          : chart_handed(job->path, &c, c.force, 0, forces, "force over the mean force (1)", error);
    }
    scree_series_destroy(&table);
    return status;
}

static scree_status draw_handed_force(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return draw_handed(run, job, false, error);
}

static scree_status draw_handed_angle(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return draw_handed(run, job, true, error);
}

// ---- map ---------------------------------------------------------------------------------------------------------

static scree_status has_last(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    (void)job;
    if (run->snapshot_count > 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "there is no snapshot");
}

/// `field`: a row a body of the snapshot.
static scree_status draw_field(const char *path, const scree_snapshot *now, const double *field, size_t marked,
                               scree_error *error)
{
    const bool in_3d = now->dimension == 3;
    scree_scene scene = {.title = in_3d ? "Rotations around the forced sphere, section"
                                        : "Rotations around the forced disc and the force network",
                         .field = field,
                         .field_name = "spin over that of the forced particle (1), same sense positive",
                         .map = SCREE_COLOUR_DIVERGING,
                         .force_network = !in_3d,
                         .marked = &marked,
                         .marked_name = "forced particle"};
    return in_3d ? scree_plot_section(path, now, &scene, error) : scree_scene_draw(path, now, &scene, error);
}

/// The rotation of each body that counts, NAN of those that nothing holds: they turn as they like.
static scree_status gather_rotations(const scree_series *bodies, double **field, scree_error *error)
{
    const double *with = NULL, *counts = NULL;
    scree_status status = get_column(bodies, FILE_BODIES, "rotation_with", &with, error);
    if (!status) status = get_column(bodies, FILE_BODIES, "counts", &counts, error);
    if (!status) status = scree_allocate(field, bodies->row_count, sizeof **field, error);
    for (size_t k = 0; !status && k < bodies->row_count; k++) (*field)[k] = counts[k] > 0 ? with[k] : NAN;
    return status;
}

static scree_status draw_last(const scree_plot_run *run, const scree_figure_job *job, const double *field, size_t count,
                              scree_error *error)
{
    const double forced = scree_plot_result(run, "forced_particle");
    scree_snapshot now;
    scree_status status = scree_snapshot_read(run->directory, run->snapshot_count - 1, &now, error);
    if (status) return status;
    size_t marked = now.count;
    if (forced >= 0) marked = scree_position_of_id(now.id, now.count, (uint32_t)forced);
    if (now.count != count || marked == now.count)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "%s is not of the last snapshot", FILE_BODIES);
    else
        status = draw_field(job->path, &now, field, marked, error);
    scree_snapshot_destroy(&now);
    return status;
}

static scree_status draw_map(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    scree_series bodies;
    double *field = NULL;
    scree_status status = read_table(run, FILE_BODIES, &bodies, error);
    if (!status) status = gather_rotations(&bodies, &field, error);
    if (!status) status = draw_last(run, job, field, bodies.row_count, error);
    scree_release(&field);
    scree_series_destroy(&bodies);
    return status;
}

// ---- family ------------------------------------------------------------------------------------------------------

typedef scree_status job_function(const scree_plot_run *run, const scree_figure_job *job, scree_error *error);

typedef struct rotation_row {
    scree_figure figure;
    job_function *applies, *draw;
} rotation_row;

static const rotation_row rows[] = {
    {{"rotation-decay", "spins over the distance from the forced particle, with the fit of their decay", SCREE_USUAL},
     has_decay,
     draw_decay},
    {{"rotation-rose", "radial strength of the contacts near the forced particle by direction", SCREE_USUAL},
     has_plane,
     draw_rose},
    {{"rotation-handed-force", "spin that contacts hand on by their force", SCREE_USUAL},
     has_handed,
     draw_handed_force},
    {{"rotation-handed-angle", "spin that contacts hand on by their angle to the major direction of the stress",
      SCREE_USUAL},
     has_handed,
     draw_handed_angle},
    {{"rotation-map", "particles coloured by their spin over that of the forced one, with the contact forces",
      SCREE_USUAL},
     has_last,
     draw_map},
};

static bool was_forced(const scree_plot_run *run, const scree_figure *figure)
{
    (void)figure;
    return has_file(run, FILE_BODIES);
}

static scree_status applies(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return ((const rotation_row *)job->figure)->applies(run, job, error);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    return ((const rotation_row *)job->figure)->draw(run, job, error);
}

const scree_figure_family scree_figures_rotation = {
    SCREE_FIGURE_ROWS(rows),
    .meant = was_forced,
    .applies = applies,
    .draw = draw,
};
