/// A 64-bit checksum over words: recognises any accidental change of a file or a state; no protection against malice.
/// Method: multiply-xorshift, the finaliser of SplitMix (Steele, Lea and Flood 2014), chained. About 2 ns a word.
#ifndef SCREE_BASE_CHECKSUM_H
#define SCREE_BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t scree_checksum_word(uint64_t checksum, uint64_t word)
{
    uint64_t z = (checksum ^ word) + UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/// A number by its bits; zeros without their sign and all NaN alike, since neither says anything about the physics.
static inline uint64_t scree_checksum_number(uint64_t checksum, double number)
{
    uint64_t word = 0;
    if (number != number)
        word = UINT64_C(0x7ff8000000000000);
    else if (number != 0)
        memcpy(&word, &number, sizeof word);
    return scree_checksum_word(checksum, word);
}

static inline uint64_t scree_checksum_numbers(uint64_t checksum, const double *numbers, size_t count)
{
    for (size_t k = 0; k < count; k++) checksum = scree_checksum_number(checksum, numbers[k]);
    return checksum;
}

/// Any number of bytes; the last word is filled with zeros.
static inline uint64_t scree_checksum_bytes(uint64_t checksum, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (; size > 0; size -= size < 8 ? size : 8, at += 8) {
        uint64_t word = 0;
        memcpy(&word, at, size < 8 ? size : 8);
        checksum = scree_checksum_word(checksum, word);
    }
    return checksum;
}

#endif
