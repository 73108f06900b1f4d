/// The scalar core: pairs one at a time with runtime arguments, and wall contacts. Same bits as the kernels.
#ifndef SCREE_CONTACT_REFERENCE_H
#define SCREE_CONTACT_REFERENCE_H

#include "contact/job.h"
#include "state/plates.h"
#include "state/work.h"

/// Adds the forces of the job's pairs to its sums and its totals. Needs no near_touched.
void contact_pairs_reference(contact_job *job);

/// Adds the contacts with plates of bodies in rows [row_begin, row_end), those under the job's law, to its sums and
/// totals.
void contact_walls(contact_job *job, const scree_wall *wall, const scree_wall_pair_list *pairs, size_t row_begin,
                   size_t row_end);

/// Totals before any contact, and the sum of two.
contact_totals contact_totals_none(void);
void contact_totals_add(contact_totals *into, const contact_totals *more);

#endif
