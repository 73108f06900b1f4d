/// What a step of a case costs on this machine: the case itself, or a smaller one of its kind, set going for a moment.
#ifndef SCREE_RUN_PROBE_H
#define SCREE_RUN_PROBE_H

#include "run/simulation.h"

/// Processor time [s] of one thread with `count` bodies.
typedef struct scree_probe {
    double count;       ///< bodies
    double step;        ///< a step: boundary, walls and ghosts included, without what follows
    double rebuild;     ///< a new neighbour list
    double upkeep;      ///< an update of the Delaunay boundary or hull; about 0 where none is kept
    double sample;      ///< a row of series.csv, without writing it
    double cells;       ///< the cells of a snapshot; 0: it has none
    double preparation; ///< placing the bodies
    double collision;   ///< s of simulated time that a collide stage is expected to last; NAN without one
} scree_probe;

/// Looks at stage `stage` of a case (not the first one, which prepares): the one that takes most of the time. Errors:
/// those of a run up to there, for the smaller case; they need not be errors of the case itself.
scree_status scree_probe_measure(const scree_case *c, int64_t stage, scree_probe *probe,
                                 scree_error *error) SCREE_MUST_USE;

#endif
