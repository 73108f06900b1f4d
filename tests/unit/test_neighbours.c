/// Neighbour list against brute force, histories over rebuilds, the budget rule, independence of order, threads and
/// instruction sets, odd positions, failing memory, and linear cost by counts of what is looked at.

#include "state/plates.h"
#include "testing.h"

#include "base/random.h"
#include "search/neighbours.h"
#include "search/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SKIN 0.3

/// A pair by ids, in a form that sorts.
typedef struct id_pair {
    uint64_t ids; ///< first << 32 | second
    bool touching;
    scree_history history;
} id_pair;

typedef struct id_list {
    id_pair *pair;
    size_t count;
} id_list;

static int two = 2, three = 3;

/// Of a test, by its initial state.
static int dimension_of(void **state)
{
    return *(const int *)*state;
}

/// Coordinate along the last axis.
static double *last_of(scree_state *state, size_t id)
{
    scree_row *row = &state->row[state->row_of_id[id]];
    return state->dimension == 3 ? &row->z : &row->y;
}

static double uniform(uint64_t seed, uint64_t counter)
{
    return scree_random_uniform(seed, SCREE_RANDOM_TEST, counter);
}

static int by_ids(const void *a, const void *b)
{
    uint64_t x = ((const id_pair *)a)->ids, y = ((const id_pair *)b)->ids;
    return (x > y) - (x < y);
}

static void make_work(scree_work *work, int threads)
{
    const scree_model model = {.mean_radius = 1, .laws = {{.law = SCREE_SLOT_hertz_mindlin}}};
    scree_error error;
    assert_int_equal(scree_work_create(work, &model, threads, &error), SCREE_OK);
    work->skin = SKIN;
}

static void refresh(scree_state *state, scree_work *work)
{
    const scree_model model = {.mean_radius = 1, .laws = {{.law = SCREE_SLOT_hertz_mindlin}}};
    scree_error error;
    assert_int_equal(scree_neighbours_refresh(&model, state, work, &error), SCREE_OK);
}

static void rebuild(scree_state *state, scree_work *work)
{
    scree_neighbours_invalidate(work);
    refresh(state, work);
}

/// Walls of a box from the origin to `side`, all but the top one.
static void stand_walls(scree_state *state, double side)
{
    const int axis[SCREE_WALL_COUNT] = {state->dimension - 1, state->dimension - 1, 0, 0, 1, 1};
    for (int w = 0; w < 2 * state->dimension; w++) {
        scree_plates(state)[w] = (scree_wall){.position = w % 2 ? -side : 0, .active = w != SCREE_WALL_TOP};
        scree_plates(state)[w].normal[axis[w]] = w % 2 ? -1 : 1;
    }
}

/// Bodies with radii from 1 to `ratio`, small ones frequent (area or volume shared equally by the octaves), at random
/// in a square of which they cover 80 %, or in a cube of which they fill 60 %; walls around it.
static void make_state(scree_state *state, int dimension, size_t count, double ratio, uint64_t seed)
{
    scree_error error;
    bool in_3d = dimension == 3;
    assert_int_equal(scree_state_create(state, dimension, count, &error), SCREE_OK);
    double room = 0;
    for (size_t k = 0; k < count; k++) {
        double u = uniform(seed, 4 * k), small = pow(ratio, -dimension);
        double radius = pow(1 - u * (1 - small), -1.0 / dimension);
        state->row[k] = (scree_row){.radius = radius, .mass = 1};
        room += in_3d ? 4 * M_PI / 3 * radius * radius * radius : M_PI * radius * radius;
    }
    double side = in_3d ? cbrt(room / 0.6) : sqrt(room / 0.8);
    for (size_t k = 0; k < count; k++) {
        state->row[k].x = side * uniform(seed, 4 * k + 1);
        state->row[k].y = side * uniform(seed, 4 * k + 2);
        if (in_3d) state->row[k].z = side * uniform(seed, 4 * k + 3);
    }
    stand_walls(state, side);
}

/// Other arrangements of the bodies of a make_state.
typedef enum arrangement { CLOUD, CLUSTERED, FLAT, LINE, ARRANGEMENTS } arrangement;

