/// Which ghosts there are, and the search for pairs with them.
///
/// Of the ghosts x_j + H s of a body, those with a lexicographically positive shift (first component that is not zero
/// above zero) are enough: the pair of i and the ghost of j at s is the pair of j and the ghost of i at -s, and exactly
/// one of the two shifts is positive. A ghost is made when its fractional coordinates lie within (R_j + R_max + skin)
/// / width of the range that the bodies fill, in each periodic direction. Bodies may be outside the cell by any
/// distance: shifts are taken relative to where they are.
///
/// Search. Images are few (a layer at half of the faces). They are put into a hash table of square cells 2 R_max + skin
/// wide; bodies that lie near an upper face look into the 3^d cells around them. Cost: a pass over the bodies with d
/// multiplications each, 3^d look-ups a body near a face. Limit: one size of cells, so a layer of many small bodies
/// among a few large ones is searched slowly. One thread.
///
/// Parts. Where other processes have some of the bodies (comm/parts.h), they are offered ghosts of those that may come
/// near theirs: of the body itself to processes of lower numbers, of its images with a positive shift to all. Near is
/// what lies within reach of the box around their bodies. The own box is held against those of all processes, for each
/// shift, and a body against those that the own box is near. All own bodies look for ghosts then, those in the cells
/// around some first: a bit a cell.
///
/// Nothing here changes the state of bodies: rebuilding a list at another step gives the same forces to the last bit.
#include "search/ghosts.h"

#include "base/matrix.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "state/periodic.h"
#include "state/persistent.h"

#include <math.h>
#include <string.h>

/// What the choice of ghosts needs: range of fractional coordinates that bodies fill, and widths of the cell.
typedef struct ghost_range {
    double low[3], high[3];
    double width[3]; ///< m
    double radius;   ///< m, of the largest body
} ghost_range;

static void fraction_of(const scree_state *state, const scree_work *work, size_t row, double fraction[3])
{
    scree_vector position;
    scree_body_position(state, row, position);
    scree_matrix_apply(work->ghosts.lattice_inverse, position, fraction);
}

