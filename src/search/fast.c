#include "search/fast.h"

#include "base/vectors.h"
#include "state/body.h"
#include "state/periodic.h"
#include "state/plates.h"

#include <math.h>

/// Skins, at most: in space a wide one holds too many others.
#define FARTHEST(dimension) ((dimension) == 3 ? 12.0 : 48.0)

typedef struct runner {
    double speed;
    uint32_t row;
} runner;

/// The SCREE_FAST + 1 fastest bodies, the fastest first; returns how many there are.
static int find_fastest(const scree_state *state, runner best[SCREE_FAST + 1])
{
    int count = 0;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector velocity, spin;
        scree_body_motion(state, row, velocity, spin);
        const double speed = scree_length(velocity);
        if (!isfinite(speed) || (count > SCREE_FAST && speed <= best[SCREE_FAST].speed)) continue;
        int at = count > SCREE_FAST ? SCREE_FAST : count++;
        for (; at > 0 && best[at - 1].speed < speed; at--) best[at] = best[at - 1];
        best[at] = (runner){speed, (uint32_t)row};
    }
    return count;
}

static bool some_plate_stands(const scree_state *state)
{
    bool some = false;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) some = some || scree_plates(state)[w].active;
    return some;
}

void scree_fast_find(scree_fast *fast, const scree_state *state, double skin)
{
    runner best[SCREE_FAST + 1];
    fast->count = 0;
    if (state->part || state->stretch || scree_cell(state)->directions || some_plate_stands(state)) return;
    const int last = find_fastest(state, best) - 1;
    for (int k = 0; k < last && best[k].speed > 2 * best[last].speed; k++) {
        const double share = best[k].speed / best[last].speed;
        int at = fast->count++;
        for (; at > 0 && fast->row[at - 1] > best[k].row; at--) {
            fast->row[at] = fast->row[at - 1];
            fast->skin[at] = fast->skin[at - 1];
        }
        fast->row[at] = best[k].row;
        fast->skin[at] = skin * fmin(share, FARTHEST(state->dimension));
    }
}

static scree_status push(scree_pair_buffer *buffer, const scree_state *state, uint32_t one, uint32_t other,
                         scree_error *error)
{
    if (buffer->count == buffer->capacity) {
        const size_t capacity = 2 * buffer->capacity + 64;
        scree_status status = scree_reallocate(&buffer->pair, buffer->count, capacity, sizeof *buffer->pair, error);
        if (status) return status;
        buffer->capacity = capacity;
    }
    const bool first = state->id[one] < state->id[other];
    buffer->pair[buffer->count++] = (scree_row_pair){first ? one : other, first ? other : one};
    return SCREE_OK;
}

static double distance(const scree_vector a, const scree_vector b)
{
    const scree_vector apart = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return scree_length(apart);
}

/// What a search for pairs needs.
typedef struct finder {
    const scree_fast *fast;
    const scree_state *state;
    double skin;
    const scree_pair_chunk *found;
    int chunks;
    scree_pair_buffer *buffer;
} finder;

/// Whether the search has found a pair that is so far apart that round-off decides.
static bool is_found(const finder *f, uint32_t one, uint32_t other)
{
    const bool first = f->state->id[one] < f->state->id[other];
    const scree_row_pair pair = {first ? one : other, first ? other : one};
    for (int c = 0; c < f->chunks; c++) {
        const scree_pair_buffer *near = &f->found[c].near;
        for (size_t k = 0; k < near->count; k++)
            if (near->pair[k].first == pair.first && near->pair[k].second == pair.second) return true;
    }
    return false;
}

/// Those of number `k`; of two fast ones the lower number finds the pair.
static scree_status find_pairs(const finder *f, int k, scree_error *error)
{
    const scree_fast *fast = f->fast;
    const scree_state *state = f->state;
    const uint32_t own = fast->row[k];
    const double radius = state->row[own].radius;
    scree_vector from, to;
    int next = 0;
    scree_body_position(state, own, from);
    for (uint32_t row = 0; row < state->count; row++) {
        const int number = scree_fast_number(fast, row, &next);
        if (row == own || (number >= 0 && number < k)) continue;
        scree_body_position(state, row, to);
        const double apart = distance(from, to), radii = radius + state->row[row].radius, found = radii + f->skin;
        const double wider = number < 0 ? f->skin : fast->skin[number];
        if (apart < found * (1 - 1e-9) || apart >= radii + 0.5 * (fast->skin[k] + wider)) continue;
        if (apart < found * (1 + 1e-9) && is_found(f, own, row)) continue;
        scree_status status = push(f->buffer, state, own, row, error);
        if (status) return status;
    }
    return SCREE_OK;
}

scree_status scree_fast_pairs(const scree_fast *fast, const scree_state *state, double skin,
                              const scree_pair_chunk *found, int chunks, scree_pair_buffer *buffer, scree_error *error)
{
    const finder f = {fast, state, skin, found, chunks, buffer};
    scree_status status = SCREE_OK;
    for (int k = 0; k < fast->count && !status; k++) status = find_pairs(&f, k, error);
    return status;
}

double scree_fast_left(const scree_fast *fast, const scree_state *state)
{
    double left = INFINITY;
    for (int k = 0; k < fast->count; k++) {
        scree_vector now;
        scree_body_position(state, fast->row[k], now);
        const double moved = distance(now, state->rebuild[fast->row[k]]);
        left = fmin(left, isfinite(moved) ? 0.5 * fast->skin[k] * (1 - 1e-6) - moved : -1);
    }
    return left;
}