static void arrange(scree_state *state, arrangement kind)
{
    double side = -scree_plates(state)[SCREE_WALL_RIGHT].position;
    for (size_t k = 0; k < state->count; k++) {
        scree_row *row = &state->row[k];
        double *last = state->dimension == 3 ? &row->z : &row->y;
        if (kind == CLUSTERED) {
            double squeeze = 0.2 + pow(uniform(77, k), 4), shift = 5 * side * (double)(k % 3);
            row->x = shift + squeeze * row->x;
            row->y *= squeeze;
            if (state->dimension == 3) row->z *= squeeze;
        }
        if (kind == FLAT) *last = 0.01 * *last;
        if (kind == LINE) {
            row->x = -1.7 * (double)k;
            row->y = 0.9 * (double)k;
            *last = 0.4 * (double)k;
        }
    }
}

/// All pairs within the skin by brute force, sorted by ids; walls as in scree_contact_memory.
static id_list brute_force(const scree_state *state, double skin)
{
    id_list list = {malloc((state->count * (state->count + 8) / 2 + 1) * sizeof(id_pair)), 0};
    assert_non_null(list.pair);
    for (size_t a = 0; a < state->count; a++) {
        const scree_row *one = &state->row[a];
        for (size_t b = a + 1; b < state->count; b++) {
            const scree_row *other = &state->row[b];
            double dx = one->x - other->x, dy = one->y - other->y, sum = one->radius + other->radius;
            double dz = state->dimension == 3 ? one->z - other->z : 0, square = dx * dx + dy * dy + dz * dz;
            if (!(square < (sum + skin) * (sum + skin))) continue;
            uint64_t first = state->id[a], second = state->id[b];
            list.pair[list.count++] = (id_pair){.ids = first < second ? first << 32 | second : second << 32 | first,
                                                .touching = square < sum * sum};
        }
        for (uint64_t w = 0; w < SCREE_WALL_COUNT; w++) {
            const scree_wall *wall = &scree_plates(state)[w];
            double along = wall->normal[0] * one->x + wall->normal[1] * one->y;
            if (state->dimension == 3) along += wall->normal[2] * one->z;
            double distance = along - wall->position;
            if (wall->active && distance < one->radius + skin)
                list.pair[list.count++] = (id_pair){.ids = (uint64_t)state->id[a] << 32 | (SCREE_WALL_ID + w)};
        }
    }
    qsort(list.pair, list.count, sizeof *list.pair, by_ids);
    return list;
}

/// The list in `work` in its own order, as ids; checks rows and the order of the ids of a pair.
static id_list listed(const scree_state *state, const scree_work *work)
{
    const scree_pair_list *pairs = &work->pairs;
    const scree_wall_pair_list *walls = &work->wall_pairs;
    id_list list = {malloc((pairs->count + walls->count + 1) * sizeof(id_pair)), 0};
    assert_non_null(list.pair);
    for (size_t k = 0; k < pairs->count; k++) {
        assert_true(pairs->first[k] < state->count && pairs->second[k] < state->count);
        uint64_t first = state->id[pairs->first[k]], second = state->id[pairs->second[k]];
        assert_true(first < second);
        list.pair[list.count++] =
            (id_pair){first << 32 | second, k < pairs->section[1].touching_end, pairs->history[k]};
    }
    for (size_t k = 0; k < walls->count; k++) {
        assert_true(walls->body[k] < state->count && walls->wall[k] < SCREE_WALL_COUNT);
        uint64_t id = state->id[walls->body[k]];
        list.pair[list.count++] = (id_pair){id << 32 | (SCREE_WALL_ID + walls->wall[k]), false, walls->history[k]};
    }
    return list;
}

static id_list sorted(id_list list)
{
    qsort(list.pair, list.count, sizeof *list.pair, by_ids);
    return list;
}

static void assert_same_pairs(id_list a, id_list b)
{
    assert_int_equal(a.count, b.count);
    for (size_t k = 0; k < a.count; k++) {
        assert_true(a.pair[k].ids == b.pair[k].ids);
        assert_int_equal(a.pair[k].touching, b.pair[k].touching);
    }
}

static void assert_equals_brute_force(const scree_state *state, const scree_work *work)
{
    id_list expected = brute_force(state, work->skin), found = sorted(listed(state, work));
    assert_same_pairs(expected, found);
    free(expected.pair);
    free(found.pair);
}

static uint32_t lower(const scree_pair_list *pairs, size_t k)
{
    return pairs->first[k] < pairs->second[k] ? pairs->first[k] : pairs->second[k];
}