/// Of the bodies that are here.
static ghost_range own_range(const scree_state *state, const scree_work *work)
{
    ghost_range range = {.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    scree_periodic_widths(work->ghosts.lattice_inverse, range.width);
    for (size_t row = 0; row < state->count; row++) {
        double f[3];
        fraction_of(state, work, row, f);
        range.radius = state->row[row].radius > range.radius ? state->row[row].radius : range.radius;
        for (int k = 0; k < state->dimension; k++) {
            range.low[k] = f[k] < range.low[k] ? f[k] : range.low[k];
            range.high[k] = f[k] > range.high[k] ? f[k] : range.high[k];
        }
    }
    return range;
}

/// Of the bodies of all processes.
static ghost_range join_range(const scree_state *state, ghost_range range)
{
    double ends[7] = {-range.low[0], -range.low[1], -range.low[2], range.high[0],
                      range.high[1], range.high[2], range.radius};
    scree_comm_maximum(state, ends, 7);
    for (int k = 0; k < 3; k++) {
        range.low[k] = -ends[k];
        range.high[k] = ends[3 + k];
    }
    range.radius = ends[6];
    return range;
}

/// Bodies are put back when they leave the cell: those that are this many cells apart have been hurled out of it.
#define MOST_CELLS 100.0

static scree_status check_range(const scree_state *state, const ghost_range *range, double skin, scree_error *error)
{
    double needed = 4 * range->radius + 2 * skin;
    for (int k = 0; k < state->dimension; k++)
        if (scree_periodic_repeats(scree_cell(state), k) && !(range->high[k] - range->low[k] <= MOST_CELLS))
            return scree_error_set(error, SCREE_ERROR_GUARD,
                                   "step %llu: particles are %.3g periodic cells apart along lattice vector %d: their "
                                   "motion is no longer physical, try a smaller integrator.step",
                                   (unsigned long long)state->step, range->high[k] - range->low[k], k + 1);
    for (int k = 0; k < state->dimension; k++)
        if (scree_periodic_repeats(scree_cell(state), k) && !(range->width[k] >= needed))
            return scree_error_set(
                error, SCREE_ERROR_GUARD,
                "stage %lld, step %llu: the periodic cell is only %.4g m wide along lattice vector %d; it must be "
                "wider than two of the largest particles (%.4g m), or a particle would meet the same "
                "neighbour on both sides: try more particles or less strain",
                (long long)state->stage.index, (unsigned long long)state->step, range->width[k], k + 1, needed);
    return SCREE_OK;
}

static scree_status append_ghost(scree_ghost_list *list, uint32_t parent, const int shift[3], scree_error *error)
{
    if (list->count == list->capacity) {
        size_t capacity = 2 * list->capacity + 64;
        scree_status status = scree_reallocate(&list->ghost, list->count, capacity, sizeof *list->ghost, error);
        if (status) return status;
        list->capacity = capacity;
    }
    list->ghost[list->count++] = (scree_ghost){parent, {shift[0], shift[1], shift[2]}};
    return SCREE_OK;
}

static bool is_positive(const int shift[3])
{
    return shift[0] > 0 || (shift[0] == 0 && (shift[1] > 0 || (shift[1] == 0 && shift[2] > 0)));
}

/// Shifts by which a body between these fractional coordinates may come within reach of the range: a box of them.
static void find_shifts(const scree_state *state, const ghost_range *range, double reach, const double low[3],
                        const double high[3], int least[3], int most[3])
{
    for (int k = 0; k < 3; k++) {
        least[k] = most[k] = 0;
        if (k >= state->dimension || !scree_periodic_repeats(scree_cell(state), k)) continue;
        const double margin = reach / range->width[k];
        least[k] = (int)ceil(range->low[k] - margin - high[k]);
        most[k] = (int)floor(range->high[k] + margin - low[k]);
    }
}

/// All ghosts of one body that are within reach of the range.
static scree_status append_ghosts(const scree_state *state, scree_work *work, const ghost_range *range, uint32_t row,
                                  scree_error *error)
{
    double f[3];
    int least[3], most[3], shift[3];
    scree_status status = SCREE_OK;
    fraction_of(state, work, row, f);
    if (!isfinite(f[0] + f[1] + f[2])) return SCREE_OK;
    find_shifts(state, range, state->row[row].radius + range->radius + work->skin, f, f, least, most);
    for (shift[0] = least[0]; shift[0] <= most[0]; shift[0]++)
        for (shift[1] = least[1]; shift[1] <= most[1]; shift[1]++)
            for (shift[2] = least[2]; shift[2] <= most[2] && !status; shift[2]++)
                if (is_positive(shift)) status = append_ghost(&work->ghosts, row, shift, error);
    return status;
}

// ---- ghosts of bodies of other processes -------------------------------------------------------------------------

/// What is offered to other processes: the boxes around their bodies; those that the own box comes near by a shift.
typedef struct neighbourhood {
    double (*box)[6];      ///< m, of each process: lowest x, y, z, then highest
    double reach;          ///< m, of the largest body, the skin, and the largest gap of a held pair
    int least[3], most[3]; ///< shifts that own bodies may have
    size_t *begin;         ///< of each of these shifts in `process`, and the end of the last
    int32_t *process;      ///< ascending in each shift
} neighbourhood;

/// Whether bodies between two corners may touch one of the process.
static bool is_near(const neighbourhood *n, int process, int dimension, const double low[3], const double high[3],
                    double radius)
{
    const double *box = n->box[process], reach = n->reach + radius;
    for (int k = 0; k < dimension; k++)
        if (!(high[k] >= box[k] - reach && low[k] <= box[3 + k] + reach)) return false;
    return true;
}

static void translate(const scree_state *state, const int shift[3], double place[3])
{
    scree_vector by, components = {shift[0], shift[1], shift[2]};
    if (!is_positive(shift)) return;
    scree_matrix_apply(scree_cell(state)->lattice, components, by);
    for (int k = 0; k < 3; k++) place[k] += by[k];
}

static size_t shift_index(const neighbourhood *n, const int shift[3])
{
    size_t index = 0;
    for (int k = 0; k < 3; k++)
        index = index * (size_t)(n->most[k] - n->least[k] + 1) + (size_t)(shift[k] - n->least[k]);
    return index;
}

/// Those to whom a ghost with this shift may be offered: the body itself to processes of lower numbers, images to all.
/// Rounding is monotone: what one body is near, the own box is near. list: NULL: only counted. Returns how many.
static size_t find_processes(const scree_state *state, const neighbourhood *n, double radius, const int shift[3],
                             int32_t *list)
{
    const bool image = is_positive(shift);
    const int here = scree_comm_rank(), last = image ? scree_comm_size() : here;
    double low[3], high[3];
    size_t count = 0;
    if (!image && (shift[0] || shift[1] || shift[2])) return 0;
    memcpy(low, n->box[here], sizeof low);
    memcpy(high, n->box[here] + 3, sizeof high);
    translate(state, shift, low);
    translate(state, shift, high);
    for (int r = 0; r < last; r++) {
        if (!is_near(n, r, state->dimension, low, high, radius)) continue;
        if (list) list[count] = r;
        count++;
    }
    return count;
}

/// own: range of the bodies that are here, range: of all.
static scree_status find_neighbours(const scree_state *state, const ghost_range *range, const ghost_range *own,
                                    neighbourhood *n, scree_error *error)
{
    int shift[3];
    bool empty = false;
    for (int k = 0; k < state->dimension; k++) empty = empty || !(own->low[k] <= own->high[k]);
    for (int k = 0; k < 3; k++) n->least[k] = n->most[k] = 0;
    if (!empty) find_shifts(state, range, own->radius + n->reach, own->low, own->high, n->least, n->most);
    const size_t shifts = shift_index(n, n->most) + 1;
    scree_status status = scree_allocate(&n->begin, shifts + 1, sizeof *n->begin, error);
    for (int fill = 0; fill < 2 && !status; fill++) {
        size_t at = 0;
        for (shift[0] = n->least[0]; shift[0] <= n->most[0]; shift[0]++)
            for (shift[1] = n->least[1]; shift[1] <= n->most[1]; shift[1]++)
                for (shift[2] = n->least[2]; shift[2] <= n->most[2]; shift[2]++) {
                    n->begin[shift_index(n, shift)] = at;
                    at += find_processes(state, n, own->radius, shift, fill ? n->process + at : NULL);
                }
        n->begin[shifts] = at;
        if (!fill) status = scree_allocate(&n->process, at + 1, sizeof *n->process, error);
    }
    return status;
}

/// Offers the ghost to all that may need it; one of an own body for own bodies comes into the list.
static scree_status offer(const scree_state *state, scree_work *work, const neighbourhood *n, const scree_ghost *ghost,
                          scree_error *error)
{
    scree_vector place;
    const size_t index = shift_index(n, ghost->shift);
    scree_status status = SCREE_OK;
    scree_body_position(state, ghost->parent, place);
    translate(state, ghost->shift, place);
    for (size_t k = n->begin[index]; k < n->begin[index + 1] && !status; k++) {
        const int r = n->process[k];
        if (!is_near(n, r, state->dimension, place, place, state->row[ghost->parent].radius)) continue;
        status = r == scree_comm_rank() ? append_ghost(&work->ghosts, ghost->parent, ghost->shift, error)
                                        : scree_parts_offer(work, r, ghost, error);
    }
    work->parts->looked += n->begin[index + 1] - n->begin[index];
    return status;
}

/// All ghosts of one body, in all processes.
static scree_status offer_ghosts(const scree_state *state, scree_work *work, const ghost_range *range,
                                 const neighbourhood *n, uint32_t row, scree_error *error)
{
    double f[3];
    int least[3], most[3];
    scree_ghost ghost = {.parent = row};
    int32_t *shift = ghost.shift;
    scree_status status = SCREE_OK;
    fraction_of(state, work, row, f);
    if (!isfinite(f[0] + f[1] + f[2])) return SCREE_OK;
    find_shifts(state, range, state->row[row].radius + n->reach, f, f, least, most);
    for (shift[0] = least[0]; shift[0] <= most[0]; shift[0]++)
        for (shift[1] = least[1]; shift[1] <= most[1]; shift[1]++)
            for (shift[2] = least[2]; shift[2] <= most[2] && !status; shift[2]++)
                status = offer(state, work, n, &ghost, error);
    return status;
}

static scree_status make_parts(scree_state *state, scree_work *work, const ghost_range *range, const ghost_range *own,
                               scree_error *error)
{
    neighbourhood n = {.reach = range->radius + work->skin + scree_persistent(state)->largest_gap};
    scree_status status = scree_allocate(&n.box, (size_t)scree_comm_size(), sizeof *n.box, error);
    if (status) return status;
    scree_parts_boxes(state, n.box);
    work->parts->sent_count = 0;
    work->parts->offered += state->count;
    status = find_neighbours(state, range, own, &n, error);
    for (size_t row = 0; row < state->count && !status; row++)
        status = offer_ghosts(state, work, range, &n, (uint32_t)row, error);
    scree_release(&n.box);
    scree_release(&n.begin);
    scree_release(&n.process);
    work->ghosts.by_parent = work->ghosts.count;
    return status ? status : scree_parts_link(state, work, error);
}

scree_status scree_ghosts_make(scree_state *state, scree_work *work, scree_error *error)
{
    scree_ghost_list *list = &work->ghosts;
    list->count = list->away = 0;
    if (!scree_cell(state)->directions && !state->part) return SCREE_OK;
    scree_matrix_unit(list->lattice_inverse);
    if (scree_cell(state)->directions) scree_matrix_invert(scree_cell(state)->lattice, list->lattice_inverse);
    const ghost_range own = own_range(state, work), range = join_range(state, own);
    list->largest_radius = range.radius;
    scree_status status = check_range(state, &range, work->skin, error);
    if (!status && state->part) status = make_parts(state, work, &range, &own, error);
    for (size_t row = 0; row < state->count && !status && !state->part; row++)
        status = append_ghosts(state, work, &range, (uint32_t)row, error);
    if (!state->part) list->by_parent = list->count;
    if (!status) return scree_comm_begin(state, work, error);
    list->count = list->away = 0;
    return status;
}

bool scree_ghosts_nearest(const scree_state *state, const scree_work *work, uint32_t first, uint32_t second,
                          int shift[3], bool *of_second)
{
    double f[3], g[3];
    fraction_of(state, work, first, f);
    fraction_of(state, work, second, g);
    bool across = false;
    for (int k = 0; k < 3; k++) {
        double apart = scree_periodic_repeats(scree_cell(state), k) ? rint(f[k] - g[k]) : 0;
        shift[k] = isfinite(apart) ? (int)apart : 0;
        across = across || shift[k] != 0;
    }
    *of_second = is_positive(shift);
    for (int k = 0; k < 3 && !*of_second; k++) shift[k] = -shift[k];
    return across;
}

scree_status scree_ghosts_row(const scree_state *state, scree_work *work, uint32_t parent, const int shift[3],
                              uint32_t *row, scree_error *error)
{
    scree_ghost_list *list = &work->ghosts;
    size_t low = 0, high = list->by_parent;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (list->ghost[middle].parent < parent)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < list->by_parent && list->ghost[low].parent == parent; low++) {
        const int32_t *found = list->ghost[low].shift;
        if (found[0] != shift[0] || found[1] != shift[1] || found[2] != shift[2]) continue;
        *row = (uint32_t)(state->count + low);
        return SCREE_OK;
    }
    *row = state->part ? SCREE_NO_ROW : (uint32_t)(state->count + list->count);
    return state->part ? SCREE_OK : append_ghost(list, parent, shift, error);
}

