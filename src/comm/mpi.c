/// Numbers out of all parts where there are several processes, by MPI.
///
/// All that is joined is a maximum or a sum of integers modulo a power of two, so neither the number of processes nor
/// the order in which MPI joins them shows in the bits. A sum of 128 bits travels as three integers of 64: two of 32
/// bits each, which cannot overflow below 2^32 processes, and the upper 64 bits, modulo 2^64. A maximum travels as
/// integers in the order of the doubles, with NaN as the largest: MPI leaves open what MPI_MAX makes of it.
#include "comm/comm.h"
#include "comm/mpi_own.h"
#include "comm/traffic.h"

static MPI_Comm together = MPI_COMM_NULL;
static int size = 1, rank, here = 1;

/// A whole state is the same in all processes, so that each finds the same in it.
static bool is_joined(const scree_state *state)
{
    return size > 1 && (!state || state->part);
}

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

enum { BLOCK = 32, LIMBS = 3 };
enum { MOST = 1 << 24 }; ///< numbers of one reduction

/// All reductions of numbers: `count` of 8 bytes each.
static void reduce(void *values, size_t count, MPI_Datatype type, MPI_Op operation)
{
    const double began = MPI_Wtime();
    (void)MPI_Allreduce(MPI_IN_PLACE, values, (int)count, type, operation, together);
    scree_traffic_count_reduction(8 * count, MPI_Wtime() - began);
}

static void add_all(uint64_t *values, size_t count)
{
    reduce(values, count, MPI_UINT64_T, MPI_SUM);
}

static void split(scree_wide_integer value, uint64_t limb[LIMBS])
{
    limb[0] = (uint64_t)value & UINT32_MAX;
    limb[1] = (uint64_t)value >> 32;
    limb[2] = (uint64_t)(value >> 64);
}

static scree_wide_integer unite(const uint64_t limb[LIMBS])
{
    __extension__ typedef unsigned __int128 wide;
    return (scree_wide_integer)((wide)limb[0] + ((wide)limb[1] << 32) + ((wide)limb[2] << 64));
}

/// A number that is larger where the double is; of NaN the largest.
static int64_t order_of(double value)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof bits);
    if (value != value) return INT64_MAX;
    return bits < 0 ? bits ^ INT64_MAX : bits;
}

static double of_order(int64_t order)
{
    double value;
    if (order == INT64_MAX) return NAN;
    if (order < 0) order ^= INT64_MAX;
    memcpy(&value, &order, sizeof value);
    return value;
}

void scree_comm_maximum(const scree_state *state, double *values, size_t count)
{
    if (!is_joined(state)) return;
    // The integers lie where the doubles were.
    int64_t order;
    for (size_t k = 0; k < count; k++) {
        order = order_of(values[k]);
        memcpy(&values[k], &order, sizeof order);
    }
    for (size_t begin = 0; begin < count; begin += MOST)
        reduce(values + begin, count - begin < MOST ? count - begin : MOST, MPI_INT64_T, MPI_MAX);
    for (size_t k = 0; k < count; k++) {
        memcpy(&order, &values[k], sizeof order);
        values[k] = of_order(order);
    }
}

void scree_comm_add(const scree_state *state, int64_t *values, size_t count)
{
    if (!is_joined(state)) return;
    // Modulo 2^64, as integers without a sign.
    add_all((uint64_t *)values, count);
}

/// Joins what the processes have found of up to BLOCK / (LIMBS + 1) sums in the pass that ends, which is the same of
/// all.
static void join_block(scree_integer_sum *sum, int count)
{
    if (sum->pass == SCREE_INTEGER_SUM_LOOKS) {
        double largest[BLOCK];
        for (int k = 0; k < count; k++) largest[k] = sum[k].largest;
        scree_comm_maximum(NULL, largest, (size_t)count);
        for (int k = 0; k < count; k++) sum[k].largest = largest[k];
    }
    if (sum->pass != SCREE_INTEGER_SUM_ADDS) return;
    uint64_t limb[BLOCK];
    enum { EACH = LIMBS + 1 };
    for (int k = 0; k < count; k++) {
        split(sum[k].quanta, limb + EACH * k);
        limb[EACH * k + LIMBS] = sum[k].spoiled;
    }
    add_all(limb, (size_t)(EACH * count));
    for (int k = 0; k < count; k++) {
        sum[k].quanta = unite(limb + EACH * k);
        sum[k].spoiled = limb[EACH * k + LIMBS] > 0;
    }
}

static void join_sums(scree_integer_sum *sum, int count)
{
    const int most = BLOCK / (LIMBS + 1);
    for (int k = 0; k < count; k += most) join_block(sum + k, count - k < most ? count - k : most);
}

bool scree_comm_sum_next(const scree_state *state, scree_integer_sum *sum, int count)
{
    if (is_joined(state)) join_sums(sum, count);
    return scree_integer_sum_next(sum, count);
}

double scree_comm_sum_of(const scree_state *state, const double *term, size_t count)
{
    if (!is_joined(state)) return scree_integer_sum_of(term, count);
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t k = 0; k < count; k++) scree_integer_sum_add(&sum, term[k]);
    return scree_integer_sum_total(&sum);
}

void scree_comm_wide_total(const scree_state *state, const scree_wide_sum *part, int count, double quantum,
                           double total[9])
{
    scree_wide_sum all = {{0}};
    uint64_t limb[9][LIMBS];
    for (int k = 0; k < 9; k++) {
        for (int p = 0; p < count; p++) all.value[k] += part[p].value[k];
        split(all.value[k], limb[k]);
    }
    if (is_joined(state)) add_all(limb[0], sizeof limb / sizeof limb[0][0]);
    for (int k = 0; k < 9; k++) all.value[k] = unite(limb[k]);
    scree_wide_total(&all, 1, quantum, total);
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
