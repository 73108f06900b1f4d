/// Memory is copied before, and put back: laws and kernels know nothing of trials (trial.h).
#include "contact/trial.h"

#include "contact/bounds.h"
#include "contact/contact.h"
#include "contact/partition.h"

#include <string.h>

/// Arrays that an evaluation changes, with their copies.
enum { MOST_ARRAYS = 10 };
typedef struct kept_array {
    void *array, *copy;
    size_t bytes;
} kept_array;

typedef struct kept_memory {
    kept_array of[MOST_ARRAYS];
    size_t count;
} kept_memory;

static void name(kept_memory *kept, void *array, size_t bytes)
{
    if (array && bytes > 0) kept->of[kept->count++] = (kept_array){array, NULL, bytes};
}

static void name_list(kept_memory *kept, scree_history *history, scree_last_force *last, scree_rolling *rolling,
                      size_t count)
{
    name(kept, history, count * sizeof *history);
    name(kept, last, count * sizeof *last);
    name(kept, rolling, count * sizeof *rolling);
}

static void release(kept_memory *kept)
{
    for (size_t k = 0; k < kept->count; k++) scree_release(&kept->of[k].copy);
}

static scree_status keep(scree_state *state, scree_work *work, kept_memory *kept, scree_error *error)
{
    const scree_wall_pair_list *plates = &work->wall_pairs, *elements = &work->primitive_pairs;
    const contact_scratch *scratch = work->reference_kernel ? NULL : contact_scratch_refresh(work, state);
    *kept = (kept_memory){.count = 0};
    name_list(kept, work->pairs.history, work->pairs.last_force, work->pairs.rolling, work->pairs.count);
    name_list(kept, plates->history, plates->last_force, plates->rolling, plates->count);
    name_list(kept, elements->history, elements->last_force, elements->rolling, elements->count);
    if (scratch) name(kept, scratch->near_touched, scratch->near_capacity);
    for (size_t k = 0; k < kept->count; k++) {
        kept_array *of = &kept->of[k];
        scree_status status = scree_allocate(&of->copy, of->bytes, 1, error);
        if (status) return status;
        memcpy(of->copy, of->array, of->bytes);
    }
    return SCREE_OK;
}

static void put_back(const kept_memory *kept)
{
    for (size_t k = 0; k < kept->count; k++) memcpy(kept->of[k].array, kept->of[k].copy, kept->of[k].bytes);
}

scree_status scree_contact_try(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    kept_memory kept;
    scree_status status = keep(state, work, &kept, error);
    if (!status) {
        scree_contact_set_quanta(model, state, 0);
        const bool in_range = scree_contact_sums(model, state, work);
        put_back(&kept);
        if (!in_range)
            status = scree_error_set(error, SCREE_ERROR_GUARD, "step %llu: a contact force leaves its bound",
                                     (unsigned long long)state->step);
    }
    release(&kept);
    return status;
}
