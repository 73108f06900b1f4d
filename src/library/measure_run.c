/// What is measured of one run: its tables, of one snapshot or as a mean over those of a stage.
#include "library/measure.h"

#include "average/chains.h"
#include "average/force_statistics.h"
#include "average/increment.h"
#include "average/profile.h"
#include "io/snapshot_when.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    USUAL = 150, ///< grains of an element unless the user says
    SHARE = 10   ///< and in small samples the whole over this
};

void measure_tables_destroy(measure_tables *tables)
{
    for (int k = 0; k < MEASURE_PRODUCTS; k++) scree_average_table_destroy(&tables->of[k]);
}

void measure_say(const measure_plan *plan, const char *format, ...)
{
    char line[512];
    va_list list;
    if (!plan->options->message) return;
    va_start(list, format);
    (void)vsnprintf(line, sizeof line, format, list);
    va_end(list);
    plan->options->message(plan->options->user, line);
}

// ---- tables ------------------------------------------------------------------------------------------------------

/// Moments of the grains of a heap between its feet, what has rolled away left out.
typedef struct heap_moments {
    double mass, height, along, skewness; ///< kg; m above the base; m of x; m3, third central moment of x
} heap_moments;

static heap_moments find_moments(const scree_average_view *view)
{
    const scree_average_sample *sample = view->sample;
    heap_moments m = {0};
    for (int pass = 0; pass < 2; pass++)
        for (size_t p = 0; p < sample->bodies; p++) {
            const scree_average_grain *grain = &sample->grain[p];
            const double x = grain->position[0];
            if (!grain->counted || x < view->surface.left || x > view->surface.right) continue;
            if (pass == 0) {
                m.mass += grain->mass;
                m.height += grain->mass * (grain->position[1] - view->frame.base);
                m.along += grain->mass * x;
            } else {
                m.skewness += grain->mass / m.mass * pow(x - m.along / m.mass, 3);
            }
        }
    m.height /= m.mass;
    m.along /= m.mass;
    return m;
}

/// Distance of the apex of a triangle from the middle of its base b [m] by the third moment of its x, which is
/// -e (9 b^2 / 4 - e^2) / 135.
static double find_lean(double base, double skewness)
{
    double low = -0.5 * base, high = 0.5 * base;
    for (int k = 0; k < 60; k++) {
        const double e = 0.5 * (low + high), found = -e * (2.25 * base * base - e * e) / 135;
        *(found > skewness ? &low : &high) = e;
    }
    return 0.5 * (low + high);
}

/// The triangle that a plane pile is to theories: its area, and its height three times that of the centre of mass; with
/// two slopes the apex by the third moment of x and the middle of the base by the centre of mass. Feet have no part in
/// it: a few grains that lie before one would move the apex by a multiple of their distance.
static void tell_triangle(const scree_average_view *view, scree_average_table *values)
{
    const scree_average_sample *sample = view->sample;
    const heap_moments m = find_moments(view);
    const bool plane = sample->dimension == 2 && view->weight > 0 && m.height > 0;
    const double height = plane ? 3 * m.height : NAN, area = view->surface.volume, half = area / height;
    const double lean = plane ? find_lean(2 * half, m.skewness) : NAN;
    scree_average_table_take(values, "triangle_height", "m", height);
    scree_average_table_take(values, "triangle_slope", "degree", atan(height / half) * 180 / M_PI);
    scree_average_table_take(values, "triangle_slope_left", "degree", atan(height / (half + lean)) * 180 / M_PI);
    scree_average_table_take(values, "triangle_slope_right", "degree", atan(height / (half - lean)) * 180 / M_PI);
    scree_average_table_take(values, "triangle_apex", "m", m.along + 2 * lean / 3 - view->frame.axis);
    scree_average_table_take(values, "weight_density", "N/m3", plane ? view->weight / (area * sample->thickness) : NAN);
}

/// Mean coordination and the like, of the whole sample.
static void tell_whole(const scree_average_view *view, scree_average_table *values)
{
    const scree_average_sample *sample = view->sample;
    double contacts = 0, averages, above, solid = 0, weighted = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        if (!sample->grain[p].counted) continue;
        contacts += sample->own[p].contacts;
        solid += sample->grain[p].volume;
        weighted += sample->grain[p].volume * sample->own[p].contacts;
    }
    scree_average_plate_force(view, &averages, &above);
    scree_average_table_take(values, "time", "s", sample->time);
    scree_average_table_take(values, "grains", "1", (double)sample->counted);
    scree_average_table_take(values, "contacts", "1", (double)sample->contacts);
    scree_average_table_take(values, "coordination", "1", contacts / (double)sample->counted);
    scree_average_table_take(values, "volume_fraction", "1", sample->solid / view->surface.volume);
    scree_average_table_take(values, "fabric_factor", "1", weighted / solid / (contacts / (double)sample->counted));
    scree_average_table_take(values, "unbalanced_ratio", "1", sample->unbalanced_ratio);
    scree_average_table_take(values, "element_side", "m", view->frame.side);
    scree_average_table_take(values, "element_grains", "1", view->grains);
    scree_average_table_take(values, "height", "m", view->frame.height);
    scree_average_table_take(values, "half_width", "m", view->frame.half);
    scree_average_table_take(values, "axis", "m", view->frame.axis);
    tell_triangle(view, values);
    scree_average_table_take(values, "weight", "N", view->weight);
    scree_average_table_take(values, "outside_force", "N", view->plate);
    scree_average_table_take(values, "outside_force_ratio", "1", view->weight > 0 ? view->plate / view->weight : NAN);
    scree_average_table_take(values, "bottom_row_ratio", "1", view->weight > 0 ? averages / above : NAN);
}

