/// Messages from declarations.
///
/// The pieces of each kind of message are found once for the program, for each dimension: where in its owner's struct
/// the pointer to the array lies, stride, offset, bytes. They are put in the order in which they lie in memory;
/// neighbouring values of one treatment are one piece, and so are position and velocity of one row with what follows
/// behind the velocity: a few loops, in which all sizes are constants, say all of a body. Cost: a row of each array
/// that has a part in it.
#include "comm/message.h"

#include "base/matrix.h"
#include "state/fields.h"

#include <assert.h>
#include <pthread.h>
#include <string.h>

typedef struct message_piece {
    int slot;            ///< of the module whose struct has the pointer to the array; -1: the state
    size_t array_offset; ///< of this pointer
    size_t stride, offset, bytes;
    scree_field_ghosts ghosts;
    size_t velocity; ///< of a piece POSITION that has a velocity, too: its offset; else 0
    size_t behind;   ///< numbers behind this velocity that are copied
} message_piece;

enum { MOST_PIECES = 64 };

typedef struct message_plan {
    message_piece piece[MOST_PIECES];
    size_t count;
} message_plan;

static message_plan plans[2][SCREE_MESSAGE_KINDS];

static scree_message_kind kind_of(const scree_field *field)
{
    if (field->ghosts == SCREE_GHOSTS_KEEP) return SCREE_MESSAGE_MAKE;
    return field->ghosts == SCREE_GHOSTS_ADD_BACK ? SCREE_MESSAGE_BACK : SCREE_MESSAGE_STEP;
}

static int slot_of(const scree_field *field)
{
    int slot = -1;
    if (field->owner)
        while (scree_modules[++slot] != field->owner) continue;
    return slot;
}

/// Makes the last piece longer where `next` lies right behind it and is treated alike.
static bool prolongs(message_piece *last, const message_piece *next)
{
    bool plain = next->ghosts != SCREE_GHOSTS_POSITION && next->ghosts != SCREE_GHOSTS_VELOCITY;
    if (!plain || last->ghosts != next->ghosts || last->slot != next->slot ||
        last->array_offset != next->array_offset || last->offset + last->bytes != next->offset)
        return false;
    last->bytes += next->bytes;
    return true;
}

/// Pieces in the order in which they lie in memory.
static bool lies_before(const message_piece *a, const message_piece *b)
{
    if (a->slot != b->slot) return a->slot < b->slot;
    if (a->array_offset != b->array_offset) return a->array_offset < b->array_offset;
    return a->offset < b->offset;
}

static void plan_field(const scree_field *field, int dimension)
{
    message_plan *plan = &plans[dimension - 2][kind_of(field)];
    const message_piece next = {.slot = slot_of(field),
                                .array_offset = field->array_offset,
                                .stride = field->stride,
                                .offset = field->offset,
                                .bytes = (size_t)scree_components(field->components, dimension) *
                                         scree_field_size(field->type),
                                .ghosts = field->ghosts};
    // Only integers can be added in any order.
    assert(field->ghosts != SCREE_GHOSTS_ADD_BACK || field->type == SCREE_FIELD_INT64);
    assert(plan->count < MOST_PIECES);
    size_t at = plan->count++;
    for (; at > 0 && lies_before(&next, &plan->piece[at - 1]); at--) plan->piece[at] = plan->piece[at - 1];
    plan->piece[at] = next;
}

static bool same_array(const message_piece *a, const message_piece *b)
{
    return a->slot == b->slot && a->array_offset == b->array_offset;
}

/// Makes a position one piece with the velocity of its array and with the number behind that.
static bool moves_along(message_piece *last, const message_piece *next)
{
    if (last->ghosts != SCREE_GHOSTS_POSITION || !same_array(last, next)) return false;
    if (next->ghosts == SCREE_GHOSTS_VELOCITY && !last->velocity) {
        last->velocity = next->offset;
        return true;
    }
    if (next->ghosts != SCREE_GHOSTS_FOLLOW || !last->velocity || last->behind > 0) return false;
    if (next->offset != last->velocity + last->bytes || next->bytes != sizeof(double)) return false;
    last->behind = 1;
    return true;
}

static void join_pieces(message_plan *plan)
{
    size_t count = 0;
    for (size_t k = 0; k < plan->count; k++) {
        message_piece *last = count > 0 ? &plan->piece[count - 1] : NULL;
        const message_piece *next = &plan->piece[k];
        if (!last || !(prolongs(last, next) || moves_along(last, next))) plan->piece[count++] = *next;
    }
    plan->count = count;
}

