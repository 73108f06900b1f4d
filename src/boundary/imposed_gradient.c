/// Forces of an imposed motion, and their accumulates.
///
/// Uniform stress S on a closed surface. Every corner of a facet gets S times its share of the facet's area vector. A
/// share is a sum over the edges of the facet, or its ends in 2D, each of which belongs to the neighbouring facet with
/// the opposite sign:
///     2D  share = (t/2) (h(b) - h(a)),  h(x) = (y, -x);      3D  share = (a x b + b x c + c x a) / 6.
/// Each term is rounded to an integer once for both facets (in 3D from the node with the lower number to the other), so
/// the integers telescope and the forces of a closed surface add up to zero to the last bit. Rounding is half a quantum
/// a term. Places are relative to a node, so the terms stay small. Cost: O(facets).
///
/// Bodies that deform are strained by these forces as by contacts: they come in at the arm R a/|a|, outwards along the
/// area vector of the body. They are known behind the contacts, and strain the bodies with those of the same step.
///
/// Rates, volume and work steer the run or stay in its state: sums in integers, whose nodes may come in any order.
#include "boundary/imposed_gradient.h"
#include "measure/imposed_gradient.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/wrapping.h"
#include "boundary/surface_work.h"
#include "contact/stretch.h"
#include "measure/facets.h"
#include "state/fields.h"

#include <math.h>
#include <string.h>

scree_status scree_imposed_begin(const scree_model *model, scree_state *state, scree_error *error)
{
    scree_imposed_gradient *imposed = scree_imposed(state);
    (void)model, (void)error;
    imposed->count = 0;
    imposed->achieved = imposed->wanted = 0;
    memset(imposed->rate, 0, sizeof imposed->rate);
    memset(imposed->stress, 0, sizeof imposed->stress);
    if (imposed->surface) memset(imposed->surface, 0, state->count * sizeof *imposed->surface);
    return SCREE_OK;
}

scree_status scree_imposed_refresh(const scree_context *context, scree_error *error)
{
    scree_state *state = context->state;
    size_t count = scree_boundary_count(state);
    scree_status status =
        scree_group_reserve(state, &scree_module_imposed_gradient, &scree_imposed_nodes, count, error);
    if (!status) scree_imposed(state)->count = count;
    return status;
}

void scree_imposed_add(scree_state *state, size_t node, const int64_t quanta[3])
{
    const size_t row = scree_boundary_row(state, node);
    if (row != SCREE_NO_ROW) {
        scree_sum_row *sum = &state->sum[row];
        scree_wrapping_add(&sum->fx, quanta[0]);
        scree_wrapping_add(&sum->fy, quanta[1]);
        if (state->dimension == 3) scree_wrapping_add(&sum->fz, quanta[2]);
    }
    for (int i = 0; i < state->dimension; i++)
        scree_imposed(state)->force[node][i] += (double)quanta[i] * state->force_quantum;
}

void scree_imposed_add_work(scree_state *state)
{
    scree_integer_sum power = {0};
    scree_vector velocity;
    while (scree_integer_sum_next(&power, 1))
        for (size_t k = 0; k < scree_imposed(state)->count; k++) {
            scree_boundary_motion(state, k, velocity);
            scree_integer_sum_add(&power, scree_dot(scree_imposed(state)->force[k], velocity));
        }
    double work = 0.5 * state->step_size * scree_integer_sum_total(&power);
    state->ledger.boundary += work;
    state->ledger.turnover += fabs(work);
}

double scree_imposed_measure(const scree_state *state, scree_vector *area, double rate[9])
{
    enum { VOLUME = 9 };
    scree_integer_sum sum[10] = {0};
    scree_vector origin, position, velocity;
    scree_boundary_position(state, 0, origin);
    while (scree_integer_sum_next(sum, 10))
        for (size_t k = 0; k < scree_boundary_count(state); k++) {
            scree_boundary_motion(state, k, velocity);
            scree_boundary_position(state, k, position);
            scree_subtract(position, origin, position);
            scree_integer_sum_add(&sum[VOLUME], scree_dot(position, area[k]));
            for (int i = 0; i < state->dimension; i++)
                for (int j = 0; j < state->dimension; j++)
                    scree_integer_sum_add(&sum[3 * i + j], velocity[i] * area[k][j]);
        }
    double volume = scree_integer_sum_total(&sum[VOLUME]) / state->dimension;
    for (int c = 0; c < 9; c++) rate[c] = scree_integer_sum_total(&sum[c]) / volume;
    return volume;
}

/// Mirror ghost of component c of a 3 x 3 tensor.
static int mirror(int c)
{
    return 3 * (c % 3) + c / 3;
}