static void list_equals_brute_force_in(int dimension, arrangement kind)
{
    const double ratios[] = {1, 2, 10, 50};
    for (size_t r = 0; r < sizeof ratios / sizeof *ratios; r++)
        for (uint64_t seed = 1; seed <= 4; seed++) {
            scree_state state;
            scree_work work;
            make_state(&state, dimension, 150 * seed, ratios[r], seed);
            arrange(&state, kind);
            make_work(&work, 2);
            rebuild(&state, &work);
            assert_equals_brute_force(&state, &work);
            // Both parts along the curve; the padding can be read, also where longer lists have been.
            work.skin /= 2;
            rebuild(&state, &work);
            assert_equals_brute_force(&state, &work);
            const scree_pair_list *pairs = &work.pairs;
            for (size_t k = 1; k < pairs->count; k++)
                if (k != pairs->section[1].touching_end) assert_true(lower(pairs, k - 1) <= lower(pairs, k));
            for (size_t k = pairs->count; k < pairs->count + SCREE_PAIR_PADDING; k++)
                assert_int_equal(pairs->first[k] + pairs->second[k], 0);
            assert_int_equal((uintptr_t)pairs->history % SCREE_ALIGNMENT, 0);
            scree_work_destroy(&work);
            scree_state_destroy(&state);
        }
}

static void list_equals_brute_force(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int kind = 0; kind < ARRANGEMENTS; kind++) list_equals_brute_force_in(dimension, (arrangement)kind);
}

