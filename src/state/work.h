/// Everything that can be rebuilt from the state: neighbour pairs, cell grid, scratch, flags, thread partition.
#ifndef SCREE_STATE_WORK_H
#define SCREE_STATE_WORK_H

#include "base/thread_pool_size.h"
#include "state/body.h"

/// Flags that kernels and integrators raise; the guard looks once a step.
enum {
    SCREE_FLAG_NAN = 1,         ///< a position or velocity is not finite
    SCREE_FLAG_OVERLAP = 2,     ///< overlap above the guard's limit
    SCREE_FLAG_FORCE_RANGE = 4, ///< a force above the bound of the quanta
    SCREE_FLAG_ESCAPED = 8,     ///< a body left the domain
};

/// Neighbour pairs in row indices, along the curve: pairs [0, held_count) are those of the persistent list, pairs
/// [held_count, touching_count) touched at the rebuild (padded groups are the kernel's own affair). Row indices are
/// valid until the next rebuild.
typedef struct scree_pair_list {
    uint32_t *first, *second;     ///< rows; id[first] < id[second]
    scree_history *history;       ///< one a pair, seen from `first`
    scree_last_force *last_force; ///< with scree_contacts_add_work: one a pair; else NULL
    scree_rolling *rolling;       ///< with scree_contacts_roll: one a pair; else NULL
    size_t count, capacity;
    size_t held_count, touching_count;
    uint64_t held_changes; ///< of the persistent list, when this was made
    scree_member_row *own; ///< held_count
    size_t own_capacity;
} scree_pair_list;

typedef struct scree_wall_pair_list {
    uint32_t *body; ///< rows
    uint32_t *wall; ///< wall index, or element of the walls of the case
    scree_history *history;
    scree_last_force *last_force; ///< as in scree_pair_list
    scree_rolling *rolling;
    size_t count, capacity;
} scree_wall_pair_list;

/// A ghost of a body in a periodic cell: row count + k of the state belongs to ghost k. Images are made anew with the
/// pair list and follow their bodies in every step (search/ghosts.h).
typedef struct scree_ghost {
    uint32_t parent;  ///< row of the body
    int32_t shift[3]; ///< lattice vectors from the body to the ghost; the first that is not zero is positive
} scree_ghost;

typedef struct scree_ghost_list {
    scree_ghost *ghost;
    size_t count, capacity;
    size_t by_parent;          ///< the first ones, in the order of their parents
    double lattice_inverse[9]; ///< 1/m, at the last rebuild
    double largest_radius;     ///< m, of all bodies
} scree_ghost_list;

/// Whether contacts have last_force rows, and rolling rows: what the law says.
static inline bool scree_contacts_add_work(const scree_model *model, int dimension)
{
    return scree_model_traits(model)->keeps_last_force[dimension - 2];
}

static inline bool scree_contacts_roll(const scree_model *model)
{
    return scree_model_traits(model)->rolling;
}

typedef struct scree_search scree_search;     ///< cell grid and scratch, private to search/
typedef struct scree_wall_set scree_wall_set; ///< walls of the case: shape/wall_set.h

typedef struct scree_work {
    scree_pair_list pairs;
    scree_wall_pair_list wall_pairs;
    scree_wall_pair_list primitive_pairs; ///< bodies near the walls of the case, by row, then element
    scree_wall_set *wall_set;             ///< these walls; NULL: none. Owned; outlives nothing but a rebuild
    scree_ghost_list ghosts;
    scree_vector *relative; ///< deforming cell: velocities relative to the affine field while rows hold whole ones
    size_t relative_capacity;
    scree_search *search;
    double skin;   ///< m, width added to the sum of radii in the list
    double budget; ///< m, distance that bodies may still move before the list must be checked
    bool valid;    ///< false: rebuild before the next force evaluation
    uint64_t rebuilds;
    uint64_t ticks;    ///< of the present step
    double next_kick;  ///< s, in which the forces of this step will act (integrate.h), for boundaries that predict it
    int threads;       ///< at most
    bool keep_threads; ///< use all of them, however busy the machine is (tests)
    scree_thread_pool_size size; ///< how many of them are worth while now
    scree_thread_pool *pool;     ///< of `threads` members, for loops of some microseconds; made at their first use
    bool settle;                 ///< held pairs break or have parted: their law says so (bond/bond.c)
    bool ledger;                 ///< dissipated energies are accumulated (default true)
    bool reference_kernel;       ///< use the plain scalar core with runtime arguments (tests)
    int instruction_set;         ///< 0: best of this machine; 2, 3, 4: x86-64-v2, v3, v4
    uint32_t flags;              ///< SCREE_FLAG_...
    uint64_t flagged_id;         ///< a body that raised a flag
    size_t clear_rows;           ///< rows of state->sum (3D: and of state->torque) from the first on that hold zeros
    void *contact_scratch;       ///< private to contact/ (per-thread slots); freed by scree_contact_scratch_destroy
} scree_work;

/// Rows that the pair list may name: bodies and ghosts.
static inline size_t scree_row_count(const scree_state *state, const scree_work *work)
{
    return state->count + work->ghosts.count;
}

/// The row of the body that `row` is, or is a ghost of.
static inline uint32_t scree_parent_row(const scree_state *state, const scree_work *work, uint32_t row)
{
    return row < state->count ? row : work->ghosts.ghost[row - state->count].parent;
}

/// Threads that work now.
static inline int scree_work_shares(const scree_work *work)
{
    int most = work->threads < 1 ? 1 : work->threads > SCREE_TEAM_MOST ? SCREE_TEAM_MOST : work->threads;
    return work->size.now > 0 && work->size.now < most && !work->keep_threads ? work->size.now : most;
}

#endif
