/// Sections of the pair list: which pairs belong to which, and the order in which they are put there.
#include "search/search.h"
#include "state/sleep.h"

#include <string.h>

static uint32_t lower_row(scree_row_pair pair)
{
    return pair.first < pair.second ? pair.first : pair.second;
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

void scree_pair_sections_cut(const scree_model *model, const scree_state *state, scree_work *work)
{
    scree_pair_list *pairs = &work->pairs;
    (void)scree_pairs_add_section(pairs, model->geometry, 0, true, work->search->held.count, 0);
    for (int k = 0; k < (scree_sleep_of(state)->count > 0 ? 2 : 1) * scree_model_law_count(model); k++) {
        const int law = k % scree_model_law_count(model);
        const bool asleep = k != law;
        const part touching = {model, state, work, law, true, asleep}, near = {model, state, work, law, false, asleep};
        scree_pairs_add_section(pairs, model->geometry, law, false, count_all(&touching, work->search),
                                count_all(&near, work->search))
            ->asleep = asleep;
    }
}
