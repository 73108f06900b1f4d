/// Files of HDF5 that all processes write together, by MPI-IO. Arrays with checksums can be written so alone: each
/// process has to take part in the writing of each of them, with its range.
#include "comm/comm.h"
#include "comm/mpi_own.h"

#include <hdf5.h>

_Static_assert(sizeof(hid_t) == sizeof(int64_t), "handles of HDF5 are numbers of 64 bits");

bool scree_comm_open_together(int64_t access)
{
    // What describes the arrays is the same in all processes, so that each can write some of it.
    return H5Pset_fapl_mpio(access, scree_comm_world(), MPI_INFO_NULL) >= 0 &&
           H5Pset_coll_metadata_write(access, true) >= 0;
}

bool scree_comm_write_together(int64_t transfer)
{
    return H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE) >= 0;
}
