/// walls.csv: forces, torques and work of the walls of a case, one row a sample, beside series.csv.
#ifndef SCREE_RUN_WALL_SERIES_H
#define SCREE_RUN_WALL_SERIES_H

#include "io/series.h"
#include "run/simulation.h"

/// Opens it as series.csv is opened; nothing for a case without walls. Columns: step, time, and for each wall
/// NAME_force_x ... NAME_torque_z, NAME_work. Errors: disk, memory.
scree_status scree_wall_series_open(scree_series_writer *writer, const scree_simulation *s, const char *directory,
                                    bool restart, scree_error *error) SCREE_MUST_USE;

/// One row of the present step; nothing when it is not open.
scree_status scree_wall_series_append(scree_series_writer *writer, const scree_simulation *s,
                                      scree_error *error) SCREE_MUST_USE;

#endif
