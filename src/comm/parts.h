/// The sample in parts: each process has some of the bodies, and ghosts of those of others that may touch them.
///
/// A state is whole or a part (state->part). Whole, it is in process 0 alone, for what looks at all bodies at once; the
/// others wait. A part, it holds the bodies of this process, in the first rows; the step knows no other. What is not
/// about bodies (walls, cells, ledger, stage) is the same in all parts, since all that it follows from is joined
/// (comm/comm.h), or comes from process 0.
///
/// Which process has a body does not show in the bits. A pair of bodies of two processes is evaluated by one of them:
/// without a shift by that of the lower number, across a face of a periodic cell by that of the body which is met by an
/// image with a positive shift, as one process does it. So positions of a pair are the same doubles wherever it is
/// evaluated, and integer sums do the rest.
///
/// What a contact remembers, or a pair that is held, travels with both of its bodies, as nobody knows yet which process
/// will evaluate it.
#ifndef SCREE_COMM_PARTS_H
#define SCREE_COMM_PARTS_H

#include "comm/balance.h"
#include "comm/message.h"
#include "comm/pair_sets.h"

/// Who has asked for whole states, and how often.
typedef struct scree_gather_reason {
    char what[80];
    uint64_t count;
} scree_gather_reason;

enum { SCREE_GATHER_REASONS = 24 }; ///< told apart; those behind are counted with the last one

typedef struct scree_parts {
    scree_ghost *sent; ///< ghosts of own bodies that other processes have, in the order of these
    int32_t *sent_to;  ///< while they are chosen: the process of each
    size_t sent_count, sent_capacity, to_capacity;
    size_t *send, *receive; ///< of each process: ghosts that it has of ours, that we have of its bodies
    unsigned char *out, *in;
    size_t out_capacity, in_capacity;
    double (*half)[9]; ///< while contacts are listed: velocity and spin at n - 1/2 of ghosts of others, and the place
                       ///< of the body itself
    uint64_t seed;     ///< not 0: bodies go to processes at random, from this seed (tests)
    uint64_t draws;
    scree_balance balance;
    bool whole;    ///< process 0 has the whole sample, and the others keep what they have, or nothing
    uint32_t *own; ///< then, in process 0: the ids of its own bodies
    size_t own_count;
    bool told_empty; ///< the run has been warned of processes without bodies
    // counted since the begin of the process
    uint64_t gathers, gathered;                       ///< states put together, and their bytes
    scree_gather_reason reason[SCREE_GATHER_REASONS]; ///< of `gathers`
    size_t reasons;
    uint64_t cuts, lists;  ///< of space; lists with ghosts
    uint64_t moved;        ///< bodies that have changed their process
    uint64_t steps, bytes; ///< messages of steps: how often, and what this process sent
    uint64_t ghosts;       ///< from other processes, sum over the lists
    uint64_t offered;      ///< own bodies, sum over the lists
    uint64_t looked;       ///< parts that these and their images have been held against
    uint64_t taken;        ///< steps
    uint64_t taken_bodies; ///< of this part, sum over the steps
    uint64_t taken_ghosts; ///< from other processes, sum over the steps
    uint64_t needed;       ///< bytes that the fields of ghosts need in the steps, sent by this process
    double worst;          ///< cost of the part that costs most over the mean, largest when a list was due
} scree_parts;

/// Process 0 has the whole sample, or none of the processes has a body yet.
bool scree_parts_are_whole(const scree_work *work);

/// From parts, whose contacts have been saved, to the whole in process 0, without a list; contacts are in the state.
/// The others keep what they have, without a list, too, and their memory does not grow. what: for whom, in the counts.
/// All processes call it. Errors: memory.
scree_status scree_parts_gather(scree_state *state, scree_work *work, const char *what,
                                scree_error *error) SCREE_MUST_USE;

