/// What is stored of a membrane.
#include "boundary/membrane.h"

#include <float.h>

typedef scree_membrane own;

const scree_group scree_membrane_bodies = {"body of the membrane", "k", offsetof(own, count), offsetof(own, capacity)};

#define ONE(...) SCREE_FIELD_ONE(membrane, own, __VA_ARGS__)
#define BODY(member, name, unit, meaning, ...)                                                                         \
    SCREE_FIELD_GROUP(membrane, own, scree_membrane_bodies, member, scree_vector, "membrane/" name,                    \
                      SCREE_FIELD_DOUBLE, 3, unit, meaning, __VA_ARGS__)
static const scree_field fields[] = {
    BODY(rest, "rest", "m",
         "unstressed lengths of the springs to the next body of the chain, in 3D of the ring and to two of the ring "
         "above; "
         "0: none",
         SCREE_RANGE(0, DBL_MAX)),
    BODY(press, "pressure_force", "N", "force of the pressure on this body of the membrane"),
    BODY(force, "chain_force", "N", "force of the springs on this body of the membrane, and of the plate on an end"),
    ONE(first_id, "scalars/membrane_first_id", SCREE_FIELD_UINT64, 1, "1",
        "id of the first body of the membrane; the others follow it", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    ONE(right, "scalars/membrane_right", SCREE_FIELD_UINT64, 1, "1", "2D: bodies of the membrane's right side"),
    ONE(around, "scalars/membrane_around", SCREE_FIELD_UINT64, 1, "1", "3D: bodies of a ring of the membrane"),
    ONE(radius, "scalars/membrane_radius", SCREE_FIELD_DOUBLE, 1, "m", "radius of the membrane's bodies",
        SCREE_RANGE(0, DBL_MAX)),
    ONE(ramp_time, "scalars/membrane_ramp_time", SCREE_FIELD_DOUBLE, 1, "s",
        "time in which the membrane takes the pressure over", SCREE_RANGE(0, DBL_MAX)),
};

static scree_status refuse(const char *name, size_t value, const char *accepted, size_t wanted, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s': %zu (accepted: %s %zu)", name, value, accepted,
                           wanted);
}

/// All of its bodies are here, with its mark, and no others have it.
static scree_status check_bodies(const scree_state *state, scree_error *error)
{
    const scree_membrane *m = scree_membrane_of(state);
    size_t bodies = state->marked[SCREE_MARK_MEMBRANE];
    if (m->count != bodies)
        return refuse("membrane/rest", m->count, "as many rows as there are bodies with its mark,", bodies, error);
    for (size_t k = 0; k < m->count; k++) {
        size_t row = scree_state_row_of(state, m->first_id + k);
        if (row == SCREE_NO_ROW || state->mark[row] != SCREE_MARK_MEMBRANE)
            return refuse("scalars/membrane_first_id", m->first_id, "the first of bodies of the membrane, as many as",
                          m->count, error);
    }
    return SCREE_OK;
}

/// The membrane has the bodies with its mark, in chains or rings.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const scree_stage_state *stage = &state->stage;
    bool began = stage->index < model->config->stage_count && stage->counter >= 0;
    scree_boundary_kind kind = began ? scree_config_boundary_of(model->config, stage->index) : SCREE_BOUNDARY_AUTO;
    const scree_membrane *m = scree_membrane_of(state);
    scree_status status = check_bodies(state, error);
    if (status) return status;
    if (kind == SCREE_BOUNDARY_MEMBRANE && m->count == 0) return refuse("membrane/rest", 0, "more rows than", 0, error);
    if (m->count == 0) return SCREE_OK;
    if (state->dimension == 2 && (m->right < 2 || m->right + 2 > m->count))
        return refuse("scalars/membrane_right", m->right, "2 to 2 less than", m->count, error);
    if (state->dimension == 3 && (m->around < 3 || m->count % m->around))
        return refuse("scalars/membrane_around", m->around, "3 or more, a divisor of", m->count, error);
    return SCREE_OK;
}

/// Springs hold its bodies together.
static const char *keeps(const scree_state *state, uint32_t id)
{
    const scree_membrane *m = scree_membrane_of(state);
    return id >= m->first_id && id < m->first_id + m->count ? "it is of the membrane" : NULL;
}

const scree_module scree_module_membrane = {
    .name = "membrane",
    .meaning = "bodies with springs around the sides of the sample",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .keeps = keeps,
};