static void list_is_the_same_for_any_instruction_set(void **dimension)
{
    scree_state state;
    make_state(&state, dimension_of(dimension), 500, 10, 5);
    id_list reference = {0};
    const bool available[] = {true, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2"),
                              __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")};
    for (int set = 2; set <= 4; set++) {
        if (!available[set - 2]) continue;
        scree_work work;
        make_work(&work, 1);
        work.instruction_set = set;
        rebuild(&state, &work);
        id_list found = listed(&state, &work);
        if (reference.pair) assert_same_pairs(reference, found);
        free(reference.pair);
        reference = found;
        scree_work_destroy(&work);
    }
    free(reference.pair);
    scree_state_destroy(&state);
}

static void list_depends_on_positions_and_ids_alone(void **dimension)
{
    enum { COUNT = 700 };
    id_list reference = {0};
    for (int variant = 0; variant < 5; variant++) {
        scree_state state;
        scree_work work;
        scree_error error;
        uint32_t order[COUNT];
        make_state(&state, dimension_of(dimension), COUNT, 10, 6);
        for (uint32_t k = 0; k < COUNT; k++) order[k] = k;
        for (uint32_t k = COUNT; variant > 0 && k-- > 1;) {
            uint32_t other = (uint32_t)(uniform(20 + (uint64_t)variant, k) * (k + 1)), kept = order[k];
            order[k] = order[other];
            order[other] = kept;
        }
        assert_int_equal(scree_state_permute(&state, order, &error), SCREE_OK);
        make_work(&work, variant < 2 ? 1 : variant);
        rebuild(&state, &work);
        id_list found = listed(&state, &work);
        if (reference.pair) assert_same_pairs(reference, found);
        free(reference.pair);
        reference = found;
        scree_work_destroy(&work);
        scree_state_destroy(&state);
    }
    free(reference.pair);
}

/// Bits that tell pairs apart and that arithmetic would not keep: a signalling NaN, minus zero.
static scree_history mark(uint64_t ids, uint64_t round)
{
    uint64_t word[SCREE_HISTORY] = {ids * UINT64_C(0x9e3779b97f4a7c15) + round, UINT64_C(0x7ff0000000000001),
                                    UINT64_C(0x8000000000000000), round};
    if (ids % 3 == 0) word[0] = word[1] = word[3] = 0;
    scree_history history;
    memcpy(history.value, word, sizeof word);
    return history;
}

static void shake(scree_state *state, double size, uint64_t seed)
{
    for (size_t id = 0; id < state->count; id++) {
        scree_row *row = &state->row[state->row_of_id[id]];
        row->x += size * (2 * uniform(seed, 3 * id) - 1);
        row->y += size * (2 * uniform(seed, 3 * id + 1) - 1);
        if (state->dimension == 3) row->z += size * (2 * uniform(seed, 3 * id + 2) - 1);
    }
}

/// Writes a history to every touching pair, every second near pair and every wall pair, none to others.
static void mark_list(const scree_state *state, scree_work *work, uint64_t round)
{
    for (size_t k = 0; k < work->pairs.count; k++) {
        uint64_t ids = (uint64_t)state->id[work->pairs.first[k]] << 32 | state->id[work->pairs.second[k]];
        bool marked = k < work->pairs.section[1].touching_end || ids % 2;
        work->pairs.history[k] = marked ? mark(ids, round) : (scree_history){{0}};
    }
    for (size_t k = 0; k < work->wall_pairs.count; k++) {
        uint64_t ids = (uint64_t)state->id[work->wall_pairs.body[k]] << 32 | work->wall_pairs.wall[k];
        work->wall_pairs.history[k] = mark(ids, round);
    }
}

/// Every pair of `after` has the history that it had in `before`, or none if it was not there. Returns how many had
/// one.
static size_t assert_histories_kept(id_list before, id_list after)
{
    const scree_history none = {{0}};
    size_t kept = 0;
    for (size_t k = 0; k < after.count; k++) {
        const id_pair *old = bsearch(&after.pair[k], before.pair, before.count, sizeof *before.pair, by_ids);
        const scree_history *expected = old ? &old->history : &none;
        assert_memory_equal(&after.pair[k].history, expected, sizeof none);
        kept += memcmp(expected, &none, sizeof none) != 0;
    }
    return kept;
}

static void histories_survive_rebuilds(void **dimension)
{
    const double ratios[] = {1.5, 10};
    for (size_t r = 0; r < 2; r++) {
        scree_state state;
        scree_work work;
        make_state(&state, dimension_of(dimension), 400, ratios[r], 7);
        make_work(&work, 2);
        rebuild(&state, &work);
        for (uint64_t round = 0; round < 6; round++) {
            mark_list(&state, &work, round);
            id_list before = sorted(listed(&state, &work));
            shake(&state, 0.4, 30 + round);
            rebuild(&state, &work);
            id_list after = sorted(listed(&state, &work));
            size_t kept = assert_histories_kept(before, after);
            // The shakes part some pairs and leave most.
            assert_true(kept > before.count / 3 && kept < before.count);
            free(before.pair);
            free(after.pair);
        }
        scree_work_destroy(&work);
        scree_state_destroy(&state);
    }
}

/// What a checkpoint does: histories to state->contact by ids, and a new `work`.
static void histories_come_back_from_the_state(void **dimension)
{
    scree_state state;
    scree_work work;
    scree_error error;
    make_state(&state, dimension_of(dimension), 300, 2, 8);
    make_work(&work, 1);
    rebuild(&state, &work);
    mark_list(&state, &work, 1);
    id_list before = sorted(listed(&state, &work));
    assert_int_equal(scree_state_reserve_contacts(&state, before.count + 2, &error), SCREE_OK);
    for (size_t k = 0; k < before.count; k++)
        state.contact[k] = (scree_contact_memory){(uint32_t)(before.pair[k].ids >> 32), (uint32_t)before.pair[k].ids,
                                                  before.pair[k].history};
    // Contacts of bodies that do not exist, as a damaged file might hold, are left out.
    state.contact[before.count] = (scree_contact_memory){.first = 5, .second = 1000000};
    state.contact[before.count + 1] = (scree_contact_memory){.first = 1000000, .second = SCREE_WALL_ID};
    state.contact_count = before.count + 2;
    scree_work_destroy(&work);
    make_work(&work, 2);
    refresh(&state, &work);
    id_list after = sorted(listed(&state, &work));
    assert_same_pairs(before, after);
    (void)assert_histories_kept(before, after);
    free(before.pair);
    free(after.pair);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

/// Bodies fly in circles, the bottom rises; after each refresh every touching pair must be in the list.
/// Returns the number of rebuilds.
static uint64_t fly(int dimension, double slow, double fast, double wall, int steps)
{
    scree_state state;
    scree_work work;
    make_state(&state, dimension, 150, 4, 9);
    make_work(&work, 2);
    for (size_t id = 0; id < state.count; id++) {
        // A few fast ones, so that the budget is a poor bound for the others. In 3D they fly in planes through x.
        double speed = id % 20 == 0 ? fast : slow, angle = 2 * M_PI * uniform(41, id);
        state.row[id].vx = speed * cos(angle);
        *(dimension == 3 && id % 2 ? &state.row[id].vz : &state.row[id].vy) = speed * sin(angle);
    }
    for (int step = 0; step < steps; step++) {
        double fastest = 0;
        for (size_t k = 0; k < state.count; k++) {
            scree_row *row = &state.row[k];
            bool upright = dimension == 3 && state.id[k] % 2;
            double turn = 0.05, vx = row->vx, *other = upright ? &row->vz : &row->vy;
            row->vx = cos(turn) * vx - sin(turn) * *other;
            *other = sin(turn) * vx + cos(turn) * *other;
            row->x += row->vx;
            *(upright ? &row->z : &row->y) += *other;
            fastest = fmax(fastest, hypot(row->vx, *other));
        }
        scree_plates(&state)[SCREE_WALL_BOTTOM].position += wall;
        work.budget -= fastest;
        refresh(&state, &work);
        id_list needed = brute_force(&state, 0), found = sorted(listed(&state, &work));
        for (size_t k = 0; k < needed.count; k++)
            assert_non_null(bsearch(&needed.pair[k], found.pair, found.count, sizeof *found.pair, by_ids));
        free(needed.pair);
        free(found.pair);
    }
    uint64_t rebuilds = work.rebuilds;
    scree_work_destroy(&work);
    scree_state_destroy(&state);
    return rebuilds;
}

static void no_contact_is_missed_between_rebuilds(void **dimension)
{
    // Half the skin is 0.15: paths at the highest speed use it up in 3 steps, in straight flight.
    assert_in_range(fly(dimension_of(dimension), 0.01, 0.05, 0, 600), 150, 200);
    assert_in_range(fly(dimension_of(dimension), 0.02, 0.02, 0, 300), 20, 41);
    // Here bodies come back after a circle of radius 0.04 and never move by half the skin: one list serves.
    assert_int_equal(fly(dimension_of(dimension), 0.002, 0.002, 0, 300), 1);
    // The wall alone: it moves by half the skin in 8 steps.
    assert_in_range(fly(dimension_of(dimension), 0, 0, 0.02, 400), 50, 58);
}

static void rebuild_waits_for_half_the_skin(void **dimension)
{
    scree_state state;
    scree_work work;
    make_state(&state, dimension_of(dimension), 50, 1, 10);
    make_work(&work, 1);
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 1);
    // 1e-6 short of skin / 2, as documented.
    assert_true(fabs(work.budget - SKIN / 2) < 1.1e-6 * SKIN / 2);
    // Displacements are looked at when the budget is used up, not before.
    work.budget = 0;
    *last_of(&state, 7) += 0.4 * SKIN;
    refresh(&state, &work);
    assert_true(work.budget == 0);
    work.budget = -1;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 1);
    assert_true(fabs(work.budget - 0.1 * SKIN) < 1.1e-6 * SKIN);
    work.budget = -1;
    *last_of(&state, 7) += 0.11 * SKIN;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 2);
    // Walls: a small motion, a large one, a new wall, one that goes.
    scree_wall *side = &scree_plates(&state)[state.dimension == 3 ? SCREE_WALL_FRONT : SCREE_WALL_LEFT];
    side->position -= 0.45 * SKIN;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 2);
    side->position -= 0.1 * SKIN;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 3);
    scree_plates(&state)[SCREE_WALL_TOP].active = 1;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 4);
    assert_equals_brute_force(&state, &work);
    scree_plates(&state)[SCREE_WALL_TOP].active = 0;
    refresh(&state, &work);
    assert_int_equal(work.rebuilds, 4);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