static scree_status tell_chains(const scree_average_sample *sample, const measure_plan *plan,
                                scree_average_table *values, scree_error *error)
{
    scree_average_chains chains;
    uint8_t *linked;
    scree_status status = scree_allocate(&linked, sample->contacts, sizeof *linked, error);
    if (!status) status = scree_average_chains_find(sample, M_PI / 4, linked, &chains, error);
    if (!status && plan->network) status = measure_draw_network(plan->network, sample, linked, error);
    scree_release(&linked);
    if (status) return status;
    scree_average_table_take(values, "chains", "1", (double)chains.chains);
    scree_average_table_take(values, "chain_grain_share", "1", chains.grain_share);
    scree_average_table_take(values, "chain_pressure_share", "1", chains.pressure_share);
    scree_average_table_take(values, "chain_length", "1", chains.length);
    scree_average_table_take(values, "chain_longest", "1", (double)chains.longest);
    return SCREE_OK;
}

/// What the two states say together.
static scree_status tell_increments(scree_average_sample *before, scree_average_sample *sample, double grains,
                                    scree_average_table *values, scree_error *error)
{
    double value[SCREE_INCREMENT_ROWS];
    if (!sample->earlier) return SCREE_OK;
    scree_status status = scree_average_increment_find(before, sample, grains, value, error);
    for (size_t k = 0; k < SCREE_INCREMENT_ROWS && !status; k++)
        scree_average_table_take(values, scree_increment_rows[k].name, scree_increment_rows[k].unit, value[k]);
    return status;
}

/// before: the earlier state, finished where elastic constants are asked for.
static scree_status measure_view(scree_average_sample *before, scree_average_sample *sample,
                                 const scree_average_view *view, const measure_plan *plan, measure_tables *tables,
                                 scree_error *error)
{
    scree_average_table *values = &tables->of[MEASURE_VALUES], *cuts = &tables->of[MEASURE_CUTS];
    scree_status status = scree_average_cuts_table(view, &plan->average, cuts, error);
    if (!status) status = scree_average_table_begin_row(values, error);
    if (!status) tell_whole(view, values);
    if (!status) scree_average_profile_tell(cuts, plan->average.points, scree_average_table_take, values);
    if (!status && plan->options->mirror) scree_average_profile_mirror(cuts, plan->average.points);
    if (!status) scree_average_profile_forces(view, scree_average_table_take, values);
    if (!status && plan->average.sizes > 0) scree_average_sizes_tell(view, scree_average_table_take, values);
    if (!status) status = scree_average_forces_tell(sample, scree_average_table_take, values, error);
    if (!status) status = tell_chains(sample, plan, values, error);
    if (!status)
        status = tell_increments(before, sample, plan->average.grains > 0 ? plan->average.grains : view->grains, values,
                                 error);
    if (!status && plan->kernel) status = measure_kernel(before, sample, view, plan, tables, error);
    if (!status) status = scree_average_table_end_row(values, error);
    if (!status && plan->average.sizes > 0)
        status = scree_average_sizes_table(view, &plan->average, &tables->of[MEASURE_SIZES], error);
    if (!status && plan->average.grid[0] > 0)
        status = scree_average_map_table(view, &plan->average, &tables->of[MEASURE_MAP], error);
    if (!status) status = scree_average_forces_table(sample, &tables->of[MEASURE_FORCES], error);
    if (!status) status = scree_average_friction_table(sample, &tables->of[MEASURE_FRICTION], error);
    if (!status) status = scree_average_rose_table(sample, &tables->of[MEASURE_ROSE], error);
    return status;
}

