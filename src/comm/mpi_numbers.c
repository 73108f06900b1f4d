/// Numbers out of all parts where there are several processes, by MPI.
///
/// All that is joined is a maximum or a sum of integers modulo a power of two, so neither the number of processes nor
/// the order in which MPI joins them shows in the bits. A sum of 128 bits travels as three integers of 64: two of 32
/// bits each, which cannot overflow below 2^32 processes, and the upper 64 bits, modulo 2^64. A maximum travels as
/// integers in the order of the doubles, with NaN as the largest: MPI leaves open what MPI_MAX makes of it.
#include "comm/comm.h"
#include "comm/mpi_own.h"
#include "comm/traffic.h"

#include <assert.h>

/// A whole state is the same in all processes, so that each finds the same in it.
static bool is_joined(const scree_state *state)
{
    return scree_comm_size() > 1 && (!state || state->part);
}

enum { BLOCK = 32, LIMBS = 3 };
enum { MOST = 1 << 24 }; ///< numbers of one reduction

/// All reductions of numbers: `count` of 8 bytes each.
static void reduce(void *values, size_t count, MPI_Datatype type, MPI_Op operation)
{
    const double began = MPI_Wtime();
    (void)MPI_Allreduce(MPI_IN_PLACE, values, (int)count, type, operation, scree_comm_world());
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

// ---- many numbers in one message ---------------------------------------------------------------------------------

enum { ROOM = 256 }; ///< numbers of 8 bytes: how many maxima, these, then sums

/// The message, the only one that is under way.
static struct {
    int64_t number[ROOM];
    int count; ///< 0: none is under way
    MPI_Datatype type;
    MPI_Request request;
    double seconds; ///< spent in it so far
} message = {.request = MPI_REQUEST_NULL};

/// Of two messages the one: the element of MPI is a whole message, so that it is never taken apart.
static void join_messages(void *other, void *own, int *messages, MPI_Datatype *type)
{
    int bytes;
    (void)MPI_Type_size(*type, &bytes);
    const int64_t *from = other;
    int64_t *to = own;
    const int count = bytes / (int)sizeof *to;
    for (int m = 0; m < *messages; m++, from += count, to += count) {
        const int maxima = (int)to[0];
        for (int k = 1; k <= maxima; k++) to[k] = from[k] > to[k] ? from[k] : to[k];
        for (int k = 1 + maxima; k < count; k++) to[k] = (int64_t)((uint64_t)to[k] + (uint64_t)from[k]);
    }
}

static MPI_Op joining(void)
{
    static MPI_Op operation = MPI_OP_NULL;
    if (operation == MPI_OP_NULL) (void)MPI_Op_create(join_messages, true, &operation);
    return operation;
}

static size_t numbers_of(scree_reduction_kind kind)
{
    return kind == SCREE_REDUCTION_WIDE ? LIMBS : 1;
}

/// Puts the k-th number of a list of this kind at `to`, or takes it from there.
static void write_number(scree_reduction_kind kind, const void *first, size_t k, int64_t *to)
{
    if (kind == SCREE_REDUCTION_MAXIMUM) *to = order_of(((const double *)first)[k]);
    if (kind == SCREE_REDUCTION_SUM) *to = ((const int64_t *)first)[k];
    if (kind == SCREE_REDUCTION_WIDE) split(((const scree_wide_integer *)first)[k], (uint64_t *)to);
}

static void read_number(scree_reduction_kind kind, void *first, size_t k, const int64_t *from)
{
    if (kind == SCREE_REDUCTION_MAXIMUM) ((double *)first)[k] = of_order(*from);
    if (kind == SCREE_REDUCTION_SUM) ((int64_t *)first)[k] = *from;
    if (kind == SCREE_REDUCTION_WIDE) ((scree_wide_integer *)first)[k] = unite((const uint64_t *)from);
}

/// Goes through the lists, maxima first, and returns the numbers of the message; own: writes them, else reads them.
static int walk(const scree_reduction *reduction, bool own)
{
    size_t at = 1;
    for (int sums = 0; sums < 2; sums++) {
        for (size_t p = 0; p < reduction->parts; p++) {
            const scree_reduction_kind kind = reduction->part[p].kind;
            if ((kind != SCREE_REDUCTION_MAXIMUM) != sums) continue;
            for (size_t k = 0; k < reduction->part[p].count; k++, at += numbers_of(kind)) {
                assert(at + numbers_of(kind) <= ROOM);
                if (own)
                    write_number(kind, reduction->part[p].first, k, &message.number[at]);
                else
                    read_number(kind, reduction->part[p].first, k, &message.number[at]);
            }
        }
        if (own && !sums) message.number[0] = (int64_t)at - 1;
    }
    return (int)at;
}

static void begin_message(const scree_reduction *reduction)
{
    assert(message.count == 0);
    message.count = walk(reduction, true);
    (void)MPI_Type_contiguous(message.count, MPI_INT64_T, &message.type);
    (void)MPI_Type_commit(&message.type);
}

static void end_message(scree_reduction *reduction)
{
    (void)MPI_Type_free(&message.type);
    scree_traffic_count_reduction(8 * (size_t)message.count, message.seconds);
    (void)walk(reduction, false);
    reduction->parts = 0;
    message.count = 0;
}

void scree_comm_join_numbers(const scree_state *state, scree_reduction *reduction)
{
    if (!is_joined(state) || reduction->parts == 0) {
        reduction->parts = 0;
        return;
    }
    begin_message(reduction);
    const double began = MPI_Wtime();
    (void)MPI_Allreduce(MPI_IN_PLACE, message.number, 1, message.type, joining(), scree_comm_world());
    message.seconds = MPI_Wtime() - began;
    end_message(reduction);
}

void scree_comm_join_begin(const scree_state *state, scree_reduction *reduction)
{
    if (!is_joined(state) || reduction->parts == 0) return;
    begin_message(reduction);
    const double began = MPI_Wtime();
    (void)MPI_Iallreduce(MPI_IN_PLACE, message.number, 1, message.type, joining(), scree_comm_world(),
                         &message.request);
    message.seconds = MPI_Wtime() - began;
}

void scree_comm_join_end(const scree_state *state, scree_reduction *reduction)
{
    if (!is_joined(state) || message.count == 0) {
        reduction->parts = 0;
        return;
    }
    const double began = MPI_Wtime();
    (void)MPI_Wait(&message.request, MPI_STATUS_IGNORE);
    message.seconds += MPI_Wtime() - began;
    end_message(reduction);
}