static void odd_positions_give_a_valid_list(void **dimension)
{
    const double odd[] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        scree_state state;
        scree_work work;
        make_state(&state, dimension_of(dimension), 200, 10, 11);
        make_work(&work, k + 1);
        refresh(&state, &work);
        assert_int_equal(work.flags, 0);
        state.row[state.row_of_id[150]].x = odd[k];
        for (size_t id = 42; id < 142; id++) *last_of(&state, id) = odd[k];
        work.budget = -INFINITY;
        refresh(&state, &work);
        assert_int_equal(work.rebuilds, 2);
        assert_true(work.flags & SCREE_FLAG_NAN);
        assert_int_equal(work.flagged_id, 42);
        assert_equals_brute_force(&state, &work);
        scree_work_destroy(&work);
        scree_state_destroy(&state);
    }
}

/// Slots and cells that a rebuild has looked at, a body.
static double effort(const scree_state *state, const scree_work *work)
{
    uint64_t sum = 0;
    for (int c = 0; c < work->search->chunks; c++) sum += work->search->chunk[c].candidates;
    for (int m = 0; m <= work->search->grid.top; m++) sum += work->search->grid.level[m].cells;
    return (double)sum / (double)state->count;
}

static void escaped_bodies_cost_nothing(void **dimension)
{
    const double far[] = {1e6, -1e15, 1e300, -1e300};
    scree_state state;
    scree_work work;
    make_state(&state, dimension_of(dimension), 600, 2, 12);
    make_work(&work, 1);
    refresh(&state, &work);
    double before = effort(&state, &work);
    size_t bytes_before, bytes;
    scree_allocation_statistics(&bytes_before, NULL);
    for (size_t k = 0; k < sizeof far / sizeof *far; k++) {
        state.row[state.row_of_id[k]].x = far[k];
        *last_of(&state, k + 1) = far[k];
        rebuild(&state, &work);
        assert_equals_brute_force(&state, &work);
        assert_true(effort(&state, &work) < before + 1);
    }
    scree_allocation_statistics(&bytes, NULL);
    // Buffers grow by an eighth when bodies come in another order; a grid over the domain would have 1e4 cells.
    assert_true(bytes < bytes_before + bytes_before / 4);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

static void few_bodies_and_bodies_at_one_point(void **dimension)
{
    const size_t counts[] = {0, 1, 2, 90};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        scree_state state;
        scree_work work;
        make_state(&state, dimension_of(dimension), counts[k], 3, 13);
        make_work(&work, 2);
        for (size_t row = 0; row < state.count; row++) {
            state.row[row].x = state.row[row].y = -7;
            *last_of(&state, row) = -7;
        }
        refresh(&state, &work);
        assert_equals_brute_force(&state, &work);
        assert_int_equal(work.pairs.count, counts[k] * (counts[k] - 1) / 2);
        assert_int_equal(work.pairs.first[work.pairs.count + SCREE_PAIR_PADDING - 1], 0);
        scree_work_destroy(&work);
        scree_state_destroy(&state);
    }
}

