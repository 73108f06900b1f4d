/// When the neighbour list is rebuilt, and the order in which its parts are.
///
/// The budget. After a rebuild no pair outside the list is closer than R_i + R_j + skin, so none can touch before some
/// body has moved by half the skin (a body and a wall together). work->budget is a distance that no body can have left
/// to go without reaching that: a rebuild sets it to skin / 2, and the integrator subtracts |v|_max dt in every drift,
/// |v|_max over all bodies (NaN counts as infinite). Walls do not concern the integrator: their positions are compared
/// here, in every step. Surfaces of bodies that deform go a way, too: the largest is taken from the budget. When it is
/// used up, true displacements decide: below half the skin, the budget becomes what is left; else the list is rebuilt.
/// Half the skin is taken 1e-6 short against round-off, so that a list never misses a contact and results do not depend
/// on when lists were built.
///
/// A rebuild: histories to state->contact; levels, keys and order of the bodies; permutation of the state; cells;
/// search by ranges of rows, a thread each; the ranges one after the other into the list, touching pairs first, each
/// with its history. The list depends on positions and ids alone, not on threads or on the order before. Cost, like
/// discs in a dense packing, one core: about 230 cycles a disc (3 ms for 32,768 discs at 2.4 GHz; measured with
/// bench/bench_neighbours), a third of it the search. Cells and sorts are not shared among threads; search and
/// histories are. Memory: 40 bytes a pair for the list (56 in 3D), during a rebuild 40 (56) a contact for
/// state->contact and about 150 a disc, 250 a sphere, for cells and buffers, which only small samples keep.
#include "search/neighbours.h"
#include "state/case_walls.h"
#include "state/deformation.h"
#include "state/periodic.h"
#include "state/persistent.h"
#include "state/plates.h"
#include "state/sleep.h"

#include "base/matrix.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "search/ghosts.h"
#include "search/moved.h"
#include "search/search.h"
#include "shape/wall_set.h"

#include <float.h>
#include <math.h>
#include <string.h>

static double half_skin(const scree_work *work)
{
    return 0.5 * work->skin * (1 - 1e-6);
}

void scree_neighbours_invalidate(scree_work *work)
{
    work->valid = false;
}

typedef struct displacement_task {
    const scree_state *state;
    const scree_fast *fast;
    const double *deformation;
    const uint32_t *moving; ///< rows; NULL: the first `count`
    size_t count;
    double square[SCREE_THREAD_POOL_MOST];
} displacement_task;

static void displacement_share(void *argument, int index, int count)
{
    displacement_task *task = argument;
    const scree_state *state = task->state;
    double largest = 0;
    int next = 0;
    size_t end = scree_thread_pool_begin(task->count, index + 1, count);
    for (size_t k = scree_thread_pool_begin(task->count, index, count); k < end; k++) {
        const size_t row = task->moving ? task->moving[k] : k;
        scree_vector now, then;
        if (scree_fast_number(task->fast, row, &next) >= 0) continue;
        scree_body_position(state, row, now);
        scree_matrix_apply(task->deformation, state->rebuild[row], then);
        double square = 0;
        for (int i = 0; i < 3; i++) square += (now[i] - then[i]) * (now[i] - then[i]);
        square = square <= DBL_MAX ? square : (double)INFINITY;
        largest = square > largest ? square : largest;
    }
    task->square[index] = largest;
}

/// Largest displacement of a body since the last rebuild [m], but for fast ones and those that sleep, relative to the
/// affine field that follows a periodic cell; infinite if a position is not finite.
static double largest_displacement(const scree_state *state, const double deformation[9], scree_work *work)
{
    displacement_task task = {.state = state, .fast = &work->search->fast, .deformation = deformation};
    task.moving = scree_moving_rows(state, &task.count);
    const int shares = scree_work_shares(work);
    scree_thread_pool_run(&work->pool, shares, displacement_share, &task);
    double largest = 0;
    for (int k = 0; k < shares; k++) largest = fmax(largest, task.square[k]);
    return sqrt(largest);
}

static double surface_time(const scree_state *state, uint64_t ticks)
{
    return (double)ticks * state->tick;
}

