/// What every public function on a simulation looks at first. Private to src/library/.
#ifndef SCREE_LIBRARY_HANDLE_H
#define SCREE_LIBRARY_HANDLE_H

#include "base/handle.h"
#include "run/simulation.h"

/// The handle is that of a simulation, and neither it nor its case was freed (builds with assertions).
#define handle_assert(simulation)                                                                                      \
    (scree_handle_check((simulation), "a simulation"), scree_handle_check((simulation)->c, "a simulation of a case"))

/// What may not be done from an own force. Errors: SCREE_ERROR_INPUT.
static inline scree_status handle_refuse_inside(const scree_simulation *s, scree_error *error)
{
    handle_assert(s);
    if (!s->forces.called) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "an own force may look at views and add loads, and nothing else of its simulation");
}

/// What needs bodies, between two steps. Errors: SCREE_ERROR_INPUT.
static inline scree_status handle_need_bodies(const scree_simulation *s, scree_error *error)
{
    scree_status status = handle_refuse_inside(s, error);
    if (status || s->state.count > 0) return status;
    return scree_error_set(error, SCREE_ERROR_INPUT, "there are no bodies yet: advance the simulation first");
}

/// The table of the contacts of this moment, in s->table. Errors: SCREE_ERROR_INPUT without bodies, memory.
static inline scree_status handle_find_contacts(scree_simulation *s, scree_error *error)
{
    scree_status status = handle_need_bodies(s, error);
    return status ? status : scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
}

#endif