/// Counts instead of times: what is looked at a body does not grow with the number of bodies.
static void cost_is_linear(void **dimension)
{
    const double ratios[] = {1, 2, 10, 50};
    // 4000 spheres of 1:50 hardly have one of every size: more bodies would mean more levels.
    size_t tested = dimension_of(dimension) == 3 ? 3 : 4;
    for (size_t r = 0; r < tested; r++) {
        double per_body[2];
        for (int large = 0; large < 2; large++) {
            scree_state state;
            scree_work work;
            make_state(&state, dimension_of(dimension), large ? 32000 : 4000, ratios[r], 14);
            make_work(&work, 1);
            refresh(&state, &work);
            per_body[large] = effort(&state, &work);
            scree_work_destroy(&work);
            scree_state_destroy(&state);
        }
        // Eight times the bodies: quadratic cost would give 8. The margin leaves room for the edges of the small
        // sample: up to 8 cells a side in 3D, where cells at the edge have up to a third of their neighbours less.
        assert_true(per_body[1] < (dimension_of(dimension) == 3 ? 1.6 : 1.3) * per_body[0]);
        // 9 cells of (2 R + skin)^2 at a cover of 0.8 hold about 12 bodies a level, 27 of (2 R + skin)^3 at 0.6 hold
        // 47; cells of up to twice the needed width hold 4 or 8 times as many.
        assert_true(per_body[1] < (dimension_of(dimension) == 3 ? 180 : 60));
    }
}

