/// Pairs within a gap come from the neighbour list, made for the time with a skin as wide as the tolerance: it has each
/// pair once, across the faces of a periodic cell too. Pairs of a list are looked up by their ids, the shortest way.
#include "bond/candidates.h"

#include "search/neighbours.h"
#include "selection/selection.h"
#include "state/persistent.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// A second neighbour of a dense packing is farther away than this, in smaller radii: in the hexagonal lattice its gap
/// is 2 (sqrt 3 - 1) radii, in the square one 2 (sqrt 2 - 1).
#define SECOND_NEIGHBOUR  0.8
#define OVERLAP_TOLERANCE 0.05

typedef scree_bond_candidate candidate;

static scree_status append(scree_bond_candidates *all, candidate pair, scree_error *error)
{
    if (all->count == all->capacity) {
        const size_t capacity = 2 * all->capacity + 64;
        scree_status status = scree_reallocate(&all->pair, all->count, capacity, sizeof *all->pair, error);
        if (status) return status;
        all->capacity = capacity;
    }
    all->pair[all->count++] = pair;
    return SCREE_OK;
}

// ---- who is meant ------------------------------------------------------------------------------------------------

static bool is_in(const scree_state *state, int64_t selection, uint32_t row)
{
    return scree_body_is_grain(state, row) && (selection < 0 || scree_selection_has(state, selection, row));
}

static bool is_meant(const scree_state *state, const scree_bond_order *order, uint32_t a, uint32_t b)
{
    const int64_t other = order->other < 0 ? order->between : order->other;
    return (is_in(state, order->between, a) && is_in(state, other, b)) ||
           (is_in(state, order->between, b) && is_in(state, other, a));
}

/// From the list, rows and ghosts as they are now.
static scree_status find_near(const scree_state *state, const scree_work *work, const scree_bond_order *order,
                              scree_bond_candidates *all, scree_error *error)
{
    const scree_pair_list *pairs = &work->pairs;
    scree_status status = SCREE_OK;
    for (size_t p = scree_pairs_held(pairs); p < pairs->count && !status; p++) {
        const uint32_t a = pairs->first[p], b = pairs->second[p];
        scree_vector from, to;
        if (!is_meant(state, order, scree_parent_row(state, work, a), scree_parent_row(state, work, b))) continue;
        scree_body_position(state, a, from);
        scree_body_position(state, b, to);
        for (int k = 0; k < 3; k++) to[k] -= from[k];
        const double gap = scree_length(to) - state->row[a].radius - state->row[b].radius;
        if (gap <= order->gap_tolerance) status = append(all, (candidate){state->id[a], state->id[b], gap}, error);
    }
    return status;
}

/// With a list as wide as the tolerance.
static scree_status find_within(const scree_model *model, scree_state *state, scree_work *work,
                                const scree_bond_order *order, scree_bond_candidates *all, scree_error *error)
{
    const double skin = work->skin;
    if (order->gap_tolerance > skin) {
        work->skin = order->gap_tolerance;
        scree_neighbours_invalidate(work);
    }
    scree_status status = scree_neighbours_refresh(model, state, work, error);
    if (!status) status = find_near(state, work, order, all, error);
    if (work->skin != skin) scree_neighbours_invalidate(work);
    work->skin = skin;
    return status;
}

static scree_status find_listed(const scree_state *state, const scree_bond_order *order, scree_bond_candidates *all,
                                scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int64_t k = 0; k < order->list_count && !status; k++) {
        const uint64_t id[2] = {(uint64_t)order->list[k][0], (uint64_t)order->list[k][1]};
        for (int i = 0; i < 2; i++) {
            const uint32_t row = scree_state_row_of(state, id[i]);
            if (row == SCREE_NO_ROW)
                return scree_error_refuse(error, "list", NULL,
                                          "names particle %llu, which is not there (%zu particles are)",
                                          (unsigned long long)id[i], state->count);
            if (!scree_body_is_grain(state, row))
                return scree_error_refuse(error, "list", NULL,
                                          "names body %llu, which is one of a membrane: only particles are bonded",
                                          (unsigned long long)id[i]);
        }
        scree_persistent_member pair = {.first = (uint32_t)fmin(order->list[k][0], order->list[k][1]),
                                        .second = (uint32_t)fmax(order->list[k][0], order->list[k][1])};
        scree_vector branch;
        scree_persistent_branch(state, &pair, branch);
        const double radii = state->row[scree_state_row_of(state, pair.first)].radius +
                             state->row[scree_state_row_of(state, pair.second)].radius;
        status = append(all, (candidate){pair.first, pair.second, scree_length(branch) - radii}, error);
    }
    return status;
}

