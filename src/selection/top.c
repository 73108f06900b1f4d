/// Selection of the grain at the top of the sample that is nearest to a place, for a piston to press on.
///
/// A grain is at the top when none stands over its middle half (top.h). The one whose centre is nearest to the place,
/// measured horizontally, is chosen; of two that are equally near the lower one in the order of ids. Cost: linear in
/// the bodies for each grain that is looked at, which are those of some columns.
#include "selection/top.h"

#include "base/memory.h"
#include "case/check.h"
#include "case/wall_motion.h"
#include "module/key_rows.h"
#include "module/wall_shape.h"
#include "selection/selection.h"
#include "shape/wall_set.h"
#include "state/body.h"

#include <math.h>
#include <stdio.h>

typedef struct select_top {
    double x, y; ///< m; NAN: the middle of the sample
} select_top;

static double size_of(const scree_state *state, size_t row)
{
    return state->form ? state->form[row].radius : state->row[row].radius;
}

uint32_t scree_row_above(const scree_state *state, size_t row)
{
    const int up = state->dimension - 1;
    scree_vector place, other;
    scree_body_position(state, row, place);
    for (size_t k = 0; k < state->count; k++) {
        if (k == row || !scree_body_is_grain(state, k)) continue;
        scree_body_position(state, k, other);
        const double across = hypot(other[0] - place[0], up == 2 ? other[1] - place[1] : 0);
        if (other[up] > place[up] && across < size_of(state, k) + 0.5 * size_of(state, row)) return (uint32_t)k;
    }
    return SCREE_NO_ROW;
}

void scree_grains_ends(const scree_state *state, int axis, double end[2])
{
    end[0] = INFINITY, end[1] = -INFINITY;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        end[0] = fmin(end[0], place[axis] - size_of(state, row));
        end[1] = fmax(end[1], place[axis] + size_of(state, row));
    }
}

/// Fills in the middle, and refuses what lies outside of the sample.
static scree_status find_place(const scree_state *state, const select_top *own, double place[2], scree_error *error)
{
    const double said[2] = {own->x, own->y};
    for (int k = 0; k < state->dimension - 1; k++) {
        double end[2];
        scree_grains_ends(state, k, end);
        place[k] = isnan(said[k]) ? 0.5 * (end[0] + end[1]) : said[k];
        if (place[k] < end[0] || place[k] > end[1])
            return scree_error_key(error,
                                   scree_error_set(error, SCREE_ERROR_INPUT,
                                                   "has its %c = %.4g m outside of the sample, which reaches from "
                                                   "%.4g m to %.4g m: choose a place in between",
                                                   "xy"[k], place[k], end[0], end[1]),
                                   "%c", "xy"[k]);
    }
    return SCREE_OK;
}

/// The grain nearest to the place among those that have not been looked at (`seen` 0).
static uint32_t find_nearest(const scree_state *state, const double place[2], const uint8_t *seen)
{
    uint32_t best = SCREE_NO_ROW;
    double least = INFINITY;
    size_t next = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;) {
        scree_vector at;
        if (seen[row] || !scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, at);
        const double across = hypot(at[0] - place[0], state->dimension == 3 ? at[1] - place[1] : 0);
        if (!(across < least)) continue;
        least = across;
        best = row;
    }
    return best;
}

static scree_status choose(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                           scree_error *error)
{
    double place[2] = {0};
    uint8_t *seen;
    uint32_t row;
    (void)model;
    scree_status status = find_place(state, own, place, error);
    if (!status) status = scree_allocate(&seen, state->count + 1, sizeof *seen, error);
    if (status) return status;
    while ((row = find_nearest(state, place, seen)) != SCREE_NO_ROW && scree_row_above(state, row) != SCREE_NO_ROW)
        seen[row] = 1;
    if (row != SCREE_NO_ROW) chosen[row] = 1;
    scree_release(&seen);
    return SCREE_OK;
}

/// The upright wall that stands and that a place lies behind, where no grain can be; NULL: there is none.
static const scree_config_wall *wall_before(const scree_config *config, double x)
{
    for (int64_t k = 0; k < config->wall_count; k++) {
        const scree_config_wall *wall = &config->walls[k];
        const scree_wall_shape *shape = wall->shape >= 0 ? scree_modules[wall->shape]->wall : NULL;
        scree_surface surface = {0};
        scree_error ignored;
        if (!shape || !shape->endless || !wall->own || !scree_wall_stands(wall)) continue;
        if (shape->make(wall->own, (int)config->dimension, &surface, &ignored)) continue;
        const double *normal = surface.normal[0];
        if (normal[1] == 0 && normal[2] == 0 && normal[0] * x < surface.offset[0]) return wall;
    }
    return NULL;
}

static void rules(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const select_top *own = config->selections[i].own;
        char path[SCREE_PATH_BYTES];
        if (config->selections[i].kind != SCREE_SLOT_select_top || !own) continue;
        (void)snprintf(path, sizeof path, "selections.%lld.y", (long long)i);
        if (config->dimension == 2 && !isnan(own->y))
            scree_rule_refuse(reader, path, "auto", "in two dimensions y points upwards: x alone says where");
        const scree_config_wall *wall = isnan(own->x) ? NULL : wall_before(config, own->x);
        (void)snprintf(path, sizeof path, "selections.%lld.x", (long long)i);
        if (wall)
            scree_rule_refuse(reader, path, "auto: the middle; or a place between the walls",
                              "there is no grain at %.4g m: it lies behind the wall '%s'", own->x,
                              wall->name ? wall->name : "");
        (void)snprintf(path, sizeof path, "selections.%lld.select", (long long)i);
        if (config->boundary.periodic >> (config->dimension - 1) & 1)
            scree_rule_refuse(reader, path, "band, layer", "a sample that repeats itself upwards has no top");
    }
}

static const scree_key keys[] = {
    NUMBER(select_top, x, "m", .standard = "auto", FROM("-1e6 m"), TO("1e6 m"),
           .meaning = "Place to which the grain is nearest; auto: the middle of the sample."),
    NUMBER(select_top, y, "m", .standard = "auto", FROM("-1e6 m"), TO("1e6 m"),
           .meaning = "The same along y, in three dimensions."),
};
static const scree_selection_kind kind = {.choose = choose};

const scree_module scree_module_select_top = {
    .name = "top",
    .meaning = "The one particle at the top of the sample that is nearest to a position.",
    .choice_of = CHOICE_OF(IS("selections")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, select_top)},
    .keys_count = 1,
    .rules = rules,
    .selection = &kind,
};