void scree_ghosts_deformation(const scree_state *state, const scree_work *work, double deformation[9])
{
    scree_matrix_multiply(scree_cell(state)->lattice, work->ghosts.lattice_inverse, deformation);
}

// ---- the search --------------------------------------------------------------------------------------------------

/// Images by cells of space: chains of ghosts that share a slot.
typedef struct ghost_table {
    double inverse_width;  ///< 1/m
    uint32_t *head, *next; ///< 1 + ghost, 0 for none
    uint64_t mask;
    uint8_t *around; ///< parts: not 0 in the slots of cells around ghosts; NULL: not asked
} ghost_table;

static uint64_t slot_of(const ghost_table *table, const int64_t cell[3])
{
    uint64_t hash = (uint64_t)cell[0] * UINT64_C(0x9e3779b97f4a7c15) +
                    (uint64_t)cell[1] * UINT64_C(0xc2b2ae3d27d4eb4f) + (uint64_t)cell[2] * UINT64_C(0x165667b19e3779f9);
    return (hash ^ hash >> 29) & table->mask;
}

static void cell_of(const scree_state *state, const ghost_table *table, size_t row, int64_t cell[3])
{
    scree_vector position;
    scree_body_position(state, row, position);
    for (int k = 0; k < 3; k++) cell[k] = (int64_t)floor(position[k] * table->inverse_width);
}

