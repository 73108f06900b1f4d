/// Rows of four 64-bit numbers to lanes and back: body rows, sum rows, histories and constants are rows of 32 bytes,
/// which are loaded whole and transposed in registers. No gather, no scatter; and because rows are added one after the
/// other, several contacts of one group may share a body. Only for files with more than one lane (kernels).
#ifndef SCREE_CONTACT_ROWS_H
#define SCREE_CONTACT_ROWS_H

#include "contact/lanes.h"

typedef double row4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef uint64_t row4_bits __attribute__((vector_size(32), aligned(8), may_alias));
typedef float row4_single __attribute__((vector_size(16), aligned(4), may_alias));

/// The four columns of `SCREE_LANES` rows: lane k of column c is row[k][c].
typedef struct columns {
    lanes c0, c1, c2, c3;
} columns;

#define SHUFFLE __builtin_shufflevector

#if SCREE_LANES == 2

SCREE_INLINE columns columns_of_rows(const row4 row[2])
{
    row4 a = row[0], b = row[1];
    return (columns){SHUFFLE(a, b, 0, 4), SHUFFLE(a, b, 1, 5), SHUFFLE(a, b, 2, 6), SHUFFLE(a, b, 3, 7)};
}

SCREE_INLINE void columns_to_rows(columns c, row4 row[2])
{
    lanes low = SHUFFLE(c.c0, c.c1, 0, 2), high = SHUFFLE(c.c2, c.c3, 0, 2);
    row[0] = SHUFFLE(low, high, 0, 1, 2, 3);
    low = SHUFFLE(c.c0, c.c1, 1, 3), high = SHUFFLE(c.c2, c.c3, 1, 3);
    row[1] = SHUFFLE(low, high, 0, 1, 2, 3);
}

#elif SCREE_LANES == 4

SCREE_INLINE columns columns_transpose(lanes a, lanes b, lanes c, lanes d)
{
    lanes ab_even = SHUFFLE(a, b, 0, 4, 2, 6), ab_odd = SHUFFLE(a, b, 1, 5, 3, 7);
    lanes cd_even = SHUFFLE(c, d, 0, 4, 2, 6), cd_odd = SHUFFLE(c, d, 1, 5, 3, 7);
    return (columns){SHUFFLE(ab_even, cd_even, 0, 1, 4, 5), SHUFFLE(ab_odd, cd_odd, 0, 1, 4, 5),
                     SHUFFLE(ab_even, cd_even, 2, 3, 6, 7), SHUFFLE(ab_odd, cd_odd, 2, 3, 6, 7)};
}

SCREE_INLINE columns columns_of_rows(const row4 row[4])
{
    return columns_transpose(row[0], row[1], row[2], row[3]);
}

SCREE_INLINE void columns_to_rows(columns c, row4 row[4])
{
    columns rows = columns_transpose(c.c0, c.c1, c.c2, c.c3);
    row[0] = rows.c0, row[1] = rows.c1, row[2] = rows.c2, row[3] = rows.c3;
}

#else

