/// Sections of the pair list: which pairs belong to which, and the order in which they are put there.
#include "search/search.h"
#include "state/sleep.h"

#include <string.h>

static uint32_t lower_row(scree_row_pair pair)
{
    return pair.first < pair.second ? pair.first : pair.second;
}

/// Parts of the list but for that of the held pairs: of each section those that touch and those that are near.
enum { PARTS = 2 * (SCREE_PAIR_SECTIONS - 1) };

static int part_number(const scree_model *model, int law, bool asleep, bool near)
{
    return 2 * (law + (asleep ? scree_model_law_count(model) : 0)) + (near ? 1 : 0);
}

/// Which of the pairs that were found are meant: touching or near ones of one law, by the materials of the bodies, and
/// those that sleep or all others.
typedef struct part {
    const scree_model *model;
    const scree_state *state;
    const scree_work *work;
    int law; ///< its number; of any, where there is no other
    bool touching, asleep;
} part;

static bool all_are_of(const part *p)
{
    return p->model->pair_laws == 0 && scree_sleep_of(p->state)->count == 0;
}

static bool is_of(const part *p, scree_row_pair pair)
{
    if (all_are_of(p)) return true;
    const uint32_t one = scree_parent_row(p->state, p->work, pair.first);
    const uint32_t other = scree_parent_row(p->state, p->work, pair.second);
    if ((scree_body_sleeps(p->state, one) && scree_body_sleeps(p->state, other)) != p->asleep) return false;
    return p->model->pair_laws == 0 ||
           p->model->law_of_pairs[scree_body_material(p->state, one)][scree_body_material(p->state, other)] == p->law;
}

static const scree_pair_buffer *buffer_of(const part *p, const scree_pair_chunk *chunk)
{
    return p->touching ? &chunk->touching : &chunk->near;
}

/// How many there are in a chunk.
static size_t count_part(const part *p, const scree_pair_chunk *chunk)
{
    const scree_pair_buffer *from = buffer_of(p, chunk);
    const bool all = all_are_of(p);
    size_t count = all ? from->count : 0;
    for (size_t k = 0; k < from->count && !all; k++) count += is_of(p, from->pair[k]);
    return count;
}

static size_t count_all(const part *p, const scree_search *search)
{
    size_t count = count_part(p, &search->ghosts);
    for (int c = 0; c < search->chunks; c++) count += count_part(p, &search->chunk[c]);
    return count;
}

/// Puts the pairs of all chunks that are meant into the list from number `at` on; returns where they end.
/// Within one level they come in the order of their lower rows; else a counting sort brings them into it.
static size_t list_pairs(scree_search *search, const part *p, scree_pair_list *pairs, size_t at)
{
    uint32_t *next = search->grid.order;
    const bool sorted = search->grid.levels_in_use <= 1;
    if (!sorted) memset(next, 0, search->bodies * sizeof *next);
    for (int c = 0; c < search->chunks && !sorted; c++) {
        const scree_pair_buffer *from = buffer_of(p, &search->chunk[c]);
        for (size_t k = 0; k < from->count; k++)
            if (is_of(p, from->pair[k])) next[lower_row(from->pair[k])]++;
    }
    size_t sum = at;
    for (size_t row = 0; row < search->bodies && !sorted; row++) {
        size_t size = next[row];
        next[row] = (uint32_t)sum;
        sum += size;
    }
    for (int c = 0; c < search->chunks; c++) {
        const scree_pair_buffer *from = buffer_of(p, &search->chunk[c]);
        for (size_t k = 0; k < from->count; k++) {
            if (!is_of(p, from->pair[k])) continue;
            size_t to = sorted ? at++ : next[lower_row(from->pair[k])]++;
            pairs->first[to] = from->pair[k].first;
            pairs->second[to] = from->pair[k].second;
        }
    }
    return sorted ? at : sum;
}

/// Puts the pairs with ghosts into the list from number `at` on.
static void list_ghost_pairs(const scree_search *search, const part *p, scree_pair_list *pairs, size_t at)
{
    const scree_pair_buffer *from = buffer_of(p, &search->ghosts);
    for (size_t k = 0; k < from->count; k++) {
        if (!is_of(p, from->pair[k])) continue;
        pairs->first[at] = from->pair[k].first;
        pairs->second[at++] = from->pair[k].second;
    }
}

void scree_pair_sections_fill(const scree_model *model, const scree_state *state, scree_work *work)
{
    scree_search *search = work->search;
    scree_pair_list *pairs = &work->pairs;
    for (int k = 0; k < pairs->section_count; k++) {
        const scree_pair_section *section = &pairs->section[k];
        part p = {model, state, work, section->law, true, section->asleep};
        if (section->persistent) continue; // they are there
        list_ghost_pairs(search, &p, pairs, list_pairs(search, &p, pairs, section->begin));
        p.touching = false;
        list_ghost_pairs(search, &p, pairs, list_pairs(search, &p, pairs, section->touching_end));
    }
}

