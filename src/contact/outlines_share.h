/// What two outlines share (shape/overlap.h), in lanes or of one pair.
#ifndef SCREE_CONTACT_OUTLINES_SHARE_H
#define SCREE_CONTACT_OUTLINES_SHARE_H

#include "contact/lanes.h"
#include "shape/overlap.h"

/// It, and what the geometry reads of the two bodies beside their rows. All zero where the outlines do not meet, but
/// for what is of the bodies.
typedef struct outlines_share {
    lanes_bits meet;     ///< masks: the outlines meet;
    lanes_bits twice;    ///< they cross twice;
    lanes_bits useless;  ///< no law can use it (flags)
    lanes area;          ///< m2
    lanes chord[2];      ///< m
    lanes arm[2][2];     ///< m
    lanes edge[2][2][2]; ///< m
    lanes radius[2];     ///< m, of the discs of equal area
    lanes turning[2];    ///< m, what inertia is of (state->form)
} outlines_share;

#if SCREE_LANES == 1
#define OUTLINES_LANE(member, k) (member)
#else
#define OUTLINES_LANE(member, k) (member)[k]
#endif

/// NULL: nothing.
SCREE_INLINE void outlines_share_put(outlines_share *share, int k, const scree_overlap *overlap)
{
    static const scree_overlap none;
    const scree_overlap *o = overlap ? overlap : &none;
    (void)k;
    OUTLINES_LANE(share->meet, k) = -(uint64_t)(overlap != NULL);
    OUTLINES_LANE(share->twice, k) = -(uint64_t)(o->crossings == 2);
    OUTLINES_LANE(share->useless, k) = -(uint64_t)(o->flags != 0);
    OUTLINES_LANE(share->area, k) = o->area;
    for (int i = 0; i < 2; i++) {
        OUTLINES_LANE(share->chord[i], k) = o->chord[i];
        for (int b = 0; b < 2; b++) {
            OUTLINES_LANE(share->arm[b][i], k) = o->arm[b][i];
            for (int e = 0; e < 2; e++) OUTLINES_LANE(share->edge[e][b][i], k) = o->edge[e][b][i];
        }
    }
}

/// What is of one of the bodies.
SCREE_INLINE void outlines_share_body(outlines_share *share, int k, int body, double radius, double turning)
{
    (void)k;
    OUTLINES_LANE(share->radius[body], k) = radius;
    OUTLINES_LANE(share->turning[body], k) = turning;
}

/// Of lanes where the mask is not set, and of the bodies, it becomes that of `other`.
SCREE_INLINE void outlines_share_keep(lanes_bits mask, outlines_share *s, const outlines_share *other)
{
    s->meet = (mask & s->meet) | (~mask & other->meet);
    s->twice = (mask & s->twice) | (~mask & other->twice);
    s->useless = (mask & s->useless) | (~mask & other->useless);
    s->area = lanes_select(mask, s->area, other->area);
    for (int i = 0; i < 2; i++) {
        s->radius[i] = other->radius[i];
        s->turning[i] = other->turning[i];
        s->chord[i] = lanes_select(mask, s->chord[i], other->chord[i]);
        for (int k = 0; k < 2; k++) {
            s->arm[k][i] = lanes_select(mask, s->arm[k][i], other->arm[k][i]);
            for (int e = 0; e < 2; e++)
                s->edge[e][k][i] = lanes_select(mask, s->edge[e][k][i], other->edge[e][k][i]);
        }
    }
}

#endif