/// What a reader has to know of the run before he believes its averages.
static void warn(const char *directory, const measure_plan *plan, const scree_average_sample *before,
                 const scree_average_view *view)
{
    const scree_average_sample *sample = view->sample;
    if (scree_average_are_few(view->grains))
        measure_say(plan, "warning: %s: an element holds %.3g grains, fewer than %d: averages over it are noise",
                    directory, view->grains, SCREE_AVERAGE_FEW);
    if (sample->contacts == 0)
        measure_say(plan, "warning: %s: there are no contacts", directory);
    else if (!(sample->unbalanced_ratio < MEASURE_AT_REST))
        measure_say(plan,
                    "warning: %s: not at rest: the mean force that is left on a grain is %.3g of the mean contact "
                    "force (averages of stress miss what moves the grains)",
                    directory, sample->unbalanced_ratio);
    if (plan->from && !sample->turn)
        measure_say(plan, "warning: %s: what grains have turned by is not known%s: there is no strain of Liao",
                    directory,
                    sample->dimension == 3 && !sample->orientation ? " (measure.orientation: yes keeps it)"
                                                                   : ", since it is counted anew in between");
    if (before->own && !(before->unbalanced_ratio < MEASURE_AT_REST))
        measure_say(
            plan,
            "warning: %s: the earlier state was not at rest, by %.3g of the mean contact force: what has changed "
            "is not elastic",
            directory, before->unbalanced_ratio);
}

/// Moves the grains from where they were in the snapshot `from`, if any, which `before` then is.
static scree_status move(const char *directory, const scree_snapshot_mark *from, const measure_plan *plan,
                         scree_average_sample *before, scree_average_sample *sample, scree_error *error)
{
    if (!from) return SCREE_OK;
    scree_status status = scree_sample_read(directory, from->index, before, error);
    if (!status && plan->average.fields & SCREE_AVERAGE_ELASTIC) status = scree_average_sample_finish(before, error);
    return status ? status : scree_average_move(sample, before, error);
}

/// m, by which kernels reach out of a cell.
static double margin_of(const measure_plan *plan, const scree_average_sample *sample)
{
    return fmax(plan->kernel_width, 2 * plan->kernel_diameters * sample->mean_radius);
}

/// What cannot be averaged over is a matter of the snapshot.
static scree_status name_snapshot(scree_status status, scree_error *error)
{
    if (status != SCREE_ERROR_INPUT || !error) return status;
    (void)snprintf(error->field, sizeof error->field, "--at");
    (void)snprintf(error->accepted, sizeof error->accepted,
                   "another snapshot: end, #N, or a stage; for grains that do not touch --fields density,velocity");
    return status;
}

/// Finishes a sample: with contacts, where something that is asked for is made of them.
static scree_status finish(const measure_plan *plan, scree_average_sample *sample, scree_error *error)
{
    const unsigned of_contacts = SCREE_AVERAGE_STRESS | SCREE_AVERAGE_FABRIC | SCREE_AVERAGE_ELASTIC;
    const bool needed = plan->average.fields & of_contacts || plan->kernel || plan->average.sizes > 0 || plan->fits > 0;
    return needed ? scree_average_sample_finish(sample, error) : scree_average_sample_finish_loose(sample, error);
}

/// A sample that is finished. before: the earlier state; frame: where places are, found by the first one of several;
/// NULL: there is one.
static scree_status measure_sample(const char *name, const measure_plan *plan, bool first, scree_average_frame *frame,
                                   scree_average_sample *before, scree_average_sample *sample, measure_tables *tables,
                                   scree_error *error)
{
    scree_average_view view;
    scree_status status = SCREE_OK;
    measure_plan own = *plan;
    own.average.frame = first ? NULL : frame;
    if (sample->dimension == 2 && own.average.grid[2] > 0)
        return scree_error_refuse(error, "--grid", "points along x and y, such as 100x50",
                                  "a sample in the plane has no third direction");
    if (own.share > 0) own.average.grains = fmax(1, own.share * (double)sample->counted);
    own.average.fits = !own.element_given;
    if (!own.element_given)
        own.average.grains = sample->counted < SHARE * USUAL ? fmax(1, (double)(sample->counted / SHARE)) : USUAL;
    // Kernels reach out of a periodic cell as far as they are wide.
    if (own.kernel) status = scree_average_sample_repeat(sample, margin_of(&own, sample), error);
    if (!status && own.kernel && before->own)
        status = scree_average_sample_repeat(before, margin_of(&own, sample), error);
    if (!status) status = scree_average_view_open(sample, &own.average, &view, error);
    if (status) return status;
    if (first && frame) *frame = view.frame;
    if (first) warn(name, plan, before, &view);
    status = measure_view(before, sample, &view, &own, tables, error);
    scree_average_view_close(&view);
    return status;
}