void scree_imposed_record(scree_state *state, const double rate[9])
{
    scree_imposed_gradient *imposed = scree_imposed(state);
    memcpy(imposed->rate, rate, sizeof imposed->rate);
    for (int c = 0; c < 9; c++) {
        if (imposed->prescribed[c] == SCREE_FREE) continue;
        double actual = imposed->prescribed[c] == SCREE_FULL ? rate[c] : 0.5 * (rate[c] + rate[mirror(c)]);
        imposed->achieved += state->step_size * imposed->target[c] * actual;
        imposed->wanted += state->step_size * imposed->target[c] * imposed->target[c];
    }
}

/// stress . vector / quantum, rounded.
static void round_force(const double stress[9], const scree_vector vector, double scale, int64_t quanta[3])
{
    for (int i = 0; i < 3; i++)
        quanta[i] = scree_fixed_round(
            scale * (stress[3 * i] * vector[0] + stress[3 * i + 1] * vector[1] + stress[3 * i + 2] * vector[2]));
}

/// Adds the term of the end or edge of a facet that goes from corner a to b.
static void add_term(const scree_facet *facet, int a, int b, const double stress[9], double scale, int64_t total[3])
{
    const double *p = facet->position[a], *q = facet->position[b];
    int64_t one[3], other[3] = {0};
    if (facet->corners == 2) {
        round_force(stress, (scree_vector){q[1], -q[0]}, scale, one);
        round_force(stress, (scree_vector){p[1], -p[0]}, scale, other);
    } else {
        int64_t sign = facet->node[a] < facet->node[b] ? 1 : -1;
        if (sign < 0) p = facet->position[b], q = facet->position[a];
        scree_vector cross;
        scree_cross(p, q, cross);
        round_force(stress, cross, scale, one);
        for (int i = 0; i < 3; i++) one[i] *= sign;
    }
    for (int i = 0; i < 3; i++) total[i] += one[i] - other[i];
}

void scree_imposed_apply_stress(const scree_model *model, scree_state *state, const double stress[9])
{
    double scale = (state->dimension == 3 ? 1.0 / 6 : 0.5 * model->thickness) / state->force_quantum;
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        int64_t share[3] = {0};
        int terms = facet.corners == 2 ? 1 : 3;
        for (int t = 0; t < terms; t++) add_term(&facet, t, (t + 1) % facet.corners, stress, scale, share);
        for (int c = 0; c < facet.corners; c++) scree_imposed_add(state, facet.node[c], share);
    }
}

/// Half of the work over surfaces, with the moments that are kept.
static void add_surface_work(scree_state *state)
{
    const double work = scree_surface_half_work(state, (const double(*)[6])scree_imposed(state)->surface);
    state->ledger.boundary += work;
    state->ledger.turnover += fabs(work);
}

/// The moments that strain a body, in the quanta of those of its contacts.
static void add_moments(scree_state *state)
{
    const int d = state->dimension;
    const scree_tensor_place *place = scree_tensor_places(d);
    for (size_t row = 0; row < state->count; row++)
        for (int k = 0; k < scree_tensor_size(d); k++) {
            const int64_t quanta = llrint(scree_imposed(state)->surface[row][k] / state->force_quantum);
            int64_t *moment = state->moment + row * scree_moment_size(d);
            moment[d * place[k].i + place[k].j] += quanta;
            if (place[k].i != place[k].j) moment[d * place[k].j + place[k].i] += quanta;
        }
}

scree_status scree_imposed_strain(scree_state *state, scree_vector *area, const double stress[9], scree_error *error)
{
    scree_imposed_gradient *imposed = scree_imposed(state);
    if (!state->stretch || !state->moment) return SCREE_OK;
    scree_status status = imposed->surface ? SCREE_OK : scree_state_begin_field(state, scree_imposed_surface, error);
    if (status) return status;
    add_surface_work(state);
    memset(imposed->surface, 0, state->count * sizeof *imposed->surface);
    for (size_t k = 0; k < imposed->count; k++) {
        const double size = scree_length(area[k]);
        double force[3], outward[3];
        for (int i = 0; i < 3; i++) {
            force[i] = stress[3 * i] * area[k][0] + stress[3 * i + 1] * area[k][1] + stress[3 * i + 2] * area[k][2];
            outward[i] = size > 0 ? area[k][i] / size : 0;
        }
        scree_surface_add(state->dimension, outward, force, imposed->surface[scree_boundary_row(state, k)]);
    }
    add_moments(state);
    add_surface_work(state);
    return SCREE_OK;
}

scree_status scree_imposed_work(const scree_context *context, scree_error *error)
{
    (void)error;
    scree_imposed_add_work(context->state);
    return SCREE_OK;
}
