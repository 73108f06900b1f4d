/// Everything that can be rebuilt from the state: neighbour pairs, cell grid, scratch, flags, thread partition.
#ifndef SCREE_STATE_WORK_H
#define SCREE_STATE_WORK_H

#include "base/reduction.h"
#include "base/thread_pool_size.h"
#include "state/body.h"
#include "state/pair_hint.h"

/// Flags that kernels and integrators raise; the guard looks once a step.
enum {
    SCREE_FLAG_NAN = 1,         ///< a position or velocity is not finite
    SCREE_FLAG_OVERLAP = 2,     ///< overlap above the guard's limit
    SCREE_FLAG_FORCE_RANGE = 4, ///< a force above the bound of the quanta
    SCREE_FLAG_ESCAPED = 8,     ///< a body left the domain
};

/// Pairs [begin, end) of the list, all of one geometry and one law, and found in one way; [begin, touching_end) touched
/// when the list was made, or are held. Along the curve, each of the two parts.
typedef struct scree_pair_section {
    int geometry;    ///< its number (contact/geometry.h)
    int law;         ///< its number in the model; of held pairs the law is that of model->persistent
    bool persistent; ///< held: of the persistent list, in contact at any distance
    bool asleep;     ///< of two bodies that sleep (state/sleep.h): not evaluated
    size_t begin, touching_end, end;
} scree_pair_section;

enum { SCREE_PAIR_SECTIONS = 1 + 2 * (1 + SCREE_MOST_PAIR_LAWS) };

/// Neighbour pairs in row indices, in sections: first the persistent one, then one for each law, and behind it one of
/// those that sleep. Row indices are valid
/// until the next rebuild.
typedef struct scree_pair_list {
    uint32_t *first, *second;     ///< rows; id[first] < id[second]
    scree_history *history;       ///< one a pair, seen from `first`
    scree_last_force *last_force; ///< with scree_contacts_add_work: one a pair; else NULL
    scree_rolling *rolling;       ///< with scree_contacts_roll: one a pair; else NULL
    double reach;                 ///< m, beyond which no neck of a law with the trait `necks` reaches; 0: none is
    scree_pair_hint *hint;        ///< with laws of areas, with no effect; else NULL
    size_t count, capacity;
    scree_pair_section section[SCREE_PAIR_SECTIONS];
    int section_count;
    uint64_t held_changes;  ///< of the persistent list, when this was made
    uint64_t sleep_changes; ///< of the bodies that sleep, when the sections were cut
    uint64_t orders;        ///< times that pairs have been put into other sections
    scree_member_row *own;  ///< one a held pair
    size_t own_capacity;
} scree_pair_list;

/// Pairs that are held: they come first.
static inline size_t scree_pairs_held(const scree_pair_list *list)
{
    return list->section_count > 0 && list->section[0].persistent ? list->section[0].end : 0;
}

/// The section of a pair of the list.
static inline const scree_pair_section *scree_pairs_section(const scree_pair_list *list, size_t pair)
{
    int k = 0;
    while (pair >= list->section[k].end) k++;
    return &list->section[k];
}

/// Adds a section of `touching` and `near` pairs behind those that there are, and returns it.
static inline scree_pair_section *scree_pairs_add_section(scree_pair_list *list, int geometry, int law, bool persistent,
                                                          size_t touching, size_t near)
{
    scree_pair_section *section = &list->section[list->section_count];
    const size_t begin = list->section_count++ > 0 ? section[-1].end : 0;
    *section = (scree_pair_section){.geometry = geometry,
                                    .law = law,
                                    .persistent = persistent,
                                    .begin = begin,
                                    .touching_end = begin + touching,
                                    .end = begin + touching + near};
    list->count = section->end;
    return section;
}

/// No pairs, and no sections.
static inline void scree_pairs_clear(scree_pair_list *list)
{
    list->count = 0;
    list->section_count = 0;
}

typedef struct scree_wall_pair_list {
    uint32_t *body; ///< rows
    uint32_t *wall; ///< wall index, or element of the walls of the case
    scree_history *history;
    scree_last_force *last_force; ///< as in scree_pair_list
    scree_rolling *rolling;
    uint8_t *law; ///< numbers of laws, where contacts follow several; else NULL
    int geometry; ///< its number
    double reach; ///< m, as in scree_pair_list
    size_t count, capacity;
} scree_wall_pair_list;

