/// Partition of the pair list. Cost: one pass over the list a rebuild (windows only for more than one part); in a step
/// 32 bytes cleared and added for each buffered row.
#include "contact/partition.h"

#include "contact/contact.h"
#include "contact/scalar.h"

static void release_parts(contact_scratch *scratch)
{
    for (int k = 0; k < scratch->part_capacity; k++) {
        scree_release(&scratch->part[k].buffer);
        scree_release(&scratch->part[k].torque);
        scree_release(&scratch->part[k].moment);
    }
    scree_release(&scratch->part);
    scratch->part_count = scratch->part_capacity = 0;
}

void scree_contact_scratch_destroy(scree_work *work)
{
    contact_scratch *scratch = work->contact_scratch;
    if (!scratch) return;
    release_parts(scratch);
    scree_release(&scratch->near_touched);
    scree_release(&work->contact_scratch);
}

/// Marks the near pairs of a section whose history is not clear: they touched in the last evaluation.
static void mark_section(uint8_t *touched, const scree_pair_list *pairs, const scree_pair_section *section)
{
    for (size_t p = section->touching_end; p < section->end; p++) {
        const size_t k = p - section->touching_end;
        memory_rows rows = memory_rows_at(pairs->history, pairs->last_force, pairs->rolling, p);
        if (!memory_is_clear(&rows)) touched[k / 8] |= (uint8_t)(1U << k % 8);
    }
}

static scree_status mark_near(contact_scratch *scratch, const scree_pair_list *pairs)
{
    size_t bytes = 0;
    for (int s = 0; s < pairs->section_count; s++) {
        scratch->near_byte[s] = bytes;
        bytes += (pairs->section[s].end - pairs->section[s].touching_end + 7) / 8;
    }
    if (bytes > scratch->near_capacity) {
        scratch->near_capacity = 0;
        scree_release(&scratch->near_touched);
        scree_status status = scree_allocate(&scratch->near_touched, bytes + bytes / 4, 1, NULL);
        if (status) return status;
        scratch->near_capacity = bytes + bytes / 4;
    }
    if (bytes > 0) memset(scratch->near_touched, 0, bytes);
    for (int s = 0; s < pairs->section_count; s++)
        mark_section(scratch->near_touched + scratch->near_byte[s], pairs, &pairs->section[s]);
    return SCREE_OK;
}

/// Rows that the pairs [begin, end) name, joined to the window of `part`.
static void extend_window(contact_part *part, const scree_pair_list *pairs, size_t begin, size_t end)
{
    for (size_t p = begin; p < end; p++) {
        size_t a = pairs->first[p], b = pairs->second[p];
        size_t low = a < b ? a : b, high = a < b ? b : a;
        if (low < part->low) part->low = low;
        if (high >= part->high) part->high = high + 1;
    }
}

/// Start of part k of `parts` equal shares of `count` pairs, at a whole group.
static size_t share(size_t count, int k, int parts)
{
    return k == parts ? count : count / (size_t)parts * (size_t)k / 8 * 8;
}

/// Buffers for a window of this many rows; those of moments where they are asked for.
static scree_status reserve_window(contact_part *part, const scree_state *state, size_t window)
{
    const bool moments = state->moment != NULL;
    if (window <= part->capacity && (!moments || part->moment)) return SCREE_OK;
    scree_release(&part->buffer);
    scree_release(&part->torque);
    scree_release(&part->moment);
    part->capacity = 0;
    scree_status status = scree_allocate(&part->buffer, window, sizeof *part->buffer, NULL);
    if (!status && state->dimension == 3) status = scree_allocate(&part->torque, window, sizeof *part->torque, NULL);
    if (!status && moments)
        status =
            scree_allocate(&part->moment, window, scree_moment_size(state->dimension) * sizeof *part->moment, NULL);
    if (!status) part->capacity = window;
    return status;
}

/// Part k of a section.
static contact_range cut_section(const scree_pair_section *section, int k, int parts)
{
    const size_t touching = section->touching_end - section->begin, near = section->end - section->touching_end;
    return (contact_range){.touching_begin = section->begin + share(touching, k, parts),
                           .touching_end = section->begin + share(touching, k + 1, parts),
                           .near_begin = section->touching_end + share(near, k, parts),
                           .near_end = section->touching_end + share(near, k + 1, parts)};
}

static scree_status cut_part(contact_scratch *scratch, const scree_pair_list *pairs, const scree_state *state,
                             size_t rows, int k)
{
    contact_part *part = &scratch->part[k];
    part->low = rows, part->high = 0;
    for (int s = 0; s < pairs->section_count; s++) {
        contact_range *range = &part->range[s];
        *range = cut_section(&pairs->section[s], k, scratch->part_count);
        if (k == 0) continue; // adds to state->sum itself
        extend_window(part, pairs, range->touching_begin, range->touching_end);
        extend_window(part, pairs, range->near_begin, range->near_end);
    }
    if (k == 0) return SCREE_OK;
    if (part->high == 0) part->low = 0;
    return reserve_window(part, state, part->high - part->low);
}