static void table_destroy(ghost_table *table)
{
    scree_release(&table->head);
    scree_release(&table->next);
    scree_release(&table->around);
}

/// Marks the slots of the cells around the ghosts.
static scree_status table_mark(const scree_state *state, const scree_work *work, ghost_table *table, scree_error *error)
{
    scree_status status = scree_allocate(&table->around, table->mask + 1, 1, error);
    const int64_t deep = state->dimension == 3;
    for (size_t k = 0; k < work->ghosts.count && !status; k++) {
        int64_t at[3], cell[3];
        cell_of(state, table, state->count + k, at);
        for (cell[0] = at[0] - 1; cell[0] <= at[0] + 1; cell[0]++)
            for (cell[1] = at[1] - 1; cell[1] <= at[1] + 1; cell[1]++)
                for (cell[2] = at[2] - deep; cell[2] <= at[2] + deep; cell[2]++)
                    table->around[slot_of(table, cell)] = 1;
    }
    return status;
}

static bool is_around(const scree_state *state, const ghost_table *table, size_t row)
{
    int64_t cell[3];
    cell_of(state, table, row, cell);
    return table->around[slot_of(table, cell)];
}

static scree_status table_fill(const scree_state *state, const scree_work *work, ghost_table *table, scree_error *error)
{
    const scree_ghost_list *list = &work->ghosts;
    uint64_t slots = 64;
    while (slots < (state->part ? 64 : 2) * list->count) slots *= 2;
    *table = (ghost_table){.inverse_width = 1 / ((2 * list->largest_radius + work->skin) * (1 + 0x1p-20)),
                           .mask = slots - 1};
    scree_status status = scree_allocate(&table->head, slots, sizeof *table->head, error);
    if (!status) status = scree_allocate(&table->next, list->count, sizeof *table->next, error);
    for (size_t k = list->count; k-- > 0 && !status;) {
        int64_t cell[3];
        cell_of(state, table, state->count + k, cell);
        uint32_t *head = &table->head[slot_of(table, cell)];
        table->next[k] = *head;
        *head = (uint32_t)k + 1;
    }
    return status;
}

