/// What goes between the processes, counted: calls, messages, bytes, and the time that this process spends in them. The
/// transport counts (mpi.c, zoltan.c); whoever sends says what for. Of this process alone, from its begin; one that is
/// alone counts nothing.
///
/// A message is one that this process sends to one other. Of calls that all make together (one number each to each,
/// arrays of all to all) those are counted that go out if nobody passes on what it has got; of reductions the bytes of
/// the numbers. What Zoltan sends to cut space is not counted, but its time is.
///
/// The time in a call is mostly that of waiting for the process that comes last.
#ifndef SCREE_COMM_TRAFFIC_H
#define SCREE_COMM_TRAFFIC_H

#include <stddef.h>
#include <stdint.h>

typedef enum scree_traffic_purpose {
    SCREE_TRAFFIC_REDUCTIONS, ///< one number out of all processes
    SCREE_TRAFFIC_STEPS,      ///< what ghosts follow in and give back in each step
    SCREE_TRAFFIC_LISTS,      ///< when lists are made: cuts, bodies that move, new ghosts
    SCREE_TRAFFIC_GATHERS,    ///< whole states
    SCREE_TRAFFIC_FILES,      ///< rows of snapshots and checkpoints, to the processes that write them (comm/ranges.h)
    SCREE_TRAFFIC_SAMPLES,    ///< what measures of parts say to each other
    SCREE_TRAFFIC_PLACES,     ///< of all grains, when the boundary of the sample is found anew (measure/grain_places.h)
    SCREE_TRAFFIC_PURPOSES
} scree_traffic_purpose;

typedef struct scree_traffic {
    uint64_t calls, messages, bytes;
    double seconds;
} scree_traffic;

/// What has been counted for a purpose.
scree_traffic scree_traffic_of(scree_traffic_purpose purpose);

/// What all but reductions are for from here on (at the begin: lists). Returns what it was before.
scree_traffic_purpose scree_traffic_for(scree_traffic_purpose purpose);

/// A reduction of so many bytes has taken `seconds`.
void scree_traffic_count_reduction(size_t bytes, double seconds);

/// A call of the present purpose.
void scree_traffic_count(size_t messages, size_t bytes, double seconds);

#endif
