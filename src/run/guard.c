/// Guards and their messages: which body, why, and what to try.
#include "run/guard.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "search/ghosts.h"
#include "shape/core_gap.h"
#include "shape/polygons.h"
#include "state/periodic.h"
#include "state/plates.h"

#include <math.h>

/// Lowest id whose row is not finite; count when there is none.
static size_t first_not_finite(const scree_state *state)
{
    size_t lowest = state->count;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place, velocity, spin;
        scree_body_position(state, row, place);
        scree_body_motion(state, row, velocity, spin);
        // The sum of finite numbers of these sizes is finite, and of others it is not.
        double sum = 0;
        for (int k = 0; k < 3; k++) sum += place[k] + velocity[k] + spin[k];
        if (!isfinite(sum) && state->id[row] < lowest) lowest = state->id[row];
    }
    return lowest;
}

static scree_status stop_not_finite(const scree_simulation *s, scree_error *error)
{
    size_t id = first_not_finite(&s->state);
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: position or velocity of particle %zu is not a number; "
                           "the step is probably too large: try integrator.step=%.2g s (now %.2g s, critical %.2g s)",
                           (unsigned long long)s->state.step, id, 0.2 * s->state.tick, s->state.tick,
                           s->model.critical_step);
}

/// Whether grains of the case attract each other.
static bool sticks(const scree_model *model)
{
    for (int k = 0; k < scree_model_law_count(model); k++)
        if (scree_modules[model->laws[k].law]->law->tabor) return true;
    return false;
}

/// Another body in the one that is indented, and what the geometry says of the two.
typedef struct indenter {
    uint32_t row;    ///< SCREE_NO_ROW: there is none, it is a wall
    double depth;    ///< m
    bool one_inside; ///< one of the two lies wholly inside the other
} indenter;

/// How deep two bodies lie in each other; *inside: one of them wholly in the other.
static double depth_of(const scree_simulation *s, uint32_t one, uint32_t other, bool *inside)
{
    const scree_state *state = &s->state;
    const scree_polygons *polygons = scree_polygons_of(state);
    const double *lattice = scree_cell(state)->lattice;
    const double radius[2] = {state->row[one].radius, state->row[other].radius};
    scree_vector from, to;
    int shift[3];
    bool of_second;
    scree_body_position(state, one, from);
    scree_body_position(state, other, to);
    const bool across = scree_ghosts_nearest(state, &s->work, one, other, shift, &of_second);
    for (int k = 0; k < 3; k++) {
        double image = 0;
        for (int i = 0; i < 3 && across; i++) image += lattice[3 * k + i] * shift[i];
        to[k] += (of_second ? image : -image) - from[k];
    }
    const double distance = scree_length(to);
    *inside = distance + fmin(radius[0], radius[1]) <= fmax(radius[0], radius[1]);
    if (distance >= radius[0] + radius[1] || !polygons || !polygons->of) return radius[0] + radius[1] - distance;
    const scree_core core = scree_core_of_row(state, polygons, one), in = scree_core_of_row(state, polygons, other);
    const double back[2] = {-to[0], -to[1]};
    *inside = scree_core_lies_within(&core, &in, to) || scree_core_lies_within(&in, &core, back);
    return scree_core_depth(&core, &in, to);
}

/// The body that lies deepest in that of a row. All are looked at: the list of pairs may be that of a part.
static indenter find_indenter(const scree_simulation *s, uint32_t row)
{
    indenter found = {.row = SCREE_NO_ROW};
    for (uint32_t k = 0; k < s->state.count; k++) {
        bool inside = false;
        const double depth = k == row ? 0 : depth_of(s, row, k, &inside);
        if (depth > found.depth) found = (indenter){k, depth, inside};
    }
    return found;
}

