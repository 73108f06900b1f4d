/// The search kernel: eight slots at a time against one body, in double precision with the exact criterion. Compiled
/// once for each instruction set; the arithmetic is the same in each, so all find the same pairs in the same order. The
/// dimension is a constant of each of its two forms.
/// Cost: about 10 slots a body in a dense packing of like discs, 65 of like spheres; 25 and 35 flops a slot.
#include "search/pair_search.h"

#include "base/kernel_name.h"
#include "state/plates.h"

#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/// Doubles in a vector register, and slots that are looked at together.
#if SCREE_ISA >= 4
enum { WIDTH = 8 };
#elif SCREE_ISA == 3
enum { WIDTH = 4 };
#else
enum { WIDTH = 2 };
#endif
enum { GROUP = SCREE_SLOT_PADDING, GROUPS = 64 / GROUP };
#define CORE static inline __attribute__((always_inline))

typedef double wide __attribute__((vector_size(8 * WIDTH)));
typedef int64_t wide_mask __attribute__((vector_size(8 * WIDTH)));

static inline wide load(const double *from)
{
    wide value;
    memcpy(&value, from, sizeof value);
    return value;
}

/// One bit a lane.
static inline uint64_t bits_of(wide_mask mask)
{
#if SCREE_ISA >= 4
    return _mm512_movepi64_mask((__m512i)mask);
#elif SCREE_ISA == 3
    return (uint64_t)_mm256_movemask_pd((__m256d)mask);
#elif SCREE_ISA == 2
    return (uint64_t)_mm_movemask_pd((__m128d)mask);
#else
    return (uint64_t)(mask[0] & 1) | (uint64_t)(mask[1] & 2);
#endif
}

/// One bit for each slot of a group whose row is above `row`.
static inline uint64_t rows_above(const uint32_t *rows, uint32_t row)
{
#if SCREE_ISA >= 3
    __m256i group = _mm256_loadu_si256((const __m256i *)rows), limit = _mm256_set1_epi32((int)row);
    return (uint64_t)(unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(group, limit)));
#else
    uint64_t bits = 0;
    for (int lane = 0; lane < GROUP; lane++) bits |= (uint64_t)(rows[lane] > row) << lane;
    return bits;
#endif
}

/// The body that looks for partners.
typedef struct seeker {
    double x, y, z, radius, reach; ///< reach = radius + skin
    uint32_t row, id;
    bool lower; ///< looks in its own level: only for bodies with higher rows, which do not find it in turn
} seeker;

/// Groups of slots that have been tested, a bit for each slot of each group.
typedef struct findings {
    uint64_t close, touching;
    uint32_t slot[GROUPS];
    int groups;
} findings;

/// Tests the `valid` first slots of a group.
CORE void test_group(const scree_cell_grid *grid, seeker body, uint32_t slot, uint32_t valid, findings *found,
                     const int dimension)
{
    uint64_t close = 0, touching = 0, wanted = valid < GROUP ? (UINT64_C(1) << valid) - 1 : (1 << GROUP) - 1;
    for (int part = 0; part < GROUP; part += WIDTH) {
        const uint32_t at = slot + (uint32_t)part;
        wide dx = load(grid->x + at) - body.x, dy = load(grid->y + at) - body.y;
        wide radius = load(grid->radius + at), sum = radius + body.radius, wider = radius + body.reach;
        wide square = dx * dx + dy * dy;
        if (dimension == 3) {
            wide dz = load(grid->z + at) - body.z;
            square += dz * dz;
        }
        close |= bits_of(square < wider * wider) << part;
        touching |= bits_of(square < sum * sum) << part;
    }
    if (body.lower) wanted &= rows_above(grid->row + slot, body.row);
    found->close |= (close & wanted) << GROUP * found->groups;
    found->touching |= touching << GROUP * found->groups;
    found->slot[found->groups++] = slot;
}

/// Appends what has been found. The chunk has room for all of it and one more.
static inline void append(const scree_cell_grid *grid, seeker body, findings *found, scree_pair_chunk *chunk)
{
    scree_row_pair *touching = chunk->touching.pair + chunk->touching.count;
    scree_row_pair *near = chunk->near.pair + chunk->near.count;
    for (uint64_t close = found->close; close; close &= close - 1) {
        unsigned bit = (unsigned)__builtin_ctzll(close);
        uint32_t slot = found->slot[bit / GROUP] + bit % GROUP, row = grid->row[slot];
        bool first = body.id < grid->id[slot], touch = found->touching >> bit & 1;
        touching->first = near->first = first ? body.row : row;
        touching->second = near->second = first ? row : body.row;
        touching += touch;
        near += !touch;
    }
    chunk->touching.count = (size_t)(touching - chunk->touching.pair);
    chunk->near.count = (size_t)(near - chunk->near.pair);
    *found = (findings){0};
}

