/// The Delaunay cells of a snapshot in run.h5 (group cells/, only with measure.cells) and what measures of consecutive
/// snapshots need besides them.
#ifndef SCREE_IO_CELL_FILE_H
#define SCREE_IO_CELL_FILE_H

#include "io/hdf5_file.h"
#include "measure/cells.h"

/// What snapshots and ParaView files show of each cell: index < scree_cell_array_count(). Names begin with "cells/".
/// Errors: memory.
size_t scree_cell_array_count(void);
scree_status scree_cell_array(const scree_cells *cells, size_t index, scree_array *array,
                              scree_error *error) SCREE_MUST_USE;

/// Writes the group cells/ below `group` of an open part.
void scree_cells_write(scree_hdf5 *part, const char *group, const scree_cells *cells);

/// Positions, radii and cells of a snapshot.
typedef struct scree_cell_snapshot {
    int64_t index;
    double time, axial_strain; ///< s; NAN outside loading
    char stage[32];
    scree_assembly assembly; ///< thickness 1: volumes of the cells have it
    scree_cells cells;
} scree_cell_snapshot;

/// SCREE_OK when there is a snapshot `which` with cells. Errors as of scree_cell_snapshot_read.
scree_status scree_cell_snapshot_find(const char *directory, size_t which, scree_error *error) SCREE_MUST_USE;
/// Errors: SCREE_ERROR_INPUT: no such snapshot, or it has no cells; SCREE_ERROR_IO.
scree_status scree_cell_snapshot_read(const char *directory, size_t which, scree_cell_snapshot *snapshot,
                                      scree_error *error) SCREE_MUST_USE;
void scree_cell_snapshot_destroy(scree_cell_snapshot *snapshot);

/// Whether two snapshots have the same grains, so that motions can be told from one to the other.
bool scree_cell_snapshots_agree(const scree_cell_snapshot *one, const scree_cell_snapshot *other);

#endif
