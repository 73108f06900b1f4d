/// The kernel of outlines under laws of areas: pairs one after the other, with law and geometry as constants, and the
/// corners of each in lanes (shape/polygon_crossings_lanes.h).
#define SCREE_LANES 1
#include "base/kernel_name.h"
#include "contact/one_by_one.h"
#include "contact/reference.h"

#define PAIRS_OF_LAW(law_)                                                                                             \
    if (law_##_traits[0].areas && v.law == SCREE_SLOT_##law_ && v.geometry == GEOMETRY_outlines && v.ledger) {         \
        evaluate_range(job, (variant){2, SCREE_SLOT_##law_, 0, true, true, v.moments, GEOMETRY_outlines});             \
        return;                                                                                                        \
    }

void SCREE_KERNEL_NAME(scree_outlines)(contact_job *job)
{
    const variant v = job->variant;
    job->totals = contact_totals_none();
    SCREE_LAWS(PAIRS_OF_LAW)
    contact_pairs_reference(job); // without a ledger
}
