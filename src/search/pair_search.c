/// Choice of the search that this machine runs best.
#include "search/pair_search.h"

scree_pair_search *scree_pair_search_get(int instruction_set)
{
#if defined(__x86_64__)
    if (instruction_set == 0) {
        bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
        bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
        instruction_set = v4 ? 4 : v3 ? 3 : 2;
    }
    return instruction_set == 4   ? scree_pair_search_v4
           : instruction_set == 3 ? scree_pair_search_v3
                                  : scree_pair_search_v2;
#else
    (void)instruction_set;
    return scree_pair_search_v0;
#endif
}

void scree_pair_chunk_destroy(scree_pair_chunk *chunk)
{
    scree_release(&chunk->touching.pair);
    scree_release(&chunk->near.pair);
    scree_release(&chunk->wall.pair);
    *chunk = (scree_pair_chunk){0};
}
