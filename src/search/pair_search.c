/// Choice of the search that this machine runs best.
#include "search/pair_search.h"

#include "base/processor.h"

scree_pair_search *scree_pair_search_get(int instruction_set)
{
#if defined(__x86_64__)
    if (instruction_set == 0) instruction_set = scree_processor_level();
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
    scree_release(&chunk->element.pair);
    *chunk = (scree_pair_chunk){0};
}
