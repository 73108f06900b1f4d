/// Which process writes what, where all of them write a file together.
///
/// An array of a file is cut into ranges of rows, one a process, as equal as can be. The rows of a part (comm/parts.h)
/// lie anywhere, so each goes to the process that writes it: bodies in the order of their ids, what belongs to two of
/// them in the order of both ids. Who writes which is found once a file (scree_ranges_open); then arrays go one by one
/// (scree_route_move), so that a process needs memory for some arrays of its range and never for all bodies. What is
/// not about bodies is the same in all parts, and so is all of a whole state: each process has its range of that.
#ifndef SCREE_COMM_RANGES_H
#define SCREE_COMM_RANGES_H

#include "state/work.h"

/// Rows of the range of every process but the last ones; first row of the range of a process.
size_t scree_range_rows(size_t total);
size_t scree_range_begin(size_t total, int process);

/// How elements come to the processes that write them.
typedef struct scree_route {
    size_t begin, rows, total; ///< the range of this process: `rows` from row `begin` on, of all
    uint32_t *index;           ///< own elements that are written, in the order of the processes that they go to
    uint32_t *place;           ///< in the range: of what comes, in the order in which it comes
    size_t *send, *receive;    ///< of each process
    size_t leaving;            ///< elements that go, to this process too
} scree_route;

/// An element that is not written by way of this process.
#define SCREE_ROUTE_NONE UINT64_MAX

/// The key of what belongs to the body `first`, or to two bodies; keys say the order.
static inline uint64_t scree_route_key(uint32_t first, uint32_t second)
{
    return (uint64_t)first << 32 | second;
}

/// The route of `count` own elements with these keys, of which no two processes have the same one. `ids`: that were
/// ever given. All processes call it. Errors: memory. Cost: keys are sorted; 24 bytes an element are sent.
scree_status scree_route_open(scree_route *route, const uint64_t *key, size_t count, size_t ids,
                              scree_error *error) SCREE_MUST_USE;
void scree_route_close(scree_route *route);

/// own: elements of `size` bytes, as they were counted; range: those that this process writes, in their order. All
/// processes call it. Errors: memory.
scree_status scree_route_move(const scree_route *route, const void *own, void *range, size_t size,
                              scree_error *error) SCREE_MUST_USE;

/// A route without places: own element k goes to process to[k], or nowhere (negative); *arriving: so many come. All
/// processes call it. Errors: memory.
scree_status scree_route_to(scree_route *route, const int32_t *to, size_t count, size_t *arriving,
                            scree_error *error) SCREE_MUST_USE;

/// Its elements of `size` bytes, in the order in which they come; answers to them go back to where they came from. All
/// processes call each. Errors: memory.
scree_status scree_route_pass(const scree_route *route, const void *own, void *in, size_t size,
                              scree_error *error) SCREE_MUST_USE;
scree_status scree_route_answer(const scree_route *route, const void *in, void *own, size_t size,
                                scree_error *error) SCREE_MUST_USE;

/// Sets of what belongs to two bodies (comm/pair_sets.h).
enum { SCREE_RANGE_SETS = 4 };

/// The routes of a state.
typedef struct scree_ranges {
    bool part; ///< else nothing moves
    scree_route bodies, set[SCREE_RANGE_SETS];
    const scree_group *group[SCREE_RANGE_SETS]; ///< of each set; NULL: contacts
    size_t sets;
} scree_ranges;

/// Contacts have been saved, or no list has been made since the state was spread. All processes call it; one that fails
/// has to end the others. Errors: memory.
scree_status scree_ranges_open(scree_state *state, scree_work *work, scree_ranges *ranges,
                               scree_error *error) SCREE_MUST_USE;
void scree_ranges_close(scree_ranges *ranges);

/// Files of which ranges have been made since the process began; those of them of parts of a sample.
uint64_t scree_ranges_files(bool from_parts);

/// The route of the elements of a field; NULL: all processes have all of them.
const scree_route *scree_ranges_of(const scree_ranges *ranges, const scree_state *state, const scree_field *field);

#endif
