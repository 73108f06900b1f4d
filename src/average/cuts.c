/// Cuts and maps.
#include "average/cuts.h"

#include <math.h>
#include <stdio.h>

// ---- the view ----------------------------------------------------------------------------------------------------

/// Upward force [N] on the grains of all that is none.
static double plate_force(const scree_average_sample *sample)
{
    const int up = sample->dimension - 1;
    double force = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const bool first = sample->grain[contact->first].counted;
        const bool second = contact->second != SCREE_AVERAGE_OUTSIDE && sample->grain[contact->second].counted;
        if (first == second) continue;
        force += (first ? 1 : -1) * contact->force[up];
    }
    return force;
}

static double centre_of_mass(const scree_average_sample *sample, const scree_average_surface *surface)
{
    double mass = 0, moment = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        const double x = grain->position[0];
        if (!grain->counted || x < surface->left || x > surface->right) continue;
        mass += grain->mass;
        moment += grain->mass * x;
    }
    return moment / mass;
}

static void place(const scree_average_sample *sample, const scree_average_plan *plan, scree_average_view *view)
{
    const scree_average_surface *s = &view->surface;
    const double apart = s->volume / (double)sample->counted; // room of a grain
    const int d = sample->dimension;
    view->side = plan->grains > 0 ? pow(plan->grains * apart, 1.0 / d) : plan->side;
    view->grains = pow(view->side, d) / apart;
    view->base = s->base;
    view->height = s->highest - s->base;
    view->half = 0.5 * (s->right - s->left);
    view->axis = plan->axis == SCREE_AVERAGE_AXIS_MASS   ? centre_of_mass(sample, s)
                 : plan->axis == SCREE_AVERAGE_AXIS_APEX ? s->apex
                                                         : plan->axis_given;
    view->middle = 0.5 * (sample->low[1] + sample->high[1]);
    view->bulk_density = sample->mass / (s->volume * sample->thickness);
    view->weight = -sample->mass * sample->gravity[d - 1];
    view->plate = plate_force(sample);
}

static scree_status check_side(const scree_average_view *view, scree_error *error)
{
    const double width = 2 * view->half;
    if (view->side <= view->height && view->side <= width) return SCREE_OK;
    scree_status status = scree_error_set(
        error, SCREE_ERROR_INPUT,
        "an element of %.3g m (%.0f grains) is larger than the sample, which is %.3g m wide and %.3g m high with %zu "
        "grains: take fewer grains",
        view->side, view->grains, width, view->height, view->sample->counted);
    if (error) (void)snprintf(error->field, sizeof error->field, "--element");
    return status;
}

scree_status scree_average_view_open(scree_average_sample *sample, const scree_average_plan *plan,
                                     scree_average_view *view, scree_error *error)
{
    *view = (scree_average_view){.sample = sample};
    scree_status status = scree_average_surface_find(sample, &view->surface, error);
    if (!status) {
        place(sample, plan, view);
        status = check_side(view, error);
    }
    if (!status) status = scree_average_sample_repeat(sample, view->side, error); // unless it has its images
    if (!status)
        status = scree_average_bins_make(sample, fmax(2 * sample->mean_radius, view->side / 4), &view->bins, error);
    for (size_t p = 0; p < sample->bodies; p++) view->moved = view->moved || sample->grain[p].moved;
    if (!status && view->moved) status = scree_average_strain_open(sample, &view->bins, &view->strain, error);
    if (status) scree_average_view_close(view);
    return status;
}

void scree_average_view_close(scree_average_view *view)
{
    scree_average_surface_destroy(&view->surface);
    scree_average_bins_destroy(&view->bins);
    scree_average_strain_close(&view->strain);
}

// ---- tables ------------------------------------------------------------------------------------------------------

static scree_average_element element_at(const scree_average_view *view, const scree_vector centre)
{
    const bool in_3d = view->sample->dimension == 3;
    return scree_average_element_at(centre, (scree_vector){view->side, view->side, in_3d ? view->side : 0});
}

