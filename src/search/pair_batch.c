/// The search kernel: eight slots at a time against one body, in double precision with the exact criterion. Compiled
/// once for each instruction set; the arithmetic is the same in each, so all find the same pairs in the same order.
/// Cost: about 10 slots a body in a dense packing of like discs, 25 flops a slot.
#include "search/pair_search.h"

#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define JOIN_(name, isa) name##_v##isa
#define JOIN(name, isa)  JOIN_(name, isa)

enum { LANES = SCREE_SLOT_PADDING, RANGES = 3 };

typedef double wide __attribute__((vector_size(8 * LANES)));
typedef int64_t wide_mask __attribute__((vector_size(8 * LANES)));

static inline wide load(const double *from)
{
    wide value;
    memcpy(&value, from, sizeof value);
    return value;
}

/// One bit a lane.
static inline unsigned bits_of(wide_mask mask)
{
    unsigned bits = 0;
#if SCREE_ISA >= 4
    __m512i whole;
    memcpy(&whole, &mask, sizeof whole);
    bits = _mm512_movepi64_mask(whole);
#elif SCREE_ISA == 3
    __m256d half[2];
    memcpy(half, &mask, sizeof half);
    bits = (unsigned)_mm256_movemask_pd(half[0]) | (unsigned)_mm256_movemask_pd(half[1]) << 4;
#else
    for (int lane = 0; lane < LANES; lane++) bits |= (unsigned)(mask[lane] & 1) << lane;
#endif
    return bits;
}

/// The body that looks for partners.
typedef struct seeker {
    double x, y, radius, reach; ///< reach = radius + skin
    uint32_t row, id;
    uint32_t above; ///< only slots with rows >= this one: what lies below finds the seeker, if it is of the same level
} seeker;

/// Appends the pairs of the seeker with slots [begin, end). The chunk has room for all of them and one more.
static inline void search_range(const scree_cell_grid *grid, seeker body, uint32_t begin, uint32_t end,
                                scree_pair_chunk *chunk)
{
    scree_row_pair *touching = chunk->touching.pair, *near = chunk->near.pair;
    size_t touching_count = chunk->touching.count, near_count = chunk->near.count;
    for (uint32_t slot = begin; slot < end; slot += LANES) {
        wide dx = load(grid->x + slot) - body.x, dy = load(grid->y + slot) - body.y;
        wide radius = load(grid->radius + slot), sum = radius + body.radius, wider = radius + body.reach;
        wide square = dx * dx + dy * dy;
        unsigned close = bits_of(square < wider * wider), touches = bits_of(square < sum * sum);
        if (end - slot < LANES) close &= (1u << (end - slot)) - 1;
        for (; close; close &= close - 1) {
            unsigned lane = (unsigned)__builtin_ctz(close);
            uint32_t row = grid->row[slot + lane];
            bool first = body.id < grid->id[slot + lane], touch = touches >> lane & 1, wanted = row >= body.above;
            scree_row_pair pair = first ? (scree_row_pair){body.row, row} : (scree_row_pair){row, body.row};
            touching[touching_count] = pair;
            near[near_count] = pair;
            touching_count += wanted & touch;
            near_count += wanted & !touch;
        }
    }
    chunk->touching.count = touching_count;
    chunk->near.count = near_count;
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
        const scree_wall *wall = &state->wall[w];
        double distance = wall->normal[0] * body.x + wall->normal[1] * body.y - wall->position;
        if (wall->active && distance < body.reach) buffer->pair[buffer->count++] = (scree_row_pair){body.row, w};
    }
    return SCREE_OK;
}

scree_status JOIN(scree_pair_search, SCREE_ISA)(const scree_cell_grid *grid, const scree_state *state, size_t begin,
                                                size_t end, scree_pair_chunk *chunk, scree_error *error)
{
    size_t cell[SCREE_CELL_LEVELS] = {0};
    for (int m = 0; m <= grid->top; m++) cell[m] = find_cell(grid, &grid->level[m], begin);
    chunk->touching.count = chunk->near.count = chunk->wall.count = 0;
    chunk->candidates = 0;
    for (size_t k = begin; k < end; k++) {
        const scree_row *row = &state->row[k];
        seeker body = {row->x,      row->y,       row->radius,    row->radius + grid->skin,
                       (uint32_t)k, state->id[k], (uint32_t)k + 1};
        scree_status status = search_walls(state, body, &chunk->wall, error);
        for (int m = grid->body_level[k]; m <= grid->top && !status; m++) {
            const scree_cell_level *level = &grid->level[m];
            if (level->cells == 0) continue;
            cell[m] = advance(grid, level, cell[m], k);
            const scree_cell_ranges *ranges = &grid->ranges[level->first_cell + cell[m]];
            size_t candidates = 0;
            for (int d = 0; d < RANGES; d++) candidates += ranges->end[d] - ranges->begin[d];
            status = reserve(&chunk->touching, candidates, 2 * (end - begin), error);
            if (!status) status = reserve(&chunk->near, candidates, (end - begin) / 2, error);
            if (status) break;
            for (int d = 0; d < RANGES; d++) search_range(grid, body, ranges->begin[d], ranges->end[d], chunk);
            chunk->candidates += candidates;
            body.above = 0;
        }
        if (status) return status;
    }
    return SCREE_OK;
}