/// A wall has come up, turned, or moved by half the skin. Walls that go away do no harm.
static bool walls_need_rebuild(const scree_model *model, const scree_state *state, const scree_work *work)
{
    if (work->wall_set) {
        double time =
            surface_time(state, scree_case_walls(state)->ticks) - surface_time(state, work->search->surface_ticks);
        double margin = scree_model_largest_radius(model) + work->skin;
        if (!(scree_wall_set_way(work->wall_set, time, margin) < half_skin(work))) return true;
    }
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const scree_wall *now = &scree_plates(state)[w], *then = &work->search->wall[w];
        if (!now->active) continue;
        bool same = then->active && now->normal[0] == then->normal[0] && now->normal[1] == then->normal[1] &&
                    now->normal[2] == then->normal[2];
        if (!same || !(fabs(now->position - then->position) < half_skin(work))) return true;
    }
    return false;
}

/// The arrays of a list of pairs or of wall pairs.
typedef struct list_arrays {
    uint32_t **one, **other;
    scree_history **history;
    scree_last_force **last_force;
    scree_rolling **rolling;
    uint8_t **law; ///< NULL: of pairs of bodies their section says it
    size_t *capacity;
} list_arrays;

static list_arrays arrays_of_pairs(scree_pair_list *l)
{
    return (list_arrays){&l->first, &l->second, &l->history, &l->last_force, &l->rolling, NULL, &l->capacity};
}

static list_arrays arrays_of_wall_pairs(scree_wall_pair_list *l)
{
    return (list_arrays){&l->body, &l->wall, &l->history, &l->last_force, &l->rolling, &l->law, &l->capacity};
}

static void release_list(const list_arrays *list)
{
    scree_release(list->one);
    scree_release(list->other);
    scree_release(list->history);
    scree_release(list->last_force);
    scree_release(list->rolling);
    if (list->law) scree_release(list->law);
    *list->capacity = 0;
}

void scree_pair_lists_destroy(scree_work *work)
{
    list_arrays pairs = arrays_of_pairs(&work->pairs), walls = arrays_of_wall_pairs(&work->wall_pairs);
    list_arrays elements = arrays_of_wall_pairs(&work->primitive_pairs);
    release_list(&pairs);
    release_list(&walls);
    release_list(&elements);
    scree_release(&work->pairs.own);
    scree_release(&work->pairs.hint);
    work->pairs.own_capacity = 0;
}

/// Makes room for `count` pairs and the padding, with the rows that the law needs, and with several `laws` their
/// numbers; contents are lost when it grows.
static scree_status reserve_list(const list_arrays *list, size_t count, bool works, bool rolls, bool laws,
                                 scree_error *error)
{
    laws = laws && list->law;
    bool complete = (!works || *list->last_force) && (!rolls || *list->rolling) && (!laws || *list->law);
    if (complete && count + SCREE_PAIR_PADDING <= *list->capacity) return SCREE_OK;
    size_t room = count + count / 16 + 4 * SCREE_PAIR_PADDING;
    release_list(list);
    scree_status status = scree_allocate(list->one, room, sizeof **list->one, error);
    if (!status) status = scree_allocate(list->other, room, sizeof **list->other, error);
    if (!status) status = scree_allocate(list->history, room, sizeof **list->history, error);
    if (!status && works) status = scree_allocate(list->last_force, room, sizeof **list->last_force, error);
    if (!status && rolls) status = scree_allocate(list->rolling, room, sizeof **list->rolling, error);
    if (!status && laws) status = scree_allocate(list->law, room, sizeof **list->law, error);
    if (!status) *list->capacity = room;
    return status;
}

/// Drops the pairs of two bodies of the membrane, which its chain holds together; the order stays. Of a pair with a
/// ghost one is here.
static void drop_membrane_pairs(const scree_state *state, scree_pair_buffer *buffer)
{
    size_t kept = 0;
    if (state->marked[SCREE_MARK_MEMBRANE] == 0) return;
    for (size_t k = 0; k < buffer->count; k++) {
        scree_row_pair pair = buffer->pair[k];
        if (scree_body_is_grain(state, pair.first) || scree_body_is_grain(state, pair.second))
            buffer->pair[kept++] = pair;
    }
    buffer->count = kept;
}

typedef struct pairs_task {
    const scree_state *state;
    const scree_work *work;
    scree_search *search;
    scree_pair_search *find;
    bool failed[SCREE_THREAD_POOL_MOST];
} pairs_task;

