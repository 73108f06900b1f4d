/// Samples: filled from a state, and what belongs to each grain alone.
#include "average/sample.h"

#include "average/tensor.h"
#include "integrate/integrate.h"
#include "integrate/orientation.h"
#include "shape/polygons.h"
#include "shape/rounding.h"
#include "state/periodic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void scree_average_sample_destroy(scree_average_sample *sample)
{
    scree_release(&sample->grain);
    scree_release(&sample->contact);
    scree_release(&sample->corner);
    scree_release(&sample->own);
    scree_release(&sample->earlier);
    scree_release(&sample->orientation);
    scree_release(&sample->turn);
    *sample = (scree_average_sample){0};
}

// ---- from a state ------------------------------------------------------------------------------------------------

static void fill_grain(const scree_model *model, const scree_state *state, size_t row, scree_average_grain *grain)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    const unsigned all = state->dimension == 2 ? 3 : 7;
    scree_vector spin, torque;
    *grain =
        (scree_average_grain){.id = state->id[row],
                              .mass = scree_body_mass(state, row),
                              .radius = scree_body_bounding_radius(state, row),
                              .volume = scree_body_volume(state, row),
                              .angle = state->dimension == 2 ? scree_body_angle(state, row) : 0,
                              .counted = scree_body_is_grain(state, row) && (scree_body_held(state, row) & all) != all};
    scree_body_position(state, row, grain->position);
    scree_body_velocity(model, state, row, grain->velocity, spin);
    scree_body_force(model, state, row, grain->resultant, torque);
    if (state->dimension == 2) grain->velocity[2] = grain->resultant[2] = 0;
    if (!polygons || !polygons->of) return;
    grain->first_corner = polygons->of[row].first;
    grain->corner_count = polygons->of[row].count;
    grain->rounding = scree_rounding_of_row(polygons, row);
}

static void fill_contact(const scree_contact *from, scree_average_contact *to)
{
    *to = (scree_average_contact){.first = from->first,
                                  .second = from->wall ? SCREE_AVERAGE_OUTSIDE : from->second,
                                  .sliding = from->sliding,
                                  .normal_force = from->normal_force,
                                  .tangential_force = from->tangential_force};
    for (int k = 0; k < 3; k++) {
        to->normal[k] = from->normal[k];
        to->point[k] = from->point[k];
        to->branch[k] = from->branch[k];
        to->force[k] = from->normal_force * from->normal[k] + from->tangential_force * from->tangent[k];
    }
}

scree_status scree_average_sample_of_state(const scree_model *model, const scree_state *state,
                                           const scree_contact_table *table, scree_average_sample *sample,
                                           scree_error *error)
{
    const scree_polygons *polygons = scree_polygons_of(state);
    const scree_quaternion *orientation = scree_orientations(state);
    *sample = (scree_average_sample){.dimension = state->dimension,
                                     .thickness = state->dimension == 2 ? model->thickness : 1,
                                     .time = scree_state_time(state),
                                     .turned_since = state->turned_since,
                                     .directions = scree_cell(state)->directions,
                                     .bodies = state->count,
                                     .contacts = table->count,
                                     .corner_count = polygons && polygons->of ? polygons->count : 0};
    memcpy(sample->gravity, model->gravity, sizeof sample->gravity);
    memcpy(sample->lattice, scree_cell(state)->lattice, sizeof sample->lattice);
    memcpy(sample->reference, scree_cell(state)->reference, sizeof sample->reference);
    scree_status status = scree_allocate(&sample->grain, state->count, sizeof *sample->grain, error);
    if (!status) status = scree_allocate(&sample->contact, table->count, sizeof *sample->contact, error);
    if (!status) status = scree_allocate(&sample->corner, sample->corner_count, sizeof *sample->corner, error);
    if (!status && orientation)
        status = scree_allocate(&sample->orientation, state->count, sizeof *sample->orientation, error);
    if (status) {
        scree_average_sample_destroy(sample);
        return status;
    }
    for (size_t row = 0; row < state->count; row++) fill_grain(model, state, row, &sample->grain[row]);
    for (size_t c = 0; c < table->count; c++) fill_contact(&table->contact[c], &sample->contact[c]);
    if (sample->corner_count > 0)
        memcpy(sample->corner, polygons->corner, sample->corner_count * sizeof *sample->corner);
    if (orientation) memcpy(sample->orientation, orientation, state->count * sizeof *sample->orientation);
    return SCREE_OK;
}

// ---- what belongs to a grain -------------------------------------------------------------------------------------

void scree_average_outline(const scree_average_sample *sample, const scree_average_grain *grain, double (*placed)[2])
{
    scree_polygon_turn((int)grain->corner_count, (const double(*)[2])sample->corner + grain->first_corner,
                       cos(grain->angle), sin(grain->angle), placed);
}

