/// ParaView files, written without VTK: discs as points (.vtp, fields of the field table), contacts as lines (.vtp),
/// and .pvd collections that are replaced after every snapshot. Binary appended raw data, little endian.
#ifndef SCREE_IO_PARAVIEW_H
#define SCREE_IO_PARAVIEW_H

#include "io/snapshot.h"

scree_status scree_paraview_write(const char *directory, const scree_model *model, const scree_state *state,
                                  const scree_contact_table *table, const scree_snapshot_info *info,
                                  scree_error *error) SCREE_MUST_USE;

#endif