static void pairs_share(void *argument, int index, int count)
{
    pairs_task *task = argument;
    const scree_state *state = task->state;
    scree_pair_chunk *chunk = &task->search->chunk[index];
    size_t begin = scree_thread_pool_begin(state->count, index, count),
           end = scree_thread_pool_begin(state->count, index + 1, count);
    chunk->element.count = 0;
    task->failed[index] = task->find(&task->search->grid, state, begin, end, chunk, NULL) ||
                          scree_primitives_search(task->work->wall_set, state, begin, end, task->work->skin,
                                                  &task->search->fast, &chunk->element, NULL);
    scree_held_drop(state, &chunk->touching);
    scree_held_drop(state, &chunk->near);
    drop_membrane_pairs(state, &chunk->touching);
    drop_membrane_pairs(state, &chunk->near);
}

static scree_status search_pairs(const scree_state *state, scree_work *work, scree_error *error)
{
    scree_search *search = work->search;
    pairs_task task = {
        .state = state, .work = work, .search = search, .find = scree_pair_search_get(work->instruction_set)};
    scree_thread_pool_run(&work->pool, search->chunks, pairs_share, &task);
    for (int c = 0; c < search->chunks; c++)
        if (task.failed[c])
            return scree_error_set_memory(error, search->chunk[c].touching.capacity * sizeof(scree_row_pair));
    return SCREE_OK;
}

/// Numbers of laws, by what bodies and walls are made of.
static void list_wall_laws(const scree_model *model, const scree_state *state, scree_work *work)
{
    const scree_wall_pair_list *plates = &work->wall_pairs, *elements = &work->primitive_pairs;
    for (size_t k = 0; k < plates->count && plates->law; k++)
        plates->law[k] = model->law_of_walls[scree_body_material(state, plates->body[k])];
    for (size_t k = 0; k < elements->count && elements->law; k++) {
        const int surface = scree_primitive_surface(work->wall_set, elements->wall[k]);
        const scree_config_wall *wall = work->wall_set->surface[surface].config;
        elements->law[k] =
            model->law_of_surfaces[wall - model->walls_of_case][scree_body_material(state, elements->body[k])];
    }
}

static void list_wall_pairs(const scree_search *search, scree_work *work)
{
    size_t wall = 0, element = 0;
    for (int c = 0; c < search->chunks; c++) {
        const scree_pair_chunk *chunk = &search->chunk[c];
        for (size_t k = 0; k < chunk->wall.count; k++, wall++) {
            work->wall_pairs.body[wall] = chunk->wall.pair[k].first;
            work->wall_pairs.wall[wall] = chunk->wall.pair[k].second;
        }
        for (size_t k = 0; k < chunk->element.count; k++, element++) {
            work->primitive_pairs.body[element] = chunk->element.pair[k].first;
            work->primitive_pairs.wall[element] = chunk->element.pair[k].second;
        }
    }
}

/// Gives entry `k` of a list the rows of contact `from` of the state, or clear ones if it has none, or is of another
/// law than the entry.
static void attach_rows(const scree_state *state, const list_arrays *list, size_t k, int law, size_t from)
{
    bool known = from < state->contact_count && (!state->contact_law || state->contact_law[from] == law);
    (*list->history)[k] = known ? state->contact[from].history : (scree_history){{0}};
    if (*list->last_force)
        (*list->last_force)[k] = known && state->last_force ? state->last_force[from] : (scree_last_force){{0}};
    if (*list->rolling)
        (*list->rolling)[k] = known && state->rolling ? state->rolling[from] : (scree_rolling){{0}, {0}};
}

typedef struct attach_task {
    scree_state *state;
    scree_work *work;
} attach_task;

static void attach_share(void *argument, int index, int count)
{
    const attach_task *task = argument;
    const scree_state *state = task->state;
    scree_pair_list *pairs = &task->work->pairs;
    const list_arrays of_pairs = arrays_of_pairs(pairs);
    size_t end = scree_thread_pool_begin(pairs->count, index + 1, count);
    for (size_t k = scree_thread_pool_begin(pairs->count, index, count); k < end; k++) {
        if (k < scree_pairs_held(pairs)) continue; // what these remember came with them
        uint32_t first = scree_parent_row(state, task->work, pairs->first[k]);
        uint32_t second = scree_parent_row(state, task->work, pairs->second[k]),
                 lower = first < second ? first : second;
        attach_rows(state, &of_pairs, k, scree_pairs_section(pairs, k)->law,
                    scree_history_find(task->work->search, state, lower, state->id[first], state->id[second]));
    }
}

