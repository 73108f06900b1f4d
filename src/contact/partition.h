/// The pair list cut among threads, and the buffers that make it free of conflicts.
///
/// Each section of the list is cut into as many parts as threads, at rebuilds. Part 0 adds to state->sum itself; every
/// other part has a private buffer for the window of rows that its pairs name (the list runs along a space-filling
/// curve, so the windows hardly overlap). When all are done, each part adds the buffers to a range of rows. Sums are
/// integers, so any partition gives the same bits. A single part has no buffer and nothing to merge.
#ifndef SCREE_CONTACT_PARTITION_H
#define SCREE_CONTACT_PARTITION_H

#include "contact/job.h"
#include "state/work.h"

typedef struct contact_part {
    contact_range range[SCREE_PAIR_SECTIONS];
    contact_job job;          ///< for walls, and the sum of all totals; set by each evaluation
    size_t low, high;         ///< window: rows that its pairs name; not for part 0
    scree_sum_row *buffer;    ///< sums of the window; none for part 0
    scree_torque_row *torque; ///< 3D: torques of the window
    int64_t *moment;          ///< moments of the window, where they are asked for
    size_t capacity;
} contact_part;

typedef struct contact_scratch {
    contact_part *part;
    int part_count, part_capacity;
    uint8_t *near_touched; ///< one bit a near pair: it touched in the last evaluation; each section from a byte on
    size_t near_capacity;
    size_t near_byte[SCREE_PAIR_SECTIONS + 1];
    // the list that all this belongs to
    uint64_t rebuilds, orders;
    const uint32_t *first;
    scree_pair_section section[SCREE_PAIR_SECTIONS];
    int section_count;
    size_t rows;
    bool moments; ///< parts have room for them
} contact_scratch;

/// The partition of the present list, made anew when the list is. NULL when there is no memory for it.
contact_scratch *contact_scratch_refresh(scree_work *work, const scree_state *state);

/// The whole of a section as one range.
static inline contact_range contact_range_of(const scree_pair_section *section)
{
    return (contact_range){section->begin, section->touching_end, section->touching_end, section->end};
}

static inline bool contact_range_is_empty(const contact_range *range)
{
    return range->touching_begin == range->touching_end && range->near_begin == range->near_end;
}

/// Before the kernel: clears the part's buffer, and gives the job the bases of its sums.
void contact_part_clear(contact_part *part, scree_state *state, contact_job *job);

/// Clears state->sum (3D: and state->torque) of the rows [begin, end).
void contact_clear_rows(scree_state *state, size_t begin, size_t end);

/// Clears state->moment of the first rows, where there is one.
void contact_clear_moments(scree_state *state, size_t rows);

/// Rows that part `index` merges.
void contact_merge_range(const contact_scratch *scratch, size_t rows, int index, size_t *begin, size_t *end);

/// After all kernels: adds the buffers to state->sum of the rows [begin, end).
void contact_merge(const contact_scratch *scratch, scree_state *state, size_t begin, size_t end);

#endif