/// Inertia tensor and long axis of a grain.
static void find_form(const scree_average_sample *sample, const scree_average_grain *grain, scree_average_own *own)
{
    const double r = grain->radius;
    if (grain->corner_count == 0) {
        const double round = sample->dimension == 2 ? 0.25 * grain->volume * r * r : 0.4 * grain->volume * r * r;
        for (int k = 0; k < sample->dimension; k++) own->inertia[4 * k] = round;
        return;
    }
    double placed[SCREE_POLYGON_CORNERS][2], value[3], direction[9];
    scree_average_outline(sample, grain, placed);
    const int count = (int)grain->corner_count;
    const double(*corner)[2] = (const double(*)[2])placed;
    const scree_polygon_measures m = grain->rounding > 0 ? scree_rounding_measure(count, corner, grain->rounding)
                                                         : scree_polygon_measure(count, corner);
    own->inertia[0] = m.moment[0];
    own->inertia[4] = m.moment[1];
    own->inertia[1] = own->inertia[3] = -m.moment[2];
    scree_tensor_principal(own->inertia, 2, value, direction);
    // The long axis is the minor one of the tensor of inertia; that of a regular polygon is none.
    if (value[0] - value[1] > 1e-9 * value[0]) scree_tensor_add(own->axis, 1, direction + 3, direction + 3);
}

static void add_contact(const scree_average_sample *sample, const scree_average_contact *contact, int end)
{
    const uint32_t at = end ? contact->second : contact->first;
    if (at == SCREE_AVERAGE_OUTSIDE) return;
    scree_average_own *own = &sample->own[at];
    scree_vector lever;
    scree_average_lever(sample, contact, end, lever);
    scree_tensor_add(own->moment, end ? -1 : 1, contact->force, lever);
    scree_tensor_add(own->normals, 1, contact->normal, contact->normal);
    if (scree_normalise(lever) > 0) scree_tensor_add(own->branches, 1, lever, lever);
    own->contacts++;
}

static void find_totals(scree_average_sample *sample)
{
    double resultants = 0, touching = 0, radii = 0;
    for (int k = 0; k < 3; k++) sample->low[k] = INFINITY, sample->high[k] = -INFINITY;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!grain->counted) continue;
        sample->counted++;
        radii += grain->radius;
        sample->solid += grain->volume;
        sample->mass += grain->mass;
        for (int k = 0; k < sample->dimension; k++) {
            sample->low[k] = fmin(sample->low[k], grain->position[k] - grain->radius);
            sample->high[k] = fmax(sample->high[k], grain->position[k] + grain->radius);
        }
        if (sample->own[p].contacts == 0) continue;
        resultants += scree_length(grain->resultant);
        touching++;
    }
    for (size_t c = 0; c < sample->contacts; c++) sample->mean_force += scree_length(sample->contact[c].force);
    if (sample->contacts > 0) sample->mean_force /= (double)sample->contacts;
    sample->mean_radius = radii / (double)sample->counted;
    sample->mean_volume = sample->solid / (double)sample->counted;
    sample->unbalanced_ratio = resultants / touching / sample->mean_force;
    for (int k = 0; k < sample->dimension; k++)
        if (scree_average_repeats(sample, k)) sample->low[k] = 0, sample->high[k] = sample->lattice[4 * k];
    if (sample->dimension == 2) sample->low[2] = sample->high[2] = 0;
}

/// Whether all numbers are numbers.
static scree_status check(const scree_average_sample *sample, bool loose, scree_error *error)
{
    size_t grains = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (!isfinite(scree_length(grain->position)) || !(grain->volume > 0) || !isfinite(grain->volume))
            return scree_error_set(error, SCREE_ERROR_INPUT, "body %u has no position or no size that is a number",
                                   grain->id);
        grains += grain->counted;
    }
    if (grains == 0) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no grain to average over");
    if (sample->contacts == 0 && !loose)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "there are no contacts: averages of stress and fabric need grains that touch");
    for (size_t c = 0; c < sample->contacts; c++)
        if (!isfinite(scree_length(sample->contact[c].force)))
            return scree_error_set(error, SCREE_ERROR_INPUT, "the force of a contact of body %u is not a number",
                                   sample->grain[sample->contact[c].first].id);
    return SCREE_OK;
}

/// loose: there need be no contacts.
static scree_status finish(scree_average_sample *sample, bool loose, scree_error *error)
{
    scree_status status = check(sample, loose, error);
    sample->count = sample->bodies;
    sample->contact_count = sample->contacts;
    if (!status) status = scree_allocate(&sample->own, sample->bodies, sizeof *sample->own, error);
    if (status) return status;
    for (size_t p = 0; p < sample->bodies; p++) {
        sample->grain[p].body = (uint32_t)p;
        find_form(sample, &sample->grain[p], &sample->own[p]);
    }
    for (size_t c = 0; c < sample->contacts; c++)
        for (int end = 0; end < 2; end++) add_contact(sample, &sample->contact[c], end);
    find_totals(sample);
    return SCREE_OK;
}

scree_status scree_average_sample_finish(scree_average_sample *sample, scree_error *error)
{
    return finish(sample, false, error);
}

scree_status scree_average_sample_finish_loose(scree_average_sample *sample, scree_error *error)
{
    return finish(sample, true, error);
}
