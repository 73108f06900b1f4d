/// ParaView files, written without VTK: discs as points, contacts, Delaunay boundary and plates as lines (.vtp), and
/// .pvd collections with the times, which are replaced after every snapshot. Appended data in the byte order of the
/// machine, which the files name, packed and in single precision (io/vtk_data.h). all.pvd has everything: the files of
/// a snapshot are the blocks of all-INDEX.vtm.
#ifndef SCREE_IO_PARAVIEW_H
#define SCREE_IO_PARAVIEW_H

#include "io/snapshot.h"

/// Writes paraview/discs-INDEX.vtp, contacts-, boundary-, plates-, with cells cells-INDEX.vtu, and renews the
/// collections; entries of snapshots from INDEX on that a run before a restart has left are dropped. Errors:
/// SCREE_ERROR_IO.
scree_status scree_paraview_write(const char *directory, const scree_model *model, const scree_state *state,
                                  const scree_contact_table *table, const scree_snapshot_info *info,
                                  scree_error *error) SCREE_MUST_USE;

#endif
