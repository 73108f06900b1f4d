/// Messages from declarations.
///
/// The pieces of each kind of message are found once for the program, for each dimension: where in its owner's struct
/// the pointer to the array lies, stride, offset, bytes. Neighbouring values of one treatment are one piece, so that a
/// few copies of 8 to 64 bytes say all of a body. Cost: a row of each array that has a part in it.
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

static void plan_field(const scree_field *field, int dimension)
{
    message_plan *plan = &plans[dimension - 2][kind_of(field)];
    const message_piece next = {slot_of(field),
                                field->array_offset,
                                field->stride,
                                field->offset,
                                (size_t)scree_components(field->components, dimension) * scree_field_size(field->type),
                                field->ghosts};
    // Only integers can be added in any order.
    assert(field->ghosts != SCREE_GHOSTS_ADD_BACK || field->type == SCREE_FIELD_INT64);
    if (plan->count > 0 && prolongs(&plan->piece[plan->count - 1], &next)) return;
    assert(plan->count < MOST_PIECES);
    plan->piece[plan->count++] = next;
}

static void make_plans(void)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        for (int dimension = 2; dimension <= 3; dimension++)
            if (field->ghosts != SCREE_GHOSTS_NONE && scree_field_exists(field, dimension))
                plan_field(field, dimension);
    }
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
        if (first_of(state, &plan->piece[k])) bytes += plan->piece[k].bytes;
    return bytes;
}

/// Copies as many bytes; the frequent numbers are moves of registers.
static inline void copy(unsigned char *to, const unsigned char *from, size_t bytes)
{
    switch (bytes) {
    case 8:
        memcpy(to, from, 8);
        break;
    case 16:
        memcpy(to, from, 16);
        break;
    case 24:
        memcpy(to, from, 24);
        break;
    case 32:
        memcpy(to, from, 32);
        break;
    case 64:
        memcpy(to, from, 64);
        break;
    default:
        memcpy(to, from, bytes);
    }
}

/// A vector plus matrix times shift.
static void pack_shifted(const message_piece *piece, const unsigned char *first, const scree_ghost *ghost, size_t count,
                         const double matrix[9], unsigned char *message)
{
    double vector[3];
    for (size_t k = 0; k < count; k++, message += piece->bytes) {
        const double s[3] = {ghost[k].shift[0], ghost[k].shift[1], ghost[k].shift[2]};
        const unsigned char *from = first + ghost[k].parent * piece->stride;
        double more[3];
        scree_matrix_apply(matrix, s, more);
        memcpy(vector, from, 16);
        vector[0] += more[0];
        vector[1] += more[1];
        memcpy(message, vector, 16);
        if (piece->bytes == 16) continue;
        memcpy(&vector[2], from + 16, 8);
        vector[2] += more[2];
        memcpy(message + 16, &vector[2], 8);
    }
}

void scree_message_pack(const scree_state *state, scree_message_kind kind, const scree_ghost *ghost, size_t count,
                        const scree_message_shift *shift, unsigned char *message)
{
    const message_plan *plan = plan_of(state, kind);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        const unsigned char *first = first_of(state, piece);
        if (!first) continue;
        if (piece->ghosts == SCREE_GHOSTS_POSITION)
            pack_shifted(piece, first, ghost, count, shift->lattice, message);
        else if (piece->ghosts == SCREE_GHOSTS_VELOCITY)
            pack_shifted(piece, first, ghost, count, shift->velocity, message);
        else
            for (size_t k = 0; k < count; k++)
                copy(message + k * piece->bytes, first + ghost[k].parent * piece->stride, piece->bytes);
        message += count * piece->bytes;
    }
}

void scree_message_unpack(scree_state *state, scree_message_kind kind, size_t row, size_t count,
                          const unsigned char *message)
{
    const message_plan *plan = plan_of(state, kind);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        for (size_t k = 0; k < count; k++, message += piece->bytes)
            copy(first + (row + k) * piece->stride, message, piece->bytes);
    }
}

void scree_message_collect(scree_state *state, size_t row, size_t count, unsigned char *message)
{
    const message_plan *plan = plan_of(state, SCREE_MESSAGE_BACK);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        for (size_t k = 0; k < count; k++, message += piece->bytes) {
            static const unsigned char zeros[64];
            unsigned char *from = first + (row + k) * piece->stride;
            copy(message, from, piece->bytes);
            if (piece->bytes <= sizeof zeros)
                copy(from, zeros, piece->bytes);
            else
                memset(from, 0, piece->bytes);
        }
    }
}

/// Adds integers of 64 bits modulo 2^64.
static void add(unsigned char *to, const unsigned char *from, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += 8) {
        uint64_t sum, more;
        memcpy(&sum, to + at, 8);
        memcpy(&more, from + at, 8);
        sum += more;
        memcpy(to + at, &sum, 8);
    }
}

void scree_message_add(scree_state *state, const scree_ghost *ghost, size_t count, const unsigned char *message)
{
    const message_plan *plan = plan_of(state, SCREE_MESSAGE_BACK);
    for (size_t p = 0; p < plan->count; p++) {
        const message_piece *piece = &plan->piece[p];
        unsigned char *first = first_of(state, piece);
        if (!first) continue;
        for (size_t k = 0; k < count; k++, message += piece->bytes)
            add(first + ghost[k].parent * piece->stride, message, piece->bytes);
    }
}
