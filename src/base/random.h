/// Counter-based random numbers: Philox 4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel random numbers: as easy as
/// 1, 2, 3"). A value is a pure function of (seed, stream, counter): the same on any machine and for any thread count.
#ifndef SCREE_BASE_RANDOM_H
#define SCREE_BASE_RANDOM_H

#include <stdint.h>

/// One stream per purpose, so that a new use never shifts the numbers of an old one.
typedef enum scree_random_stream {
    SCREE_RANDOM_RADIUS = 1,
    SCREE_RANDOM_POSITION = 2,
    SCREE_RANDOM_VELOCITY = 3,
    SCREE_RANDOM_BED = 4,
    SCREE_RANDOM_SPECIES = 5,
    SCREE_RANDOM_STRENGTH = 6,
    SCREE_RANDOM_SHUFFLE = 9,
    SCREE_RANDOM_EIGENVECTOR = 10,
    SCREE_RANDOM_CORNER = 11,
    SCREE_RANDOM_CORNER_COUNT = 12,
    SCREE_RANDOM_BIRTH_PLACE = 13,
    SCREE_RANDOM_BIRTH_MOTION = 14,
    SCREE_RANDOM_BOOTSTRAP = 15,
    SCREE_RANDOM_TEST = 100,
} scree_random_stream;

/// Four independent 32-bit words.
void scree_random_words(uint64_t seed, uint32_t stream, uint64_t counter, uint32_t words[4]);

/// Uniform on [0, 1), 53 bits, from words 0 and 1 of the block.
double scree_random_uniform(uint64_t seed, uint32_t stream, uint64_t counter);

/// Standard normal (Box-Muller on one block).
double scree_random_normal(uint64_t seed, uint32_t stream, uint64_t counter);

#endif