static scree_status append_pair(scree_pair_buffer *buffer, uint32_t first, uint32_t second, scree_error *error)
{
    if (buffer->count == buffer->capacity) {
        size_t capacity = 2 * buffer->capacity + 256;
        scree_status status = scree_reallocate(&buffer->pair, buffer->count, capacity, sizeof *buffer->pair, error);
        if (status) return status;
        buffer->capacity = capacity;
    }
    buffer->pair[buffer->count++] = (scree_row_pair){first, second};
    return SCREE_OK;
}

/// Lists the body and the ghost if they are close.
static scree_status test_pair(const scree_state *state, const scree_work *work, uint32_t row, uint32_t ghost,
                              scree_pair_chunk *chunk, scree_error *error)
{
    scree_vector a, b;
    scree_body_position(state, row, a);
    scree_body_position(state, ghost, b);
    double square = 0, sum = state->row[row].radius + state->row[ghost].radius, wider = sum + work->skin;
    for (int k = 0; k < state->dimension; k++) square += (a[k] - b[k]) * (a[k] - b[k]);
    chunk->candidates++;
    if (!(square < wider * wider)) return SCREE_OK;
    bool lower = state->id[row] < state->id[ghost];
    return append_pair(square < sum * sum ? &chunk->touching : &chunk->near, lower ? row : ghost, lower ? ghost : row,
                       error);
}

