/// Overlaps of COUNT random pairs of polygons from number FIRST on against the exact area, and their symmetries: what
/// tests/unit/test_polygon_overlap.c does with 50,000, for as many as one has time for. Prints the counts a kind;
/// status 1 if anything does not hold.
///     check_polygons COUNT [FIRST]
#include "polygon_pairs.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static void tell(const char *name, const pair_tally *t)
{
    (void)printf("%-17s %9" PRIu64 " pairs: %9" PRIu64 " apart, %9" PRIu64 " two crossings, %8" PRIu64
                 " more, %8" PRIu64 " inside; %7" PRIu64 " of no area met, %7" PRIu64
                 " too thin to be met; largest error %.2f; %" PRIu64 " flat, %" PRIu64 " wrong, %" PRIu64 " unequal\n",
                 name, t->pairs, t->apart, t->two, t->more, t->inside, t->touching, t->thin, t->worst, t->flat,
                 t->wrong, t->unequal);
}

int main(int argc, char **argv)
{
    uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 0, first = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
    if (count == 0) {
        (void)fprintf(stderr, "usage: check_polygons COUNT [FIRST]\n");
        return 2;
    }
    static pair_tally tally[PAIR_KINDS];
    static exact_clip clip;
    exact_init(&clip);
    for (uint64_t id = first; id < first + count; id++) {
        pair_sample sample;
        pair_make(id, &sample);
        if (!pair_check(&clip, &sample, &tally[sample.kind]))
            (void)printf("pair %" PRIu64 " (%s) does not hold\n", id, pair_names[sample.kind]);
    }
    exact_clear(&clip);
    bool bad = false;
    for (int k = 0; k < PAIR_KINDS; k++) {
        tell(pair_names[k], &tally[k]);
        bad = bad || tally[k].wrong > 0 || tally[k].unequal > 0;
    }
    return bad;
}