/// Cuts the list into sections, the held pairs as they are. size: pairs of each part (part_number).
static void cut_list(const scree_model *model, const scree_state *state, scree_pair_list *pairs,
                     const size_t size[PARTS])
{
    const int laws = scree_model_law_count(model), count = (scree_sleep_of(state)->count > 0 ? 2 : 1) * laws;
    for (int k = 0; k < count; k++) {
        const int touching = part_number(model, k % laws, k >= laws, false);
        scree_pairs_add_section(pairs, model->geometry, k % laws, false, size[touching], size[touching + 1])->asleep =
            k >= laws;
    }
}

void scree_pair_sections_cut(const scree_model *model, const scree_state *state, scree_work *work)
{
    const int laws = scree_model_law_count(model);
    size_t size[PARTS] = {0};
    for (int k = 0; k < (scree_sleep_of(state)->count > 0 ? 2 : 1) * 2 * laws; k++) {
        const part p = {model, state, work, k / 2 % laws, k % 2 == 0, k >= 2 * laws};
        size[part_number(model, p.law, p.asleep, !p.touching)] = count_all(&p, work->search);
    }
    (void)scree_pairs_add_section(&work->pairs, model->geometry, 0, true, work->search->held.count, 0);
    cut_list(model, state, &work->pairs, size);
}

// ---- the same pairs in other sections -------------------------------------------------------------------------------

/// Says of every pair but the held ones to which part of the list it belongs now; size: how many each has.
static void find_parts(const scree_model *model, const scree_state *state, scree_work *work, size_t size[PARTS])
{
    const scree_pair_list *pairs = &work->pairs;
    uint8_t *number = work->search->part;
    memset(size, 0, PARTS * sizeof *size);
    for (int k = 1; k < pairs->section_count; k++) {
        const scree_pair_section *section = &pairs->section[k];
        for (size_t p = section->begin; p < section->end; p++) {
            const uint32_t one = scree_parent_row(state, work, pairs->first[p]);
            const uint32_t other = scree_parent_row(state, work, pairs->second[p]);
            const bool asleep = scree_body_sleeps(state, one) && scree_body_sleeps(state, other);
            number[p] = (uint8_t)part_number(model, section->law, asleep, p >= section->touching_end);
            size[number[p]]++;
        }
    }
}

#define EXCHANGE(array, a, b)                                                                                          \
    do {                                                                                                               \
        const __typeof__(*(array)) kept = (array)[a];                                                                  \
        (array)[a] = (array)[b];                                                                                       \
        (array)[b] = kept;                                                                                             \
    } while (0)

/// Exchanges two pairs with all that they remember.
static void exchange(scree_pair_list *pairs, uint8_t *number, size_t a, size_t b)
{
    EXCHANGE(number, a, b);
    EXCHANGE(pairs->first, a, b);
    EXCHANGE(pairs->second, a, b);
    EXCHANGE(pairs->history, a, b);
    if (pairs->last_force) EXCHANGE(pairs->last_force, a, b);
    if (pairs->rolling) EXCHANGE(pairs->rolling, a, b);
    if (pairs->hint) EXCHANGE(pairs->hint, a, b);
}

/// Brings every pair into its part, of which `next` and `end` are the first and behind the last one. Those that are
/// there stay.
static void arrange(scree_pair_list *pairs, uint8_t *number, size_t next[PARTS], const size_t end[PARTS])
{
    for (int k = 0; k < PARTS; k++)
        while (next[k] < end[k]) {
            const int own = number[next[k]];
            if (own == k) {
                next[k]++;
                continue;
            }
            while (number[next[own]] == own) next[own]++; // there is one of another part, since one of its own is here
            exchange(pairs, number, next[k], next[own]++);
        }
}

scree_status scree_pair_sections_renew(const scree_model *model, const scree_state *state, scree_work *work,
                                       scree_error *error)
{
    scree_pair_list *pairs = &work->pairs;
    scree_search *search = work->search;
    size_t size[PARTS], next[PARTS] = {0}, end[PARTS] = {0};
    scree_status status = SCREE_OK;
    if (search->part_capacity < pairs->capacity) {
        search->part_capacity = 0;
        scree_release(&search->part);
        status = scree_allocate(&search->part, pairs->capacity, sizeof *search->part, error);
        if (status) return status;
        search->part_capacity = pairs->capacity;
    }
    find_parts(model, state, work, size);
    pairs->section_count = 1;
    cut_list(model, state, pairs, size);
    for (int k = 1; k < pairs->section_count; k++) {
        const scree_pair_section *section = &pairs->section[k];
        const int number = part_number(model, section->law, section->asleep, false);
        next[number] = section->begin;
        end[number] = next[number + 1] = section->touching_end;
        end[number + 1] = section->end;
    }
    arrange(pairs, search->part, next, end);
    pairs->orders++;
    return SCREE_OK;
}