/// A few large bodies among many small ones must not make the small ones' cells large.
static void few_large_bodies_cost_little(void **dimension)
{
    scree_state state;
    scree_work work;
    make_state(&state, dimension_of(dimension), 20000, 1, 15);
    make_work(&work, 1);
    refresh(&state, &work);
    double like = effort(&state, &work);
    for (size_t id = 0; id < 5; id++) state.row[state.row_of_id[id]].radius = 50;
    rebuild(&state, &work);
    // Cells of small bodies are halves of halves of the large ones' cells, and so wider than they need be. Each body
    // also looks at the large ones around it (at most 5), and the grid of large cells is small.
    double wider = (100 + SKIN) / 32 / (2 + SKIN);
    assert_true(effort(&state, &work) < like * pow(wider, dimension_of(dimension)) + 5);
    // A slanting line of bodies has no area for a grid of boxes to hold.
    for (size_t id = 0; id < state.count; id++) {
        scree_row *row = &state.row[state.row_of_id[id]];
        *row = (scree_row){.x = 1.9 * (double)id, .y = 1.3 * (double)id, .radius = 1, .mass = 1};
        if (state.dimension == 3) row->z = 0.5 * (double)id;
    }
    rebuild(&state, &work);
    assert_true(effort(&state, &work) < 8);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

static void rebuild_without_growth_allocates_nothing(void **dimension)
{
    scree_state state;
    scree_work work;
    make_state(&state, dimension_of(dimension), 500, 10, 16);
    make_work(&work, 2);
    refresh(&state, &work);
    mark_list(&state, &work, 0);
    rebuild(&state, &work);
    mark_list(&state, &work, 1);
    (void)scree_allocation_fail_after(0);
    rebuild(&state, &work);
    // The one is the scratch of scree_state_permute.
    assert_in_range(scree_allocation_fail_after(0), 0, 1);
    scree_work_destroy(&work);
    scree_state_destroy(&state);
}

/// Each allocation of the first rebuilds fails once: an error, and the next refresh goes on with all histories.
static void failed_allocations_lose_nothing(void **dimension)
{
    const scree_model model = {.mean_radius = 1, .laws = {{.law = SCREE_SLOT_hertz_mindlin}}};
    scree_error error;
    int failures = 0;
    for (uint64_t site = 1; site < 1000; site++) {
        scree_state state;
        scree_work work;
        make_state(&state, dimension_of(dimension), 60, 10, 17);
        (void)scree_allocation_fail_after(site <= 3 ? site : 0);
        if (scree_work_create(&work, &model, 1, &error)) {
            (void)scree_allocation_fail_after(0);
            scree_state_destroy(&state);
            failures++;
            continue;
        }
        (void)scree_allocation_fail_after(0);
        refresh(&state, &work);
        mark_list(&state, &work, site);
        id_list before = sorted(listed(&state, &work));
        // A wider skin makes everything grow; the pairs of before are all in the new list.
        work.skin = 3;
        scree_neighbours_invalidate(&work);
        (void)scree_allocation_fail_after(site);
        scree_status status = scree_neighbours_refresh(&model, &state, &work, &error);
        (void)scree_allocation_fail_after(0);
        if (status) {
            assert_int_equal(status, SCREE_ERROR_IO);
            failures++;
            refresh(&state, &work);
        }
        id_list after = sorted(listed(&state, &work));
        size_t marked = assert_histories_kept(before, before);
        assert_int_equal(assert_histories_kept(before, after), marked);
        free(before.pair);
        free(after.pair);
        scree_work_destroy(&work);
        scree_state_destroy(&state);
        if (!status && site > 3) break;
    }
    assert_true(failures > 5);
}

#define IN(number, pointed, test)                                                                                      \
    {                                                                                                                  \
#test " in " #number "D", test, NULL, NULL, &(pointed)                                                         \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(list_equals_brute_force),
        IN(2, two, list_is_the_same_for_any_instruction_set),
        IN(3, three, list_is_the_same_for_any_instruction_set),
        IN(2, two, list_depends_on_positions_and_ids_alone),
        IN(3, three, list_depends_on_positions_and_ids_alone),
        IN(2, two, histories_survive_rebuilds),
        IN(3, three, histories_survive_rebuilds),
        IN(2, two, histories_come_back_from_the_state),
        IN(3, three, histories_come_back_from_the_state),
        IN(2, two, no_contact_is_missed_between_rebuilds),
        IN(3, three, no_contact_is_missed_between_rebuilds),
        IN(2, two, rebuild_waits_for_half_the_skin),
        IN(3, three, rebuild_waits_for_half_the_skin),
        IN(2, two, odd_positions_give_a_valid_list),
        IN(3, three, odd_positions_give_a_valid_list),
        IN(2, two, escaped_bodies_cost_nothing),
        IN(3, three, escaped_bodies_cost_nothing),
        IN(2, two, few_bodies_and_bodies_at_one_point),
        IN(3, three, few_bodies_and_bodies_at_one_point),
        IN(2, two, cost_is_linear),
        IN(3, three, cost_is_linear),
        IN(2, two, few_large_bodies_cost_little),
        IN(3, three, few_large_bodies_cost_little),
        IN(2, two, rebuild_without_growth_allocates_nothing),
        IN(3, three, rebuild_without_growth_allocates_nothing),
        IN(2, two, failed_allocations_lose_nothing),
        IN(3, three, failed_allocations_lose_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