/// Gives every pair of the new list what its contact remembers.
static void attach_histories(scree_state *state, scree_work *work)
{
    const scree_search *search = work->search;
    scree_wall_pair_list *walls = &work->wall_pairs, *elements = &work->primitive_pairs;
    const list_arrays of_walls = arrays_of_wall_pairs(walls), of_elements = arrays_of_wall_pairs(elements);
    attach_task task = {state, work};
    scree_thread_pool_run(&work->pool, search->chunks, attach_share, &task);
    for (size_t k = 0; k < walls->count; k++)
        attach_rows(state, &of_walls, k, scree_wall_pair_law(walls, k),
                    scree_history_find(search, state, walls->body[k], state->id[walls->body[k]],
                                       SCREE_WALL_ID + walls->wall[k]));
    for (size_t k = 0; k < elements->count; k++)
        attach_rows(state, &of_elements, k, scree_wall_pair_law(elements, k),
                    scree_history_find(search, state, elements->body[k], state->id[elements->body[k]],
                                       SCREE_PRIMITIVE_ID + elements->wall[k]));
}

/// Row 0 (wall 0) and clear rows behind the last pair.
static void pad_list(const scree_state *state, const list_arrays *list, size_t count)
{
    for (size_t k = count; k < count + SCREE_PAIR_PADDING; k++) {
        (*list->one)[k] = (*list->other)[k] = 0;
        attach_rows(state, list, k, 0, SIZE_MAX);
    }
}

/// The chunks' pairs one after the other: the same list however many chunks there are.
static scree_status assemble(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    scree_search *search = work->search;
    scree_pair_list *pairs = &work->pairs;
    scree_wall_pair_list *walls = &work->wall_pairs, *elements = &work->primitive_pairs;
    size_t wall = 0, element = 0;
    for (int c = 0; c < search->chunks; c++) {
        wall += search->chunk[c].wall.count;
        element += search->chunk[c].element.count;
    }
    scree_pairs_clear(pairs);
    scree_pair_sections_cut(model, state, work);
    const size_t count = pairs->count, held = scree_persistent_total(state);
    pairs->count = walls->count = elements->count = 0;
    const list_arrays of_pairs = arrays_of_pairs(pairs), of_walls = arrays_of_wall_pairs(walls);
    const list_arrays of_elements = arrays_of_wall_pairs(elements);
    bool works = scree_contacts_add_work(model, state->dimension), rolls = scree_contacts_roll(model),
         laws = model->pair_laws > 0;
    bool held_keeps = held > 0 && scree_model_held_traits(model)->keeps_last_force[state->dimension - 2];
    bool held_rolls = held > 0 && scree_model_held_traits(model)->rolling;
    scree_status status = reserve_list(&of_pairs, count, works || held_keeps, rolls || held_rolls, false, error);
    if (!status) status = scree_held_list(state, &search->held, pairs, error);
    scree_release(&pairs->hint);
    if (!status && scree_model_traits(model)->areas)
        status = scree_allocate(&pairs->hint, count + 1, sizeof *pairs->hint, error);
    if (!status) status = reserve_list(&of_walls, wall, works, rolls, laws, error);
    if (!status && work->wall_set) status = reserve_list(&of_elements, element, works, rolls, laws, error);
    if (status) {
        scree_pairs_clear(pairs);
        return status;
    }
    pairs->count = count;
    walls->count = wall;
    walls->geometry = elements->geometry = model->geometry;
    pairs->reach = walls->reach = elements->reach = scree_model_reach(model);
    elements->count = element;
    scree_pair_sections_fill(model, state, work);
    list_wall_pairs(search, work);
    list_wall_laws(model, state, work);
    attach_histories(state, work);
    pad_list(state, &of_pairs, pairs->count);
    pad_list(state, &of_walls, walls->count);
    return SCREE_OK;
}

/// The velocities that boundary/periodic.c keeps beside the rows go with them.
static scree_status permute_relative(scree_work *work, size_t count, scree_error *error)
{
    scree_vector *moved;
    if (work->relative_capacity < count || count == 0) return SCREE_OK;
    scree_status status = scree_allocate(&moved, work->relative_capacity, sizeof *moved, error);
    if (status) return status;
    for (size_t k = 0; k < count; k++) memcpy(moved[k], work->relative[work->search->grid.order[k]], sizeof *moved);
    scree_release(&work->relative);
    work->relative = moved;
    return SCREE_OK;
}