static void make_plans(void)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        for (int dimension = 2; dimension <= 3; dimension++)
            if (field->ghosts != SCREE_GHOSTS_NONE && scree_field_exists(field, dimension))
                plan_field(field, dimension);
    }
    for (int kind = 0; kind < SCREE_MESSAGE_KINDS; kind++) {
        join_pieces(&plans[0][kind]);
        join_pieces(&plans[1][kind]);
    }
}

/// Bytes of a body in a message.
static size_t bytes_of(const message_piece *piece)
{
    return (piece->velocity ? 2 : 1) * piece->bytes + piece->behind * sizeof(double);
}

static const message_plan *plan_of(const scree_state *state, scree_message_kind kind)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, make_plans);
    return &plans[state->dimension - 2][kind];
}

/// First byte of a piece of row 0; NULL: there is no such array.
static unsigned char *first_of(const scree_state *state, const message_piece *piece)
{
    const unsigned char *owner = piece->slot < 0 ? (const unsigned char *)state : state->own[piece->slot];
    unsigned char *array = NULL;
    if (owner) memcpy(&array, owner + piece->array_offset, sizeof array);
    return array ? array + piece->offset : NULL;
}

size_t scree_message_bytes(const scree_state *state, scree_message_kind kind)
{
    const message_plan *plan = plan_of(state, kind);
    size_t bytes = 0;
    for (size_t k = 0; k < plan->count; k++)
        if (first_of(state, &plan->piece[k])) bytes += bytes_of(&plan->piece[k]);
    return bytes;
}

#define MESSAGE_INLINE static inline __attribute__((always_inline))

/// Calls a loop with the number of bytes as a constant where it is a frequent one: copies are moves of registers then.
#define WITH_CONSTANT_BYTES(loop, bytes_, ...)                                                                         \
    switch (bytes_) {                                                                                                  \
    case 8:                                                                                                            \
        loop(8, __VA_ARGS__);                                                                                          \
        break;                                                                                                         \
    case 24:                                                                                                           \
        loop(24, __VA_ARGS__);                                                                                         \
        break;                                                                                                         \
    case 32:                                                                                                           \
        loop(32, __VA_ARGS__);                                                                                         \
        break;                                                                                                         \
    default:                                                                                                           \
        loop(bytes_, __VA_ARGS__);                                                                                     \
    }

MESSAGE_INLINE void pack_copies(size_t bytes, const unsigned char *first, size_t stride, const scree_ghost *ghost,
                                size_t count, unsigned char *message)
{
    for (size_t k = 0; k < count; k++, message += bytes) memcpy(message, first + ghost[k].parent * stride, bytes);
}

// Bytes of messages and of rows as numbers; copies, since a message is aligned to nothing.
MESSAGE_INLINE double number_at(const unsigned char *bytes, size_t k)
{
    double number;
    memcpy(&number, bytes + k * sizeof number, sizeof number);
    return number;
}

MESSAGE_INLINE void set_number(unsigned char *bytes, size_t k, double number)
{
    memcpy(bytes + k * sizeof number, &number, sizeof number);
}

/// A vector plus matrix times shift; the third component of a shift in the plane is zero.
MESSAGE_INLINE void pack_vector(int dimension, const unsigned char *from, const double matrix[9], const double shift[3],
                                unsigned char *message)
{
    double more[3];
    scree_matrix_apply_in(dimension, matrix, shift, more);
    for (int i = 0; i < dimension; i++) set_number(message, (size_t)i, number_at(from, (size_t)i) + more[i]);
}

/// What moves with the lattice. velocity: whether a velocity follows, and `behind` numbers.
MESSAGE_INLINE void pack_moved(int dimension, bool velocity, size_t behind, const message_piece *piece,
                               const unsigned char *first, const scree_ghost *ghost, size_t count,
                               const scree_message_shift *shift, unsigned char *message)
{
    // Copies: messages do not overlap them.
    const scree_message_shift by = *shift;
    const double *matrix = piece->ghosts == SCREE_GHOSTS_POSITION ? by.lattice : by.velocity;
    const size_t stride = piece->stride, to_velocity = piece->velocity - piece->offset,
                 size = (size_t)dimension * sizeof(double);
    for (size_t k = 0; k < count; k++) {
        const double s[3] = {ghost[k].shift[0], ghost[k].shift[1], ghost[k].shift[2]};
        const unsigned char *from = first + ghost[k].parent * stride;
        pack_vector(dimension, from, velocity ? by.lattice : matrix, s, message);
        message += size;
        if (!velocity) continue;
        from += to_velocity;
        pack_vector(dimension, from, by.velocity, s, message);
        for (size_t i = 0; i < behind; i++) set_number(message + size, i, number_at(from + size, i));
        message += size + behind * sizeof(double);
    }
}