/// Pairs of one body with the ghosts in the cells around it. Images of other cells may share a slot, and two cells may
/// share one too: a ghost is tested from the cell that it lies in.
static scree_status search_body(const scree_state *state, const scree_work *work, const ghost_table *table,
                                uint32_t row, scree_pair_chunk *chunk, scree_error *error)
{
    int64_t centre[3], cell[3], own[3];
    scree_status status = SCREE_OK;
    const int64_t deep = state->dimension == 3;
    cell_of(state, table, row, centre);
    for (cell[0] = centre[0] - 1; cell[0] <= centre[0] + 1; cell[0]++)
        for (cell[1] = centre[1] - 1; cell[1] <= centre[1] + 1; cell[1]++)
            for (cell[2] = centre[2] - deep; cell[2] <= centre[2] + deep; cell[2]++)
                for (uint32_t k = table->head[slot_of(table, cell)]; k > 0 && !status; k = table->next[k - 1]) {
                    uint32_t ghost = (uint32_t)state->count + k - 1;
                    cell_of(state, table, ghost, own);
                    if (memcmp(own, cell, sizeof own) == 0) status = test_pair(state, work, row, ghost, chunk, error);
                }
    return status;
}

/// Whether a ghost can be near: all of them lie beyond an upper end of the range, in some direction.
static bool is_near_face(const scree_state *state, const scree_work *work, const ghost_range *range, double reach,
                         size_t row)
{
    double f[3];
    fraction_of(state, work, row, f);
    if (!isfinite(f[0] + f[1] + f[2])) return false;
    for (int k = 0; k < state->dimension; k++)
        if (scree_periodic_repeats(scree_cell(state), k) && f[k] >= range->low[k] + 1 - reach / range->width[k])
            return true;
    return false;
}

scree_status scree_ghosts_search(const scree_state *state, const scree_work *work, scree_pair_chunk *chunk,
                                 scree_error *error)
{
    ghost_table table;
    chunk->touching.count = chunk->near.count = chunk->wall.count = 0;
    chunk->candidates = 0;
    if (work->ghosts.count == 0) return SCREE_OK;
    scree_status status = table_fill(state, work, &table, error);
    if (!status && state->part) status = table_mark(state, work, &table, error);
    const ghost_range range = state->part ? (ghost_range){.radius = 0} : own_range(state, work);
    const double reach = 2 * range.radius + work->skin;
    for (size_t row = 0; row < state->count && !status; row++)
        if (state->part ? is_around(state, &table, row) : is_near_face(state, work, &range, reach, row))
            status = search_body(state, work, &table, (uint32_t)row, chunk, error);
    table_destroy(&table);
    return status;
}
