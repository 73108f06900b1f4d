/// Numbers out of all parts where there is one process: what it has found is all that there is.
#include "comm/comm.h"

bool scree_comm_has_transport(void)
{
    return false;
}

scree_status scree_comm_join(scree_error *error)
{
    (void)error;
    return SCREE_OK;
}

void scree_comm_leave(void) {}

int scree_comm_size(void)
{
    return 1;
}

int scree_comm_rank(void)
{
    return 0;
}

int scree_comm_neighbours(void)
{
    return 1;
}

scree_status scree_comm_agree(scree_status status, scree_error *error)
{
    (void)error;
    return status;
}

void scree_comm_stop(scree_status status)
{
    (void)status;
}

bool scree_comm_sum_next(const scree_state *state, scree_integer_sum *sum, int count)
{
    (void)state;
    return scree_integer_sum_next(sum, count);
}

double scree_comm_sum_of(const scree_state *state, const double *term, size_t count)
{
    (void)state;
    return scree_integer_sum_of(term, count);
}

void scree_comm_wide_total(const scree_state *state, const scree_wide_sum *part, int count, double quantum,
                           double total[9])
{
    (void)state;
    scree_wide_total(part, count, quantum, total);
}

void scree_comm_maximum(const scree_state *state, double *values, size_t count)
{
    (void)state;
    (void)values;
    (void)count;
}

void scree_comm_add(const scree_state *state, int64_t *values, size_t count)
{
    (void)state;
    (void)values;
    (void)count;
}

void scree_comm_join_numbers(const scree_state *state, scree_reduction *reduction)
{
    scree_comm_join_begin(state, reduction);
    scree_comm_join_end(state, reduction);
}

void scree_comm_join_begin(const scree_state *state, scree_reduction *reduction)
{
    (void)state;
    (void)reduction;
}

void scree_comm_join_end(const scree_state *state, scree_reduction *reduction)
{
    (void)state;
    reduction->parts = 0;
}

void scree_comm_trade(const uint64_t *mine, uint64_t *theirs, size_t each)
{
    memcpy(theirs, mine, each * sizeof *mine);
}

size_t scree_comm_deliver(const void *out, const size_t *send, void *in, const size_t *receive, size_t size)
{
    (void)out, (void)send, (void)in, (void)receive, (void)size;
    return 0;
}

void scree_comm_gather(const void *mine, void *all, const size_t *counts, size_t size)
{
    memmove(all, mine, counts[0] * size);
}

void scree_comm_share(void *bytes, size_t size)
{
    (void)bytes, (void)size;
}

bool scree_comm_open_together(int64_t access)
{
    (void)access;
    return true;
}

bool scree_comm_write_together(int64_t transfer)
{
    (void)transfer;
    return true;
}

scree_status scree_comm_cut(const scree_vector *place, const float *weight, size_t count, int dimension,
                            scree_error *error)
{
    (void)place, (void)weight, (void)count, (void)dimension, (void)error;
    return SCREE_OK;
}

int scree_comm_part_of(const scree_vector place)
{
    (void)place;
    return 0;
}