CORE void search_cells(const scree_cell_grid *grid, seeker body, const scree_slot_range *range, scree_pair_chunk *chunk,
                       const int dimension)
{
    findings found = {0};
    for (int d = 0; d < SCREE_CELL_ROWS(dimension); d++)
        for (uint32_t slot = range[d].begin; slot < range[d].end; slot += GROUP) {
            test_group(grid, body, slot, range[d].end - slot, &found, dimension);
            if (found.groups == GROUPS) append(grid, body, &found, chunk);
        }
    append(grid, body, &found, chunk);
}

static inline scree_status reserve(scree_pair_buffer *buffer, size_t more, size_t guess, scree_error *error)
{
    size_t needed = buffer->count + more + 1;
    if (__builtin_expect(needed <= buffer->capacity, 1)) return SCREE_OK;
    size_t capacity = needed + needed / 8 + guess;
    scree_status status = scree_reallocate(&buffer->pair, buffer->count, capacity, sizeof *buffer->pair, error);
    if (!status) buffer->capacity = capacity;
    return status;
}

/// Cell of `level` in which a row that lies at or behind the cell `from` is found.
static inline size_t advance(const scree_cell_grid *grid, const scree_cell_level *level, size_t from, size_t row)
{
    const uint32_t *cell_row = grid->cell_row + level->first_cell;
    while (from + 1 < level->cells && cell_row[from + 1] <= row) from++;
    return from;
}

/// The same from anywhere, by bisection.
static size_t find_cell(const scree_cell_grid *grid, const scree_cell_level *level, size_t row)
{
    const uint32_t *cell_row = grid->cell_row + level->first_cell;
    size_t low = 0, high = level->cells;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(cell_row[middle] <= row ? &low : &high) = middle;
    }
    return low;
}

static scree_status search_walls(const scree_state *state, seeker body, scree_pair_buffer *buffer, scree_error *error)
{
    scree_status status = reserve(buffer, SCREE_WALL_COUNT, 64, error);
    if (status) return status;
    for (uint32_t w = 0; w < SCREE_WALL_COUNT; w++) {
        const scree_wall *wall = &scree_plates(state)[w];
        double along = wall->normal[0] * body.x + wall->normal[1] * body.y;
        if (state->dimension == 3) along += wall->normal[2] * body.z;
        double distance = along - wall->position;
        if (wall->active && distance < body.reach) buffer->pair[buffer->count++] = (scree_row_pair){body.row, w};
    }
    return SCREE_OK;
}

CORE scree_status search_rows(const scree_cell_grid *grid, const scree_state *state, size_t begin, size_t end,
                              scree_pair_chunk *chunk, scree_error *error, const int dimension)
{
    const size_t ranges = SCREE_CELL_ROWS(dimension);
    size_t cell[SCREE_CELL_LEVELS] = {0};
    for (int m = 0; m <= grid->top; m++) cell[m] = find_cell(grid, &grid->level[m], begin);
    chunk->touching.count = chunk->near.count = chunk->wall.count = 0;
    chunk->candidates = 0;
    for (size_t k = begin; k < end; k++) {
        const scree_row *row = &state->row[k];
        seeker body = {.x = row->x,
                       .y = row->y,
                       .z = dimension == 3 ? row->z : 0,
                       .radius = row->radius,
                       .reach = row->radius + grid->skin,
                       .row = (uint32_t)k,
                       .id = state->id[k],
                       .lower = true};
        scree_status status = search_walls(state, body, &chunk->wall, error);
        for (int m = grid->body_level[k]; m <= grid->top && !status; m++) {
            const scree_cell_level *level = &grid->level[m];
            if (level->cells == 0) continue;
            cell[m] = advance(grid, level, cell[m], k);
            const scree_slot_range *range = &grid->range[(level->first_cell + cell[m]) * ranges];
            size_t candidates = 0;
            for (size_t d = 0; d < ranges; d++) candidates += range[d].end - range[d].begin;
            status = reserve(&chunk->touching, candidates, end - begin, error);
            if (!status) status = reserve(&chunk->near, candidates, (end - begin) / 2, error);
            if (status) break;
            search_cells(grid, body, range, chunk, dimension);
            chunk->candidates += candidates;
            body.lower = false;
        }
        if (status) return status;
    }
    return SCREE_OK;
}

scree_status SCREE_KERNEL_NAME(scree_pair_search)(const scree_cell_grid *grid, const scree_state *state, size_t begin,
                                                  size_t end, scree_pair_chunk *chunk, scree_error *error)
{
    return state->dimension == 3 ? search_rows(grid, state, begin, end, chunk, error, 3)
                                 : search_rows(grid, state, begin, end, chunk, error, 2);
}