/// Number of bodies from which on memory matters more than a few per cent of a rebuild; smaller samples keep all they
/// have, so that their rebuilds allocate nothing.
enum { LARGE = 20000 };

/// In a large assembly, frees what only a rebuild needs: cells, buffers of the search, the packed histories. They would
/// take more room than the state.
static void release_scratch(scree_search *search, scree_state *state)
{
    if (state->count < LARGE) return;
    scree_cell_grid_destroy(&search->grid);
    for (int c = 0; c < search->chunks; c++) {
        scree_release(&search->chunk[c].touching.pair);
        scree_release(&search->chunk[c].near.pair);
        scree_release(&search->chunk[c].wall.pair);
        scree_release(&search->chunk[c].element.pair);
        search->chunk[c].touching.capacity = search->chunk[c].near.capacity = search->chunk[c].wall.capacity = 0;
        search->chunk[c].element.capacity = 0;
    }
    scree_release(&search->entry_begin);
    scree_release(&search->entry);
    search->entry_begin_capacity = search->entry_capacity = 0;
    scree_state_release_contacts(state);
}

/// No body has come or gone since the list was made.
static bool is_of_these_bodies(const scree_search *search, const scree_state *state)
{
    return search->bodies == state->count && search->changes == state->changes;
}

/// What the contacts of the old list remember goes into the state; bodies go to other processes with it.
static scree_status take_histories(scree_state *state, scree_work *work, scree_error *error)
{
    if (!work->search->listed || !is_of_these_bodies(work->search, state)) return SCREE_OK;
    scree_status status = scree_histories_collect(state, work, error);
    if (!status && state->part) status = scree_parts_migrate(state, work, error);
    return status;
}

/// Modules derive what they need of rows, then of ghosts.
static scree_status derive(scree_state *state, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->derive) status = scree_modules[m]->derive(state, error);
    return status;
}

static void derive_ghosts(scree_state *state, const scree_work *work)
{
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->derive_ghosts) scree_modules[m]->derive_ghosts(state, work);
}

static void note_sleepers(scree_state *state, scree_work *work)
{
    work->pairs.sleep_changes = scree_sleep_of(state)->changes;
    scree_sleep_list(state);
}

static bool sleepers_have_changed(const scree_state *state, const scree_work *work)
{
    return work->pairs.sleep_changes != scree_sleep_of(state)->changes;
}

static scree_status rebuild(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    scree_search *search = work->search;
    scree_status status = SCREE_OK;
    work->valid = false;
    // Surfaces of bodies that deform lie outside of the circles that the search knows.
    work->skin = fmax(work->skin, 4 * scree_deformation_of(state)->largest_reach);
    // A neck begins with a touch, in the list; it must not leave the list while it lasts.
    work->skin = fmax(work->skin, 2 * scree_model_reach(model));
    // Until the new list is whole, state->contact holds the histories: a rebuild that fails can be repeated.
    if ((status = take_histories(state, work, error))) return status;
    search->listed = false;
    search->bodies = state->count;
    search->changes = state->changes;
    scree_pairs_clear(&work->pairs);
    work->wall_pairs.count = work->primitive_pairs.count = work->ghosts.count = 0;
    work->ghosts.away = 0;
    if (state->count >= LARGE) scree_pair_lists_destroy(work);

    if ((status = derive(state, error))) return status;
    scree_cell_grid_fit(&search->grid, state, work->skin);
    if (!search->grid.finite) {
        work->flags |= SCREE_FLAG_NAN;
        work->flagged_id = search->grid.odd_id;
    }
    status = scree_cell_grid_order(&search->grid, state, error);
    if (!status) status = permute_relative(work, state->count, error);
    if (!status) status = scree_state_permute(state, search->grid.order, error);
    if (!status) status = scree_cell_grid_fill(&search->grid, state, error);
    if (!status) status = scree_histories_index(search, state, error);
    scree_fast_find(&search->fast, state, work->skin);
    if (!status) status = search_pairs(state, work, error);
    if (!status) status = scree_ghosts_make(state, work, error);
    if (!status) derive_ghosts(state, work);
    if (!status) status = scree_ghosts_search(state, work, &search->ghosts, error);
    // Behind the others, with those of ghosts.
    if (!status)
        status = scree_fast_pairs(&search->fast, state, work->skin, search->chunk, search->chunks, &search->ghosts.near,
                                  error);
    scree_held_drop(state, &search->ghosts.touching);
    scree_held_drop(state, &search->ghosts.near);
    drop_membrane_pairs(state, &search->ghosts.touching);
    drop_membrane_pairs(state, &search->ghosts.near);
    if (!status) status = scree_held_find(model, state, work, &search->held, error);
    scree_state_set_laws(state, model);
    if (!status) status = assemble(model, state, work, error);
    if (status) return status;

    for (size_t k = 0; k < state->count; k++) scree_body_position(state, k, state->rebuild[k]);
    memcpy(search->wall, scree_plates(state), sizeof search->wall);
    search->surface_ticks = scree_case_walls(state)->ticks;
    if (work->wall_set) scree_wall_set_list(work->wall_set);
    release_scratch(search, state);
    search->listed = work->valid = true;
    work->budget = half_skin(work) - scree_deformation_of(state)->largest_reach;
    note_sleepers(state, work);
    work->rebuilds++;
    return SCREE_OK;
}

