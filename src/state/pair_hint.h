/// What a pair of outlines is known to be like in poses near one in which it was looked at (shape/polygon_hint.h): kept
/// beside the pair list, clear in a new one, and of no effect on any number.
#ifndef SCREE_STATE_PAIR_HINT_H
#define SCREE_STATE_PAIR_HINT_H

#include <stdint.h>

typedef struct scree_pair_hint {
    float pose[4]; ///< the second centre from the first [m], the angles of both [rad]
    float room;    ///< m, how far a corner of one may move against the other: above 0 the outlines cross twice, below 0
                   ///< they lie apart, each for so long; 0: nothing is known
    int8_t edge[4]; ///< with two crossings: the edge of the first and that of the second where the outline of the first
                    ///< goes in, then where it comes out; else edge[0] as scree_polygon_uncrossed tells it, or 0
} scree_pair_hint;

#endif
