/// Places a membrane; here the chains of 2D, sheet_place.c has the sheet of 3D. The discs of a side stand at equal
/// heights, the ends tangent to the plates, about two radii apart; each is pushed in from outside until it touches a
/// grain. Where no grain is in reach, it stands on the straight line between the next ones below and above that touch.
/// The unstressed lengths of the chain are the distances that this gives. Cost: O(grains x bodies of the membrane),
/// once.
#include "boundary/membrane.h"
#include "state/body.h"

#include "boundary/sheet.h"
#include "state/fields.h"
#include "state/plates.h"

#include <math.h>

/// The place at the height y, seen from the side with the outward direction `side` (+1 right, -1 left), where a disc
/// touches the outermost grain in its way; NAN when none is.
static double touching_place(const scree_state *state, double radius, double y, double side)
{
    double outermost = -INFINITY;
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        const scree_row *grain = &state->row[row];
        double reach = grain->radius + radius, dy = y - grain->y;
        if (fabs(dy) < reach) outermost = fmax(outermost, side * grain->x + sqrt(reach * reach - dy * dy));
    }
    return isfinite(outermost) ? side * outermost : NAN;
}

/// Fills the gaps of x (NAN) from the next values on both sides.
static void fill_gaps(double *x, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        if (!isnan(x[k])) continue;
        size_t next = k;
        while (next < count && isnan(x[next])) next++;
        double before = k > 0 ? x[k - 1] : x[next], after = next < count ? x[next] : before;
        double gap = (double)(next - k) + 1;
        for (size_t j = k; j < next; j++) x[j] = before + (after - before) * (double)(j - k + 1) / gap;
    }
}

/// One side: bodies [first, first + count) of the membrane.
static void place_side(const scree_model *model, scree_state *state, size_t first, size_t count, double side, double *x)
{
    scree_membrane *membrane = scree_membrane_of(state);
    double low = scree_plates(state)[SCREE_WALL_BOTTOM].position + membrane->radius;
    double high = -scree_plates(state)[SCREE_WALL_TOP].position - membrane->radius;
    double begin = side > 0 ? low : high, spacing = (side > 0 ? high - low : low - high) / (double)(count - 1);
    for (size_t k = 0; k < count; k++)
        x[k] = touching_place(state, membrane->radius, begin + spacing * (double)k, side);
    fill_gaps(x, count);
    for (size_t k = 0; k < count; k++) {
        size_t row = scree_membrane_row(state, first + k);
        state->row[row] =
            (scree_row){.x = x[k],
                        .y = begin + spacing * (double)k,
                        .material = scree_membrane_numbers_of(model)->material,
                        .radius = membrane->radius,
                        .mass = scree_model_mass(model, scree_membrane_numbers_of(model)->material, membrane->radius)};
        scree_body_make_round(state, row);
        state->species[row] = SCREE_NO_SPECIES;
        scree_body_refer(state, row);
        membrane->rest[first + k][0] =
            k + 1 < count ? sqrt(spacing * spacing + (x[k + 1] - x[k]) * (x[k + 1] - x[k])) : 0;
    }
}

scree_status scree_membrane_make_room(scree_state *state, size_t count, scree_error *error)
{
    scree_membrane *membrane = scree_membrane_of(state);
    scree_status status = scree_group_reserve(state, &scree_module_membrane, &scree_membrane_bodies, count, error);
    size_t first = state->next_id;
    if (!status) status = scree_state_append(state, SCREE_MARK_MEMBRANE, count, error);
    if (status) return status;
    membrane->first_id = first;
    membrane->count = count;
    return SCREE_OK;
}

/// The chains of 2D.
static scree_status place_chains(const scree_model *model, scree_state *state, double height, scree_error *error)
{
    double radius = scree_membrane_numbers_of(model)->radius;
    size_t side = (size_t)round(height / (2 * radius)) < 2 ? 2 : (size_t)round(height / (2 * radius));
    double *x = NULL;
    scree_status status = scree_allocate(&x, side, sizeof *x, error);
    if (!status) status = scree_membrane_make_room(state, 2 * side, error);
    if (!status) {
        scree_membrane_of(state)->radius = radius;
        scree_membrane_of(state)->right = side;
        place_side(model, state, 0, side, 1, x);
        place_side(model, state, side, side, -1, x);
    }
    scree_release(&x);
    return status;
}

scree_status scree_membrane_place(const scree_model *model, scree_state *state, scree_error *error)
{
    double radius = scree_membrane_numbers_of(model)->radius;
    double height = scree_plate_height(state, SCREE_WALL_TOP) - scree_plate_height(state, SCREE_WALL_BOTTOM);
    if (!(height > 4 * radius))
        return scree_error_set(error, SCREE_ERROR_GUARD,
                               "a membrane of bodies of radius %.3g m does not fit between plates %.3g m apart", radius,
                               height);
    return state->dimension == 3 ? scree_sheet_place(model, state, error) : place_chains(model, state, height, error);
}