static scree_status measure_snapshot(const char *directory, const scree_snapshot_mark *mark,
                                     const scree_snapshot_mark *from, const measure_plan *plan, bool first,
                                     scree_average_frame *frame, measure_tables *tables, scree_error *error)
{
    scree_average_sample sample, before = {0};
    scree_status status = scree_sample_read(directory, mark->index, &sample, error);
    if (status) return status;
    status = move(directory, from, plan, &before, &sample, error);
    if (!status) status = name_snapshot(finish(plan, &sample, error), error);
    if (!status) status = measure_sample(directory, plan, first, frame, &before, &sample, tables, error);
    if (!status && from && plan->network && sample.dimension == 2)
        status = measure_draw_displacements(plan->network, directory, from->place, &sample, &tables->of[MEASURE_VALUES],
                                            error);
    if (!status && sample.dimension == 2)
        status = measure_response(directory, sample.thickness, &tables->of[MEASURE_RESPONSE], error);
    scree_average_sample_destroy(&before);
    scree_average_sample_destroy(&sample);
    if (status && error && !error->file[0]) (void)snprintf(error->file, sizeof error->file, "%s", directory);
    return status;
}

static scree_status measure_file(const char *path, const measure_plan *plan, measure_tables *tables, scree_error *error)
{
    scree_average_sample sample, before = {0};
    scree_status status = measure_file_sample(path, plan, &sample, error);
    if (status) return status;
    status = finish(plan, &sample, error);
    if (!status) status = measure_sample(path, plan, true, NULL, &before, &sample, tables, error);
    scree_average_sample_destroy(&sample);
    if (status && error && !error->file[0]) (void)snprintf(error->file, sizeof error->file, "%s", path);
    return status;
}

// ---- a run -------------------------------------------------------------------------------------------------------

/// Mean over some snapshots, table by table.
static scree_status average_over(const measure_tables *each, size_t count, measure_tables *tables, scree_error *error)
{
    scree_average_table *same;
    scree_status status = scree_allocate(&same, count, sizeof *same, error);
    for (int k = 0; k < MEASURE_PRODUCTS && !status; k++) {
        if (each[0].of[k].rows == 0) continue;
        for (size_t i = 0; i < count; i++) same[i] = each[i].of[k];
        status = scree_average_table_mean(same, count, &tables->of[k], NULL, NULL, error);
    }
    scree_release(&same);
    return status;
}

/// Whether snapshot k is one of those that a mean is taken over: of a stage, or the last ones.
static bool is_meant(const measure_plan *plan, bool by_number, unsigned long last, const scree_snapshot_mark *mark,
                     size_t count, size_t k)
{
    return by_number ? k + last >= count : scree_snapshot_mark_is_of(&mark[k], plan->at);
}

static scree_status measure_stage(const char *directory, const scree_snapshot_mark *mark, size_t count,
                                  const measure_plan *plan, measure_tables *tables, scree_error *error)
{
    measure_tables *each;
    scree_average_frame frame;
    size_t taken = 0, of_stage = 0;
    char *end;
    // A whole number means so many snapshots, the last ones.
    const unsigned long last = strtoul(plan->at, &end, 10);
    const bool by_number = *plan->at && *end == 0 && last > 0;
    for (size_t k = 0; k < count; k++) of_stage += is_meant(plan, by_number, last, mark, count, k);
    if (of_stage == 0) return scree_snapshot_refuse_when(mark, count, plan->at, "--at", error);
    scree_status status = scree_allocate(&each, of_stage, sizeof *each, error);
    for (size_t k = 0; k < count && !status; k++) {
        if (!is_meant(plan, by_number, last, mark, count, k)) continue;
        status = measure_snapshot(directory, &mark[k], NULL, plan, taken == 0, &frame, &each[taken], error);
        taken++;
    }
    if (!status) measure_say(plan, "%s: mean over %zu snapshots", directory, taken);
    if (!status) status = average_over(each, taken, tables, error);
    for (size_t k = 0; k < taken; k++) measure_tables_destroy(&each[k]);
    scree_release(&each);
    return status;
}

scree_status measure_run(const char *directory, const measure_plan *plan, measure_tables *tables, scree_error *error)
{
    scree_snapshot_mark *mark;
    size_t count, which = 0, from = 0;
    if (measure_is_file(directory)) return measure_file(directory, plan, tables, error);
    scree_status status = scree_snapshot_marks(directory, &mark, &count, error);
    if (status) return status;
    if (plan->mean) {
        status = measure_stage(directory, mark, count, plan, tables, error);
    } else {
        status = scree_snapshot_find_when(mark, count, plan->at, "--at", &which, error);
        if (!status && plan->from) status = scree_snapshot_find_when(mark, count, plan->from, "--from", &from, error);
        if (!status && plan->from && from == which)
            status = scree_error_refuse(error, "--from", "an earlier one: start, #N, or a stage",
                                        "'%s' is the snapshot of --at: nothing has moved between the two", plan->from);
        if (!status)
            status = measure_snapshot(directory, &mark[which], plan->from ? &mark[from] : NULL, plan, true, NULL,
                                      tables, error);
    }
    scree_release(&mark);
    return status;
}
