/// What is remembered of bodies that were born, and of the sources that they come from (src/source/).
#ifndef SCREE_STATE_BIRTHS_H
#define SCREE_STATE_BIRTHS_H

#include "state/fields.h"

/// Why sources have stopped in the present stage.
typedef enum scree_pour_end {
    SCREE_POUR_GOES_ON,
    SCREE_POUR_COUNT,  ///< the stage has as many as it wants
    SCREE_POUR_OUT,    ///< the case has no more particles, or no source has
    SCREE_POUR_HEIGHT, ///< the pile is as high as the stage wants
    SCREE_POUR_WIDTH,
    SCREE_POUR_PLATEAU, ///< so has the plateau of a source that stops then
    SCREE_POUR_ENDS
} scree_pour_end;

/// One source of the case.
typedef struct scree_source_state {
    uint64_t begun;     ///< 1: it has poured; its motion began at `start`
    double start;       ///< s
    uint64_t due;       ///< step from which on the next birth may be
    uint64_t born;      ///< particles so far
    uint64_t attempts;  ///< of the birth that waits; 0: none does
    uint64_t since;     ///< step at which it began to wait
    uint64_t waits;     ///< births that had to wait
    uint64_t waited;    ///< ticks that they waited together
    uint64_t layer;     ///< the present one, from 0
    uint64_t in_layer;  ///< particles of it that are born
    double top;         ///< m, of the pile when the layer began; NAN: there was none
    double left, right; ///< m, ends of its plateau then; NAN
} scree_source_state;

/// State of the module `births`.
typedef struct scree_births {
    double *time; ///< s, a body; NULL until the first stage that pours
    scree_source_state source[SCREE_SOURCES];
    uint64_t in_stage; ///< particles born in the present stage
    uint64_t end;      ///< scree_pour_end of it
    uint64_t ended;    ///< step of that
    uint64_t lost;     ///< particles that were taken out, since they had fallen past everything that stands
} scree_births;

static inline scree_births *scree_births_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_births];
}

/// Room for the times of birth. Errors: memory.
static inline scree_status scree_births_make_room(scree_state *state, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_module_births.field_count && !status; k++)
        if (scree_module_births.fields[k].rows == SCREE_ROWS_BODIES)
            status = scree_state_begin_field(state, &scree_module_births.fields[k], error);
    return status;
}

#endif
