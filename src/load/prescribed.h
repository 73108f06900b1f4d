/// Prescribed bodies: what a case says of them, and what a run remembers. See prescribed_step.c for the method.
///
/// Components of a body are numbered: 0 to 2 its velocity x, y, z, 3 to 5 its spin. In 2D there are 0, 1 and 5.
#ifndef SCREE_LOAD_PRESCRIBED_H
#define SCREE_LOAD_PRESCRIBED_H

#include "base/schedule.h"
#include "case/config.h"
#include "load/load.h"
#include "load/profile.h"
#include "state/body.h"

enum { SCREE_COMPONENTS = 6, SCREE_LEVER = SCREE_COMPONENTS };

typedef enum scree_attack { SCREE_ATTACK_CENTRE, SCREE_ATTACK_SURFACE } scree_attack;

/// Of one load. Times of schedules count from the begin of the first stage in which it acts.
typedef struct scree_prescribed_config {
    char *name;                              ///< in columns and results; auto: that of the selection
    char *selection;                         ///< a name
    char *from;                              ///< first stage in which it acts; auto: the first one
    char *until;                             ///< last one; auto: the last one
    scree_schedule motion[SCREE_COMPONENTS]; ///< m/s, rad/s; the constant NAN: free
    scree_load_profile profile;              ///< of `motion`
    double gradient[9];                      ///< 1/s, added: factor x gradient x (position at the begin - origin)
    scree_schedule factor;
    double origin[3];                      ///< m
    scree_schedule push[SCREE_COMPONENTS]; ///< N, N m; the constant NAN: none
    int per;                               ///< scree_per
    int attack;                            ///< scree_attack
    double direction[3]; ///< 1, from the centre to where a force acts on the surface; none: where it turns nothing
    double until_force;  ///< N, against the velocity, with which it ends and which then acts; not above 0: never
} scree_prescribed_config;

typedef enum scree_per { SCREE_PER_BODY, SCREE_PER_SELECTION } scree_per;

/// Numbers of loads, from 1, for the components; that of a force on the surface; the last is not used. 0: none.
typedef uint8_t scree_owners[8];

/// What the loads put on a body at n.
typedef struct scree_exerted {
    int64_t quanta[SCREE_COMPONENTS]; ///< force and torque quanta: applied, or the reaction that drives it
    int64_t lever[3];                 ///< torque quanta of a force on the surface
    double
        spread[6]; ///< J, arm (x) force of it, symmetric: xx, yy, zz, yz, xz, xy; what strains of the body work against
} scree_exerted;

/// Before the first half of a step. Derived.
typedef struct scree_departure {
    double position[3];                    ///< m
    double angle;                          ///< rad, 2D
    double acceleration[SCREE_COMPONENTS]; ///< m/s2, rad/s2
} scree_departure;

enum { SCREE_LOADS = 16 }; ///< most of a case

/// State of the module `prescribed`. Arrays have one element a body, and are NULL until a stage prescribes something.
typedef struct scree_prescribed {
    scree_owners *owner; ///< from the next forces on
    scree_owners *by;    ///< who has made `exerted`
    scree_exerted *exerted;
    scree_vector *reference; ///< m, where the body was when the first load that drives it began
    scree_departure *departure;
    uint32_t *row; ///< the first `listed`: rows of bodies that a load prescribes, or whose `exerted` it has made; from
                   ///< the begin of a step to the search, and from there to its end (derived)
    uint64_t listed;
    int64_t acts[SCREE_LOADS];       ///< 1: in the present stage
    double begun[SCREE_LOADS];       ///< s
    double work[SCREE_LOADS];        ///< J, on the bodies
    scree_vector given[SCREE_LOADS]; ///< N, on the selection, in place of the velocity that has ended; 0: it has not
} scree_prescribed;

static inline scree_prescribed *scree_prescribed_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_prescribed];
}

/// Whether states of a dimension have a component.
static inline bool scree_component_exists(int dimension, int component)
{
    return dimension == 3 || component < 2 || component == SCREE_COMPONENTS - 1;
}

/// The struct of load `index` among those of the case, NULL when it is of another kind.
static inline const scree_prescribed_config *scree_prescribed_config_of(const scree_config_load *loads, int64_t index)
{
    return loads[index].kind == SCREE_SLOT_prescribed ? loads[index].own : NULL;
}

/// Its name in columns and results.
static inline const char *scree_prescribed_name(const scree_prescribed_config *own)
{
    return own->name ? own->name : own->selection;
}

/// Whether it says the velocity of a component, or a force on it.
bool scree_prescribed_drives(const scree_prescribed_config *own, int component);
bool scree_prescribed_pushes(const scree_prescribed_config *own, int component);

/// Force of a load on its bodies [N], as it was at the last forces; the same in all processes.
void scree_prescribed_force(const scree_state *state, int64_t load, double force[3]);

/// prescribed_begin.c: who is prescribed what in the stage that begins. Errors: a selection without bodies; two loads
/// that say the same component of a body; memory.
scree_status scree_prescribed_begin(const scree_context *context, scree_error *error) SCREE_MUST_USE;

/// Where there are such loads their selections are looked for among all bodies.
bool scree_prescribed_begins_whole(const scree_context *context);

/// prescribed_step.c
scree_status scree_prescribed_depart(const scree_context *context, scree_error *error) SCREE_MUST_USE;
scree_status scree_prescribed_move(const scree_context *context, scree_error *error) SCREE_MUST_USE;
/// Where forces act on surfaces: what they strain.
scree_status scree_prescribed_attack(const scree_context *context, scree_error *error) SCREE_MUST_USE;
scree_status scree_prescribed_push(const scree_context *context, scree_error *error) SCREE_MUST_USE;
scree_status scree_prescribed_hold(const scree_context *context, scree_error *error) SCREE_MUST_USE;
double scree_prescribed_bound(const scree_context *context);

/// prescribed_rules.c
void scree_prescribed_rules(scree_reader *reader, const scree_config *config);

#endif