/// The number of the law of a pair with a wall.
static inline int scree_wall_pair_law(const scree_wall_pair_list *list, size_t pair)
{
    return list->law ? list->law[pair] : 0;
}

/// A ghost of a body in a periodic cell, or of a body of another process: row count + k of the state belongs to ghost
/// k. Images are made anew with the pair list and follow their bodies in every step (search/ghosts.h).
typedef struct scree_ghost {
    uint32_t parent;  ///< row of the body; of a ghost whose body is not here its own row
    int32_t shift[3]; ///< lattice vectors from the body to the ghost; the first that is not zero is positive
} scree_ghost;

typedef struct scree_ghost_list {
    scree_ghost *ghost;
    size_t count, capacity;
    size_t away;               ///< the last ones: those of bodies of other processes, in the order of these
    size_t by_parent;          ///< the first ones, in the order of their parents
    double lattice_inverse[9]; ///< 1/m, at the last rebuild
    double largest_radius;     ///< m, of all bodies
} scree_ghost_list;

/// Whether contacts have last_force rows, and rolling rows: what one of their laws says.
static inline bool scree_contacts_add_work(const scree_model *model, int dimension)
{
    bool adds = false;
    for (int k = 0; k < scree_model_law_count(model); k++)
        adds = adds || scree_law_use_traits(&model->laws[k])->keeps_last_force[dimension - 2];
    return adds;
}

static inline bool scree_contacts_roll(const scree_model *model)
{
    bool rolls = false;
    for (int k = 0; k < scree_model_law_count(model); k++)
        rolls = rolls || scree_law_use_traits(&model->laws[k])->rolling;
    return rolls;
}

/// The largest of the bodies that are here [m/s]. Infinite: one is not a number.
typedef struct scree_speeds {
    double surface;      ///< of |v| + R |w|; 0: `centre` + `spin` bounds it
    double centre, spin; ///< of |v|, which the list reckons with, and of R |w|
} scree_speeds;

/// What processes tell each other between the first half of a step and the search (search/moved.h).
typedef struct scree_moved {
    scree_speeds speeds; ///< that the scheme has told
    double driven;       ///< m/s, of the bodies that were driven behind it
    double due;          ///< above 0: one of them has to make its list anew
    bool told;           ///< speeds of this process wait for the message
    bool known;          ///< the message has come before the search
    scree_reduction together;
} scree_moved;

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
    bool reference_kernel;       ///< use the plain scalar core with runtime arguments (tests)
    int instruction_set;         ///< 0: best of this machine; 2, 3, 4: x86-64-v2, v3, v4
    uint32_t flags;              ///< SCREE_FLAG_...
    uint64_t flagged_id;         ///< a body that raised a flag
    bool alarm;                  ///< a process may have raised one until the contact forces were known: all know this
    scree_moved moved;
    double virial_bound;       ///< m, of the last virial (contact/ghost_forces.c): it changes seldom
    double motion_quantum;     ///< J, of the last sum over the motions (boundary/periodic.c), in the same way
    size_t clear_rows;         ///< rows of state->sum (3D: and of state->torque) from the first on that hold zeros
    void *contact_scratch;     ///< private to contact/ (per-thread slots); freed by scree_contact_scratch_destroy
    bool parts_by_time;        ///< space is cut by measured times (comm/balance.h)
    struct scree_parts *parts; ///< what goes to other processes (comm/parts.h); NULL: all is here
} scree_work;

/// Rows that the pair list may name: bodies and ghosts.
static inline size_t scree_row_count(const scree_state *state, const scree_work *work)
{
    return state->count + work->ghosts.count;
}

/// The row of the body that `row` is, or is a ghost of; a ghost whose body is not here stands for itself.
static inline uint32_t scree_parent_row(const scree_state *state, const scree_work *work, uint32_t row)
{
    return row < state->count ? row : work->ghosts.ghost[row - state->count].parent;
}

/// Threads that work now.
static inline int scree_work_shares(const scree_work *work)
{
    int most = work->threads < 1 ? 1 : work->threads > SCREE_THREAD_POOL_MOST ? SCREE_THREAD_POOL_MOST : work->threads;
    return work->size.now > 0 && work->size.now < most && !work->keep_threads ? work->size.now : most;
}

#endif
