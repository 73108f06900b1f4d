/// Private to the files of comm/ that know MPI.
#ifndef SCREE_COMM_MPI_OWN_H
#define SCREE_COMM_MPI_OWN_H

#include <mpi.h>

/// All processes that take part.
MPI_Comm scree_comm_world(void);

/// Releases the cuts, before MPI ends.
void scree_comm_forget_cuts(void);

#endif
