/// A whole state as a group of an HDF5 file, bit for bit.
#ifndef SCREE_IO_STATE_FILE_H
#define SCREE_IO_STATE_FILE_H

#include "io/hdf5_file.h"

/// Writes everything that is needed to continue into `group` of an open part. Contacts must have been saved. `shared`
/// NULL: bodies in the order of their rows. Else the group of a snapshot, which has its fields already: those are left
/// out, and the bodies are in the order of their ids as they are there, as they are in a file of several processes.
/// `ranges`: in such a file what each process writes; else NULL.
void scree_state_write(scree_hdf5 *part, const char *group, const char *shared, const scree_state *state,
                       const scree_ranges *ranges, uint64_t case_checksum);

/// The array of a field as this process gives it to scree_hdf5_write. Errors: memory.
scree_status scree_array_of_range(const scree_hdf5 *file, const scree_state *state, const scree_field *field,
                                  bool by_id, const scree_ranges *ranges, scree_array *array) SCREE_MUST_USE;

/// Reads it back into *state, which must own nothing and stays empty on failure. Rows are in the order in which they
/// were written; derived arrays but row_of_id are zero. Errors, in file->status: SCREE_ERROR_INPUT for another case or
/// another version of the state; SCREE_ERROR_IO (file->damaged) for ids that are no permutation, lengths that do not
/// agree. Values are not looked at: state/check.h.
void scree_state_read(scree_hdf5 *file, const char *group, const char *shared, int dimension, uint64_t case_checksum,
                      scree_state *state);

/// The same by all processes: of bodies and what belongs to two of them each reads its range of rows, and none has the
/// others. The state is a part whose pairs lie anywhere; ids are not looked at (scree_parts_spread).
void scree_state_read_range(scree_hdf5 *file, const char *group, const char *shared, int dimension,
                            uint64_t case_checksum, scree_state *state);

#endif