static scree_status stop_overlap(const scree_simulation *s, scree_error *error)
{
    const uint32_t flagged = s->state.row_of_id[s->work.flagged_id];
    const scree_row *row = &s->state.row[flagged];
    const indenter other = find_indenter(s, flagged);
    const bool cohesive = sticks(&s->model);
    char by[100] = "";
    if (other.row != SCREE_NO_ROW)
        (void)snprintf(by, sizeof by, " by particle %u%s", s->state.id[other.row],
                       other.one_inside ? ": one of them lies inside the other" : "");
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: particle %llu at (%.4g, %.4g) m is indented by more than %.3g of its radius "
                           "(guard.overlap)%s; the load is too high for the stiffness%s, the motion too fast or the "
                           "step too large: try a stiffer material, a lower pressure%s, a slower rate or a smaller "
                           "step",
                           (unsigned long long)s->state.step, (unsigned long long)s->work.flagged_id, row->x, row->y,
                           s->model.overlap_limit, by, cohesive ? ", the cohesion too strong for it" : "",
                           cohesive ? ", less surface energy" : "");
}

void scree_guard_join(const scree_state *state, scree_work *work, bool late)
{
    if (!state->part || !(work->alarm || late)) return;
    double flags[5] = {0};
    for (int k = 0; k < 4; k++) flags[k] = work->flags >> k & 1;
    flags[4] = work->flags ? -(double)work->flagged_id : (double)-INFINITY;
    scree_comm_maximum(state, flags, 5);
    work->flags = 0;
    for (int k = 0; k < 4; k++) work->flags |= (uint32_t)(flags[k] > 0) << k;
    if (work->flags) work->flagged_id = (uint64_t)-flags[4];
}

scree_status scree_guard_step(const scree_simulation *s, scree_error *error)
{
    uint32_t flags = s->work.flags;
    if (!flags) return SCREE_OK;
    if (flags & SCREE_FLAG_NAN) return stop_not_finite(s, error);
    if (flags & SCREE_FLAG_OVERLAP) return stop_overlap(s, error);
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: a force on particle %llu exceeds the bound of this step (%.3g N); "
                           "the motion changes too much within one step: try a smaller integrator.step",
                           (unsigned long long)s->state.step, (unsigned long long)s->work.flagged_id,
                           ldexp(s->state.force_quantum, 50));
}

/// Lowest id of a body here whose centre is behind a plate, and of which; UINT32_MAX: there is none.
static uint32_t first_behind(const scree_state *state, bool *below)
{
    const scree_wall *bottom = &scree_plates(state)[SCREE_WALL_BOTTOM], *top = &scree_plates(state)[SCREE_WALL_TOP];
    uint32_t first = UINT32_MAX;
    for (uint32_t k = 0; k < state->count && (bottom->active || top->active); k++) {
        scree_vector place;
        scree_body_position(state, k, place);
        const double height = place[state->dimension - 1];
        const bool under = bottom->active && height < bottom->position, over = top->active && -height < top->position;
        if (!(under || over) || state->id[k] >= first) continue;
        first = state->id[k];
        *below = under;
    }
    return first;
}

/// A body that has left the neighbourhood of all others by more than the size of the sample will not come back.
static scree_status stop_escaped(const scree_simulation *s, scree_error *error)
{
    const scree_state *state = &s->state;
    bool below = false;
    double lowest = -(double)first_behind(state, &below), told[4] = {0};
    scree_comm_maximum(state, &lowest, 1);
    if (lowest == -(double)UINT32_MAX) return SCREE_OK;
    const uint32_t id = (uint32_t)-lowest, row = scree_state_row_of(state, id);
    if (row != SCREE_NO_ROW) {
        scree_body_position(state, row, told);
        told[3] = below;
    }
    scree_parts_tell(state, &id, 1, told, 4);
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: the centre of particle %u is behind the %s plate, at (%.4g, %.4g, %.4g) "
                           "m: the plate moves too fast or the step is too large",
                           (unsigned long long)state->step, id, told[3] > 0 ? "bottom" : "top", told[0], told[1],
                           told[2]);
}

scree_status scree_guard_sample(const scree_simulation *s, double relative_residual, scree_error *error)
{
    scree_status status = stop_escaped(s, error);
    if (status) return status;
    double limit = s->model.energy_growth;
    if (relative_residual <= limit) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: the energy balance is open by %.2g of all energy (guard.energy_growth %.2g); "
                           "energy appears from nowhere: try integrator.step=%.2g s",
                           (unsigned long long)s->state.step, relative_residual, limit, 0.25 * s->state.tick);
}