/// The rows of the state have their spin behind the velocity in 2D.
static void pack_motion(const message_piece *piece, const unsigned char *first, const scree_ghost *ghost, size_t count,
                        const scree_message_shift *shift, unsigned char *message)
{
    const int dimension = (int)(piece->bytes / sizeof(double));
    const bool velocity = piece->velocity > 0;
    if (dimension == 2 && velocity && piece->behind == 1)
        pack_moved(2, true, 1, piece, first, ghost, count, shift, message);
    else if (dimension == 3 && velocity && piece->behind == 0)
        pack_moved(3, true, 0, piece, first, ghost, count, shift, message);
    else
        pack_moved(dimension, velocity, piece->behind, piece, first, ghost, count, shift, message);
}

void scree_message_pack(const scree_state *state, scree_message_kind kind, const scree_ghost *ghost, size_t count,
                        const scree_message_shift *shift, unsigned char *message)
{
    const message_plan *plan = plan_of(state, kind);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        const unsigned char *first = first_of(state, piece);
        if (!first) continue;
        if (piece->ghosts == SCREE_GHOSTS_POSITION || piece->ghosts == SCREE_GHOSTS_VELOCITY)
            pack_motion(piece, first, ghost, count, shift, message);
        else
            WITH_CONSTANT_BYTES(pack_copies, piece->bytes, first, piece->stride, ghost, count, message)
        message += count * bytes_of(piece);
    }
}

MESSAGE_INLINE void unpack_copies(size_t bytes, unsigned char *to, size_t stride, size_t count,
                                  const unsigned char *message)
{
    for (size_t k = 0; k < count; k++, to += stride, message += bytes) memcpy(to, message, bytes);
}

MESSAGE_INLINE void unpack_moved(size_t size, size_t behind, const message_piece *piece, unsigned char *to,
                                 size_t count, const unsigned char *message)
{
    const size_t stride = piece->stride, to_velocity = piece->velocity - piece->offset,
                 rest = size + behind * sizeof(double);
    for (size_t k = 0; k < count; k++, to += stride, message += size + rest) {
        memcpy(to, message, size);
        memcpy(to + to_velocity, message + size, rest);
    }
}

static void unpack_motion(const message_piece *piece, unsigned char *to, size_t count, const unsigned char *message)
{
    if (piece->bytes == 16 && piece->behind == 1)
        unpack_moved(16, 1, piece, to, count, message);
    else if (piece->bytes == 24 && piece->behind == 0)
        unpack_moved(24, 0, piece, to, count, message);
    else
        unpack_moved(piece->bytes, piece->behind, piece, to, count, message);
}

void scree_message_unpack(scree_state *state, scree_message_kind kind, size_t row, size_t count,
                          const unsigned char *message)
{
    const message_plan *plan = plan_of(state, kind);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        unsigned char *to = first + row * piece->stride;
        if (piece->velocity)
            unpack_motion(piece, to, count, message);
        else
            WITH_CONSTANT_BYTES(unpack_copies, piece->bytes, to, piece->stride, count, message)
        message += count * bytes_of(piece);
    }
}

MESSAGE_INLINE void collect(size_t bytes, unsigned char *from, size_t stride, size_t count, unsigned char *message)
{
    for (size_t k = 0; k < count; k++, from += stride, message += bytes) {
        memcpy(message, from, bytes);
        memset(from, 0, bytes);
    }
}

void scree_message_collect(scree_state *state, size_t row, size_t count, unsigned char *message)
{
    const message_plan *plan = plan_of(state, SCREE_MESSAGE_BACK);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        WITH_CONSTANT_BYTES(collect, piece->bytes, first + row * piece->stride, piece->stride, count, message)
        message += count * piece->bytes;
    }
}

/// Adds integers of 64 bits modulo 2^64.
MESSAGE_INLINE void add(size_t bytes, unsigned char *first, size_t stride, const scree_ghost *ghost, size_t count,
                        const unsigned char *message)
{
    for (size_t k = 0; k < count; k++, message += bytes) {
        unsigned char *to = first + ghost[k].parent * stride;
        for (size_t at = 0; at < bytes; at += 8) {
            uint64_t sum, more;
            memcpy(&sum, to + at, 8);
            memcpy(&more, message + at, 8);
            sum += more;
            memcpy(to + at, &sum, 8);
        }
    }
}

void scree_message_add(scree_state *state, const scree_ghost *ghost, size_t count, const unsigned char *message)
{
    const message_plan *plan = plan_of(state, SCREE_MESSAGE_BACK);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        WITH_CONSTANT_BYTES(add, piece->bytes, first, piece->stride, ghost, count, message)
        message += count * piece->bytes;
    }
}
