/// The kernel of discs: contact/pairs.h with the dimension as a constant.
#include "contact/pairs.h"

void KERNEL_NAME(scree_plane_pairs_v, SCREE_ISA)(contact_job *job)
{
    run_variant(job, 2);
}
