/// Bodies that sleep: left out of the steps while what acts on them stays in balance. What they are left out of is said
/// where it is done (integrate/kick.h, contact/forces.c, search/neighbours.c); who falls asleep and who wakes is
/// decided in integrate/sleep.c.
///
/// A body that sleeps has no velocity and does not move. Its contacts stay with what they remember. Those with bodies
/// that are awake, and with walls that can move, are evaluated in every step; what those with others that sleep, and
/// with walls of the case that stand, exert on it does not change, and lies here.
#ifndef SCREE_STATE_SLEEP_H
#define SCREE_STATE_SLEEP_H

#include "state/work.h"

/// What the contacts of a body with others that sleep, and with walls that stand, exert on it, while it sleeps. Whole
/// numbers, so that it does not depend on the order in which bodies fall asleep; in units of their own, since quanta
/// change from step to step.
typedef struct scree_resting {
    int64_t force[3], torque[3]; ///< units of force and of torque
    int64_t contacts;
} scree_resting;

/// Contacts of a body that sleeps: those that it had when it fell asleep, or when another one came to rest beside it,
/// and those with others that slept at the last look.
typedef struct scree_counted {
    int64_t contacts, resting;
} scree_counted;

/// What all that sleep exert on a wall that stands, about its centre.
typedef struct scree_resting_load {
    int64_t force[3], torque[3]; ///< units of force, and of torque on walls
} scree_resting_load;

/// In `asleep`, the last two while a step decides.
typedef enum scree_sleep_mark { SCREE_AWAKE, SCREE_ASLEEP, SCREE_FALLS, SCREE_WAKES } scree_sleep_mark;

static inline bool scree_slept(uint8_t mark)
{
    return mark == SCREE_ASLEEP || mark == SCREE_WAKES;
}

static inline bool scree_will_sleep(uint8_t mark)
{
    return mark == SCREE_ASLEEP || mark == SCREE_FALLS;
}

#define SCREE_SLEEP_ALL UINT64_MAX

/// State of the module `sleep`.
typedef struct scree_sleep {
    scree_resting_load wall[SCREE_SURFACES]; ///< in the order of the case
    double wall_torque_unit;                 ///< N m, a power of two
    uint8_t *asleep;                         ///< a body; NULL: no stage yet in which bodies may sleep
    uint32_t *quiet;                         ///< a body: steps for which it has been quiet
    scree_resting *resting;                  ///< a body
    scree_counted *counted;                  ///< a body
    double (*push)[6];    ///< a body: mean resultant of the last window over weight, force and torque over radius
    double force_unit;    ///< N, a power of two
    double torque_unit;   ///< N m, the same
    double gravity[3];    ///< m/s2, of the last step
    uint64_t walls;       ///< a bit for each wall of the case that moved in it
    double woken;         ///< s, time at which all woke
    double overlap;       ///< m, no contact of two that sleep has a larger one
    double taken;         ///< J, kinetic energy of bodies when they fell asleep, less that of those that woke
    uint64_t awake_steps; ///< steps of all bodies that were awake, since the first could sleep
    uint64_t steps;       ///< steps since then
    uint64_t count;       ///< bodies that sleep (derived)
    uint64_t total;       ///< the same of all processes (derived)
    uint64_t changes;     ///< times that some fell asleep or woke in this process (derived)
    uint32_t *moving;     ///< rows of those that are awake; moving_count of them, where some sleep (derived)
    uint64_t moving_count;
    uint32_t *pushed;      ///< rows of those that sleep whose sums are not clear; pushed_count of them (derived)
    uint64_t pushed_count; ///< SCREE_SLEEP_ALL: not known, any of them
    uint64_t listed;       ///< 1: it is of the list of pairs, and of these
    uint64_t bodies;       ///< changes of the state, then (derived)
    uint64_t found;        ///< bodies that fall asleep or wake in this step, of all processes (derived)
} scree_sleep;

static inline scree_sleep *scree_sleep_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_sleep];
}

static inline bool scree_body_sleeps(const scree_state *state, size_t row)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    return sleep->count > 0 && (sleep->asleep[row] & 1); // even while one is marked (integrate/sleep.c)
}

/// Rows that move, and how many; NULL: the rows 0 .. count - 1.
static inline const uint32_t *scree_moving_rows(const scree_state *state, size_t *count)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    *count = sleep->count > 0 ? sleep->moving_count : state->count;
    return sleep->count > 0 ? sleep->moving : NULL;
}

/// Contacts of a body, those with others that sleep among them.
static inline int64_t scree_body_contacts(const scree_state *state, size_t row)
{
    return state->sum[row].contacts +
           (scree_body_sleeps(state, row) ? scree_sleep_of(state)->resting[row].contacts : 0);
}

/// Adds to the sums of a body that sleeps, or just has, what others that sleep exert on it.
void scree_sleep_add_resting(scree_state *state, size_t row);

/// Lists anew which rows move, when some have fallen asleep or woken.
void scree_sleep_list_moving(scree_state *state);

/// The same for a new list of pairs.
void scree_sleep_list(scree_state *state);

/// Clears the sums of those that sleep, for the forces of the next step.
void scree_sleep_clear_sums(scree_state *state);

/// Wakes all.
void scree_sleep_end(scree_state *state);

/// Whether one of the bodies with these ids sleeps.
bool scree_some_sleep(const scree_state *state, const uint32_t *ids, size_t count);

#endif