/// Minus the vertical normal stress [Pa].
static double vertical_pressure(const scree_average_view *view, const scree_average_value *value)
{
    const int up = view->sample->dimension - 1;
    return -value->centres.moment[4 * up] / (value->volume * view->sample->thickness);
}

static void tell_fields(const scree_average_view *view, const scree_average_plan *plan, const scree_vector centre,
                        scree_average_table *table)
{
    const scree_average_element element = element_at(view, centre);
    const double g = -view->sample->gravity[view->sample->dimension - 1];
    scree_average_value value;
    scree_average_measure(view->sample, &view->bins, &view->surface, &element, &value);
    scree_average_tell(view->sample, &value, plan->fields, scree_average_table_take, table);
    if (view->moved) scree_average_strain_tell(&view->strain, &element, scree_average_table_take, table);
    if (plan->fields & SCREE_AVERAGE_STRESS)
        scree_average_table_take(table, "vertical_pressure_scaled", "1",
                                 g > 0 ? vertical_pressure(view, &value) / (view->bulk_density * g * view->height)
                                       : NAN);
}

scree_status scree_average_cuts_table(const scree_average_view *view, const scree_average_plan *plan,
                                      scree_average_table *table, scree_error *error)
{
    const int up = view->sample->dimension - 1;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < plan->cuts * plan->points && !status; k++) {
        const size_t cut = k / plan->points, half = plan->points / 2;
        const double at = half > 0 ? ((double)(k % plan->points) - (double)half) / (double)half : 0;
        scree_vector centre = {view->axis + at * view->half, view->middle, 0};
        centre[up] = view->base + 0.5 * view->side + plan->height[cut] * (view->height - view->side);
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        scree_average_table_take(table, "cut", "1", (double)cut);
        scree_average_table_take(table, "height", "1", plan->height[cut]);
        scree_average_table_take(table, up == 1 ? "y" : "z", "m", centre[up] - view->base);
        scree_average_table_take(table, "place", "1", at);
        scree_average_table_take(table, "x", "m", centre[0] - view->axis);
        tell_fields(view, plan, centre, table);
        status = scree_average_table_end_row(table, error);
    }
    return status;
}

scree_status scree_average_map_table(const scree_average_view *view, const scree_average_plan *plan,
                                     scree_average_table *table, scree_error *error)
{
    const scree_average_sample *sample = view->sample;
    const double low[3] = {view->surface.left, sample->dimension == 2 ? view->base : sample->low[1], view->base};
    const double high[3] = {view->surface.right, sample->dimension == 2 ? view->surface.highest : sample->high[1],
                            view->surface.highest};
    const size_t *n = plan->grid, count = n[0] * n[1] * n[2];
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < count && !status; k++) {
        const size_t number[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        scree_vector centre = {0};
        for (int i = 0; i < sample->dimension; i++)
            centre[i] = low[i] + ((double)number[i] + 0.5) / (double)n[i] * (high[i] - low[i]);
        status = scree_average_table_begin_row(table, error);
        if (status) break;
        for (int i = 0; i < sample->dimension; i++)
            scree_average_table_take(table, (const char *[]){"x", "y", "z"}[i], "m", centre[i]);
        tell_fields(view, plan, centre, table);
        status = scree_average_table_end_row(table, error);
    }
    return status;
}

void scree_average_plate_force(const scree_average_view *view, double *averages, double *weight)
{
    const scree_average_sample *sample = view->sample;
    const int up = sample->dimension - 1;
    // One element that spans the sample is the sum of elements side by side.
    scree_average_element row;
    scree_average_value value;
    for (int k = 0; k < 3; k++) {
        row.low[k] = sample->low[k] - view->side;
        row.high[k] = sample->high[k] + view->side;
    }
    row.low[up] = view->base;
    row.high[up] = view->base + view->side;
    scree_average_measure(sample, &view->bins, &view->surface, &row, &value);
    *averages = -value.parts.moment[4 * up] / view->side;
    *weight = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        const double above = (grain->position[up] - view->base) / view->side;
        if (grain->counted) *weight -= grain->mass * sample->gravity[up] * fmax(0, fmin(1, above));
    }
}
