/// The processes that take part, and bytes between them, by MPI.
#include "comm/comm.h"
#include "comm/mpi_own.h"
#include "comm/traffic.h"

static MPI_Comm together = MPI_COMM_NULL;
static int size = 1, rank, here = 1;

bool scree_comm_has_transport(void)
{
    return true;
}

scree_status scree_comm_join(scree_error *error)
{
    int given;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS || given < MPI_THREAD_FUNNELED)
        return scree_error_set(error, SCREE_ERROR_IO, "MPI cannot start beside threads (MPI_THREAD_FUNNELED)");
    (void)MPI_Comm_dup(MPI_COMM_WORLD, &together);
    (void)MPI_Comm_size(together, &size);
    if (size > SCREE_PROCESSES)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%d processes (accepted: at most %d)", size, SCREE_PROCESSES);
    (void)MPI_Comm_rank(together, &rank);
    MPI_Comm node;
    (void)MPI_Comm_split_type(together, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    (void)MPI_Comm_size(node, &here);
    (void)MPI_Comm_free(&node);
    return SCREE_OK;
}

void scree_comm_leave(void)
{
    if (together == MPI_COMM_NULL) return;
    scree_comm_forget_cuts();
    (void)MPI_Comm_free(&together);
    (void)MPI_Finalize();
    size = here = 1;
    rank = 0;
}

MPI_Comm scree_comm_world(void)
{
    return together;
}

int scree_comm_size(void)
{
    return size;
}

int scree_comm_rank(void)
{
    return rank;
}

int scree_comm_neighbours(void)
{
    return here;
}

scree_status scree_comm_agree(scree_status status, scree_error *error)
{
    if (size == 1) return status;
    int lowest = status ? rank : size;
    (void)MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT, MPI_MIN, together);
    if (lowest == size) return SCREE_OK;
    int shared = (int)status;
    (void)MPI_Bcast(&shared, 1, MPI_INT, lowest, together);
    scree_error none = {0};
    (void)MPI_Bcast(error ? error : &none, (int)sizeof none, MPI_BYTE, lowest, together);
    return (scree_status)shared;
}

void scree_comm_stop(scree_status status)
{
    if (size > 1) (void)MPI_Abort(together, (int)status);
}

// ---- bytes -------------------------------------------------------------------------------------------------------

void scree_comm_trade(const uint64_t *mine, uint64_t *theirs, size_t each)
{
    const double began = MPI_Wtime();
    const size_t others = (size_t)(size - 1);
    (void)MPI_Alltoall(mine, (int)each, MPI_UINT64_T, theirs, (int)each, MPI_UINT64_T, together);
    scree_traffic_count(others, others * each * sizeof *mine, MPI_Wtime() - began);
}

/// Elements of so many bytes, so that counts stay within the integers of MPI.
static MPI_Datatype element(size_t bytes)
{
    MPI_Datatype type;
    (void)MPI_Type_contiguous((int)bytes, MPI_BYTE, &type);
    (void)MPI_Type_commit(&type);
    return type;
}

size_t scree_comm_deliver(const void *out, const size_t *send, void *in, const size_t *receive, size_t bytes)
{
    MPI_Request request[2 * SCREE_PROCESSES];
    MPI_Datatype type = element(bytes);
    const unsigned char *from = out;
    unsigned char *to = in;
    size_t sent = 0, messages = 0;
    int count = 0;
    const double began = MPI_Wtime();
    for (int r = 0; r < size; to += receive[r++] * bytes)
        if (r != rank && receive[r] > 0) (void)MPI_Irecv(to, (int)receive[r], type, r, 0, together, &request[count++]);
    for (int r = 0; r < size; from += send[r++] * bytes) {
        if (r == rank || send[r] == 0) continue;
        (void)MPI_Isend(from, (int)send[r], type, r, 0, together, &request[count++]);
        sent += send[r] * bytes;
        messages++;
    }
    (void)MPI_Waitall(count, request, MPI_STATUSES_IGNORE);
    (void)MPI_Type_free(&type);
    scree_traffic_count(messages, sent, MPI_Wtime() - began);
    return sent;
}

void scree_comm_gather(const void *mine, void *all, const size_t *counts, size_t bytes)
{
    int number[SCREE_PROCESSES], begin[SCREE_PROCESSES], sum = 0;
    MPI_Datatype type = element(bytes);
    const double began = MPI_Wtime();
    const size_t others = (size_t)(size - 1);
    for (int r = 0; r < size; r++) {
        begin[r] = sum;
        sum += number[r] = (int)counts[r];
    }
    (void)MPI_Allgatherv(mine, number[rank], type, all, number, begin, type, together);
    (void)MPI_Type_free(&type);
    scree_traffic_count(others, others * counts[rank] * bytes, MPI_Wtime() - began);
}

void scree_comm_share(void *bytes, size_t count)
{
    if (size == 1) return;
    const double began = MPI_Wtime();
    (void)MPI_Bcast(bytes, (int)count, MPI_BYTE, 0, together);
    scree_traffic_count(rank == 0 ? (size_t)(size - 1) : 0, rank == 0 ? (size_t)(size - 1) * count : 0,
                        MPI_Wtime() - began);
}