/// Rows a and b side by side.
SCREE_INLINE lanes row4_join(row4 a, row4 b)
{
    return SHUFFLE(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

SCREE_INLINE columns columns_of_rows(const row4 row[8])
{
    lanes r02 = row4_join(row[0], row[2]), r13 = row4_join(row[1], row[3]);
    lanes r46 = row4_join(row[4], row[6]), r57 = row4_join(row[5], row[7]);
    lanes low_even = SHUFFLE(r02, r13, 0, 8, 2, 10, 4, 12, 6, 14),
          low_odd = SHUFFLE(r02, r13, 1, 9, 3, 11, 5, 13, 7, 15);
    lanes high_even = SHUFFLE(r46, r57, 0, 8, 2, 10, 4, 12, 6, 14),
          high_odd = SHUFFLE(r46, r57, 1, 9, 3, 11, 5, 13, 7, 15);
    return (columns){SHUFFLE(low_even, high_even, 0, 1, 4, 5, 8, 9, 12, 13),
                     SHUFFLE(low_odd, high_odd, 0, 1, 4, 5, 8, 9, 12, 13),
                     SHUFFLE(low_even, high_even, 2, 3, 6, 7, 10, 11, 14, 15),
                     SHUFFLE(low_odd, high_odd, 2, 3, 6, 7, 10, 11, 14, 15)};
}

SCREE_INLINE void columns_to_rows(columns c, row4 row[8])
{
    lanes even = SHUFFLE(c.c0, c.c1, 0, 8, 2, 10, 4, 12, 6, 14), odd = SHUFFLE(c.c0, c.c1, 1, 9, 3, 11, 5, 13, 7, 15);
    lanes even2 = SHUFFLE(c.c2, c.c3, 0, 8, 2, 10, 4, 12, 6, 14), odd2 = SHUFFLE(c.c2, c.c3, 1, 9, 3, 11, 5, 13, 7, 15);
    row[0] = SHUFFLE(even, even2, 0, 1, 8, 9), row[1] = SHUFFLE(odd, odd2, 0, 1, 8, 9);
    row[2] = SHUFFLE(even, even2, 2, 3, 10, 11), row[3] = SHUFFLE(odd, odd2, 2, 3, 10, 11);
    row[4] = SHUFFLE(even, even2, 4, 5, 12, 13), row[5] = SHUFFLE(odd, odd2, 4, 5, 12, 13);
    row[6] = SHUFFLE(even, even2, 6, 7, 14, 15), row[7] = SHUFFLE(odd, odd2, 6, 7, 14, 15);
}

#endif

#if SCREE_LANES == 8

typedef double row8 __attribute__((vector_size(64), aligned(8), may_alias));

/// The first four and the last four columns of rows of eight.
SCREE_INLINE void columns_of_long_rows(const row8 row[8], columns half[2])
{
    lanes even[4], odd[4], first[4], second[4];
    for (int k = 0; k < 4; k++) {
        even[k] = SHUFFLE((lanes)row[2 * k], (lanes)row[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        odd[k] = SHUFFLE((lanes)row[2 * k], (lanes)row[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int k = 0; k < 2; k++) {
        first[k] = SHUFFLE(even[2 * k], even[2 * k + 1], 0, 1, 4, 5, 8, 9, 12, 13);
        first[k + 2] = SHUFFLE(odd[2 * k], odd[2 * k + 1], 0, 1, 4, 5, 8, 9, 12, 13);
        second[k] = SHUFFLE(even[2 * k], even[2 * k + 1], 2, 3, 6, 7, 10, 11, 14, 15);
        second[k + 2] = SHUFFLE(odd[2 * k], odd[2 * k + 1], 2, 3, 6, 7, 10, 11, 14, 15);
    }
    half[0] = (columns){SHUFFLE(first[0], first[1], 0, 1, 4, 5, 8, 9, 12, 13),
                        SHUFFLE(first[2], first[3], 0, 1, 4, 5, 8, 9, 12, 13),
                        SHUFFLE(second[0], second[1], 0, 1, 4, 5, 8, 9, 12, 13),
                        SHUFFLE(second[2], second[3], 0, 1, 4, 5, 8, 9, 12, 13)};
    half[1] = (columns){SHUFFLE(first[0], first[1], 2, 3, 6, 7, 10, 11, 14, 15),
                        SHUFFLE(first[2], first[3], 2, 3, 6, 7, 10, 11, 14, 15),
                        SHUFFLE(second[0], second[1], 2, 3, 6, 7, 10, 11, 14, 15),
                        SHUFFLE(second[2], second[3], 2, 3, 6, 7, 10, 11, 14, 15)};
}

#endif

#define LANE_LOOP _Pragma("GCC unroll 8") for (int k = 0; k < SCREE_LANES; k++)

SCREE_INLINE columns columns_load(const double *const position[SCREE_LANES])
{
    row4 row[SCREE_LANES];
    LANE_LOOP row[k] = *(const row4 *)position[k];
    return columns_of_rows(row);
}

/// Rows of four single-precision numbers.
SCREE_INLINE columns columns_load_single(const float *const position[SCREE_LANES])
{
    row4 row[SCREE_LANES];
    LANE_LOOP row[k] = __builtin_convertvector(*(const row4_single *)position[k], row4);
    return columns_of_rows(row);
}

#endif
