/// The kernel of spheres: contact/pairs.h with the dimension as a constant.
#include "contact/pairs.h"

void KERNEL_NAME(scree_solid_pairs_v, SCREE_ISA)(contact_job *job)
{
    run_variant(job, 3);
}
