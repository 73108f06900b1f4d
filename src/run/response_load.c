/// The load on one grain whose response is told. See response_load.h.
#include "run/response_load.h"

#include "load/prescribed.h"
#include "selection/selection.h"
#include "selection/top.h"
#include "state/body.h"

#include <math.h>

#define USED_UP 0.999 /* of the friction of a contact that slides, or is about to */

const scree_response_numbers *scree_response_numbers_of(const scree_model *model)
{
    const scree_response_numbers *n = scree_model_numbers(model, SCREE_SLOT_response);
    return n && n->load >= 0 ? n : NULL;
}

bool scree_response_slides(double friction, double tangential_force, double normal_force)
{
    const double limit = USED_UP * friction * normal_force;
    return limit > 0 && fabs(tangential_force) >= limit;
}

bool scree_response_load_begins(const scree_context *c)
{
    const scree_response_numbers *n = scree_response_numbers_of(c->model);
    int64_t range[2];
    if (!n) return false;
    const scree_prescribed_config *own = scree_prescribed_config_of(c->model->loads, n->load);
    scree_load_stages(c->model->stages, c->model->stage_count, own->from, own->until, range);
    return c->state->stage.index == range[0];
}

static scree_status refuse(scree_error *error, const char *format, uint32_t one, uint32_t other)
{
    return scree_error_refuse(error, "measure.response_load", NULL, format, one, other);
}

scree_status scree_response_find_loaded(const scree_model *model, const scree_state *state, int64_t load,
                                        uint32_t *found, scree_error *error)
{
    const scree_prescribed_config *own = scree_prescribed_config_of(model->loads, load);
    const int64_t selection = scree_config_selection_find(model->selections, model->selection_count, own->selection);
    size_t next = 0;
    *found = SCREE_NO_ROW;
    for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;) {
        if (!scree_selection_has(state, selection, row)) continue;
        if (*found != SCREE_NO_ROW)
            return refuse(error,
                          "the load presses on particle %u and on particle %u: the response is that to a load on one "
                          "grain, such as that of a selection `top`",
                          state->id[*found], state->id[row]);
        *found = row;
    }
    return SCREE_OK;
}

/// Elements lie within the layer.
static scree_status check_element(double element, const scree_state *state, scree_error *error)
{
    double wide[2], high[2];
    if (element == 0) return SCREE_OK;
    scree_grains_ends(state, 0, wide);
    scree_grains_ends(state, 1, high);
    if (element <= fmin(wide[1] - wide[0], high[1] - high[0])) return SCREE_OK;
    return scree_error_refuse(error, "measure.response_element", "auto: two mean diameters",
                              "an element of %.3g m is larger than the layer, which is %.3g m wide and %.3g m high",
                              element, wide[1] - wide[0], high[1] - high[0]);
}

scree_status scree_response_check_load(const scree_context *c, scree_error *error)
{
    const scree_response_numbers *n = scree_response_numbers_of(c->model);
    const scree_prescribed_config *own = scree_prescribed_config_of(c->model->loads, n->load);
    uint32_t row;
    const int64_t selection =
        scree_config_selection_find(c->model->selections, c->model->selection_count, own->selection);
    scree_status status = scree_selection_resolve(c->model, c->state, selection, error);
    if (!status) status = scree_response_find_loaded(c->model, c->state, n->load, &row, error);
    if (!status) status = check_element(n->element, c->state, error);
    if (status) return status;
    const uint32_t above = scree_row_above(c->state, row);
    return above == SCREE_NO_ROW
               ? SCREE_OK
               : refuse(error,
                        "the load presses on particle %u, which is not at the top: particle %u stands over it; let it "
                        "press on a selection `top`",
                        c->state->id[row], c->state->id[above]);
}