static scree_status cut(contact_scratch *scratch, const scree_work *work, const scree_state *state)
{
    int parts = scree_work_shares(work);
    if (parts > scratch->part_capacity) {
        release_parts(scratch);
        scree_status status = scree_allocate(&scratch->part, (size_t)parts, sizeof *scratch->part, NULL);
        if (status) return status;
        scratch->part_capacity = parts;
    }
    scratch->part_count = parts;
    scree_status status = mark_near(scratch, &work->pairs);
    for (int k = 0; k < parts && !status; k++)
        status = cut_part(scratch, &work->pairs, state, scree_row_count(state, work), k);
    return status;
}

static bool is_current(const contact_scratch *scratch, const scree_work *work, size_t rows, bool moments)
{
    return scratch->part_count == scree_work_shares(work) && scratch->rebuilds == work->rebuilds &&
           scratch->orders == work->pairs.orders && scratch->first == work->pairs.first &&
           scratch->section_count == work->pairs.section_count &&
           memcmp(scratch->section, work->pairs.section, (size_t)scratch->section_count * sizeof *scratch->section) ==
               0 &&
           scratch->rows == rows && (scratch->moments || !moments);
}

contact_scratch *contact_scratch_refresh(scree_work *work, const scree_state *state)
{
    contact_scratch *scratch = work->contact_scratch;
    if (scratch && is_current(scratch, work, scree_row_count(state, work), state->moment != NULL)) return scratch;
    if (!scratch) {
        if (scree_allocate(&scratch, 1, sizeof *scratch, NULL)) return NULL;
        work->contact_scratch = scratch;
    }
    if (cut(scratch, work, state)) {
        scree_contact_scratch_destroy(work);
        return NULL;
    }
    scratch->rebuilds = work->rebuilds;
    scratch->orders = work->pairs.orders;
    scratch->first = work->pairs.first;
    scratch->section_count = work->pairs.section_count;
    memcpy(scratch->section, work->pairs.section, sizeof scratch->section);
    scratch->rows = scree_row_count(state, work);
    scratch->moments = state->moment != NULL;
    return scratch;
}

/// The base from which the rows of a window are counted; it lies before a buffer, which as an integer it may.
#define WINDOW_BASE(window, low) ((void *)((uintptr_t)(window) - (low) * sizeof *(window)))

void contact_clear_rows(scree_state *state, size_t begin, size_t end)
{
    if (begin >= end) return;
    memset(state->sum + begin, 0, (end - begin) * sizeof *state->sum);
    if (state->torque) memset(state->torque + begin, 0, (end - begin) * sizeof *state->torque);
}

void contact_clear_moments(scree_state *state, size_t rows)
{
    if (state->moment && rows > 0)
        memset(state->moment, 0, rows * scree_moment_size(state->dimension) * sizeof *state->moment);
}

void contact_part_clear(contact_part *part, scree_state *state, contact_job *job)
{
    job->sum = state->sum;
    job->torque = state->torque;
    job->moment = state->moment;
    if (!part->buffer) return;
    size_t rows = part->high - part->low;
    if (rows > 0) memset(part->buffer, 0, rows * sizeof *part->buffer);
    if (rows > 0 && part->torque) memset(part->torque, 0, rows * sizeof *part->torque);
    job->sum = WINDOW_BASE(part->buffer, part->low);
    if (part->torque) job->torque = WINDOW_BASE(part->torque, part->low);
    if (!state->moment) return;
    const size_t size = scree_moment_size(state->dimension);
    if (rows > 0) memset(part->moment, 0, rows * size * sizeof *part->moment);
    job->moment = WINDOW_BASE(part->moment, size * part->low);
}

void contact_merge_range(const contact_scratch *scratch, size_t rows, int index, size_t *begin, size_t *end)
{
    *begin = rows * (size_t)index / (size_t)scratch->part_count;
    *end = rows * (size_t)(index + 1) / (size_t)scratch->part_count;
}

static void add_buffer(const contact_part *part, scree_state *state, size_t begin, size_t end)
{
    size_t from = begin > part->low ? begin : part->low, to = end < part->high ? end : part->high;
    for (size_t row = from; row < to; row++) {
        const scree_sum_row *more = &part->buffer[row - part->low];
        sum_row_add(&state->sum[row], (uint64_t)more->fx, (uint64_t)more->fy, (uint64_t)more->fz,
                    (uint64_t)more->contacts);
        if (!part->torque) continue;
        const scree_torque_row *torque = &part->torque[row - part->low];
        torque_row_add(&state->torque[row], (uint64_t)torque->x, (uint64_t)torque->y, (uint64_t)torque->z);
    }
}

/// The same for moments.
static void add_moments(const contact_part *part, scree_state *state, size_t begin, size_t end)
{
    const size_t size = scree_moment_size(state->dimension);
    size_t from = begin > part->low ? begin : part->low, to = end < part->high ? end : part->high;
    for (size_t k = from * size; k < to * size && state->moment; k++)
        state->moment[k] = (int64_t)((uint64_t)state->moment[k] + (uint64_t)part->moment[k - part->low * size]);
}

void contact_merge(const contact_scratch *scratch, scree_state *state, size_t begin, size_t end)
{
    for (int k = 1; k < scratch->part_count; k++) {
        add_buffer(&scratch->part[k], state, begin, end);
        add_moments(&scratch->part[k], state, begin, end);
    }
}