/// Looks at the displacements when the budget is used up. What a periodic cell has been compressed or sheared by brings
/// bodies nearer too: by at most |F - 1| times the width of a list that still has all of its skin.
static scree_status check_list(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    double deformation[9], change[9], shrunk = 0;
    scree_matrix_unit(deformation);
    if (scree_cell(state)->directions) {
        scree_ghosts_deformation(state, work, deformation);
        for (int k = 0; k < 9; k++) change[k] = deformation[k] - (k % 4 == 0);
        shrunk = scree_matrix_norm(change) * (work->ghosts.largest_radius + 0.5 * work->skin);
    }
    const double moved =
        largest_displacement(state, deformation, work) + shrunk + scree_deformation_of(state)->largest_reach;
    const double left = fmin(half_skin(work) - moved, scree_fast_left(&work->search->fast, state));
    double worst[] = {moved, -left};
    scree_comm_maximum(state, worst, 2);
    if (!(worst[1] < 0) || !(worst[0] < half_skin(work))) return rebuild(model, state, work, error);
    work->budget = -worst[1];
    return SCREE_OK;
}

bool scree_neighbours_are_due(const scree_state *state, const scree_work *work)
{
    return scree_held_changed(state, &work->search->held) || (state->part && sleepers_have_changed(state, work));
}

/// The same pairs, in other sections. Bodies that have woken may have gone a way before they fell asleep: the budget
/// knows nothing of it.
static scree_status follow_sleepers(const scree_model *model, scree_state *state, scree_work *work, scree_error *error)
{
    scree_status status = scree_pair_sections_renew(model, state, work, error);
    if (status) return status;
    note_sleepers(state, work);
    return check_list(model, state, work, error);
}

scree_status scree_neighbours_refresh(const scree_model *model, scree_state *state, scree_work *work,
                                      scree_error *error)
{
    if (work->wall_set) {
        scree_case_wall_set *walls = scree_case_walls(state);
        scree_wall_set_place(work->wall_set, walls, scree_case_walls_time(walls, state), state->step_size);
        walls->speed = walls->moving ? scree_wall_set_speed(work->wall_set) : 0;
    }
    // Bodies come and go in whole samples only: what of the lists is left so is the same in all processes.
    const bool stands = work->valid && is_of_these_bodies(work->search, state);
    const bool due = scree_neighbours_are_due(state, work);
    if (!work->moved.known) scree_moved_begin(state, work, due);
    // While that goes ghosts follow, of which a list that is made anew knows nothing.
    scree_status status = SCREE_OK;
    if (stands && (work->ghosts.count > 0 || state->part)) status = scree_comm_exchange(state, work, error);
    if (!work->moved.known) scree_moved_end(state, work);
    work->moved.known = false;
    if (status) return status;
    if (!stands || due || work->moved.due > 0 || walls_need_rebuild(model, state, work))
        return rebuild(model, state, work, error);
    if (sleepers_have_changed(state, work)) return follow_sleepers(model, state, work, error);
    return work->budget >= 0 ? SCREE_OK : check_list(model, state, work, error);
}