// ---- what is allowed ---------------------------------------------------------------------------------------------

static scree_status check_twice(const scree_state *state, const scree_bond_order *order,
                                const scree_bond_candidates *all, size_t k, scree_error *error)
{
    const candidate *pair = &all->pair[k];
    if (k > 0 && pair[-1].first == pair->first && pair[-1].second == pair->second)
        return scree_error_refuse(error, order->list ? "list" : "gap_tolerance", NULL,
                                  "particles %u and %u would be bonded twice%s", pair->first, pair->second,
                                  order->list ? ": name each pair once"
                                              : ", on both sides of the periodic cell: try a larger cell");
    const size_t held = scree_persistent_find(state, pair->first, pair->second);
    if (held == SIZE_MAX) return SCREE_OK;
    const bool broken = scree_persistent(state)->member[held].constant[SCREE_MEMBER_TENSION] < 0;
    return scree_error_refuse(error, "list", NULL, "particles %u and %u %s: leave them out", pair->first, pair->second,
                              broken ? "had a bond that broke, and have not parted yet" : "are bonded already");
}

static scree_status check_gap(const scree_state *state, const scree_bond_order *order, const candidate *pair,
                              scree_error *error)
{
    const double least = fmin(state->row[scree_state_row_of(state, pair->first)].radius,
                              state->row[scree_state_row_of(state, pair->second)].radius);
    const double overlap = isnan(order->overlap_tolerance) ? OVERLAP_TOLERANCE * least : order->overlap_tolerance;
    if (!order->list && pair->gap >= SECOND_NEIGHBOUR * least)
        return scree_error_refuse(error, "gap_tolerance", NULL,
                                  "%.4g m would bond second neighbours: particles %u and %u have a gap of %.4g m, "
                                  "more than %g of the smaller radius (%.4g m); try a tolerance below %.4g m",
                                  order->gap_tolerance, pair->first, pair->second, pair->gap, SECOND_NEIGHBOUR, least,
                                  SECOND_NEIGHBOUR * least);
    if (-pair->gap > overlap)
        return scree_error_refuse(error, "overlap_tolerance", NULL,
                                  "particles %u and %u overlap by %.4g m, more than the tolerance (%.4g m): let "
                                  "them come to rest farther apart, or allow it with a larger tolerance",
                                  pair->first, pair->second, -pair->gap, overlap);
    return SCREE_OK;
}

static int compare(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return p->second < q->second ? -1 : p->second > q->second;
}

scree_status scree_bond_candidates_find(const scree_model *model, scree_state *state, scree_work *work,
                                        const scree_bond_order *order, scree_bond_candidates *all, scree_error *error)
{
    *all = (scree_bond_candidates){0};
    scree_status status =
        order->list ? find_listed(state, order, all, error) : find_within(model, state, work, order, all, error);
    if (status) return status;
    if (all->count == 0)
        return scree_error_refuse(error, "gap_tolerance", NULL,
                                  "nothing is bonded: no two particles that are meant, and not held already, have "
                                  "a gap below %.4g m; try a larger tolerance",
                                  order->gap_tolerance);
    qsort(all->pair, all->count, sizeof *all->pair, compare);
    for (size_t k = 0; k < all->count && !status; k++) {
        status = check_twice(state, order, all, k, error);
        if (!status) status = check_gap(state, order, &all->pair[k], error);
    }
    return status;
}
