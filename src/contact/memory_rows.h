/// What a contact remembers, as rows of the lists.
#ifndef SCREE_CONTACT_MEMORY_ROWS_H
#define SCREE_CONTACT_MEMORY_ROWS_H

#include "state/state.h"

#include <stdbool.h>

/// Those that do not exist are NULL.
typedef struct memory_rows {
    scree_history *history;
    scree_last_force *last_force;
    scree_rolling *rolling;
} memory_rows;

/// Rows of contact `k` of a list.
static inline memory_rows memory_rows_at(scree_history *history, scree_last_force *last_force, scree_rolling *rolling,
                                         size_t k)
{
    return (memory_rows){history + k, last_force ? last_force + k : NULL, rolling ? rolling + k : NULL};
}

/// A contact that has opened has all its rows clear, so the history row tells, but for what only rolls.
static inline bool memory_is_clear(const memory_rows *rows)
{
    bool clear = true;
    for (int k = 0; k < 4; k++) {
        clear = clear && rows->history->value[k] == 0;
        if (rows->last_force) clear = clear && rows->last_force->value[k] == 0;
        if (rows->rolling) clear = clear && rows->rolling->value[k] == 0 && rows->rolling->last[k] == 0;
    }
    return clear;
}

#endif
