/// The message between the first half of a step and the search.
#include "search/moved.h"

#include "comm/comm.h"

#include <math.h>

/// Of all processes: the bound for the quanta, the budget of the list, the flag.
static void settle(scree_state *state, scree_work *work, const scree_speeds *speeds)
{
    const double each = speeds->centre + speeds->spin;
    // What is not a number is kept.
    state->largest_speed = each <= speeds->surface ? speeds->surface : each;
    work->budget -= state->step_size * speeds->centre;
    if (!isfinite(state->largest_speed)) work->flags |= SCREE_FLAG_NAN;
}

/// The list has reckoned with the speeds that the scheme has told.
static void settle_driven(scree_state *state, scree_work *work, double speed)
{
    const double before = state->largest_speed;
    state->largest_speed = fmax(before, speed);
    work->budget -= state->step_size * (state->largest_speed - before);
}

void scree_moved_tell(scree_state *state, scree_work *work, const scree_speeds *speeds)
{
    scree_moved *moved = &work->moved;
    if (!state->part) {
        settle(state, work, speeds);
        return;
    }
    moved->told = true;
    moved->driven = 0;
    moved->speeds = *speeds;
}

void scree_moved_drive(scree_state *state, scree_work *work, double speed)
{
    if (state->part)
        work->moved.driven = fmax(work->moved.driven, speed);
    else
        settle_driven(state, work, speed);
}

static void list(scree_moved *moved, bool due)
{
    moved->due = due;
    scree_reduction_maximum(&moved->together, &moved->due, 1);
    if (!moved->told) return;
    scree_reduction_maximum(&moved->together, &moved->speeds.surface, 1);
    scree_reduction_maximum(&moved->together, &moved->speeds.centre, 1);
    scree_reduction_maximum(&moved->together, &moved->speeds.spin, 1);
    scree_reduction_maximum(&moved->together, &moved->driven, 1);
}

static void settle_all(scree_state *state, scree_work *work)
{
    scree_moved *moved = &work->moved;
    if (!moved->told) return;
    moved->told = false;
    settle(state, work, &moved->speeds);
    if (moved->driven > 0) settle_driven(state, work, moved->driven);
}

void scree_moved_begin(scree_state *state, scree_work *work, bool due)
{
    list(&work->moved, due);
    scree_comm_join_begin(state, &work->moved.together);
}

void scree_moved_end(scree_state *state, scree_work *work)
{
    scree_comm_join_end(state, &work->moved.together);
    settle_all(state, work);
}

void scree_moved_join(scree_state *state, scree_work *work, bool due)
{
    list(&work->moved, due);
    scree_comm_join_numbers(state, &work->moved.together);
    settle_all(state, work);
    work->moved.known = true;
}
