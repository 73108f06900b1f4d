/// Philox 4x32-10 (Salmon et al. 2011): ten rounds of multiply-high, exclusive-or and key schedule on a 128-bit
/// counter.
#include "base/random.h"

#include <math.h>

enum { ROUNDS = 10 };

void scree_random_words(uint64_t seed, uint32_t stream, uint64_t counter, uint32_t words[4])
{
    uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
    uint32_t c[4] = {(uint32_t)counter, (uint32_t)(counter >> 32), stream, 0};
    for (int round = 0; round < ROUNDS; round++) {
        uint64_t p0 = (uint64_t)c[0] * UINT32_C(0xD2511F53);
        uint64_t p1 = (uint64_t)c[2] * UINT32_C(0xCD9E8D57);
        uint32_t next[4] = {(uint32_t)(p1 >> 32) ^ c[1] ^ key[0], (uint32_t)p1, (uint32_t)(p0 >> 32) ^ c[3] ^ key[1],
                            (uint32_t)p0};
        for (int i = 0; i < 4; i++) c[i] = next[i];
        key[0] += UINT32_C(0x9E3779B9);
        key[1] += UINT32_C(0xBB67AE85);
    }
    for (int i = 0; i < 4; i++) words[i] = c[i];
}

/// 53 bits of two words on [0, 1).
static double unit_interval(uint32_t low, uint32_t high)
{
    uint64_t bits = ((uint64_t)high << 32 | low) >> 11;
    return (double)bits * 0x1p-53;
}

double scree_random_uniform(uint64_t seed, uint32_t stream, uint64_t counter)
{
    uint32_t words[4];
    scree_random_words(seed, stream, counter, words);
    return unit_interval(words[0], words[1]);
}

double scree_random_normal(uint64_t seed, uint32_t stream, uint64_t counter)
{
    uint32_t words[4];
    scree_random_words(seed, stream, counter, words);
    double u = 1.0 - unit_interval(words[0], words[1]);
    double v = unit_interval(words[2], words[3]);
    return sqrt(-2.0 * log(u)) * cos(2.0 * M_PI * v);
}
