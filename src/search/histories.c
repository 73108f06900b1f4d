/// Contact histories from one neighbour list to the next, by ids.
///
/// Method. The histories of the old list that are not zero (in any bit) are packed into state->contact, the form in
/// which they also come from a checkpoint. When the rows have their new order, a counting sort puts them by the lower
/// row of their pair; the new list then finds each one among the few of its row. Old and new order differ little, so
/// all of it runs through memory nearly in order. Linear cost. Rows of last forces and of rolling go along with the
/// histories where a law has them; those of pairs that are held go back to the persistent list. A pair that has left
/// the list loses its history; it is separated by more than the skin then.
#include "search/search.h"

#include <string.h>

/// Any bit set: also a negative zero survives.
static bool holds_something(const void *row, size_t bytes)
{
    const unsigned char *at = row;
    uint64_t any = 0;
    for (size_t k = 0; k < bytes; k += sizeof any) {
        uint64_t word;
        memcpy(&word, at + k, sizeof word);
        any |= word;
    }
    return any != 0;
}

/// The pairs of bodies, those with plates and those with the walls of the case are one sequence: what belongs to number
/// `k` of it.
typedef struct entry {
    uint32_t first, second; ///< ids
    int law;
    const scree_history *history;
    const scree_last_force *last_force;
    const scree_rolling *rolling;
} entry;

static size_t entry_count(const scree_work *work)
{
    return work->pairs.count - scree_pairs_held(&work->pairs) + work->wall_pairs.count + work->primitive_pairs.count;
}

static entry entry_get(const scree_state *state, const scree_work *work, size_t k)
{
    const scree_pair_list *pairs = &work->pairs;
    const scree_wall_pair_list *walls = &work->wall_pairs;
    k += scree_pairs_held(pairs);
    if (k < pairs->count)
        return (entry){state->id[pairs->first[k]],
                       state->id[pairs->second[k]],
                       scree_pairs_section(pairs, k)->law,
                       &pairs->history[k],
                       pairs->last_force ? &pairs->last_force[k] : NULL,
                       pairs->rolling ? &pairs->rolling[k] : NULL};
    k -= pairs->count;
    uint32_t base = SCREE_WALL_ID;
    if (k >= walls->count) {
        k -= walls->count;
        walls = &work->primitive_pairs;
        base = SCREE_PRIMITIVE_ID;
    }
    return (entry){state->id[walls->body[k]],
                   base + walls->wall[k],
                   scree_wall_pair_law(walls, k),
                   &walls->history[k],
                   walls->last_force ? &walls->last_force[k] : NULL,
                   walls->rolling ? &walls->rolling[k] : NULL};
}

static bool entry_holds_something(const scree_state *state, const scree_work *work, size_t k)
{
    entry e = entry_get(state, work, k);
    return holds_something(e.history, sizeof *e.history) ||
           (e.last_force && holds_something(e.last_force, sizeof *e.last_force)) ||
           (e.rolling && holds_something(e.rolling, sizeof *e.rolling));
}

/// Copies ids and rows of number `k` to the contact memory `to`.
static void pack_entry(scree_state *state, const scree_work *work, size_t k, size_t to)
{
    entry e = entry_get(state, work, k);
    state->contact[to] = (scree_contact_memory){e.first, e.second, *e.history};
    if (e.last_force) state->last_force[to] = *e.last_force;
    if (e.rolling) state->rolling[to] = *e.rolling;
    if (state->contact_law) state->contact_law[to] = (uint8_t)e.law;
}

typedef struct collect_task {
    scree_state *state;
    const scree_work *work;
    size_t entries;
} collect_task;

static void count_share(void *argument, int index, int count)
{
    const collect_task *task = argument;
    size_t carried = 0, end = scree_thread_pool_begin(task->entries, index + 1, count);
    for (size_t k = scree_thread_pool_begin(task->entries, index, count); k < end; k++)
        carried += entry_holds_something(task->state, task->work, k);
    task->work->search->chunk[index].carried = carried;
}

static void pack_share(void *argument, int index, int count)
{
    const collect_task *task = argument;
    size_t to = 0, end = scree_thread_pool_begin(task->entries, index + 1, count);
    for (int before = 0; before < index; before++) to += task->work->search->chunk[before].carried;
    for (size_t k = scree_thread_pool_begin(task->entries, index, count); k < end; k++)
        if (entry_holds_something(task->state, task->work, k)) pack_entry(task->state, task->work, k, to++);
}

scree_status scree_histories_collect(scree_state *state, scree_work *work, scree_error *error)
{
    scree_search *search = work->search;
    collect_task task = {state, work, entry_count(work)};
    // Each chunk counts its entries, so that all chunks can write theirs at once.
    scree_thread_pool_run(&work->pool, search->chunks, count_share, &task);
    size_t total = 0;
    for (int c = 0; c < search->chunks; c++) total += search->chunk[c].carried;
    state->contact_count = 0;
    scree_status status = scree_state_reserve_contacts(state, total, error);
    if (!status && work->pairs.last_force) status = scree_state_add_last_force(state, error);
    if (!status && state->pair_laws > 0) status = scree_state_add_contact_law(state, error);
    if (!status && work->pairs.rolling) status = scree_state_add_rolling(state, error);
    if (status) return status;
    scree_thread_pool_run(&work->pool, search->chunks, pack_share, &task);
    state->contact_count = total;
    scree_held_collect(state, work);
    return SCREE_OK;
}

/// Lower row of the pair of an entry, that of the body which is here where the other is not; `count` for an entry that
/// belongs to no pair.
static uint32_t lower_row(const scree_state *state, const scree_contact_memory *memory)
{
    const uint32_t first = scree_state_row_of(state, memory->first);
    const uint32_t second =
        memory->second >= SCREE_PRIMITIVE_ID ? SCREE_NO_ROW : scree_state_row_of(state, memory->second);
    const uint32_t lower = first < second ? first : second;
    return lower == SCREE_NO_ROW ? (uint32_t)state->count : lower;
}

static scree_status reserve_indices(uint32_t **array, size_t *capacity, size_t count, scree_error *error)
{
    if (count <= *capacity) return SCREE_OK;
    scree_release(array);
    *capacity = 0;
    scree_status status = scree_allocate(array, count + count / 8, sizeof **array, error);
    if (!status) *capacity = count + count / 8;
    return status;
}

scree_status scree_histories_index(scree_search *search, const scree_state *state, scree_error *error)
{
    // One more for entries of no pair, and one for the end.
    scree_status status = reserve_indices(&search->entry_begin, &search->entry_begin_capacity, state->count + 2, error);
    if (!status) status = reserve_indices(&search->entry, &search->entry_capacity, state->contact_count, error);
    if (status) return status;
    uint32_t *begin = search->entry_begin;
    memset(begin, 0, (state->count + 2) * sizeof *begin);
    for (size_t k = 0; k < state->contact_count; k++) begin[lower_row(state, &state->contact[k])]++;
    uint32_t sum = 0;
    for (size_t row = 0; row <= state->count; row++) {
        sum += begin[row];
        begin[row] = sum;
    }
    // Filled from behind, so that the sort is stable and ends become begins.
    for (size_t k = state->contact_count; k-- > 0;)
        search->entry[--begin[lower_row(state, &state->contact[k])]] = (uint32_t)k;
    return SCREE_OK;
}