/// Back, when process 0 has only looked at the whole; its contacts have been saved. Errors: memory.
scree_status scree_parts_return(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// All processes get from process 0 what is not about bodies (walls, cells, ledger, stage, laws), from the declarations
/// of the fields; the others have no bodies then, and the same arrays. All processes call it. Errors: memory.
scree_status scree_parts_share(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Each body, and what belongs to two, is with one process, whichever: to parts, without a list. Contacts have been
/// saved. All processes call it. Errors: memory; SCREE_ERROR_IO: an id is there twice, or something is of a body that
/// is not there.
scree_status scree_parts_spread(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Before a list is made anew: bodies go to the processes in whose parts they lie, with all that fields declare and
/// what their contacts remember, which is in the state. Errors: memory.
scree_status scree_parts_migrate(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Range of the positions of the bodies of each process [m]: lowest x, y, z, then highest. `box`: one a process.
void scree_parts_boxes(const scree_state *state, double (*box)[6]);

/// receive[r]: how many elements come from process r, which tells send[r'] of them to each r'. Returns their sum. All
/// processes call it.
size_t scree_parts_trade(const size_t *send, size_t *receive);

/// counts[r]: how many elements process r has, which says `mine`. Returns their sum. All processes call it.
size_t scree_parts_count(size_t mine, size_t *counts);

/// begin[r]: what the processes before r count together. Returns the sum of all.
size_t scree_parts_begins(const size_t *counts, size_t *begin);

/// `count` elements of `size` bytes in an array of its own, *list: where the state is a part those of all processes
/// take their place, by the numbers of processes. Errors: memory. All processes call it.
scree_status scree_parts_collect(const scree_state *state, void *list, size_t *count, size_t size,
                                 scree_error *error) SCREE_MUST_USE;

/// Numbers about bodies: value[each * k ...], `each` of them, of the body id[k], which the process has filled in that
/// has it. Where the state is a part all get them, in one reduction; nobody keeps track of who has which. All processes
/// call it, with the same ids.
void scree_parts_tell(const scree_state *state, const uint32_t *id, size_t count, double *value, size_t each);

/// Another process will have this ghost; scree_parts_link tells it. Errors: memory.
scree_status scree_parts_offer(scree_work *work, int process, const scree_ghost *ghost,
                               scree_error *error) SCREE_MUST_USE;

/// All ghosts have been offered: puts those that others offered behind the own ones of the list. Errors: memory.
scree_status scree_parts_link(const scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Room for the messages of the present ghosts. Errors: memory.
scree_status scree_parts_reserve_messages(const scree_state *state, scree_work *work,
                                          scree_error *error) SCREE_MUST_USE;

/// What ghosts elsewhere are told; what they have collected. All processes call them.
void scree_parts_send(scree_state *state, scree_work *work, scree_message_kind kind, const scree_message_shift *shift);
void scree_parts_add_back(scree_state *state, scree_work *work);

/// This part takes a step; it has been taken.
void scree_parts_begin_step(scree_work *work);
void scree_parts_end_step(const scree_state *state, scree_work *work);

void scree_parts_destroy(scree_work *work);

// ---- what parts.c and whole.c share ------------------------------------------------------------------------------

/// Makes work->parts, if there is none yet. Errors: memory.
scree_status scree_parts_open(scree_work *work, scree_error *error) SCREE_MUST_USE;

/// The ghosts of the last list are void.
void scree_parts_forget_ghosts(scree_work *work);

/// Cuts space anew by the places of all bodies and their weights, weight[row] (NULL: all weigh alike). Errors: memory,
/// the library's.
scree_status scree_parts_cut(const scree_state *state, scree_parts *parts, const float *weight,
                             scree_error *error) SCREE_MUST_USE;

/// to[row]: the process in whose part the body of the row lies.
void scree_parts_choose(const scree_state *state, scree_parts *parts, int32_t *to);

/// Element `from` of each array becomes element `to`.
void scree_parts_move_element(const scree_body_array *list, size_t arrays, size_t from, size_t to);

/// Leaves the rows that stay here, to[row] is this process, in their order. Ids have to be given their rows anew.
void scree_parts_keep_rows(scree_state *state, const scree_body_array *list, size_t arrays, const int32_t *to);

/// Counts bodies with each mark.
void scree_parts_count_marks(scree_state *state);

/// The processes that the two bodies of element `k` of a set are with, end[0] and end[1]; a wall is with the body. `to`
/// says it of rows; SCREE_PARTS_NOBODY of a body that is not here.
enum { SCREE_PARTS_NOBODY = -1 };
void scree_parts_ends(const scree_state *state, const scree_pair_set *set, const int32_t *to, size_t k, int32_t end[2]);

/// Leaves the elements of a set of which one end is here, in their order; ends[2 k] and ends[2 k + 1] are those of
/// element k.
void scree_parts_keep_pairs(const scree_pair_set *set, const int32_t *ends);

/// Each element goes to the processes of both of its ends, and stays nowhere else. Errors: memory.
scree_status scree_parts_move_pairs(scree_state *state, const scree_pair_set *set, const int32_t *ends,
                                    scree_error *error) SCREE_MUST_USE;

/// The body of each row goes to to[row], with its elements of the arrays, those of the state and `relative` of a cell
/// in motion. Errors: memory.
scree_status scree_parts_move_rows(scree_state *state, scree_work *work, const int32_t *to,
                                   scree_error *error) SCREE_MUST_USE;

#endif
